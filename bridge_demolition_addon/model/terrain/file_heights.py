"""Heights as a file has them: in its own coordinates and unit, with what was left out; and ESRI ASCII grids of them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ...system.reading import MEGABYTE, file_text

_FEW_LOST, _LOST_SHARE = 3, 0.01
"""Triangles without their points that a surface may have: so many, or such a part of all."""


@dataclass(frozen=True, eq=False, slots=True)
class FileHeights:
    """Heights of a file.

    Attributes
    ----------
    unit_m
        Metres in its unit, where the file says it; 1 otherwise.
    unit
        What the file calls it; empty where it says none.
    notes
        What was left out of it.
    """

    source: Raster | Surface
    unit_m: float = 1.0
    unit: str = ""
    notes: tuple[str, ...] = ()


def no_number(error: ValueError) -> str:
    """Return what is no number, of the error that Python and numpy raise of a text."""
    return f"{str(error).rpartition(': ')[2]}, which is no number"


def note_on_lost(lost: int, total: int, first: str) -> tuple[str, ...]:
    """Return a note on triangles that name points that are not there; a `GeometryError` where they are not few."""
    if lost and lost == total:
        raise GeometryError("its surface has no triangles: all of them name points that are not there")
    if lost > max(_FEW_LOST, _LOST_SHARE * total):
        raise GeometryError(
            f"its surface is damaged: {lost} of {total} triangles name points that are not there, first {first}; "
            "export it again"
        )
    return (f"{lost} of {total} triangles name points that are not there: left out",) if lost else ()


_MOST_BYTES = 500 * MEGABYTE

_NO_DATA = -9999.0
"""What stands for no data where the header does not say (ESRI, *ArcGIS*, ASCII raster format)."""

_FINEST_M, _EAST_DEG, _NORTH_DEG = 0.005, 180.0, 90.0
"""Steps of a grid below which, between these longitudes and latitudes, it is in degrees: 0.005° are 500 m."""

_NO_NUMBERS = ("nan", "inf", "infinity")
"""Heights that are written with letters, as GDAL does where there are no data."""

_EXPECTED = "expected ncols, nrows, xllcorner and yllcorner (or xllcenter and yllcenter), and cellsize"


def read_ascii_grid(path: Path, no_data: float | None) -> Raster:
    """Read a grid; a `GeometryError` says what is wrong with it, without the name of the file."""
    header, numbers = _header_and_rest(_with_points(file_text(path, _MOST_BYTES)))
    columns, rows = (_count(header, name) for name in ("ncols", "nrows"))
    dx, dy = (_number(header, name, "cellsize") for name in ("dx", "dy"))
    if dx <= 0.0 or dy <= 0.0:
        raise GeometryError(f"cellsize is {min(dx, dy):g}: expected more than 0")
    first = [_first(header, axis, step) for axis, step in (("x", dx), ("y", dy))]
    if max(dx, dy) < _FINEST_M and abs(first[0]) <= _EAST_DEG and abs(first[1]) <= _NORTH_DEG:
        raise GeometryError(
            f"cellsize is {max(dx, dy):g}, at ({first[0]:g}, {first[1]:g}): that is in degrees; project it to a map in "
            "metres first, such as UTM"
        )
    try:
        heights = np.array(numbers.split(), dtype=float)
    except ValueError as error:
        raise GeometryError(f"a height is {no_number(error)}; export it again") from error
    if len(heights) != rows * columns:
        raise GeometryError(f"holds {len(heights)} heights: expected {rows} rows of {columns}")
    unknown = header.get("nodata_value", _NO_DATA) if no_data is None else no_data
    heights = np.where((heights == unknown) | ~np.isfinite(heights), np.nan, heights).reshape(rows, columns)[::-1]
    return Raster(np.array(first), np.array([dx, dy]), heights)


def _with_points(text: str) -> str:
    """Return a grid with decimal points where it has decimal commas."""
    return text.replace(",", ".") if "," in text and "." not in text else text


def _header_and_rest(text: str) -> tuple[dict[str, float], str]:
    header: dict[str, float] = {}
    position = 0
    while position < len(text):
        end = text.find("\n", position)
        end = len(text) if end < 0 else end
        words = text[position:end].split()
        if words and (not words[0][0].isalpha() or words[0].lower() in _NO_NUMBERS):
            break
        if words:
            if len(words) != 2:
                raise GeometryError(f"has no header of a grid: {_EXPECTED}")
            try:
                header[words[0].lower()] = float(words[1])
            except ValueError as error:
                raise GeometryError(f"{words[0]} is {words[1]}: expected a number") from error
        position = end + 1
    return header, text[position:]


def _number(header: dict[str, float], *names: str) -> float:
    for name in names:
        if name in header:
            return header[name]
    raise GeometryError(f"its header has no {names[-1]}: {_EXPECTED}")


def _count(header: dict[str, float], name: str) -> int:
    value = _number(header, name)
    if not (value == int(value) and value >= 2):
        raise GeometryError(f"{name} is {value:g}: expected a whole number of at least 2")
    return int(value)


def _first(header: dict[str, float], axis: str, step: float) -> float:
    if (centre := f"{axis}llcenter") in header:
        return header[centre]
    return _number(header, f"{axis}llcorner") + step / 2.0
