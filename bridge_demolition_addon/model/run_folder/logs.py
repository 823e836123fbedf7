"""The logs of a run: CSV files that grow by whole lines, frame by frame, and are read again where a run was killed."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

import numpy as np

from ...engineering.elasticity.crack_state import FrameCracks
from ...engineering.mechanics.bearing_loads import BearingLoads
from ...engineering.mechanics.section_cuts import SectionForces
from ...engineering.mechanics.stress import principal_stresses
from ...errors import OutputError, UnreadableError
from ...system.disk import is_in_place, writing
from ...system.reading import MEGABYTE, check_file, csv_cell, csv_rows
from ..blast.explosion import StepLoads
from ..results.energy import flies_on_solver_energy
from ..results.frames import Frame
from ..results.motion import throw, travel
from .files import BREAKING_LOG, FORCE_LOG

Source = TypeVar("Source")
"""Type of the source of a log's values."""

_STARTS = ("frame", "time_s")
_XYZ = ("x", "y", "z")


@dataclass(frozen=True, slots=True)
class LogColumn(Generic[Source]):
    """A value of a log. One that has parts, such as a vector, takes a column of the file for each."""

    name: str  # in the header; may be empty
    unit: str  # in the header; may be empty
    value: Callable[[Source], np.ndarray]  # returns (n,) or (n, parts) values for n lines
    parts: tuple[str, ...] = ("",)  # in the header, between name and unit

    @property
    def headers(self) -> list[str]:
        """Header of each column of the file."""
        return ["_".join(filter(None, (self.name, part, self.unit))) for part in self.parts]


@dataclass(frozen=True, slots=True)
class LogTable(Generic[Source]):
    """All columns of a log: frame and time, names, and values."""

    names: tuple[str, ...]
    columns: tuple[LogColumn[Source], ...]

    @property
    def value_headers(self) -> list[str]:
        """Headers of the columns that hold numbers."""
        return [header for column in self.columns for header in column.headers]

    @property
    def headers(self) -> list[str]:
        """Headers of the file's columns."""
        return [*_STARTS, *self.names, *self.value_headers]

    def values(self, source: Source) -> np.ndarray:
        """Return the values (n, k), line by line; a zero has no sign."""
        return np.column_stack([column.value(source) for column in self.columns]) + 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Flights:
    """Where n bodies are, and what may have moved them."""

    first_m: np.ndarray  # (n, 3), positions in the first frame
    last_m: np.ndarray  # (n, 3), positions now
    made_j: np.ndarray  # (n,), energy that the solver made
    largest_kinetic_j: np.ndarray  # (n,), so far

    @property
    def throws_m(self) -> np.ndarray:
        """Horizontal distances (n,)."""
        return throw(self.first_m, self.last_m)


@dataclass(frozen=True, slots=True, eq=False)
class FrameBlast:
    """Blast loads in a frame, and its length."""

    loads: StepLoads
    frame_s: float

    @property
    def forces_n(self) -> np.ndarray:
        """Mean forces (n,)."""
        return self.loads.impulses_ns / self.frame_s


@dataclass(frozen=True, slots=True, eq=False)
class FrameBearings:
    """Forces of b bearings in a frame, and the part (b,) of the connections of each that is there at its end."""

    loads: BearingLoads
    intact: np.ndarray


