"""Table of runs: a row for each run, with its inputs and outputs; also as a sheet, where XlsxWriter is installed.

``pandas.read_csv("runs.csv")`` reads it. Columns of inputs begin with ``in.``, columns of outputs with ``out.``, and
both end in their unit. A cell of a run that did not finish, or of an unknown value, is empty.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import OutputError, UnreadableError
from ...system.disk import whole_file
from ...system.reading import MEGABYTE, csv_rows
from ..results.collapse import FALLEN

RUN, STATUS = "run", "status"
INPUT, OUTPUT = "in.", "out."

DONE, REFUSED, FAILED, CRASHED = "done", "refused", "failed", "crashed"
TIMED_OUT, OUT_OF_MEMORY, KILLED = "timed_out", "out_of_memory", "killed"
STATUSES = (DONE, REFUSED, FAILED, CRASHED, TIMED_OUT, OUT_OF_MEMORY, KILLED)
"""How a run ended."""

REACH = "reach_m"
"""Output with the debris distance."""

TRUSTED_REACH = "reach_without_doubtful_m"
"""Output with the debris distance of all but those whose throws nothing explains."""
MOVING, RESTED = "moving_at_end", "came_to_rest_s"
"""Outputs that say how many shards still moved when a run ended, so that its distances are not final, and since when
everything rested; tables of earlier versions have but the second."""

_MOST_BYTES = 1000 * MEGABYTE
_TRUTHS = {"true": True, "false": False}
_NO_TIME = datetime(2000, 1, 1)
"""Date of the sheet: the same rows give the same bytes."""


@dataclass(frozen=True, slots=True, eq=False)
class RunOutcome:
    """How a run ended."""

    status: str  # one of `STATUSES`
    reason: str = ""  # why it is not done
    outputs: Mapping[str, Any] = field(default_factory=dict)  # values by name, where it is done
    fingerprint: Mapping[str, str] = field(default_factory=dict)  # digests, where it is done
    wall_time_s: float = 0.0


@dataclass(frozen=True, slots=True)
class RunRow:
    """A run in the table.

    Inputs and outputs are numbers, texts, truths or None for what is not known, by names without `INPUT` or `OUTPUT`.
    """

    number: int  # from 1
    status: str  # one of `STATUSES`
    inputs: Mapping[str, Any]
    outputs: Mapping[str, Any]
    reason: str = field(default="", compare=False)  # why it is not done; the file does not hold it


@dataclass(frozen=True)
class RunsTable:
    """All runs that have ended, by number."""

    rows: tuple[RunRow, ...]

    def __len__(self) -> int:
        return len(self.rows)

    @cached_property
    def numbers(self) -> np.ndarray:
        """Numbers (n,) of the runs."""
        return np.array([row.number for row in self.rows], int)

    @cached_property
    def done(self) -> np.ndarray:
        """Which runs (n,) finished."""
        return np.array([row.status == DONE for row in self.rows], bool)

    @property
    def still_moving(self) -> int:
        """Number of runs that finished before everything rested: their distances are not final."""
        return sum(outputs[RESTED] is None and bool(outputs.get(MOVING, True)) for outputs in self._runs_with_rest_time)

    @property
    def single_moving(self) -> int:
        """Number of runs in which everything rested as a whole, while single shards still moved."""
        return sum(outputs[RESTED] is not None and bool(outputs.get(MOVING)) for outputs in self._runs_with_rest_time)

    @property
    def _runs_with_rest_time(self) -> list[Mapping[str, Any]]:
        """Outputs of runs that finished and say since when everything rested."""
        return [row.outputs for row in self.rows if row.status == DONE and RESTED in row.outputs]

    @cached_property
    def median_row(self) -> int | None:
        """Row with the median debris distance of the runs that finished, the lower of two; None where none did."""
        return int(self._by_distance[(len(self._by_distance) - 1) // 2]) if len(self._by_distance) else None

    @cached_property
    def worst_row(self) -> int | None:
        """Row with the largest debris distance of those that finished; None where none did."""
        return int(self._by_distance[-1]) if len(self._by_distance) else None

    @property
    def _by_distance(self) -> np.ndarray:
        distances_m = self.largest(REACH)
        order = np.argsort(distances_m, kind="stable")
        return order[np.isfinite(distances_m[order])]

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs."""
        return _names(row.inputs for row in self.rows)

    @cached_property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return _names(row.outputs for row in self.rows)

    def input(self, name: str) -> np.ndarray:
        """Values (n,) of an input: float where all of them are numbers, else object."""
        return _column([row.inputs.get(name) for row in self.rows])

    def output(self, name: str) -> np.ndarray:
        """Values (n,) of an output: float, nan for what is not known, if all others are numbers; else object."""
        return _column([row.outputs.get(name) for row in self.rows])

    def largest(self, name: str) -> np.ndarray:
        """Values (n,) of an output where larger is worse: infinity for what is not known."""
        values = self.output(name)
        return np.where(self.done & np.isfinite(values), values, np.inf)

    def fallen(self, name: str) -> np.ndarray:
        """Which runs (n,) finished with so much of the height of a part lost, by an output, that it is down."""
        return self.done & (self.output(name) >= FALLEN)

    def met(self, name: str) -> np.ndarray:
        """Which runs (n,) finished with an output that is true."""
        return np.array([row.status == DONE and row.outputs.get(name) is True for row in self.rows], bool)


