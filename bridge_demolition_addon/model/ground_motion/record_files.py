"""CSV files of ground motion: accelerograms of the user, and the record of a run."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np

from ...engineering.ground_motion import GroundRecord, integrated
from ...errors import ScenarioError, UnreadableError
from ...system.reading import MEGABYTE, csv_rows, file_text
from ..schema import shown
from .settings import DIRECTIONS

_MOST_BYTES = 50 * MEGABYTE
"""Size up to which a record is read: half an hour of three components at 200 a second has 20 MB."""

_MOST_RECORD_BYTES = 200 * MEGABYTE

_LEAST_ROWS = 4

_GAP = 1.5
"""A step longer than the middle one by this factor is a gap: sampling is even but for the rounding of the times."""

_QUANTITIES = (
    ("acceleration", "m_s2", "accelerations_m_s2"),
    ("velocity", "m_s", "velocities_m_s"),
    ("displacement", "m", "displacements_m"),
)

_HEADING = ("time_s", *(f"{name}_{direction}_{unit}" for name, unit, _ in _QUANTITIES for direction in DIRECTIONS))


def accelerogram_from_file(path: Path, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Return times (k,) in s and accelerations (k, columns) in the file's unit, from rows of these."""
    try:
        text = file_text(path, _MOST_BYTES)
    except UnreadableError as error:
        raise ScenarioError(f'ground_motion.file is "{path}": {error}') from error
    separator = ";" if ";" in text else ","
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    try:
        rows = [(number, row) for number, row in enumerate(lines, start=1) if any(map(str.strip, row))]
    except csv.Error as error:
        raise ScenarioError(f'ground_motion.file is "{path}": {error}') from error
    if rows and not any(map(_is_number, rows[0][1])):
        del rows[0]
    if len(rows) < _LEAST_ROWS:
        raise ScenarioError(f"{path}: expected an accelerogram of at least {_LEAST_ROWS} rows, found {len(rows)}")
    values = np.array([_row(path, number, row, columns) for number, row in rows])
    _check_times(path, [number for number, _ in rows], values[:, 0])
    return values[:, 0], values[:, 1:]


def _row(path: Path, number: int, row: list[str], columns: int) -> list[float]:
    if len(row) != columns + 1:
        raise ScenarioError(
            f"{path}, row {number}: has {len(row)} columns: expected {columns + 1}, the time in s and an acceleration "
            "for each of ground_motion.directions, with a point in decimals"
        )
    try:
        numbers = list(map(float, row))
    except ValueError as error:
        raise ScenarioError(f"{path}, row {number}: expected numbers, found {shown(', '.join(row))}") from error
    if not np.isfinite(numbers).all():
        raise ScenarioError(f"{path}, row {number}: expected finite numbers, found {shown(', '.join(row))}")
    return numbers


def _check_times(path: Path, rows: list[int], times_s: np.ndarray) -> None:
    steps = np.diff(times_s)
    backwards = np.flatnonzero(steps <= 0.0)
    if len(backwards):
        row = int(backwards[0])
        raise ScenarioError(
            f"{path}, row {rows[row + 1]}: the time is {times_s[row + 1]:g} s after {times_s[row]:g} s: expected times "
            "that increase"
        )
    usual = float(np.median(steps))
    gaps = np.flatnonzero(steps > _GAP * usual)
    if len(gaps):
        row = int(gaps[0])
        raise ScenarioError(
            f"{path}, row {rows[row + 1]}: a gap of {steps[row]:g} s after {times_s[row]:g} s, where samples are "
            f"{usual:g} s apart: expected an accelerogram without gaps"
        )


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def record_text(record: GroundRecord, start_s: float) -> str:
    """Return a record as CSV: simulated time, then acceleration, velocity and displacement along, across and up."""
    columns = [start_s + record.times_s, *(getattr(record, name) for _, _, name in _QUANTITIES)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_HEADING)
    writer.writerows(np.column_stack(columns).tolist())
    return text.getvalue()


def read_record(path: Path) -> tuple[GroundRecord, float]:
    """Return a record that `record_text` wrote, and the time at which it begins."""
    try:
        rows = list(csv_rows(path, _MOST_RECORD_BYTES))
        values = np.array(rows[1:], float)
    except (UnreadableError, ValueError) as error:
        raise ScenarioError(f"{path}: expected the motion of the ground ({error})") from error
    if not rows or tuple(rows[0]) != _HEADING or len(values) < 2 or not np.isfinite(values).all():
        raise ScenarioError(f"{path}: expected the motion of the ground")
    return integrated(values[:, 0], values[:, 1:4]), float(values[0, 0])