FORCE_TABLE: LogTable[Frame] = LogTable(
    ("body",),
    (
        LogColumn("force", "N", lambda frame: frame.loads.body_forces_n, _XYZ),
        LogColumn("force_sum", "N", lambda frame: frame.loads.body_sums_n),
        LogColumn("peak_force", "N", lambda frame: frame.loads.body_peaks_n),
        LogColumn("peak_force_sum", "N", lambda frame: frame.loads.body_peak_sums_n),
        LogColumn("contact_impulse", "Ns", lambda frame: frame.loads.body_contact_impulses_ns, _XYZ),
        LogColumn("signed_2019", "N", lambda frame: frame.loads.body_signed_2019_n),
        LogColumn("stress", "Pa", lambda frame: principal_stresses(frame.loads.stresses_pa), ("largest", "smallest")),
        LogColumn("von_mises", "Pa", lambda frame: frame.loads.von_mises_pa),
        LogColumn("asleep", "", lambda frame: frame.asleep),
    ),
)
DEBRIS_TABLE: LogTable[Flights] = LogTable(
    ("body",),
    (
        LogColumn("", "m", lambda flights: flights.last_m, _XYZ),
        LogColumn("distance", "m", lambda flights: travel(flights.first_m, flights.last_m)),
        LogColumn("throw", "m", lambda flights: flights.throws_m),
        LogColumn("made_by_solver", "J", lambda flights: flights.made_j),
        LogColumn(
            "on_solver_energy",
            "",
            lambda flights: flies_on_solver_energy(flights.throws_m, flights.made_j, flights.largest_kinetic_j),
        ),
    ),
)
BREAKING_TABLE: LogTable[SectionForces] = LogTable(
    ("connection", "first_body", "second_body"),
    (
        LogColumn("axial", "N", lambda loads: loads.axial_n),
        LogColumn("shear", "N", lambda loads: loads.shear_n, ("y", "z")),
        LogColumn("torsion", "Nm", lambda loads: loads.torsion_nm),
        LogColumn("bending", "Nm", lambda loads: loads.bending_nm, ("y", "z")),
    ),
)
EXPLOSION_TABLE: LogTable[FrameBlast] = LogTable(
    ("body", "charge"),
    (
        LogColumn("stand_off", "m", lambda blast: blast.loads.stand_offs_m),
        LogColumn("scaled_distance", "m_kg13", lambda blast: blast.loads.scaled_distances),
        LogColumn("projected_area", "m2", lambda blast: blast.loads.areas_m2),
        LogColumn("direction", "", lambda blast: blast.loads.directions, _XYZ),
        LogColumn("peak_pressure", "Pa", lambda blast: blast.loads.peaks_pa),
        LogColumn("mean_pressure", "Pa", lambda blast: blast.loads.pressure_impulses_pa_s / blast.frame_s),
        LogColumn("force", "N", lambda blast: blast.forces_n[:, None] * blast.loads.directions, _XYZ),
        LogColumn("impulse", "Ns", lambda blast: blast.loads.impulses_ns),
    ),
)
BEARING_TABLE: LogTable[FrameBearings] = LogTable(
    ("bearing",),
    (
        LogColumn("force", "N", lambda bearings: bearings.loads.forces_n, _XYZ),
        LogColumn("moment", "Nm", lambda bearings: bearings.loads.moments_nm, _XYZ),
        LogColumn("largest_up", "N", lambda bearings: bearings.loads.largest_up_n),
        LogColumn("least_up", "N", lambda bearings: bearings.loads.least_up_n),
        LogColumn("largest_horizontal", "N", lambda bearings: bearings.loads.largest_horizontal_n),
        LogColumn("largest_moment_y", "Nm", lambda bearings: bearings.loads.largest_moment_y_nm),
        LogColumn("open_share", "", lambda bearings: bearings.loads.open_shares),
        LogColumn("displacement", "m", lambda bearings: bearings.loads.displacements_m, _XYZ),
        LogColumn("slip", "m", lambda bearings: bearings.loads.slips_m),
        LogColumn("intact", "", lambda bearings: bearings.intact),
    ),
)
BAR_TABLE: LogTable[FrameCracks] = LogTable(
    ("connection", "first_member", "second_member"),
    (
        LogColumn("opening", "m", lambda cracks: cracks.openings_m),
        LogColumn("force", "N", lambda cracks: cracks.forces_n),
        LogColumn("yield_share", "", lambda cracks: cracks.yield_shares),
        LogColumn("rupture_strain_share", "", lambda cracks: cracks.rupture_shares),
        LogColumn("ruptured_share", "", lambda cracks: cracks.ruptured_shares),
    ),
)

_STEP_MARK = "\0"


class CsvLog(Generic[Source]):
    """CSV file that grows by whole lines; one that is there is replaced."""

    def __init__(self, path: Path, table: LogTable[Source]):
        self._path, self._table = path, table
        with writing(path):
            self._file = path.open("w", encoding="utf-8", newline="")
        self.add(",".join(table.headers) + "\n")

    @property
    def in_place(self) -> bool:
        """Whether the file is still where it was opened."""
        return is_in_place(self._file.fileno(), self._path)

    def add(self, lines: str) -> None:
        """Add lines; a run that is killed keeps them."""
        with writing(self._path):
            self._file.write(lines)
            self._file.flush()

    def close(self) -> None:
        """Close the file."""
        with writing(self._path):
            self._file.close()


