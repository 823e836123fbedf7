"""The program that reads the ground in an IFC file: see `model/terrain/ifc_surfaces`, which starts it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..model.terrain.file_heights import note_on_lost
from ..system.isolated import answer
from .library import library
from .map_place import is_ground, on_map
from .missing_references import items_of
from .settings import ImportSettings, matches
from .shapes import single_shape
from .source import IfcSource, naming_contradictions, open_source


def main() -> None:
    """Answer the request: leave the triangles of the ground in a file."""
    answer(_ground)


def _ground(request: dict[str, Any]) -> dict[str, Any]:
    path, name = Path(request["path"]), request["name"]
    with naming_contradictions(path):
        source = open_source(path, ImportSettings())
        products = [product for product in source.model.by_type("IfcProduct") if product.Representation]
        chosen = [product for product in products if _is_wanted(product, name)]
        meshes = [mesh for product in chosen if (mesh := _surface(source, product)) is not None]
        if not meshes:
            return {"surfaces": 0, "others": [product.Name or product.is_a() for product in products], "notes": []}
        whole, lost = _without_lost(meshes)
        mapped = on_map(source, whole.vertices)
        vertices = whole.vertices if mapped is None else mapped
        notes = [] if mapped is None else ["its heights are those of its map"]
    np.savez(request["kept"], vertices=vertices, triangles=whole.triangles)
    of_file = [note.partition("; --unit")[0] for note in source.notes]
    return {"surfaces": len(meshes), "others": [], "notes": [*of_file, *lost, *notes]}


def _without_lost(meshes: Sequence[TriangleMesh]) -> tuple[TriangleMesh, tuple[str, ...]]:
    """Return meshes as one without triangles that name points that are not there, and a note on these."""
    kept, firsts, total = [], [], 0
    for mesh in meshes:
        points, rows = mesh.vertices, mesh.triangles
        is_there = np.append(np.isfinite(points).all(axis=1), False)
        named = np.where((rows >= 0) & (rows < len(points)), rows, len(points))
        is_whole = is_there[named].all(axis=1)
        firsts += [f"number {row + 1}" for row in np.flatnonzero(~is_whole)]
        total += len(rows)
        kept.append(TriangleMesh(np.where(np.isfinite(points), points, 0.0), rows[is_whole]))
    return joined_meshes(kept), note_on_lost(len(firsts), total, next(iter(firsts), ""))


def _is_wanted(product: Any, name: str | None) -> bool:
    if name is not None:
        return matches(name, (product.Name or "", product.GlobalId))
    return is_ground(product)


def _surface(source: IfcSource, product: Any) -> TriangleMesh | None:
    """Return the triangles of a product: of its networks and faces as they are, or as the library works them out."""
    sets = items_of(product, "IfcTriangulatedFaceSet")
    if not sets:
        return single_shape(source, product)
    placing = np.eye(4)
    if product.ObjectPlacement:
        placing = np.array(library("util.placement").get_local_placement(product.ObjectPlacement), dtype=float)
    meshes = []
    for item in sets:
        points, rows = _points(item), _rows(item)
        placed = points @ placing[:3, :3].T + placing[:3, 3]
        meshes.append(TriangleMesh(placed * source.unit_m, rows))
    return joined_meshes(meshes)


def _points(item: Any) -> np.ndarray:
    """Return the points (n, 3) that the triangles of a set name, without numbers where the file has none."""
    given = item.Coordinates.CoordList or () if item.Coordinates else ()
    points = np.array([point if len(point) == 3 else [np.nan] * 3 for point in given], float).reshape(-1, 3)
    if not getattr(item, "PnIndex", None):
        return points
    rows = np.array(item.PnIndex, np.int64) - 1
    is_there = (rows >= 0) & (rows < len(points))
    return np.where(is_there[:, None], points[np.where(is_there, rows, 0)], np.nan) if len(points) else points


def _rows(item: Any) -> np.ndarray:
    """Return the points of each triangle of a set (t, 3), from 0; -1 where it names none."""
    rows = np.array([row if len(row) == 3 else [0] * 3 for row in item.CoordIndex or ()], np.int64).reshape(-1, 3) - 1
    flags = np.array(getattr(item, "Flags", None) or (), np.int64)
    # Negative ones are holes and what lies outside: IFC 4.3, 8.8.3.46.
    return rows[flags >= 0] if len(flags) == len(rows) else rows
