"""Vertex groups that were painted on a mesh, as places with weights."""

from __future__ import annotations

import bpy
import numpy as np

from ..core.errors import GeometryError


def painted_points(body: bpy.types.Object, group: str) -> tuple[np.ndarray, np.ndarray]:
    """Where a mesh's vertices are, (v, 3) in m in the world's axes, and their weights (v,) in a vertex group, 0 to 1.

    The mesh is taken as it was painted, without modifiers, which may change its vertices.

    Raises
    ------
    GeometryError
        The object is not a mesh, or has no such group.
    """
    if body.type != "MESH":
        raise GeometryError(f"{body.name}: is of type {body.type}, not a mesh; choose the object that was painted.")
    index = body.vertex_groups.find(group)
    if index < 0:
        known = ", ".join(each.name for each in body.vertex_groups) or "none"
        raise GeometryError(f"{body.name}: has no vertex group {group!r}; paint one, or choose from: {known}.")
    mesh = body.data
    local = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", local)
    weights = np.array([_weight(vertex, index) for vertex in mesh.vertices])
    matrix = np.array(body.matrix_world, dtype=float)
    return local.reshape(-1, 3).astype(float) @ matrix[:3, :3].T + matrix[:3, 3], weights


def _weight(vertex: bpy.types.MeshVertex, group: int) -> float:
    return next((each.weight for each in vertex.groups if each.group == group), 0.0)
