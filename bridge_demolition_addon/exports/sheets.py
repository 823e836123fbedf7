"""All tables of a run in one workbook (XLSX): of its results, its logs and its report."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.units import name_and_unit
from ..errors import MissingLibraryError, OutputError, UnreadableError
from ..model.results.arrays import Results
from ..model.results.energy import energy_of
from ..model.results.motion import throw
from ..model.run_folder.files import BEARING_LOG, BREAKING_LOG, DEBRIS_LOG, EXPLOSION_LOG, FORCE_LOG, TABLE_FOLDER
from ..model.run_folder.logs import LARGEST_LOG
from ..system.disk import whole_file
from ..system.progress import Progress
from ..system.reading import csv_rows

MOST_ROWS = 1_048_575
"""Of a sheet, beside its headings; what has more goes on in another one."""

_LONGEST_NAME = 31
_LONGEST_TEXT = 32_767
_NO_TIME = datetime(2000, 1, 1)
"""When the workbook says it was made: the same run gives the same bytes."""


@dataclass(frozen=True, slots=True)
class _Table:
    """A table: its name, its headings and its rows."""

    name: str
    headings: Sequence[str]
    rows: Iterable[Sequence[Any]]


def check_sheets() -> None:
    """Make sure that the library is there."""
    if find_spec("xlsxwriter") is None:
        raise MissingLibraryError(
            "a workbook is written by XlsxWriter, which this Python does not have: pip install "
            "'bridge-demolition-addon[sheets]', or use bda export where that is installed"
        )


def write_sheets(folder: Path, results: Results, path: Path, progress: Progress) -> None:
    """Write all tables of a run into one file, also its logs and the tables of its report."""
    import xlsxwriter

    progress.stage("writing the tables")
    tables = [*_results_tables(results), *_files_tables(folder)]
    with tempfile.TemporaryDirectory(prefix="bda-sheets-") as scratch:
        options = {
            "constant_memory": True,
            "tmpdir": scratch,
            "strings_to_formulas": False,
            "strings_to_urls": False,
        }
        with xlsxwriter.Workbook(str(path), options) as book:
            book.set_properties({"created": _NO_TIME})
            bold = book.add_format({"bold": True})
            _write_units(book.add_worksheet("units"), bold, tables)
            for done, table in enumerate(tables, start=1):
                _write_table(book, bold, table)
                progress.part(done, len(tables), "tables written")


def write_workbook(tables: Iterable[tuple[str, Sequence[str], Iterable[Sequence[Any]]]], path: Path) -> bool:
    """Write tables, each by its name, headings and rows, as sheets; return False where XlsxWriter is not installed."""
    if find_spec("xlsxwriter") is None:
        return False
    import xlsxwriter

    sheets = [_Table(*table) for table in tables]
    with whole_file(path) as part:
        book = xlsxwriter.Workbook(str(part), {"strings_to_formulas": False, "strings_to_urls": False})
        book.set_properties({"created": _NO_TIME})
        bold = book.add_format({"bold": True})
        _write_units(book.add_worksheet("units"), bold, sheets)
        for sheet in sheets:
            _write_table(book, bold, sheet)
        book.close()
    return True


def _write_units(sheet: Any, bold: Any, tables: Sequence[_Table]) -> None:
    rows = [(table.name, heading, name_and_unit(heading)[1]) for table in tables for heading in table.headings]
    for line, row in enumerate([("sheet", "column", "unit"), *rows]):
        sheet.write_row(line, 0, row, bold if line == 0 else None)
    sheet.freeze_panes(1, 0)


def _write_table(book: Any, bold: Any, table: _Table) -> None:
    number, sheet, line = 1, _new_sheet(book, bold, table.name, table.headings), 0
    for row in table.rows:
        if line == MOST_ROWS:
            number, line = number + 1, 0
            sheet = _new_sheet(book, bold, f"{table.name} {number}", table.headings)
        line += 1
        for column, value in enumerate(map(_cell, row)):
            if isinstance(value, float | int):
                sheet.write_number(line, column, value)
            elif value:
                sheet.write_string(line, column, value)


def _new_sheet(book: Any, bold: Any, name: str, headings: Sequence[str]) -> Any:
    sheet = book.add_worksheet(name)
    sheet.write_row(0, 0, headings, bold)
    sheet.freeze_panes(1, 0)
    return sheet


def _cell(value: Any) -> float | int | str:
    """Return what a sheet can hold: it knows neither infinity nor what is no number."""
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, float) and not math.isfinite(value):
        return "" if math.isnan(value) else str(value)
    return value[:_LONGEST_TEXT] if isinstance(value, str) else value


def _results_tables(results: Results) -> Iterator[_Table]:
    yield _frames_table(results)
    yield _bodies_table(results)
    if len(results.inventory.pairs):
        yield _connections_table(results)
    yield _motion_table(results)
    if len(results.balls.bodies):
        yield _balls_table(results)


def _of_columns(name: str, columns: dict[str, np.ndarray]) -> _Table:
    return _Table(name, list(columns), zip(*(values.tolist() for values in columns.values()), strict=True))


def _frames_table(results: Results) -> _Table:
    frames, work, energy = results.frames, results.frames.work, energy_of(results)
    columns = {
        "frame": frames.number,
        "time_s": frames.time_s,
        "substep_s": frames.substep_s,
        "intact_connections": frames.intact.sum(axis=1),
        "potential_J": energy.potential_j,
        "translation_J": energy.translation_j,
        "rotation_J": energy.rotation_j,
        "work_of_gravity_J": work.gravity_j,
        "work_of_loads_J": work.loads_j,
        "work_of_tools_J": work.tools_j,
        "lost_to_damping_J": work.damping_j,
        "dissipated_between_bodies_J": work.dissipated_j,
        "dissipated_by_bars_J": work.yielding_j,
        "dissipated_by_crack_friction_J": work.crack_friction_j,
    }
    return _of_columns("frames", columns)


def _bodies_table(results: Results) -> _Table:
    inventory, frames = results.inventory, results.frames
    columns = {
        "body": inventory.body_names,
        "kind": inventory.body_kinds,
        "member": inventory.body_members,
        "member_kind": inventory.body_member_kinds,
        "mass_kg": inventory.masses_kg,
        "volume_m3": inventory.volumes_m3,
        **_along_axes("first", frames.positions_m[0], "m"),
        **_along_axes("last", frames.positions_m[-1], "m"),
        "throw_m": throw(frames.positions_m[0], frames.positions_m[-1]),
        "peak_force_N": np.fmax.reduce(frames.loads.body_peaks_n),
        "peak_von_mises_Pa": np.fmax.reduce(frames.loads.von_mises_pa),
    }
    return _of_columns("bodies", columns)


def _connections_table(results: Results) -> _Table:
    inventory, frames = results.inventory, results.frames
    names = np.append(inventory.body_names, "")  # the last one for -1: no body
    broken = ~frames.intact
    columns = {
        "connection": inventory.connection_names,
        "first_body": names[inventory.pairs[:, 0]],
        "second_body": names[inventory.pairs[:, 1]],
        **_along_axes("first", inventory.points_m, "m"),
        "area_m2": inventory.areas_m2,
        "peak_force_N": np.fmax.reduce(frames.loads.connection_peaks_n),
        "broken_by_s": np.where(broken.any(axis=0), frames.time_s[broken.argmax(axis=0)], np.nan),
    }
    return _of_columns("connections", columns)


def _motion_table(results: Results) -> _Table:
    headings = ["frame", "time_s", "body", "x_m", "y_m", "z_m", "velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"]
    return _Table("motion", headings, _motion_rows(results))


def _motion_rows(results: Results) -> Iterator[tuple[Any, ...]]:
    names, frames = results.inventory.body_names.tolist(), results.frames
    for row, (number, time_s) in enumerate(zip(frames.number.tolist(), frames.time_s.tolist(), strict=True)):
        moved = np.hstack([frames.positions_m[row], frames.velocities_m_s[row]]).tolist()
        for name, values in zip(names, moved, strict=True):
            yield (number, time_s, name, *values)


def _balls_table(results: Results) -> _Table:
    balls, names = results.balls, results.inventory.body_names
    steps, count = len(balls.times_s), len(balls.bodies)
    columns = {
        "time_s": np.repeat(balls.times_s, count),
        "body": np.tile(names[balls.bodies], steps),
        **_along_axes("impulse", balls.impulses_ns.reshape(-1, 3), "Ns"),
        **_along_axes("velocity", balls.velocities_m_s.reshape(-1, 3), "m_s"),
    }
    return _of_columns("balls", columns)


def _along_axes(name: str, vectors: np.ndarray, unit: str) -> dict[str, np.ndarray]:
    return {f"{name}_{axis}_{unit}": vectors[:, column] for column, axis in enumerate("xyz")}


def _files_tables(folder: Path) -> Iterator[_Table]:
    """Give the tables that are there as CSV: logs, and a report's tables below their own names."""
    logs = [folder / name for name in (FORCE_LOG, DEBRIS_LOG, BREAKING_LOG, EXPLOSION_LOG, BEARING_LOG)]
    reported = sorted((folder / TABLE_FOLDER).glob("*.csv"))
    for path in [*logs, *reported]:
        if path.is_file():
            name = path.stem if path in logs else f"report {path.stem}"
            headings = next(_rows(path), None)
            if headings:
                yield _Table(name[:_LONGEST_NAME], headings, _numbers(path))


def _rows(path: Path) -> Iterator[list[str]]:
    try:
        yield from csv_rows(path, LARGEST_LOG)
    except UnreadableError as error:
        raise OutputError(f"{path}: {error}") from error


def _numbers(path: Path) -> Iterator[list[Any]]:
    """Give the rows of a table below its headings, with what can be one as a number."""
    rows = _rows(path)
    next(rows)
    for row in rows:
        yield [_number(text) for text in row]


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
