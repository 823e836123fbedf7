"""Files of terrain, each read by its own reader."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError, ScenarioError, UnreadableError
from ..mesh_reading import MESH_FILES, from_y_up, read_mesh
from ..scenario import Ground
from .file_heights import FileHeights, read_ascii_grid
from .geotiff import read_geotiff
from .landxml import IFC_FILES, read_ifc_surface, read_landxml
from .point_files import CLOUD_FILES, read_cloud, read_points, triangulated

GRID_FILES, POINT_FILES, LANDXML_FILES, TIFF_FILES = (".asc",), (".xyz", ".csv", ".txt"), (".xml",), (".tif", ".tiff")
TERRAIN_FILES = (*MESH_FILES, *GRID_FILES, *POINT_FILES, *LANDXML_FILES, *TIFF_FILES, *CLOUD_FILES, *IFC_FILES)
SURFACE_FILES = (*MESH_FILES, *LANDXML_FILES)

_CELL = 0.5
"""Side of the cells of which a point cloud gives the lowest point, in its own unit."""

_GROUND_CLASS = 2


def read_terrain(name: str, ground: Ground) -> FileHeights:
    """Read the heights of a file, in its own coordinates and units."""
    with _named_file(name, "ground.file", TERRAIN_FILES) as path:
        suffix = path.suffix.lower()
        if suffix in GRID_FILES:
            return FileHeights(read_ascii_grid(path, ground.no_data))
        if suffix in TIFF_FILES:
            return read_geotiff(path, ground.no_data, ground.scale)
        if suffix in POINT_FILES:
            return FileHeights(read_points(path, ground.no_data))
        if suffix in CLOUD_FILES:
            return _cloud_heights(path)
        if suffix in IFC_FILES:
            return read_ifc_surface(path, ground.surface)
        if suffix in LANDXML_FILES:
            return read_landxml(path, ground.surface)
        return FileHeights(Surface(_surface_mesh(path, ground)))


def _cloud_heights(path: Path) -> FileHeights:
    """Return the lowest points of a cloud in each cell, of those that are ground where some are said to be."""
    points, classes = read_cloud(path)
    is_ground = classes == _GROUND_CLASS
    notes: tuple[str, ...] = ()
    if is_ground.sum() >= 3:
        points = points[is_ground]
    else:
        notes = ("none of its points is said to be ground: the lowest ones are taken for it",)
    cells = np.floor(points[:, :2] / _CELL).astype(np.int64)
    order = np.lexsort((points[:, 2], cells[:, 1], cells[:, 0]))
    is_first = np.append(True, (np.diff(cells[order], axis=0) != 0).any(axis=1))
    return FileHeights(triangulated(points[order][is_first]), notes=notes)


def read_surface(name: str, ground: Ground) -> tuple[TriangleMesh, float]:
    """Read the mesh of a surface on the ground, in its own coordinates, and the metres in its unit where it says it."""
    with _named_file(name, "ground.surfaces.file", SURFACE_FILES) as path:
        if path.suffix.lower() in LANDXML_FILES:
            read = read_landxml(path)
            assert isinstance(read.source, Surface)
            return read.source.mesh, read.unit_m
        return _surface_mesh(path, ground), 1.0


def _surface_mesh(path: Path, ground: Ground) -> TriangleMesh:
    suffix = path.suffix.lower()
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
