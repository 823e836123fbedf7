"""Broken faces as they look: uneven, with chipped edges, on copies of shards that pictures alone show.

A face recedes inwards only, so that a copy is nowhere larger than its shard, and hides nothing.
"""

from __future__ import annotations

import bmesh
import bpy
import numpy as np
from mathutils import Vector, noise

_SAME_WAY, _NEAR_M = 0.95, 0.08
"""Cosine between the normals of a face and of its connection, and how far from its plane the face may lie."""

_PIECE_M, _MOST_CUTS = 0.16, 7
_DEEPEST_M, _OF_SIZE = 0.07, 0.09
"""How deep a face recedes at most, and as a part of the shard's size."""

_PATCHES_PER_M = 5.0
_SLIDES = 8
"""Times that a move is taken back from all faces at a corner, each of which may lead out of another."""


def roughened(
    mesh: bpy.types.Mesh, built_at: Vector, points_m: np.ndarray, normals: np.ndarray, broken_slot: int
) -> bpy.types.Mesh:
    """Return a copy of the mesh of a shard that is rough where connections broke.

    Parameters
    ----------
    built_at
        Where the shard was built: two copies differ, and one looks the same in every frame.
    points_m, normals
        Middles (k, 3) of the broken connections' faces, m, and unit normals out of the shard, in the mesh's own axes.
    broken_slot
        Material of faces that were cut.
    """
    copy = mesh.copy()
    work = bmesh.new()
    work.from_mesh(copy)
    size = max((vert.co.length for vert in work.verts), default=0.0)
    edges = {edge for face in work.faces if _is_open(face, points_m, normals, broken_slot) for edge in face.edges}
    for cuts in range(1, _MOST_CUTS + 1):
        alike = [edge for edge in edges if edge.is_valid and _cuts(edge) == cuts]
        if alike:
            bmesh.ops.subdivide_edges(work, edges=alike, cuts=cuts, use_grid_fill=True)
    bmesh.ops.triangulate(work, faces=[face for face in work.faces if len(face.verts) > 3])
    depth = min(_DEEPEST_M, _OF_SIZE * size)
    _push_in(work, built_at, points_m, normals, broken_slot, depth)
    work.to_mesh(copy)
    work.free()
    return copy


def _cuts(edge: bmesh.types.BMEdge) -> int:
    return int(np.clip(round(edge.calc_length() / _PIECE_M) - 1, 1, _MOST_CUTS))


def _push_in(
    work: bmesh.types.BMesh,
    built_at: Vector,
    points_m: np.ndarray,
    normals: np.ndarray,
    broken_slot: int,
    depth: float,
) -> None:
    """Move what belongs to open faces, and to no cut that still holds, inwards by noise."""
    work.normal_update()
    is_open = {face: _is_open(face, points_m, normals, broken_slot) for face in work.faces}
    moves = []
    for vert in work.verts:
        here = [face for face in vert.link_faces if is_open[face]]
        held = any(face.material_index == broken_slot and not is_open[face] for face in vert.link_faces)
        if here and not held:
            inwards = -sum((face.normal for face in here), Vector()).normalized()
            share = 0.5 + 0.9 * noise.fractal((vert.co + built_at) * _PATCHES_PER_M, 1.0, 2.0, 3)
            moves.append((vert, _kept_inside(inwards * depth * min(max(share, 0.0), 1.0), vert)))
    for vert, move in moves:
        vert.co += move


def _kept_inside(move: Vector, vert: bmesh.types.BMVert) -> Vector:
    """Return a move without what leads out of the faces at its vertex: along a face that leans over, it slides."""
    for _ in range(_SLIDES):
        for face in vert.link_faces:
            move = move - max(move.dot(face.normal), 0.0) * face.normal
    return move


def _is_open(face: bmesh.types.BMFace, points_m: np.ndarray, normals: np.ndarray, broken_slot: int) -> bool:
    if face.material_index != broken_slot:
        return False
    normal, middle = np.array(face.normal), np.array(face.calc_center_median())
    near = np.abs(((middle - points_m) * normals).sum(axis=1)) < _NEAR_M
    return bool((near & (normals @ normal > _SAME_WAY)).any())