class EntryLog(CsvLog[Source]):
    """CSV file with a line for each thing that happened in a frame, such as a break."""

    def write(self, frame: int, time_s: float, entries: Sequence[Sequence[str]], source: Source) -> None:
        """Add lines with the names of n entries, and their values of a source."""
        if not entries:
            return
        self.add(
            "".join(
                f"{frame},{time_s:.9g},{_csv_text(*names)}," + ",".join(f"{value:.9g}" for value in row) + "\n"
                for names, row in zip(entries, self._table.values(source).tolist(), strict=True)
            )
        )


class BodyLog(CsvLog[Source]):
    """CSV file with a line for each of n bodies and each logged frame."""

    def __init__(self, path: Path, table: LogTable[Source], bodies: Sequence[str]):
        names, values = [f",{_csv_text(name)}" for name in bodies], ",".join(["%.9g"] * len(table.value_headers))
        # One template for all lines of a frame: formatting line by line takes several times as long.
        self._lines = "".join(f"{_STEP_MARK}{name.replace('%', '%%')},{values}\n" for name in names)
        super().__init__(path, table)

    def write(self, frame: int, time_s: float, source: Source) -> None:
        """Add a line for each body with its values of a source."""
        values = tuple(self._table.values(source).ravel().tolist())
        self.add((self._lines % values).replace(_STEP_MARK, f"{frame},{time_s:.9g}"))


def _csv_text(*texts: str) -> str:
    """Return texts as a line of CSV, quoted also where they hold a line break of another system."""
    buffer = io.StringIO()
    csv.writer(buffer).writerow(map(csv_cell, texts))
    return buffer.getvalue().removesuffix("\r\n")


LARGEST_LOG = 100_000 * MEGABYTE
"""Bytes; 10 000 bodies in 40 000 frames have so much."""


@dataclass(frozen=True, eq=False, slots=True)
class LoggedForces:
    """The content of a force log without results."""

    times_s: np.ndarray  # (k,), of the frames
    sums_n: np.ndarray  # (k,), largest sum of magnitudes on any body but the ground
    resultants_n: np.ndarray  # (k,), largest resultant on any body but the ground
    is_cut: bool  # whether the log ends within a frame, which is left out


def read_logged_forces(folder: Path) -> LoggedForces | None:
    """Return the largest forces of every frame that the force log holds whole; None without a log."""
    path = folder / FORCE_LOG
    if not path.exists():
        return None
    largest: dict[float, tuple[float, float]] = {}
    bodies_of_frame: dict[float, int] = {}
    try:
        rows = csv_rows(path, LARGEST_LOG)
        columns = next(rows, [])
        for cells in rows:
            if len(cells) < len(columns):  # a line that was cut in two
                break
            row = dict(zip(columns, cells, strict=False))
            time_s = float(row["time_s"])
            bodies_of_frame[time_s] = bodies_of_frame.get(time_s, 0) + 1
            before = largest.get(time_s, (0.0, 0.0))
            if row["body"] != "Ground":
                forces_n = (float(row["peak_force_sum_N"]), float(row["peak_force_N"]))
                largest[time_s] = tuple(np.fmax(before, forces_n))
            else:
                largest.setdefault(time_s, before)
    except (UnreadableError, ValueError, KeyError) as error:
        raise OutputError(f"{FORCE_LOG} cannot be read, and is left out: {error}") from error
    whole = [time_s for time_s, count in bodies_of_frame.items() if count == max(bodies_of_frame.values())]
    if not whole:
        raise OutputError(f"{FORCE_LOG} holds no frame")
    sums, resultants = np.array([largest[time_s] for time_s in whole]).T
    return LoggedForces(np.array(whole), sums, resultants, is_cut=len(whole) < len(bodies_of_frame))


def count_logged_breaks(folder: Path) -> int | None:
    """Return how many breaks the breaking log holds whole; None without it."""
    path = folder / BREAKING_LOG
    if not path.exists():
        return None
    try:
        check_file(path, LARGEST_LOG)
        with path.open("rb") as file:
            return max(0, sum(line.endswith(b"\n") for line in file) - 1)
    except (UnreadableError, OSError) as error:
        raise OutputError(f"{BREAKING_LOG} cannot be read, and what broke is left out: {error}") from error
