"""All logs of a recording."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engineering.elasticity.crack_state import FrameCracks
from ...engineering.geometry.vectors import dot
from ...errors import OutputError, SimulationError
from ...model.blast.explosion import StepLoads
from ...model.results.frames import Frame, Inventory
from ...model.run_folder.files import BAR_LOG, BEARING_LOG, BREAKING_LOG, DEBRIS_LOG, EXPLOSION_LOG, FORCE_LOG
from ...model.run_folder.logs import (
    BAR_TABLE,
    BEARING_TABLE,
    BREAKING_TABLE,
    DEBRIS_TABLE,
    EXPLOSION_TABLE,
    FORCE_TABLE,
    BodyLog,
    EntryLog,
    Flights,
    FrameBearings,
    FrameBlast,
)
from ...model.schema import given
from ...system.disk import writing
from .breaking import Breaks


@dataclass(frozen=True, slots=True)
class LogFiles:
    """Files of their own for logs; None for the folder of the results."""

    forces: Path | None = None
    debris: Path | None = None


_IN_THE_FOLDER = LogFiles()


class Logs:
    """All logs of a recording, in an existing folder, in which they replace others.

    Charges are named where there is a blast, bearings where there are any; `files` says which logs go elsewhere.
    """

    def __init__(
        self,
        folder: Path,
        inventory: Inventory,
        charges: Sequence[str] = (),
        bearings: Sequence[str] = (),
        files: LogFiles = _IN_THE_FOLDER,
    ):
        bodies = inventory.body_names.tolist()
        self._folder, self._inventory, self._charges, self._bearings = folder, inventory, charges, bearings
        self._forces = BodyLog(files.forces or folder / FORCE_LOG, FORCE_TABLE, bodies)
        self._debris = BodyLog(files.debris or folder / DEBRIS_LOG, DEBRIS_TABLE, bodies)
        self._breaking = EntryLog(folder / BREAKING_LOG, BREAKING_TABLE)
        self._explosion = EntryLog(folder / EXPLOSION_LOG, EXPLOSION_TABLE) if charges else None
        self._bearing = EntryLog(folder / BEARING_LOG, BEARING_TABLE) if bearings else None
        self._bars: EntryLog[FrameCracks] | None = None
        self._first_positions: np.ndarray | None = None
        self._made_j = np.zeros(len(bodies))
        self._largest_kinetic_j = np.zeros(len(bodies))

    def write_frame(self, frame: Frame) -> None:
        """Log the loads of a frame; of the first frame, also all positions."""
        if not self._breaking.in_place:
            raise SimulationError(f"{self._folder}: was moved or deleted while a run wrote to it")
        self._forces.write(frame.number, frame.time_s, frame)
        self._made_j += np.nan_to_num(frame.work.made_j)
        kinetic = 0.5 * self._inventory.masses_kg * dot(frame.velocities_m_s, frame.velocities_m_s)
        self._largest_kinetic_j = np.maximum(self._largest_kinetic_j, kinetic)
        if self._first_positions is None:
            self._first_positions = frame.positions_m
            self._write_positions(frame)

    def write_breaks(self, frame: int, breaks: Sequence[Breaks]) -> None:
        """Log the connections that broke in a frame, with the loads that broke them."""
        names, bodies, pairs = self._inventory.connection_names, self._inventory.body_names, self._inventory.pairs
        for at_once in breaks:
            entries = [(names[row], *bodies[pairs[row]]) for row in at_once.connections]
            self._breaking.write(frame, at_once.time_s, entries, at_once.loads)

    def write_blast(self, frame: Frame, loads: StepLoads, frame_s: float) -> None:
        """Log the blast loads of a frame of a length in s; pressures and forces are means over it."""
        bodies = self._inventory.body_names
        pairs = zip(loads.bodies, loads.charges, strict=True)
        entries = [(bodies[body], self._charges[charge]) for body, charge in pairs]
        given(self._explosion).write(frame.number, frame.time_s, entries, FrameBlast(loads, frame_s))

    def write_bearings(self, frame: Frame, bearings: FrameBearings) -> None:
        """Log the forces of all bearings in a frame."""
        given(self._bearing).write(frame.number, frame.time_s, [(name,) for name in self._bearings], bearings)

    def begin_bars(self) -> None:
        """Begin the log of bars across cracks."""
        self._bars = EntryLog(self._folder / BAR_LOG, BAR_TABLE)

    def write_bars(self, frame: Frame, entries: Sequence[Sequence[str]], cracks: FrameCracks) -> None:
        """Log bars across cracks in a frame, with the names of each crack and of its members."""
        given(self._bars).write(frame.number, frame.time_s, entries, cracks)

    def close(self, last_frame: Frame | None) -> None:
        """Log all positions of the last frame, if there is one, and close the files.

        Raises an `OutputError` if the disk is full; the files are closed all the same.
        """
        with ExitStack() as files:
            for log in (self._forces, self._debris, self._breaking, self._explosion, self._bearing, self._bars):
                if log:
                    files.callback(log.close)
            if last_frame:
                self._write_positions(last_frame)

    def _write_positions(self, frame: Frame) -> None:
        flights = Flights(given(self._first_positions), frame.positions_m, self._made_j, self._largest_kinetic_j)
        self._debris.write(frame.number, frame.time_s, flights)


def checked_log(path: Path, *, overwrite: bool) -> Path:
    """Return a file for a log after checking that it can be written."""
    if path.is_dir():
        raise OutputError(f"{path}: expected a file for the log, found a folder")
    if path.exists() and not path.is_file():
        raise OutputError(f"{path}: expected a file for the log, found a pipe or a device")
    if path.exists() and not overwrite:
        raise OutputError(f"{path}: exists already; choose another file or allow overwriting")
    with writing(path):
        existed = path.exists()
        path.open("ab").close()  # the only sure way to know; what is in it stays until it is written
        if not existed:
            path.unlink()
    return path
