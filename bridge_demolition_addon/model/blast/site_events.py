"""Measured events of a test blast or a drop test, from a CSV file, and the law that they give.

Heads of columns are the file's own: what they are is read from their words and their units, as seismographs and charge
plans write them, such as ``Distance (m)``, ``Max charge per delay [kg]``, ``Tran PPV (mm/s)`` or ``ppv_mm_s``.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engineering.blast.site_law import SiteLaw, fitted_law
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import BlastError, ScenarioError, UnreadableError
from ...system.reading import MEGABYTE, file_text
from ..schema import shown
from .vibration_laws import OF_CHARGES, OF_FALL

_MOST_BYTES = 10 * MEGABYTE
_J_PER_KJ = 1e3


@dataclass(frozen=True, slots=True)
class _Unit:
    """A unit of a head: what it measures, how much of it is one of ours, and whether it is an imperial one."""

    measures: str
    factor: float
    is_imperial: bool = False


_UNITS = {
    "m": _Unit("length", 1.0),
    "km": _Unit("length", 1e3),
    "cm": _Unit("length", 1e-2),
    "ft": _Unit("length", 0.3048, is_imperial=True),
    "feet": _Unit("length", 0.3048, is_imperial=True),
    "g": _Unit("mass", 1e-3),
    "kg": _Unit("mass", 1.0),
    "t": _Unit("mass", 1e3),
    "lb": _Unit("mass", 0.45359237, is_imperial=True),
    "lbs": _Unit("mass", 0.45359237, is_imperial=True),
    "j": _Unit("energy", 1.0 / _J_PER_KJ),
    "kj": _Unit("energy", 1.0),
    "mj": _Unit("energy", _J_PER_KJ),
    "m/s": _Unit("velocity", 1.0),
    "cm/s": _Unit("velocity", 1e-2),
    "mm/s": _Unit("velocity", 1e-3),
    "in/s": _Unit("velocity", 0.0254, is_imperial=True),
    "hz": _Unit("frequency", 1.0),
}
"""Units by how heads have them in small letters. International yard and pound agreement (1959)."""

_SPELLINGS = (
    (r"mm/sec|mm s-1|mm s\b|mm\.s-1", "mm/s"),
    (r"in/sec|ips\b|in s\b", "in/s"),
    (r"cm/sec|cm s\b", "cm/s"),
    (r"m/sec|\bm s\b", "m/s"),
)

_IGNORED = ("scaled", "total", "time", "date", "limit", "number", "accel", "displ", "itude", "microphone")
"""Words of columns that are not read: a scaled distance follows from the others, a total is not what shakes."""

_OF_AIR = ("db", "dbl", "pa", "kpa", "psi")
"""Units of columns of the air, which are not read either."""

_SUMS = ("sum", "pvs", "vector", "resultant")
"""Words of velocities that add the components up, taken where there are no components."""

_WORDS = {
    "distance": ("dist", "range", "abstand", "entfernung"),
    "charge": ("charge", "explosive", "mic", "mcd", "ladung", "lade"),
    "height": ("height", "drop", "hoehe", "höhe"),
    "mass": ("mass", "weight", "masse"),
    "energy": ("energy", "energie"),
    "velocity": ("ppv", "pvs", "vel", "peak", "tran", "vert", "long", "vector", "sum", "schwing"),
    "frequency": ("freq", "frequenz"),
}
"""Parts of words by which a column is known, in the order in which they are looked for."""

_MEASURES = {
    "distance": "length",
    "charge": "mass",
    "height": "length",
    "mass": "mass",
    "energy": "energy",
    "velocity": "velocity",
    "frequency": "frequency",
}


@dataclass(frozen=True, slots=True, eq=False)
class SiteEvents:
    """Events (n,) of one source: distances in m, sizes in kg or kJ, velocities in m/s, frequencies in Hz or None."""

    of: str
    distances_m: np.ndarray
    sizes: np.ndarray
    velocities_m_s: np.ndarray
    frequencies_hz: np.ndarray | None

    def law(self) -> SiteLaw:
        """Return the law that they give."""
        return fitted_law(self.distances_m, self.sizes, self.velocities_m_s)


@dataclass(frozen=True, slots=True)
class _Column:
    number: int
    head: str
    kind: str
    unit: _Unit

    @property
    def is_sum(self) -> bool:
        return any(word in self.head.lower() for word in _SUMS)


def law_of_file(path: Path) -> tuple[SiteEvents, SiteLaw]:
    """Return the events of a file, and the law that they give."""
    events = site_events(path)
    try:
        return events, events.law()
    except BlastError as error:
        raise BlastError(f"{path}: {error}; no law is given") from error


def site_events(path: Path) -> SiteEvents:
    """Return the events of a CSV file, whose first row has heads with units; a row is an event at a station.

    Raises
    ------
    ScenarioError
        Where the file cannot be read, a column is missing or twice, a head has no unit or one of another system, or a
        cell is no finite number above 0.
    """
    try:
        rows = _rows(file_text(path, _MOST_BYTES))
    except (UnreadableError, csv.Error) as error:
        raise ScenarioError(f"{path}: {error}") from error
    if not rows:
        raise ScenarioError(f"{path}: expected a table of events, found no rows")
    columns = list(_columns(path, rows[0][1]))
    _check_one_system(path, columns)
    of = _check_kinds(path, columns)
    values = {column.number: _values(path, rows[1:], column) for column in columns}

    def of_kind(kind: str) -> list[np.ndarray]:
        return [values[column.number] for column in columns if column.kind == kind]

    velocity = [column for column in columns if column.kind == "velocity"]
    components = [column for column in velocity if not column.is_sum] or velocity
    velocities = np.max([values[column.number] for column in components], axis=0)
    frequencies = of_kind("frequency")
    return SiteEvents(
        of,
        of_kind("distance")[0],
        _sizes(of_kind, of),
        velocities,
        np.min(frequencies, axis=0) if frequencies else None,
    )


def _sizes(of_kind: Callable[[str], list[np.ndarray]], of: str) -> np.ndarray:
    """Return charges in kg, or energies in kJ."""
    if of == OF_CHARGES:
        return of_kind("charge")[0]
    if energies := of_kind("energy"):
        return energies[0]
    energy_kj: np.ndarray = of_kind("mass")[0] * of_kind("height")[0] * STANDARD_GRAVITY_M_S2 / _J_PER_KJ
    return energy_kj


def _rows(text: str) -> list[tuple[int, list[str]]]:
    """Return the rows that are not empty, with their numbers; a comma is a decimal one where others separate."""
    head = next((line for line in text.splitlines() if line.strip() and not line.startswith("#")), "")
    separator = max(";\t,", key=head.count)
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    kept = [
        (number, [cell.strip() for cell in row])
        for number, row in enumerate(lines, start=1)
        if any(map(str.strip, row)) and not row[0].startswith("#")
    ]
    if separator == ",":
        return kept
    return [*kept[:1], *((number, [cell.replace(",", ".") for cell in row]) for number, row in kept[1:])]


def _columns(path: Path, heads: Sequence[str]) -> Iterator[_Column]:
    """Yield the columns that are read, with their units."""
    for number, head in enumerate(heads):
        words = _plain(head)
        kind = _kind(words)
        if kind is None:
            continue
        last = words.split()[-1]
        unit = _UNITS.get(last)
        if unit is None or unit.measures != _MEASURES[kind]:
            wanted = [name for name, one in _UNITS.items() if one.measures == _MEASURES[kind]]
            raise ScenarioError(f'{path}: column "{head}" is a {kind}: expected its unit at its end, {_or(wanted)}')
        yield _Column(number, head, kind, unit)


def _plain(head: str) -> str:
    """Return a head in small letters, with single words and a unit in one spelling."""
    words = " ".join(re.sub(r"[()\[\],_:]", " ", head.lower()).split())
    for pattern, unit in _SPELLINGS:
        words = re.sub(rf"(?:{pattern})$", unit, words)
    return words


def _kind(words: str) -> str | None:
    if any(word in words for word in _IGNORED) or words.split()[-1:] in ([unit] for unit in _OF_AIR):
        return None
    if "freq" in words or words.endswith(" hz"):
        return "frequency"
    return next((kind for kind, parts in _WORDS.items() if any(part in words for part in parts)), None)


def _check_one_system(path: Path, columns: Sequence[_Column]) -> None:
    metric = [column.head for column in columns if not column.unit.is_imperial and column.kind != "frequency"]
    imperial = [column.head for column in columns if column.unit.is_imperial]
    if metric and imperial:
        raise ScenarioError(
            f'{path}: units of two systems, "{imperial[0]}" and "{metric[0]}": expected one; no law is given'
        )


def _check_kinds(path: Path, columns: Sequence[_Column]) -> str:
    """Return what shakes; complain of what is missing or twice."""
    kinds = [column.kind for column in columns]
    for kind in ("distance", "charge", "mass", "height", "energy"):
        if kinds.count(kind) > 1:
            heads = [column.head for column in columns if column.kind == kind]
            raise ScenarioError(f"{path}: columns {' and '.join(heads)} are both a {kind}: expected one; leave one out")
    falls = "energy" in kinds or {"mass", "height"} <= set(kinds)
    if missing := [kind for kind in ("distance", "velocity") if kind not in kinds]:
        raise ScenarioError(f"{path}: no column is a {_or(missing)}: expected heads such as Distance (m), PPV (mm/s)")
    if ("charge" in kinds) == falls:
        raise ScenarioError(
            f"{path}: expected either a charge per delay, as Charge (kg), or what falls: Mass (kg) and Height (m), or "
            "Energy (kJ)"
        )
    return OF_FALL if falls else OF_CHARGES


def _values(path: Path, rows: Sequence[tuple[int, list[str]]], column: _Column) -> np.ndarray:
    return np.array([_number(path, number, row, column) for number, row in rows]) * column.unit.factor


def _number(path: Path, number: int, row: Sequence[str], column: _Column) -> float:
    cell = row[column.number] if column.number < len(row) else ""
    try:
        value = float(cell)
    except ValueError:
        value = np.nan
    if not (np.isfinite(value) and value > 0.0):
        raise ScenarioError(
            f'{path}, row {number}: "{column.head}" is {shown(cell)}: expected a number above 0, '
            "its unit in the head alone"
        )
    return value


def _or(names: Sequence[str]) -> str:
    return " or ".join(names)
