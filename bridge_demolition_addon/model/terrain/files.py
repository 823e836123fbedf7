"""Files of terrain, each read by its own reader."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError, ScenarioError, UnreadableError
from ..mesh_reading import MESH_FILES, from_y_up, read_mesh
from ..scenario import Ground
from .ascii_grid import read_ascii_grid
from .geotiff import read_geotiff
from .landxml import read_landxml
from .point_files import read_points

GRID_FILES, POINT_FILES, LANDXML_FILES, TIFF_FILES = (".asc",), (".xyz", ".csv", ".txt"), (".xml",), (".tif", ".tiff")
TERRAIN_FILES = (*MESH_FILES, *GRID_FILES, *POINT_FILES, *LANDXML_FILES, *TIFF_FILES)
SURFACE_FILES = (*MESH_FILES, *LANDXML_FILES)


def read_terrain(name: str, ground: Ground) -> Raster | Surface:
    """Read the heights of a file, in its own coordinates and units."""
    with _named_file(name, "ground.file", TERRAIN_FILES) as path:
        suffix = path.suffix.lower()
        if suffix in GRID_FILES:
            return read_ascii_grid(path, ground.no_data)
        if suffix in TIFF_FILES:
            return read_geotiff(path, ground.no_data, ground.scale)
        if suffix in POINT_FILES:
            return read_points(path, ground.no_data)
        return Surface(_surface_mesh(path, ground))


def read_surface(name: str, ground: Ground) -> TriangleMesh:
    """Read the mesh of a surface on the ground, in its own coordinates and units."""
    with _named_file(name, "ground.surfaces.file", SURFACE_FILES) as path:
        return _surface_mesh(path, ground)


def _surface_mesh(path: Path, ground: Ground) -> TriangleMesh:
    suffix = path.suffix.lower()
    if suffix in LANDXML_FILES:
        return read_landxml(path, ground.scale).mesh
    mesh = read_mesh(path)
    is_y_up = (ground.up or ("y" if suffix == ".glb" else "z")) == "y"
    return TriangleMesh(from_y_up(mesh.vertices), mesh.triangles) if is_y_up else mesh


@contextmanager
def _named_file(name: str, key: str, suffixes: tuple[str, ...]) -> Iterator[Path]:
    """Give the path under a key, whose name says what kind of file it is; errors of its reader name the file."""
    path = Path(name)
    if path.suffix.lower() not in suffixes:
        raise ScenarioError(f'{key} is "{path}": expected a file that ends in one of {", ".join(suffixes)}')
    try:
        yield path
    except UnreadableError as error:
        raise ScenarioError(f'{key} is "{path}": {error}') from error
    except GeometryError as error:
        raise GeometryError(f"{path}: {str(error).removeprefix(f'{path}: ')}") from error
