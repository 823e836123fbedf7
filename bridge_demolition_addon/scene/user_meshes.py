"""Mesh objects of a Blender scene as members that can be cut into shards."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ..core.bridge.member import Member
from ..core.bridge.preparation import PreparedMembers, without_overlap
from ..core.errors import GeometryError
from ..core.geometry.repair import repaired_solid
from ..core.geometry.solids import mesh_of
from .bodies import mesh_arrays


def members_of_objects(
    objects: Sequence[bpy.types.Object], density_kg_m3: float, kind: str = "member"
) -> PreparedMembers:
    """Objects as members where they stand: modifiers applied, scaled, turned and moved as they and their parents are.

    Objects are not changed. Linked and parented ones, ones with a scale that is not applied and mirrored ones are
    taken as they are seen.

    Parameters
    ----------
    objects
        Meshes. What an object has in common with one before it is cut off it.
    density_kg_m3
        Density of all of them.
    kind
        What kind of members they are.

    Raises
    ------
    GeometryError
        There are none, one is not a mesh, or not a solid and cannot be made one; the text begins with its name.
    """
    if not len(objects):
        raise GeometryError("No objects are selected; select the meshes that are to be members.")
    graph = bpy.context.evaluated_depsgraph_get()
    members, notes = [], []
    for each in objects:
        if each.type != "MESH":
            raise GeometryError(f"{each.name}: is of type {each.type}, not a mesh; convert it, or leave it out.")
        done = repaired_solid(mesh_of(*_triangles_in_world(each, graph)), each.name)
        members.append(Member(each.name, kind, done.solid, density_kg_m3))
        notes += [f"{each.name}: {repair}" for repair in done.repairs]
    apart = without_overlap(members)
    return PreparedMembers(apart.members, (*notes, *apart.notes))


def _triangles_in_world(body: bpy.types.Object, graph: bpy.types.Depsgraph) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (v, 3) in m in the world's axes, and triangles (t, 3), of an object with its modifiers."""
    evaluated = body.evaluated_get(graph)
    try:
        vertices, triangles = mesh_arrays(evaluated.to_mesh())
    finally:
        evaluated.to_mesh_clear()
    matrix = np.array(evaluated.matrix_world, dtype=float)
    # A mirrored object shows its faces the other way round.
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        triangles = triangles[:, ::-1]
    return vertices @ matrix[:3, :3].T + matrix[:3, 3], triangles
