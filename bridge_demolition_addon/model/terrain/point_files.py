"""Points as text, x, y and z in each line, and point clouds in LAS and LAZ, which a process of its own unpacks."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError, MissingLibraryError
from ...system.isolated import isolated
from ...system.reading import MEGABYTE, check_file, file_text
from .file_heights import no_number

_MOST_BYTES = 500 * MEGABYTE

MOST_SCATTERED = 1_000_000
"""Points that do not lie on a grid, between which triangles are looked for."""

_OFF_GRID = 1e-3
"""How far a point may lie off a grid, as a part of its step: decimals that were cut off."""

_CELLS_PER_POINT = 3
"""Cells of a grid for each point on it, fewer than that: what is left out of it has no data."""


_FEWEST_COLUMNS = 3

_CALLED = (
    ("x", "e", "east", "easting", "rechtswert", "ost", "øst", "öst", "este"),
    ("y", "n", "north", "northing", "hochwert", "nord", "norte"),
    ("z", "h", "height", "elev", "elevation", "level", "höhe", "hoehe", "høyde", "höjd", "altitude", "cota", "quota"),
)
"""What columns of x, y and z are called."""

_NAME_THEM = "name the columns x, y and z in a first line, such as id, x, y, z, code"


def read_points(path: Path, no_data: float | None) -> Raster | Surface:
    """Read points: as a grid where they lie on one, else with the triangles of Delaunay between them."""
    points = point_rows(path)
    if no_data is not None:
        points = points[points[:, 2] != no_data]
    if len(points) < 3:
        raise GeometryError(f"holds {len(points)} points: expected at least 3")
    return on_grid(points) or triangulated(points)


def point_rows(path: Path) -> np.ndarray:
    """Return the points (n, 3) of a file of lines."""
    return _numbers(file_text(path, _MOST_BYTES))


def on_grid(points: np.ndarray) -> Raster | None:
    """Return points (n, 3) as a grid; None where they do not lie on one."""
    along_x, along_y = (_regular(points[:, axis]) for axis in (0, 1))
    if along_x is None or along_y is None:
        return None
    (columns, first_x, dx), (rows, first_y, dy) = along_x, along_y
    shape = int(rows.max()) + 1, int(columns.max()) + 1
    if min(shape) < 2 or shape[0] * shape[1] >= _CELLS_PER_POINT * len(points):
        return None
    heights = np.full(shape, np.nan)
    heights[rows, columns] = points[:, 2]
    return Raster(np.array([first_x, first_y]), np.array([dx, dy]), heights)


def triangulated(points: np.ndarray) -> Surface:
    """Return the triangles of Delaunay between points (n, 3) in plan."""
    if len(points) > MOST_SCATTERED:
        raise GeometryError(
            f"holds {len(points)} points that lie on no grid: expected at most {MOST_SCATTERED}; make a grid of them"
        )
    from matplotlib.tri import Triangulation  # takes long to load, and most ground is a grid or level

    x, y = (points[:, :2] - points[:, :2].mean(axis=0)).T
    try:
        triangles = Triangulation(x, y).triangles
    except (RuntimeError, ValueError) as error:
        raise GeometryError("holds points that lie on a line: expected an area of them") from error
    return Surface(TriangleMesh(points, triangles.astype(np.int64)))


def _numbers(text: str) -> np.ndarray:
    text = _with_points(text)
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    names: list[str] = []
    if lines and not _are_numbers(_words(lines[0])):
        names, lines = _names(lines[0]), lines[1:]
    if not lines:
        raise GeometryError("expected lines of x, y and z")
    columns = _named_columns(names)
    points = _columns(lines, columns) if columns else _first_columns(lines)
    if not np.isfinite(points[:, :2]).all():
        raise GeometryError("a point has no position: expected numbers for x and y")
    return points[np.isfinite(points[:, 2])]


def _first_columns(lines: Sequence[str]) -> np.ndarray:
    """Return the first three numbers (n, 3) of each line."""
    width = len(_words(lines[0]))
    if width < _FEWEST_COLUMNS:
        raise GeometryError("expected lines of x, y and z")
    try:
        values = np.array(_words(" ".join(lines)), dtype=float)
    except ValueError as error:
        raise GeometryError(f"expected lines of x, y and z, found {no_number(error)}; {_NAME_THEM}") from error
    if len(values) != width * len(lines):
        raise GeometryError(f"expected {width} numbers in each line, as in the first")
    points = values.reshape(-1, width)
    if width > _FEWEST_COLUMNS and (points[:, 0] == np.arange(1, len(points) + 1)).all():
        raise GeometryError(f"its first column counts the points: take it out, or {_NAME_THEM}")
    return points[:, :_FEWEST_COLUMNS]


def _columns(lines: Sequence[str], columns: Sequence[int]) -> np.ndarray:
    """Return the numbers (n, 3) in some columns of each line; other columns may hold text."""
    try:
        rows = [[words[column] for column in columns] for words in map(_names, lines)]
        return np.array(rows, dtype=float).reshape(-1, _FEWEST_COLUMNS)
    except IndexError as error:
        raise GeometryError("expected columns of x, y and z in each line, as in the first") from error
    except ValueError as error:
        raise GeometryError(f"expected numbers in the columns of x, y and z, found {no_number(error)}") from error


def _words(text: str) -> list[str]:
    for separator in ",;\t":
        text = text.replace(separator, " ")
    return text.split()


def _names(line: str) -> list[str]:
    """Return the contents of a line's columns, some maybe empty."""
    separator = next((sign for sign in ";\t," if sign in line), None)
    return [word.strip().strip('"') for word in line.split(separator)]


