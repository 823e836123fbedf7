"""Mesh objects of the user's files: their solids, weights painted on them, and what is no member, shown as wire."""

from __future__ import annotations

from collections.abc import Mapping

import bpy
import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.repair import Repaired, repaired_solid
from ..engineering.geometry.vectors import transformed
from ..errors import GeometryError
from .bodies import triangle_mesh
from .collections import ROLE, collection_for, remove_marked


def solid_of_object(body: bpy.types.Object) -> Repaired:
    """Return an object's mesh as a solid where it stands, in m, and what was repaired to make it one.

    Linked, parented, mirrored and scaled objects are taken as they are seen, with modifiers; the object is not changed.
    """
    _check_is_mesh(body, "convert it, or leave it out")
    return repaired_solid(_mesh_in_world(body), body.name)


def painted_points(body: bpy.types.Object, group: str) -> tuple[np.ndarray, np.ndarray]:
    """Return a mesh's vertices (v, 3), m, in the world's axes, and their weights (v,), 0 to 1, in a vertex group.

    The mesh is taken as it was painted, without modifiers, which may change its vertices.
    """
    _check_is_mesh(body, "choose the object that was painted")
    index = body.vertex_groups.find(group)
    if index < 0:
        known = ", ".join(vertex_group.name for vertex_group in body.vertex_groups) or "none"
        raise GeometryError(f"{body.name}: has no vertex group {group!r}; paint one, or choose from: {known}.")
    groups = [{group.group: group.weight for group in vertex.groups} for vertex in body.data.vertices]
    weights = np.array([weights_by_group.get(index, 0.0) for weights_by_group in groups])
    return _in_world(body, triangle_mesh(body.data).vertices), weights


def _check_is_mesh(body: bpy.types.Object, advice: str) -> None:
    if body.type != "MESH":
        raise GeometryError(f"{body.name}: is of type {body.type}, not a mesh; {advice}.")


def _mesh_in_world(body: bpy.types.Object) -> TriangleMesh:
    """Return the triangles of an object with its modifiers, in the world's axes."""
    evaluated = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    try:
        mesh = triangle_mesh(evaluated.to_mesh())
    finally:
        evaluated.to_mesh_clear()
    seen = TriangleMesh(_in_world(evaluated, mesh.vertices), mesh.triangles)
    # A mirrored object shows its faces the other way round.
    return seen.flipped() if evaluated.matrix_world.determinant() < 0.0 else seen


def _in_world(body: bpy.types.Object, vertices: np.ndarray) -> np.ndarray:
    """Return vertices (v, 3) of an object, from its own axes to the world's, m."""
    matrix = np.array(body.matrix_world, dtype=float)
    return transformed(matrix[:3, :3], vertices) + matrix[:3, 3]


LEFT_OUT_ROLE = "IFC Left Out"


def show_left_out(scene: bpy.types.Scene, meshes: Mapping[str, TriangleMesh]) -> list[bpy.types.Object]:
    """Show elements by their names as wire, in place of those that were shown before."""
    remove_marked(scene, LEFT_OUT_ROLE)
    shown = []
    for name, mesh in meshes.items():
        data = bpy.data.meshes.new(name)
        data.from_pydata(mesh.vertices.tolist(), [], mesh.triangles.tolist())
        wire = bpy.data.objects.new(name, data)
        wire[ROLE] = LEFT_OUT_ROLE
        wire.display_type, wire.hide_render, wire.hide_select = "WIRE", True, False
        collection_for(scene, LEFT_OUT_ROLE).objects.link(wire)
        shown.append(wire)
    return shown
