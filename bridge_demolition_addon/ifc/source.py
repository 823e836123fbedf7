"""An IFC file, opened and checked, with its unit of length.

Products that stand at a distance along an alignment get plain placements: the geometry library crashes on some
alignments, and does not know others.
"""

from __future__ import annotations

import re
import traceback
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from ..engineering.geometry.vectors import unit
from ..errors import GeometryError, IfcError, UnreadableError
from ..system.reading import MEGABYTE, check_file
from .alignments import curve_of, place_along
from .library import library
from .missing_references import CONTRADICTIONS, items_of, opened, remove_incomplete, unknown_shapes
from .older_schemas import translated
from .settings import UNITS, ImportSettings

MOST_BYTES = 2000 * MEGABYTE
"""Size up to which a file is read, all of it in memory."""

SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")

_NEWEST = "IFC4X3_ADD2"
_READ_AS = (
    (re.compile(r"IFC2X3(_?(FINAL|TC|ADD|RC)\w*)?"), "IFC2X3"),
    (re.compile(r"IFC(4|2X4)(_?(FINAL|TC|ADD|RC)\w*)?"), "IFC4"),
    (re.compile(r"IFC4[X.][123](_?(FINAL|TC|ADD|RC|DEV)\w*)?"), _NEWEST),
)
"""Names of schemas with those of their editions, as programs write them, and the one of the library's that has it."""

_NOT_FOUND = re.compile(r"Instance #(\d+) not found")
_CLASS = re.compile(rb"=\s*(IFC[A-Z0-9_]+)\s*\(")

_BEGINNING, _END = b"ISO-10303-21;", b"END-ISO-10303-21;"
_HEAD = 100_000
"""Bytes in which the header of a file ends."""

_SCHEMA = re.compile(rb"FILE_SCHEMA\s*\(\s*\(?\s*'([^']*)'", flags=re.IGNORECASE)
_DATA = re.compile(rb"^[ \t]*DATA\b[^;\n]*;", flags=re.IGNORECASE | re.MULTILINE)
_HEADER = b"""ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('%s'));
ENDSEC;
"""
"""Where the data of a file begin, and what is put before them: without all of its own header none is read."""

_AMERICAN = re.compile(rb"(IFCSIUNIT\s*\([^;]*?\.(?:SQUARE_|CUBIC_)?)METER(\.\s*\)\s*;)", flags=re.IGNORECASE)
"""A unit as some programs spell it; the standard's metre is METRE."""

_MOST, _LARGEST_IN_METRES = 0.75, 200.0
"""Part of all coordinates, and what it does not exceed in metres: parts of bridges are smaller, and placements few."""

_RADIAN = {"UnitType": "PLANEANGLEUNIT", "Name": "RADIAN"}

_NUMBER = re.compile(rb"^[ \t]*#(\d+)[ \t]*=", flags=re.MULTILINE)
_STATEMENT = re.compile(rb"^[ \t]*#(\d+)[ \t]*=(?:'[^']*'|[^';])*+;", flags=re.MULTILINE)

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
    """Classes that the schema that the file is read as does not have."""
    unknown: Mapping[int, str] = field(default_factory=dict)
    """Why products have no shape, by their numbers in the file, where lines are missing that these need."""


@contextmanager
def naming_contradictions(path: Path) -> Iterator[None]:
    """Report that a file contradicts its schema where IfcOpenShell fails on it; errors of other code pass."""
    try:
        yield
    except (AssertionError, AttributeError, IndexError, KeyError, RuntimeError, TypeError, ValueError) as error:
        frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
        folder = Path(library().__file__ or "").parent
        if not any(folder in Path(frame.f_code.co_filename).parents for frame in frames):
            raise
        raise IfcError(
            f"{path}: contradicts its schema{_place_of(frames, error)}; check it with a validator of IFC, or export it "
            "again"
        ) from error


def _place_of(frames: Sequence[FrameType], error: Exception) -> str:
    """Return the statement that was read last; empty where none was."""
    if found := _NOT_FOUND.search(str(error)):
        return f", as #{found.group(1)} is the number of several lines, or of none"
    for frame in reversed(frames):
        for value in reversed(frame.f_locals.values()):
            if hasattr(value, "is_a") and hasattr(value, "id") and value.id():
                return f" in {value.is_a()} #{value.id()}"
    return ""


