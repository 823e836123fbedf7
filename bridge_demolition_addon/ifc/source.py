"""An IFC file, opened and checked, with its unit of length."""

from __future__ import annotations

import re
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import IfcError, UnreadableError
from ..system.reading import MEGABYTE, check_file
from .library import library
from .linear_placements import place_along_curves
from .older_schemas import translated
from .settings import UNITS, ImportSettings

MOST_BYTES = 2000 * MEGABYTE
"""Size up to which a file is read, all of it in memory."""

SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")

_READ_AS = re.compile(r"IFC4X(1|2|3_(RC|TC|ADD1)\w*)(_\w*)?")
_NEWEST = "IFC4X3_ADD2"
"""Schemas that came before IFC4X3, whose elements it has too, and what they are read as."""

_CLASS = re.compile(rb"=\s*(IFC[A-Z0-9_]+)\s*\(")

_BEGINNING, _END = b"ISO-10303-21;", b"END-ISO-10303-21;"
_HEAD = 100_000
"""Bytes in which the header of a file ends."""

_SCHEMA = re.compile(rb"FILE_SCHEMA\s*\(\s*\(\s*'([^']*)'", flags=re.IGNORECASE)
_AMERICAN = re.compile(rb"(IFCSIUNIT\s*\([^;]*?\.(?:SQUARE_|CUBIC_)?)METER(\.\s*\)\s*;)", flags=re.IGNORECASE)
"""A unit as some programs spell it; the standard's metre is METRE."""

_MOST, _LARGEST_IN_METRES = 0.75, 200.0
"""Part of all coordinates, and what it does not exceed in metres: parts of bridges are smaller, and placements few."""

_BEYOND_ASCII = re.compile(r"[^\x00-\x7f]+")


@dataclass(frozen=True, slots=True)
class IfcSource:
    """An IFC file: its content, an `ifcopenshell.file`, and notes on corrections.

    `scale` is a factor on what IfcOpenShell takes for metres; `unit_m` and `angle_rad` are the file's units of length
    and angle.
    """

    path: Path
    model: Any
    scale: float
    unit_m: float
    angle_rad: float = 1.0
    notes: tuple[str, ...] = ()
    lost_classes: tuple[str, ...] = ()
    """Classes of an older schema that the one that the file is read as does not have."""


@contextmanager
def naming_contradictions(path: Path) -> Iterator[None]:
    """Report that a file contradicts its schema where IfcOpenShell fails on it; errors of other code pass."""
    try:
        yield
    except (AttributeError, IndexError, KeyError, RuntimeError, TypeError, ValueError) as error:
        frames = traceback.extract_tb(error.__traceback__)
        if Path(library().__file__ or "").parent not in Path(frames[-1].filename).parents:
            raise
        raise IfcError(
            f"{path}: contradicts its schema ({error}); check it with a validator of IFC, or export it again"
        ) from error


def open_source(path: Path, settings: ImportSettings) -> IfcSource:
    """Open an IFC file."""
    openshell = library()
    content = _content(path)
    mended, count = _AMERICAN.subn(rb"\1METRE\2", content)
    mended, schema, assumed = _relabelled(mended)
    try:
        # By its text, as a file opened by its path is not closed before the interpreter ends.
        model = openshell.file.from_string(_text(mended))
    except (RuntimeError, ValueError, openshell.Error) as error:
        raise IfcError(f"{path}: cannot be read as IFC ({error}); export it again") from error
    if not model.by_type("IfcProject"):
        raise IfcError(f"{path}: has no IfcProject, so no units and no bridge; export the whole project")
    notes = ("METER is taken for METRE, as the standard spells it",) if count else ()
    lost = _lost_classes(mended) if schema else ()
    if schema:
        notes = (*notes, f"the schema {schema} is read as {_NEWEST}, which came after it", *assumed)
    if lost:
        notes = (*notes, f"{_NEWEST} has no {', '.join(lost)}: what is placed along these has no shape")
    own_m = _unit_of_file(model)
    unit_m = own_m if settings.unit is None else UNITS[settings.unit]
    if unit_m is None and not settings.strict and (guessed := _guessed_unit(model)):
        unit_m = UNITS[guessed]
        notes = (*notes, f"the file has no unit of length that is known: taken for {guessed}; --unit says it better")
    if unit_m is None:
        raise IfcError(
            f"{path}: has no unit of length that is known; say which it is, one of {', '.join(UNITS)}, by --unit"
        )
    if own_m is not None and unit_m != own_m:
        notes = (*notes, f"lengths are taken for {settings.unit}, though the file says that its unit is {own_m:g} m")
    notes = (*notes, *place_along_curves(model, unit_m))
    taken_m = library("util.unit").calculate_unit_scale(model)
    angle_rad = float(library("util.unit").calculate_unit_scale(model, "PLANEANGLEUNIT")) or 1.0
    return IfcSource(path, model, unit_m / taken_m, unit_m, angle_rad, notes, lost)


