"""GeoTIFFs of heights, by OGC 19-008r4 (*GeoTIFF standard*, 2019), and the program that reads them."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from ...engineering.terrain.raster import Raster
from ...errors import GeometryError, UnreadableError
from ...system.isolated import answer, isolated
from ...system.reading import MEGABYTE, check_file
from .file_heights import FileHeights

_MOST_BYTES = 1000 * MEGABYTE
_LIMIT_S = 600.0
_MOST_MEMORY = 2 * 10**9
"""Bytes for as many heights, in the numbers of the file and in double precision."""


MOST_HEIGHTS = 50_000_000
"""Heights that are read; a square of 7 km by 7 km in steps of 1 m."""

_PIXEL_SCALE, _TIE_POINT, _TRANSFORMATION, _NO_DATA = 33550, 33922, 34264, 42113
"""Tags, the last one of GDAL."""

_PIXEL_IS_POINT, _GEOGRAPHIC = 2, 2
_METRE = 9001
_FEET = {9002: 0.3048, 9003: 0.304800609601}
"""Units of length by their codes of EPSG: the international foot, and that of US surveys."""


def read_geotiff(path: Path, no_data: float | None, scale: float) -> FileHeights:
    """Read the heights of a GeoTIFF, in a process of its own; `scale` is what the user takes for metres in one unit.

    A `GeometryError` says what is wrong: no height model, in degrees, or in a unit that is not known.
    """
    check_file(path, _MOST_BYTES)
    with tempfile.TemporaryDirectory(prefix="bda-heights-") as folder:
        kept = Path(folder) / "heights.npz"
        request = {"path": str(path.absolute()), "kept": str(kept), "no_data": no_data, "scale": scale}
        try:
            said = isolated("model.terrain.geotiff", request | {"most_heights": MOST_HEIGHTS}, _LIMIT_S, _MOST_MEMORY)
        except UnreadableError as error:
            raise GeometryError(str(error)) from error
        with np.load(kept) as arrays:
            raster = Raster(arrays["first"], arrays["steps"], arrays["heights"])
    return FileHeights(raster, said["unit_m"] or 1.0, "feet" if said["unit_m"] else "")


def heights_in(path: Path, no_data: float | None, scale: float, most_heights: int) -> tuple[Raster, float | None]:
    """Return the heights of a GeoTIFF, read in this process, and the metres in its unit where that is not the metre."""
    import tifffile  # no other ground needs it

    try:
        with tifffile.TiffFile(path) as file:
            page = file.pages.first
            _check_kind(page, most_heights)
            keys = page.geotiff_tags or {}
            tags = {code: page.tags[code].value for code in _tags_in(page)}
            values = page.asarray()
    except (GeometryError, MemoryError):
        raise
    except Exception as error:  # the reader has many for a file that is damaged or compressed in ways it does not know
        raise GeometryError(
            f"cannot be read as TIFF: {error}; save it without compression, or compressed by DEFLATE"
        ) from error
    _check_units(keys, scale)
    first, steps = _placing(tags, keys)
    heights = values.reshape(values.shape[:2]).astype(float)
    unknown = _no_data_of(tags) if no_data is None else no_data
    if unknown is not None:
        # Compared in the kind of number that the file has: -3.4028235e38 of single precision is another in double.
        heights[values.reshape(heights.shape) == _in_kind(unknown, values.dtype)] = np.nan
    rows = len(heights)
    raster = Raster(np.array([first[0], first[1] - steps[1] * (rows - 1)]), steps, heights[::-1])
    return raster, _FEET.get(int(keys.get("ProjLinearUnitsGeoKey", _METRE)))


def _tags_in(page: Any) -> list[int]:
    return [code for code in (_PIXEL_SCALE, _TIE_POINT, _TRANSFORMATION, _NO_DATA) if code in page.tags]


def _check_kind(page: Any, most_heights: int) -> None:
    shape = page.shape
    if len(shape) > 3 or (len(shape) == 3 and 1 not in (shape[0], shape[2])) or page.samplesperpixel != 1:
        raise GeometryError("is no height model: expected one value a pixel, found several, as pictures have")
    if page.dtype is None or page.dtype.kind not in "iuf" or page.dtype.itemsize < 2:
        raise GeometryError(f"is no height model: its values are {page.dtype}, as pictures have")
    if page.size > most_heights:
        raise GeometryError(f"holds {page.size} heights: expected at most {most_heights}; cut the site out of it first")
    if page.size < 4 or min(page.imagelength, page.imagewidth) < 2:
        raise GeometryError("is no height model: expected at least 2 rows of 2 heights")


def _check_units(keys: dict[str, Any], scale: float) -> None:
    is_projected = "ProjectedCSTypeGeoKey" in keys
    if int(keys.get("GTModelTypeGeoKey", 0)) == _GEOGRAPHIC or (
        "GeographicTypeGeoKey" in keys and not is_projected and "ProjLinearUnitsGeoKey" not in keys
    ):
        raise GeometryError("is in degrees: project it to a map in metres first, such as UTM")
    unit = int(keys.get("ProjLinearUnitsGeoKey", _METRE))
    vertical = int(keys.get("VerticalUnitsGeoKey", unit))
    if vertical != unit:
        raise GeometryError("has heights in another unit than distances: convert the one into the other first")
    if unit != _METRE and unit not in _FEET and scale == 1.0:
        raise GeometryError(f"is in a unit of length with the EPSG code {unit}: set ground.scale to it, or use metres")


def _placing(tags: dict[int, Any], keys: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return easting and northing of the north-western height, and the steps between heights."""
    if _TRANSFORMATION in tags:
        matrix = np.asarray(tags[_TRANSFORMATION], float).reshape(4, 4)
        if not keys and not matrix[:2, 3].any():
            raise GeometryError(
                "does not say where it lies: give it its corners on a map, as gdal_edit.py -a_ullr does"
            )
        if matrix[0, 1] or matrix[1, 0] or matrix[0, 0] <= 0.0 or matrix[1, 1] >= 0.0:
            raise GeometryError("is turned against north: resample it to rows from west to east first")
        corner, steps = matrix[:2, 3], np.array([matrix[0, 0], -matrix[1, 1]])
    elif _PIXEL_SCALE in tags and _TIE_POINT in tags:
        steps = np.asarray(tags[_PIXEL_SCALE], float)[:2]
        tie = np.asarray(tags[_TIE_POINT], float)[:6]
        corner = tie[3:5] - tie[:2] * steps * (1.0, -1.0)
    else:
        raise GeometryError("is no GeoTIFF: it does not say where it lies")
    if not (np.isfinite(steps).all() and (steps > 0.0).all() and np.isfinite(corner).all()):
        raise GeometryError("does not say how large its pixels are")
    if int(keys.get("GTRasterTypeGeoKey", 1)) != _PIXEL_IS_POINT:
        corner = corner + steps * (0.5, -0.5)
    return corner, steps


def _no_data_of(tags: dict[int, Any]) -> float | None:
    text = str(tags.get(_NO_DATA, "")).strip(" \0")
    try:
        return float(text) if text else None
    except ValueError as error:
        raise GeometryError(f"says that {text!r} stands for no data: expected a number, set ground.no_data") from error


def _in_kind(value: float, kind: np.dtype) -> Any:
    """Return a number as a kind of number; nan, which equals nothing, where that cannot hold it."""
    if kind.kind == "f":
        with np.errstate(over="ignore"):
            return np.asarray(value, float).astype(kind)
    limits = np.iinfo(kind)
    return np.asarray(int(value), kind) if limits.min <= value <= limits.max and value == int(value) else np.nan


def main() -> None:
    """Answer the request: read heights, and leave them in a file."""
    answer(_read)


def _read(request: dict[str, Any]) -> dict[str, Any]:
    raster, unit_m = heights_in(
        Path(request["path"]), request["no_data"], request["scale"], int(request["most_heights"])
    )
    np.savez(request["kept"], first=raster.first, steps=raster.steps, heights=raster.heights)
    return {"unit_m": unit_m}