def open_source(path: Path, settings: ImportSettings) -> IfcSource:
    """Open an IFC file."""
    content, schema = _content(path)
    mended, count = _AMERICAN.subn(rb"\1METRE\2", content)
    mended, read_as, assumed = _relabelled(mended, schema)
    mended, repeated = _without_repeated(mended)
    try:
        model, missing = opened(_text(mended))
        has_project = bool(model.by_type("IfcProject"))
    except (RuntimeError, ValueError, library().Error) as error:
        raise IfcError(f"{path}: cannot be read as IFC; export it again") from error
    if not has_project:
        raise IfcError(f"{path}: has no IfcProject, so no units and no bridge; export the whole project")
    notes = ("METER is taken for METRE, as the standard spells it",) if count else ()
    lost = _lost_classes(mended, read_as)
    if read_as != schema:
        notes = (*notes, f"the schema {schema} is read as {read_as}", *assumed)
    if lost:
        said = "they are left out, and what is placed along these has no shape"
        notes = (*notes, f"{read_as} has no {', '.join(lost)}: {said}")
    unknown, unplaced = unknown_shapes(model, missing)
    incomplete = (*repeated, *unplaced, *remove_incomplete(model))
    if incomplete and settings.strict:
        raise IfcError(f"{path}: {incomplete[0]}; export it again")
    notes = (*notes, *incomplete)
    project = model.by_type("IfcProject")[0]
    if project.UnitsInContext is None:  # without any no geometry is worked out; what it is in is guessed, or said
        project.UnitsInContext = model.create_entity("IfcUnitAssignment", [model.create_entity("IfcSIUnit", **_RADIAN)])
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
    return IfcSource(path, model, unit_m / taken_m, unit_m, angle_rad, notes, lost, unknown)


def _content(path: Path) -> tuple[bytes, str]:
    """Return what a file holds, and the name of its schema, as it writes it."""
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
        meshes = "export one, or meshes as OBJ or STL, which [[geometry]] of a scenario names"
        raise IfcError(f"{path}: is no IFC file, which begins with {_BEGINNING.decode()} {meshes}")
    if _END not in content[-_HEAD:]:
        raise IfcError(f"{path}: is cut short, as {_END.decode()} is missing at its end; copy or export it again")
    schema = _SCHEMA.search(beginning)
    name = schema.group(1).decode("latin-1") if schema else ""
    if not _read_as(name):
        actual = f"of the schema {name}" if name else "of no schema"
        raise IfcError(f"{path}: is {actual}: expected one of {', '.join(SCHEMAS)}; export it as one of them")
    known = library().ifcopenshell_wrapper.schema_names()
    if _read_as(name) not in known:
        raise IfcError(
            f"{path}: is of the schema {name}, and the IfcOpenShell that is installed reads only "
            f"{', '.join(one for one in known if one.startswith('IFC'))}; export it as one of them, or install a newer "
            "IfcOpenShell"
        )
    return content, name


def _read_as(name: str) -> str:
    """Return the schema that one is read as by its name, whatever its case and spaces; empty for none."""
    plain = re.sub(r"[\s-]+", "_", name.strip()).upper().removeprefix("IFC_")
    plain = plain if plain.startswith("IFC") else f"IFC{plain}"
    return next((schema for pattern, schema in _READ_AS if pattern.fullmatch(plain)), "")


def _relabelled(content: bytes, name: str) -> tuple[bytes, str, tuple[str, ...]]:
    """Return a file with a header of the schema that it is read as, that schema, and what was assumed."""
    read_as = _read_as(name)
    if data := _DATA.search(content):
        content = _HEADER % read_as.encode() + content[data.start() :]
    if name == read_as or read_as != _NEWEST:
        return content, read_as, ()
    mended, notes = translated(content)
    return mended, read_as, notes


def _lost_classes(content: bytes, read_as: str) -> tuple[str, ...]:
    """Return the classes of a file that a schema does not have, as their names are written there."""
    schema = library().ifcopenshell_wrapper.schema_by_name(read_as)
    lost = []
    for name in sorted({name.decode("ascii") for name in set(_CLASS.findall(content))}):
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


def _without_repeated(content: bytes) -> tuple[bytes, tuple[str, ...]]:
    """Return the text without statements of a number that one before has, or of #0, and a note on them."""
    numbers = _NUMBER.findall(content)
    if len({b"0", *numbers}) > len(numbers):
        return content, ()
    known: set[int] = {0}
    repeated: list[str] = []

    def first_of_its_number(statement: re.Match[bytes]) -> bytes:
        number = int(statement[1])
        if number in known:
            repeated.append(f"#{number}")
            return b""
        known.add(number)
        return statement[0]

    kept = _STATEMENT.sub(first_of_its_number, content)
    return kept, (f"of statements with one number the first counts: {', '.join(dict.fromkeys(repeated))}",)