def _content(path: Path) -> bytes:
    try:
        check_file(path, MOST_BYTES)
        content = path.read_bytes()
    except UnreadableError as error:
        raise IfcError(f"{path}: {error}") from error
    except OSError as error:
        raise IfcError(f"{path}: cannot be read: {error.strerror}") from error
    beginning = content[:_HEAD].removeprefix(b"\xef\xbb\xbf").lstrip()
    if beginning.startswith(b"PK"):
        raise IfcError(f"{path}: is packed; unpack it, and import the .ifc file in it")
    if beginning.startswith(b"<"):
        raise IfcError(f"{path}: is XML; save it as a STEP file, .ifc")
    if not beginning.startswith(_BEGINNING):
        raise IfcError(f"{path}: is no IFC file: expected one that begins with {_BEGINNING.decode()}")
    if _END not in content[-_HEAD:]:
        raise IfcError(f"{path}: is cut short, as {_END.decode()} is missing at its end; copy or export it again")
    schema = _SCHEMA.search(beginning)
    name = schema.group(1).decode("latin-1").upper() if schema else ""
    if not schema or (name.split("_")[0] not in SCHEMAS and not _READ_AS.fullmatch(name)):
        actual = f"of the schema {schema.group(1).decode('latin-1')}" if schema else "of no schema"
        raise IfcError(f"{path}: is {actual}: expected one of {', '.join(SCHEMAS)}; export it as one of them")
    return content


def _relabelled(content: bytes) -> tuple[bytes, str, tuple[str, ...]]:
    """Return a file with the schema that it is read as, its own where that is another, and what was assumed."""
    found = _SCHEMA.search(content[:_HEAD])
    name = found.group(1).decode("latin-1").upper() if found else ""
    if not found or not _READ_AS.fullmatch(name):
        return content, "", ()
    relabelled = content[: found.start(1)] + _NEWEST.encode() + content[found.end(1) :]
    mended, notes = translated(relabelled)
    return mended, name, notes


def _lost_classes(content: bytes) -> tuple[str, ...]:
    """Return the classes of a file that the newest schema does not have, as their names are written there."""
    schema = library().ifcopenshell_wrapper.schema_by_name(_NEWEST)
    lost = []
    for name in sorted({match.group(1).decode("ascii") for match in _CLASS.finditer(content)}):
        try:
            schema.declaration_by_name(name)
        except RuntimeError:
            lost.append(name)
    return tuple(lost)


def _text(content: bytes) -> str:
    """Return a file as text, with letters beyond ASCII spelt as in the standard, ISO 10303-21."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:  # against the standard, but what programs of some countries write
        text = content.decode("latin-1")
    return _BEYOND_ASCII.sub(lambda match: f"\\X4\\{match.group().encode('utf-32-be').hex().upper()}\\X0\\", text)


def _guessed_unit(model: Any) -> str:
    """Return the unit that most coordinates of a file can be in, m or mm; empty where it has none."""
    points = (point.Coordinates for point in model.by_type("IfcCartesianPoint"))
    sizes = sorted(abs(float(value)) for values in points for value in values or () if value)
    if not sizes:
        return ""
    return "mm" if sizes[int(_MOST * (len(sizes) - 1))] > _LARGEST_IN_METRES else "m"


def _unit_of_file(model: Any) -> float | None:
    """Return the metres in the file's unit of length; None where it has none, or a misspelt one."""
    units = model.by_type("IfcProject")[0].UnitsInContext
    for unit in units.Units if units else ():
        if getattr(unit, "UnitType", None) != "LENGTHUNIT":
            continue
        if unit.is_a("IfcSIUnit") and unit.Name is None:
            return None
        scale = library("util.unit").get_unit_scale(unit)
        return float(scale) if scale and scale > 0.0 else None
    return None
