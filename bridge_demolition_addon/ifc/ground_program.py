"""The program that reads the ground in an IFC file: see `model/terrain/ifc_surfaces`, which starts it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..system.isolated import answer
from .library import library
from .map_place import is_ground, on_map
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
        whole = joined_meshes(meshes)
        mapped = on_map(source, whole.vertices)
        vertices = whole.vertices if mapped is None else mapped
        notes = [] if mapped is None else ["its heights are those of its map"]
    np.savez(request["kept"], vertices=vertices, triangles=whole.triangles)
    return {"surfaces": len(meshes), "others": [], "notes": [*source.notes, *notes]}


def _is_wanted(product: Any, name: str | None) -> bool:
    if name is not None:
        return matches(name, (product.Name or "", product.GlobalId))
    return is_ground(product)


def _surface(source: IfcSource, product: Any) -> TriangleMesh | None:
    """Return the triangles of a product: of its networks and faces as they are, or as the library works them out."""
    items = [item for shape in product.Representation.Representations for item in shape.Items or ()]
    sets = [item for item in items if item.is_a("IfcTriangulatedFaceSet")]
    if not sets:
        return single_shape(source, product)
    placing = np.eye(4)
    if product.ObjectPlacement:
        placing = np.array(library("util.placement").get_local_placement(product.ObjectPlacement), dtype=float)
    meshes = []
    for item in sets:
        points = np.array(item.Coordinates.CoordList, dtype=float)
        rows = np.array(item.CoordIndex, dtype=np.int64) - 1
        if item.is_a("IfcTriangulatedIrregularNetwork") and item.Flags:
            rows = rows[np.array(item.Flags) >= 0]  # negative ones are holes and what lies outside: IFC 4.3, 8.8.3.46
        placed = points @ placing[:3, :3].T + placing[:3, 3]
        meshes.append(TriangleMesh(placed * source.unit_m, rows))
    return joined_meshes(meshes)