def _guessed_unit(model: Any) -> str:
    """Return the unit that most coordinates of a file can be in, m or mm; empty where it has none."""
    points = (point.Coordinates for point in model.by_type("IfcCartesianPoint"))
    lists = () if model.schema == "IFC2X3" else model.by_type("IfcCartesianPointList3D")
    rows = (row for points_of in lists for row in points_of.CoordList or ())
    sizes = sorted(abs(float(value)) for values in chain(points, rows) for value in values or () if value)
    if not sizes:
        return ""
    return "mm" if sizes[int(_MOST * (len(sizes) - 1))] > _LARGEST_IN_METRES else "m"


def _unit_of_file(model: Any) -> float | None:
    """Return the metres in the file's unit of length; None where it has none, or a misspelt one."""
    units = model.by_type("IfcProject")[0].UnitsInContext
    for given in units.Units if units else ():
        if getattr(given, "UnitType", None) != "LENGTHUNIT":
            continue
        if given.is_a("IfcSIUnit") and given.Name is None:
            return None
        scale = library("util.unit").get_unit_scale(given)
        return float(scale) if scale and scale > 0.0 else None
    return None


def place_along_curves(model: Any, unit_m: float) -> tuple[str, ...]:
    """Give products of a file, an `ifcopenshell.file`, plain placements, and return what was assumed."""
    if not model.schema.startswith("IFC4X3"):
        return ()
    counted = 0
    for placement in model.by_type("IfcLinearPlacement"):
        for product in placement.PlacesObject:
            if _swept_along(product) and _swept_along(product) == {getattr(_location(placement), "BasisCurve", None)}:
                counted += 1
                product.ObjectPlacement = None
        plain = _plain(model, placement, unit_m)
        if plain is None:
            continue
        for product in placement.PlacesObject:
            product.ObjectPlacement = plain
        for other in placement.ReferencedByPlacements:
            other.PlacementRelTo = plain
    if not counted:
        return ()
    return (f"{counted} elements that are swept along an alignment and placed along it as well are placed once",)


def _swept_along(product: Any) -> set[Any]:
    """Return the curves along which a product is swept; none where a part of it is of another kind."""
    items = items_of(product, "IfcSolidModel")
    swept = {item.Directrix for item in items if item.is_a("IfcSectionedSolidHorizontal")}
    return swept if all(item.is_a("IfcSectionedSolidHorizontal") for item in items) else set()


def _location(placement: Any) -> Any:
    return getattr(placement.RelativePlacement, "Location", None)


def _plain(model: Any, placement: Any, unit_m: float) -> Any:
    """Return a placement without its curve; None where the curve is not known and the file has no position."""
    point = _location(placement)
    try:
        along, left, up = place_along(point, unit_m)
        frame = curve_of(point.BasisCurve, unit_m).at(float(along))
        axis, way = frame.up, frame.along
        if placement.RelativePlacement.Axis or placement.RelativePlacement.RefDirection:
            axis, way = _turned(placement.RelativePlacement, frame.along, frame.left, frame.up)
    except (GeometryError, *CONTRADICTIONS):
        at = placement.CartesianPosition
        return model.create_entity("IfcLocalPlacement", placement.PlacementRelTo, at) if at else None
    origin = (frame.point + left * frame.left + up * frame.up) / unit_m
    location = model.create_entity("IfcCartesianPoint", tuple(map(float, origin)))
    directions = [model.create_entity("IfcDirection", tuple(map(float, one))) for one in (axis, way)]
    at = model.create_entity("IfcAxis2Placement3D", location, *directions)
    return model.create_entity("IfcLocalPlacement", placement.PlacementRelTo, at)


def _turned(relative: Any, along: np.ndarray, left: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return z and x of a placement that is turned against the curve, whose directions its own are given in."""

    def in_file(direction: Any, otherwise: np.ndarray) -> np.ndarray:
        if direction is None:
            return otherwise
        x, y, z = (*direction.DirectionRatios, 0.0)[:3]
        return unit(x * along + y * left + z * up)

    return in_file(relative.Axis, up), in_file(relative.RefDirection, along)