def cells_of(inputs: Mapping[str, Any], names: Sequence[str]) -> tuple[str, ...]:
    """Return inputs as they stand in the table, which identify a run: no other has the same."""
    return tuple(_cell(inputs.get(name)) for name in names)


def write_runs(table: RunsTable, path: Path) -> None:
    """Write a table of runs, whole or not at all; the same rows give the same bytes."""
    with whole_file(path) as part, part.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(map(_cell, line) for line in _lines(table))


def write_sheet(table: RunsTable, path: Path) -> bool:
    """Write the table as a sheet, with the columns of the CSV; return False where XlsxWriter is not installed."""
    if find_spec("xlsxwriter") is None:
        return False
    import xlsxwriter

    with whole_file(path) as part:
        book = xlsxwriter.Workbook(str(part), {"strings_to_formulas": False, "strings_to_urls": False})
        book.set_properties({"created": _NO_TIME})
        sheet = book.add_worksheet("runs")
        bold = book.add_format({"bold": True})
        sheet.freeze_panes(1, 2)
        for number, line in enumerate(_lines(table)):
            sheet.write_row(number, 0, map(_sheet_cell, line), None if number else bold)
        book.close()
    return True


def _lines(table: RunsTable) -> Iterator[list[Any]]:
    """Yield the header, then the values of each row."""
    yield [RUN, STATUS, *(INPUT + name for name in table.inputs), *(OUTPUT + name for name in table.outputs)]
    for row in table.rows:
        yield [row.number, row.status, *map(row.inputs.get, table.inputs), *map(row.outputs.get, table.outputs)]


def read_runs(path: Path) -> RunsTable:
    """Read a table of runs."""
    try:
        lines = csv_rows(path, _MOST_BYTES)
        columns = next(lines, [])
        if columns[:2] != [RUN, STATUS]:
            raise OutputError(f"{path}: expected a table of runs, whose columns begin with {RUN} and {STATUS}")
        return RunsTable(tuple(_row(path, columns, cells) for cells in lines))
    except UnreadableError as error:
        raise OutputError(f"{path}: {error}") from error


def _row(path: Path, columns: Sequence[str], cells: Sequence[str]) -> RunRow:
    if len(cells) != len(columns) or not cells[0].isdecimal() or cells[1] not in STATUSES:
        shown = ",".join(cells)[:40]
        raise OutputError(f"{path}: expected rows of {len(columns)} cells with a number and a status, found {shown}")
    values = dict(zip(columns, map(_value, cells), strict=True))
    inputs = {name.removeprefix(INPUT): value for name, value in values.items() if name.startswith(INPUT)}
    outputs = {name.removeprefix(OUTPUT): value for name, value in values.items() if name.startswith(OUTPUT)}
    return RunRow(int(cells[0]), cells[1], inputs, outputs)


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _sheet_cell(value: Any) -> Any:
    """Return a value that a sheet can hold: it knows neither infinity nor nan."""
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value


def _value(cell: str) -> Any:
    if cell in _TRUTHS or not cell:
        return _TRUTHS.get(cell)
    for number in (int, float):
        try:
            return number(cell)
        except ValueError:
            continue
    return cell


def _names(mappings: Iterable[Mapping[str, Any]]) -> tuple[str, ...]:
    """Return names in the order in which they come first."""
    return tuple(dict.fromkeys(name for mapping in mappings for name in mapping))


def _column(values: Sequence[Any]) -> np.ndarray:
    if all(value is None or (isinstance(value, int | float) and not isinstance(value, bool)) for value in values):
        return np.array([math.nan if value is None else value for value in values], float)
    return np.array(values, object)
