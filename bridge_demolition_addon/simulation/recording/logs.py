"""The logs of a run: CSV files that grow by whole lines, frame by frame."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engineering.geometry.vectors import dot
from ...engineering.mechanics.stress import principal_stresses
from ...errors import SimulationError
from ...model.blast.explosion import StepLoads
from ...model.results.files import BREAKING_LOG, DEBRIS_LOG, EXPLOSION_LOG, FORCE_LOG
from ...model.results.frames import Frame
from ...model.results.inventory import Inventory
from ...model.results.motion import throw, travel
from ...model.results.solver_energy import flies_on_solver_energy
from ...system.disk import is_in_place, writing
from .substeps import Breaks

FORCE_COLUMNS = (
    "frame",
    "time_s",
    "body",
    "force_x_N",
    "force_y_N",
    "force_z_N",
    "force_sum_N",
    "peak_force_N",
    "peak_force_sum_N",
    "contact_impulse_x_Ns",
    "contact_impulse_y_Ns",
    "contact_impulse_z_Ns",
    "signed_2019_N",
    "stress_largest_Pa",
    "stress_smallest_Pa",
    "von_mises_Pa",
    "asleep",
)
DEBRIS_COLUMNS = (
    "frame",
    "time_s",
    "body",
    "x_m",
    "y_m",
    "z_m",
    "distance_m",
    "throw_m",
    "made_by_solver_J",
    "on_solver_energy",
)
BREAKING_COLUMNS = (
    "frame",
    "time_s",
    "connection",
    "first_body",
    "second_body",
    "axial_N",
    "shear_y_N",
    "shear_z_N",
    "torsion_Nm",
    "bending_y_Nm",
    "bending_z_Nm",
)
EXPLOSION_COLUMNS = (
    "frame",
    "time_s",
    "body",
    "charge",
    "stand_off_m",
    "scaled_distance_m_kg13",
    "projected_area_m2",
    "direction_x",
    "direction_y",
    "direction_z",
    "peak_pressure_Pa",
    "mean_pressure_Pa",
    "force_x_N",
    "force_y_N",
    "force_z_N",
    "impulse_Ns",
)

_STEP_MARK = "\0"


@dataclass(frozen=True, slots=True)
class LogFiles:
    """Files of their own for logs that are not to go to the folder of the results.

    Attributes
    ----------
    forces, debris
        File for that log, or None for the folder.
    """

    forces: Path | None = None
    debris: Path | None = None


_IN_THE_FOLDER = LogFiles()


class Logs:
    """All logs of a recording.

    Parameters
    ----------
    folder
        Existing folder; logs that are there are replaced.
    inventory
        The bodies and connections that the logs are about.
    charges
        Names of the charges, where there is a blast.
    files
        Logs that go elsewhere.
    """

    def __init__(
        self, folder: Path, inventory: Inventory, charges: Sequence[str] = (), files: LogFiles = _IN_THE_FOLDER
    ):
        names = inventory.body_names.tolist()
        self._folder, self._inventory = folder, inventory
        self._forces = BodyLog(files.forces or folder / FORCE_LOG, FORCE_COLUMNS, names)
        self._debris = BodyLog(files.debris or folder / DEBRIS_LOG, DEBRIS_COLUMNS, names)
        self._breaking = CsvLog(folder / BREAKING_LOG, BREAKING_COLUMNS)
        self._explosion = ExplosionLog(folder / EXPLOSION_LOG, names, charges) if charges else None
        self._first_positions: np.ndarray | None = None
        self._made_j = np.zeros(len(names))
        self._largest_kinetic_j = np.zeros(len(names))

    def write_frame(self, frame: Frame) -> None:
        """Log the loads of a frame; of the first frame, also where everything is.

        Raises
        ------
        SimulationError
            The folder is not there any more: what is written to its open files would be lost with them.
        """
        if not self._breaking.in_place:
            raise SimulationError(f"{self._folder}: was moved or deleted while a run wrote to it")
        loads = frame.loads
        columns = (
            loads.body_forces_n,
            loads.body_sums_n,
            loads.body_peaks_n,
            loads.body_peak_sums_n,
            loads.body_contact_impulses_ns,
            loads.body_signed_2019_n,
            principal_stresses(loads.stresses_pa),
            loads.von_mises_pa,
            frame.asleep,
        )
        self._forces.write(frame.number, frame.time_s, np.column_stack(columns))
        self._made_j += np.nan_to_num(frame.work.made_j)
        kinetic = 0.5 * self._inventory.masses_kg * dot(frame.velocities_m_s, frame.velocities_m_s)
        self._largest_kinetic_j = np.maximum(self._largest_kinetic_j, kinetic)
        if self._first_positions is None:
            self._first_positions = frame.positions_m
            self._write_positions(frame)

    def write_breaks(self, frame: int, breaks: Sequence[Breaks]) -> None:
        """Log the connections that broke in a frame, each with the loads that it broke under."""
        names, bodies, pairs = self._inventory.connection_names, self._inventory.body_names, self._inventory.pairs
        lines = []
        for each in breaks:
            loads = each.loads
            values = np.column_stack((loads.axial_n, loads.shear_n, loads.torsion_nm, loads.bending_nm)) + 0.0
            for row, numbers in zip(each.connections, values, strict=True):
                texts = (names[row], *bodies[pairs[row]], *(f"{number:.9g}" for number in numbers))
                lines.append(_csv_text(str(frame), f"{each.time_s:.9g}", *texts) + "\n")
        self._breaking.add("".join(lines))

    def write_blast(self, frame: Frame, loads: StepLoads, frame_s: float) -> None:
        """Log the blast loads of a frame that is that long."""
        self._explosion.write(frame.number, frame.time_s, frame_s, loads)

    def close(self, last_frame: Frame | None) -> None:
        """Log where everything is at last, if there was a frame, and close the files.

        Raises
        ------
        OutputError
            The disk is full; the files are closed all the same.
        """
        with ExitStack() as files:
            for each in (self._forces, self._debris, self._breaking, self._explosion):
                if each:
                    files.callback(each.close)
            if last_frame:
                self._write_positions(last_frame)

    def _write_positions(self, frame: Frame) -> None:
        first, last = self._first_positions, frame.positions_m
        throws = throw(first, last)
        on_solver_energy = flies_on_solver_energy(throws, self._made_j, self._largest_kinetic_j)
        values = np.column_stack((last, travel(first, last), throws, self._made_j, on_solver_energy))
        self._debris.write(frame.number, frame.time_s, values)


class CsvLog:
    """CSV file that grows by whole lines.

    Parameters
    ----------
    path
        File to write; one that is there is replaced.
    columns
        Header.

    Raises
    ------
    OutputError
        The file cannot be written, as where it is a folder by now.
    """

    def __init__(self, path: Path, columns: Sequence[str]):
        self._path = path
        with writing(path):
            self._file = path.open("w", encoding="utf-8", newline="")
        self.add(",".join(columns) + "\n")

    @property
    def in_place(self) -> bool:
        """Whether the file is still where it was opened."""
        return is_in_place(self._file.fileno(), self._path)

    def add(self, lines: str) -> None:
        """Add lines; a run that is killed keeps them.

        Raises
        ------
        OutputError
            They cannot be written, as on a full disk.
        """
        with writing(self._path):
            self._file.write(lines)
            self._file.flush()

    def close(self) -> None:
        """Close the file.

        Raises
        ------
        OutputError
            Lines that are still to be written cannot be.
        """
        with writing(self._path):
            self._file.close()


class ExplosionLog(CsvLog):
    """CSV file with one line per body, charge and frame in which the charge loads the body.

    Pressure and force are means over the frame's simulated time.

    Parameters
    ----------
    path
        File to write.
    bodies, charges
        Names of the n bodies and c charges.
    """

    def __init__(self, path: Path, bodies: Sequence[str], charges: Sequence[str]):
        self._bodies = [_csv_text(name) for name in bodies]
        self._charges = [_csv_text(name) for name in charges]
        super().__init__(path, EXPLOSION_COLUMNS)

    def write(self, frame: int, time_s: float, frame_s: float, loads: StepLoads) -> None:
        """Add the loads of a frame that ends at a time and is that long."""
        if not len(loads):
            return
        forces = loads.impulses_ns / frame_s
        columns = (
            loads.stand_offs_m,
            loads.scaled_distances,
            loads.areas_m2,
            loads.directions,
            loads.peaks_pa,
            loads.pressure_impulses_pa_s / frame_s,
            forces[:, None] * loads.directions,
            loads.impulses_ns,
        )
        values = (np.column_stack(columns) + 0.0).tolist()
        names = zip(loads.bodies.tolist(), loads.charges.tolist(), strict=True)
        lines = [
            f"{frame},{time_s:.9g},{self._bodies[body]},{self._charges[charge]},"
            + ",".join(f"{value:.9g}" for value in row)
            for (body, charge), row in zip(names, values, strict=True)
        ]
        self.add("\n".join(lines) + "\n")


class BodyLog(CsvLog):
    """CSV file with one line per body and logged frame.

    Parameters
    ----------
    path
        File to write.
    columns
        Header, beginning with frame, time and body.
    bodies
        Names of the n bodies.
    """

    def __init__(self, path: Path, columns: Sequence[str], bodies: Sequence[str]):
        values = ",".join(["%.9g"] * (len(columns) - 3))
        # One template for all lines of a frame: formatting line by line takes several times as long.
        self._lines = "".join(f"{_STEP_MARK},{_csv_text(name).replace('%', '%%')},{values}\n" for name in bodies)
        super().__init__(path, columns)

    def write(self, frame: int, time_s: float, values: np.ndarray) -> None:
        """Add one line per body with its values (n, columns)."""
        self.add((self._lines % tuple((values + 0.0).ravel().tolist())).replace(_STEP_MARK, f"{frame},{time_s:.9g}"))


def _csv_text(*texts: str) -> str:
    """Texts as CSV writes them in one line, quoted also where they hold a line break of another system."""
    buffer = io.StringIO()
    csv.writer(buffer).writerow(texts)
    return buffer.getvalue().removesuffix("\r\n")
