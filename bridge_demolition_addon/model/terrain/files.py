"""Files of terrain, each read by its own reader."""

from __future__ import annotations

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
    path = _checked(name, "ground.file", TERRAIN_FILES)
    suffix = path.suffix.lower()
    try:
        if suffix in GRID_FILES:
            return read_ascii_grid(path, ground.no_data)
        if suffix in TIFF_FILES:
            return read_geotiff(path, ground.no_data, ground.scale)
        if suffix in POINT_FILES:
            return read_points(path, ground.no_data)
        return Surface(_surface_mesh(path, ground))
    except UnreadableError as error:
        raise ScenarioError(f'ground.file is "{path}": {error}') from error
    except GeometryError as error:
        raise GeometryError(_named(path, error)) from error


def read_surface(name: str, ground: Ground) -> TriangleMesh:
    """Read the mesh of a surface on the ground, in its own coordinates and units."""
    path = _checked(name, "ground.surfaces.file", SURFACE_FILES)
    try:
        return _surface_mesh(path, ground)
    except UnreadableError as error:
        raise ScenarioError(f'ground.surfaces.file is "{path}": {error}') from error
    except GeometryError as error:
        raise GeometryError(_named(path, error)) from error


def _surface_mesh(path: Path, ground: Ground) -> TriangleMesh:
    suffix = path.suffix.lower()
    if suffix in LANDXML_FILES:
        return read_landxml(path, ground.scale).mesh
    mesh = read_mesh(path)
    is_y_up = (ground.up or ("y" if suffix == ".glb" else "z")) == "y"
    return TriangleMesh(from_y_up(mesh.vertices), mesh.triangles) if is_y_up else mesh


def _checked(name: str, key: str, suffixes: tuple[str, ...]) -> Path:
    path = Path(name)
    if path.suffix.lower() not in suffixes:
        raise ScenarioError(f'{key} is "{path}": expected a file that ends in one of {", ".join(suffixes)}')
    return path


def _named(path: Path, error: GeometryError) -> str:
    text = str(error)
    return text if text.startswith(f"{path}: ") else f"{path}: {text}"
