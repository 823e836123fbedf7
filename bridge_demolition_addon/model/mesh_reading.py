"""Meshes in files: binary ones are read in a process of their own, so that a damaged one ends no other."""

from __future__ import annotations

import tempfile
from fnmatch import fnmatchcase
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.vectors import transformed
from ..errors import GeometryError, UnreadableError
from ..system.isolated import isolated
from ..system.reading import MEGABYTE, check_file

MESH_FILES = (".stl", ".obj", ".ply", ".glb")

MOST_BYTES = 1000 * MEGABYTE
"""Size up to which a mesh is read: tens of millions of triangles."""

_TEXT_FILES = (".obj",)
"""Files that are read here: Python reads their text, and an imported bridge has hundreds of them."""

_LIMIT_S = 600.0

_LISTED = 10
"""Objects of a file that a message names."""

_REMEMBERED_BYTES = 10 * MEGABYTE
"""Size up to which a binary mesh is remembered: the runs of a study read the same files again and again."""
_UNREADABLE = "{}: cannot be read as {}: it is damaged, or of another kind than its name says; export it again"

_FROM_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def from_y_up(vertices: np.ndarray) -> np.ndarray:
    """Turn coordinates (v, 3) with y up and z towards the viewer into ours, with z up."""
    return transformed(_FROM_Y_UP, vertices)


def read_mesh(path: Path, part: str | None = None) -> TriangleMesh:
    """Return the mesh in a file that ends in one of `MESH_FILES`, as it is, or only its objects of a name."""
    return TriangleMesh(*_read(path, is_cloud=False, part=part))


def read_points_of_mesh(path: Path) -> np.ndarray:
    """Return the vertices (n, 3) in a file that ends in one of `MESH_FILES`, which may be a cloud without faces."""
    return _read(path, is_cloud=True)[0]


def _read(path: Path, *, is_cloud: bool, part: str | None = None) -> tuple[np.ndarray, np.ndarray]:
    check_file(path, MOST_BYTES)
    if path.suffix.lower() in _TEXT_FILES:
        return loaded(path, is_cloud=is_cloud, part=part)
    found = path.stat()
    if found.st_size > _REMEMBERED_BYTES:
        return _read_apart(path, is_cloud=is_cloud, part=part)
    changed_and_size = found.st_mtime_ns, found.st_size
    vertices, triangles = _remembered(path.absolute(), *changed_and_size, is_cloud=is_cloud, part=part)
    return vertices.copy(), triangles.copy()


@lru_cache(maxsize=64)
def _remembered(
    path: Path, changed_ns: int, size: int, *, is_cloud: bool, part: str | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return what a file holds; one that was changed since is read again."""
    return _read_apart(path, is_cloud=is_cloud, part=part)


def _read_apart(path: Path, *, is_cloud: bool, part: str | None) -> tuple[np.ndarray, np.ndarray]:
    with tempfile.TemporaryDirectory(prefix="bda-mesh-") as folder:
        kept = Path(folder) / "mesh.npz"
        request = {"path": str(path.absolute()), "kept": str(kept), "is_cloud": is_cloud, "part": part}
        try:
            isolated("model.mesh_program", request, _LIMIT_S)
        except UnreadableError as error:
            raise GeometryError(f"{path}: {str(error).removeprefix(f'{path.absolute()}: ')}") from error
        with np.load(kept) as arrays:
            return arrays["vertices"], arrays["triangles"]


def loaded(path: Path, *, is_cloud: bool, part: str | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices (v, 3) and triangles (t, 3) of a file, read in this process; of a cloud its points alone."""
    import trimesh  # loading it takes half of what all else takes, and most scenarios have no mesh

    try:
        if part is not None:
            whole = _part_of(path, part)
        else:
            whole = trimesh.load(path, process=False) if is_cloud else trimesh.load(path, force="mesh", process=False)
    except GeometryError:
        raise
    except Exception as error:  # each reader has its own errors
        raise GeometryError(_UNREADABLE.format(path, path.suffix[1:].upper())) from error
    if is_cloud:
        return _points(whole, path), np.empty((0, 3), np.int64)
    if not isinstance(whole, trimesh.Trimesh) or not len(whole.faces):
        raise GeometryError(f"{path}: has no faces; export a closed surface.")
    vertices, triangles = _vertices(whole, path), np.asarray(whole.faces, dtype=np.int64)
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise GeometryError(f"{path}: has faces with vertices that it does not have: it is damaged; export it again.")
    if part is None:
        return vertices, triangles
    used, triangles = np.unique(triangles, return_inverse=True)
    return vertices[used], triangles.reshape(-1, 3)


def _part_of(path: Path, part: str) -> Any:
    """Return the mesh of the objects of a name in a file, in their places; in an OBJ file also of groups."""
    import trimesh

    splits = ("split_objects", "split_groups") if path.suffix.lower() == ".obj" else ()
    ways: list[dict[str, Any]] = [{split: True, "group_material": False} for split in splits] or [{}]
    known: list[str] = []
    for way in ways:
        scene: Any = trimesh.load_scene(path, process=False, **way)
        nodes = {node: scene.graph[node] for node in scene.graph.nodes_geometry}
        known += [name for node, (_, mesh) in nodes.items() for name in (node, mesh)]
        wanted = [
            scene.geometry[mesh].copy().apply_transform(matrix)
            for node, (matrix, mesh) in nodes.items()
            if any(fnmatchcase(name.casefold(), part.casefold()) for name in (node, mesh))
        ]
        if wanted:
            return trimesh.util.concatenate(wanted)
    names = list(dict.fromkeys(known))
    listed = ", ".join(names[:_LISTED]) + (" and more" if len(names) > _LISTED else "")
    has = f"it has {listed}" if names else "it names none"
    raise GeometryError(f'{path}: has no object "{part}", which geometry.part names; {has}.')


def _points(whole: Any, path: Path) -> np.ndarray:
    try:
        parts = whole.dump() if hasattr(whole, "dump") else [whole]
        points = np.concatenate([np.empty((0, 3)), *(_vertices(part, path) for part in parts)])
    except Exception as error:  # what is neither a mesh nor a cloud
        raise GeometryError(_UNREADABLE.format(path, path.suffix[1:].upper())) from error
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
