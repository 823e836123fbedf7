"""Meshes in files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.vectors import transformed
from ..errors import GeometryError
from ..system.reading import MEGABYTE, check_file

MESH_FILES = (".stl", ".obj", ".ply", ".glb")

MOST_BYTES = 1000 * MEGABYTE
"""Size up to which a mesh is read: tens of millions of triangles."""

_FROM_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def from_y_up(vertices: np.ndarray) -> np.ndarray:
    """Turn coordinates (v, 3) with y up and z towards the viewer into ours, with z up."""
    return transformed(_FROM_Y_UP, vertices)


def read_mesh(path: Path) -> TriangleMesh:
    """Return the mesh in a file that ends in one of `MESH_FILES`, as it is."""
    check_file(path, MOST_BYTES)
    import trimesh  # loading it takes half of what all else takes, and most scenarios have no mesh

    try:
        mesh = trimesh.load(path, force="mesh", process=False)
    except Exception as error:  # each reader has its own errors
        raise GeometryError(f"{path}: cannot be read as {path.suffix[1:].upper()}: {error}") from error
    if not isinstance(mesh, trimesh.Trimesh) or not len(mesh.faces):
        raise GeometryError(f"{path}: has no faces; export a closed surface.")
    return TriangleMesh(_vertices(mesh, path), np.asarray(mesh.faces, dtype=np.int64))


def read_points_of_mesh(path: Path) -> np.ndarray:
    """Return the vertices (n, 3) in a file that ends in one of `MESH_FILES`, which may be a cloud without faces."""
    check_file(path, MOST_BYTES)
    import trimesh

    try:
        loaded = trimesh.load(path, process=False)
        parts = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
        points = np.concatenate([_vertices(part, path) for part in parts])
    except Exception as error:  # each reader has its own errors
        raise GeometryError(f"{path}: cannot be read as {path.suffix[1:].upper()}: {error}") from error
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        raise GeometryError(f"{path}: has no points.")
    return points


def _vertices(mesh: Any, path: Path) -> np.ndarray:
    vertices = np.asarray(mesh.vertices, dtype=float)
    if path.suffix.lower() == ".glb":
        # Of single precision in the file; trimesh has placed them by products whose last bits differ by processor.
        vertices = vertices.astype(np.float32).astype(float)
    return vertices