def _named_columns(names: Sequence[str]) -> tuple[int, ...]:
    """Return the columns of x, y and z by what they are called; empty where that does not say all three."""
    plain = [name.lower().strip() for name in names]
    found = [next((column for column, name in enumerate(plain) if name in called), None) for called in _CALLED]
    return tuple(column for column in found if column is not None) if None not in found else ()


def _with_points(text: str) -> str:
    """Return lines with decimal points where they have decimal commas and other separators."""
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    last = lines[-1].strip() if lines else ""
    is_apart = ";" in last or "\t" in last or len(last.replace(", ", ",").split()) >= _FEWEST_COLUMNS
    return text.replace(",", ".") if is_apart and "," in last and "." not in last else text


def _are_numbers(words: Sequence[str]) -> bool:
    try:
        return bool([float(word) for word in words])
    except ValueError:
        return False


def _regular(values: np.ndarray) -> tuple[np.ndarray, float, float] | None:
    """Return number (n,) of each value in a regular row, its first value and its step; None without a step."""
    different = np.unique(values)
    gaps = np.diff(different)
    scale = float(np.abs(values).max())
    gaps = gaps[gaps > 1e-9 * max(scale, 1.0)]
    if not len(gaps):
        return None
    step = float(gaps.min())
    numbers = np.rint((values - different[0]) / step)
    if numbers.max() > 1e6:
        return None
    step = float((different[-1] - different[0]) / max(numbers.max(), 1.0))
    numbers = np.rint((values - different[0]) / step)
    if (np.abs(values - different[0] - numbers * step) > _OFF_GRID * step).any():
        return None
    return numbers.astype(np.int64), float(different[0]), step


CLOUD_FILES = (".las", ".laz")

MOST_BYTES = 4000 * MEGABYTE
MOST_POINTS = 200_000_000

_LIMIT_S = 600.0
_MOST_MEMORY = 16 * 10**9
"""Bytes of as many points, with all that a file says of each."""

_HOW = "point clouds in LAS are read by laspy: install it with pip install 'bridge-demolition-addon[scans]'"


def read_cloud(path: Path, most_points: int = MOST_POINTS) -> tuple[np.ndarray, np.ndarray]:
    """Return the points (n, 3) of a cloud, in its own coordinates, and their classes (n,); 2 is ground.

    Classes: ASPRS, *LAS specification 1.4*, table 17. Raise `UnreadableError` where the file cannot be read.
    """
    check_file(path, MOST_BYTES)
    if find_spec("laspy") is None:
        raise MissingLibraryError(_HOW)
    with tempfile.TemporaryDirectory(prefix="bda-cloud-") as folder:
        kept = Path(folder) / "points.npz"
        request = {"path": str(path.absolute()), "kept": str(kept), "most_points": most_points}
        isolated("model.terrain.cloud_program", request, _LIMIT_S, _MOST_MEMORY)
        with np.load(kept) as arrays:
            points, classes = arrays["points"], arrays["classes"]
    if not len(points):
        raise GeometryError("holds no points")
    return points, classes
