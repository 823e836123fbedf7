"""The record of a run as a table, for whoever wants to see or use it."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np

from ...engineering.ground_motion.record import GroundRecord, integrated
from ...errors import ScenarioError, UnreadableError
from ...system.reading import MEGABYTE, file_text
from .settings import DIRECTIONS

_MOST_BYTES = 200 * MEGABYTE

_QUANTITIES = (
    ("acceleration", "m_s2", "accelerations_m_s2"),
    ("velocity", "m_s", "velocities_m_s"),
    ("displacement", "m", "displacements_m"),
)

_HEADING = ("time_s", *(f"{name}_{direction}_{unit}" for name, unit, _ in _QUANTITIES for direction in DIRECTIONS))


def record_text(record: GroundRecord, start_s: float) -> str:
    """Return a record as CSV: simulated time, then acceleration, velocity and displacement along, across and up."""
    columns = [start_s + record.times_s, *(getattr(record, name) for _, _, name in _QUANTITIES)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_HEADING)
    writer.writerows(np.column_stack(columns).tolist())
    return text.getvalue()


def read_record(path: Path) -> tuple[GroundRecord, float]:
    """Return a record that `record_text` wrote, and when it begins.

    Raises
    ------
    ScenarioError
        The file cannot be read, or holds something else.
    """
    try:
        rows = list(csv.reader(io.StringIO(file_text(path, _MOST_BYTES))))
        values = np.array(rows[1:], float)
    except (UnreadableError, csv.Error, ValueError) as error:
        raise ScenarioError(f"{path}: expected the motion of the ground ({error})") from error
    if not rows or tuple(rows[0]) != _HEADING or len(values) < 2 or not np.isfinite(values).all():
        raise ScenarioError(f"{path}: expected the motion of the ground")
    return integrated(values[:, 0], values[:, 1:4]), float(values[0, 0])
