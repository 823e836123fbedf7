"""Closed meshes that touch along plane patches, sewn to one closed mesh.

A boolean operation does not unite them: where two patches are the same but for rounding, it finds a gap as often as a
contact, and the result falls apart. Here the patches are taken out and the rims of the holes joined, corner to corner.
"""

from itertools import pairwise

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .mesh import TriangleMesh
from .vectors import distance, dot, length


def sewn(mesh: TriangleMesh, patch: BoolArray, tolerance_m: float) -> TriangleMesh:
    """Closed meshes, joined to one, without the patches (t,) they touch along, closed again across the rims.

    The patches come in two layers, one of either mesh, that cover each other. Corners of the rims that are no further
    apart than the tolerance are one. Vertices stay, those of the patches are no longer used. Where a corner of one rim
    lies on an edge of the other, a triangle without area joins them.
    """
    rim = np.unique(_open_edges(mesh.triangles[~patch]))
    triangles = without_slivers(welded(mesh.vertices, rim, tolerance_m)[mesh.triangles[~patch]])
    loops = loops_of_open_edges(mesh.vertices, triangles)
    return TriangleMesh(mesh.vertices, np.concatenate([triangles, *(_fan(loop) for loop in loops)]))


def without_slivers(triangles: IntArray) -> IntArray:
    """Those of the triangles (t, 3) that have no vertex twice."""
    proper: IntArray = triangles[(triangles != np.roll(triangles, 1, axis=1)).all(axis=1)]
    return proper


def loops_of_open_edges(vertices: FloatArray, triangles: IntArray) -> list[list[int]]:
    """Rims of the holes between triangles (t, 3), each as its corners in the order that the triangles walk them."""
    return _loops(_open_edges(triangles), vertices)


def _open_edges(triangles: IntArray) -> IntArray:
    """Directed edges (e, 2) that no triangle walks the other way, as often as they are open."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    lower, upper = edges.min(axis=1), edges.max(axis=1)
    unique, edge = np.unique(np.column_stack([lower, upper]), axis=0, return_inverse=True)
    forwards = np.where(edges[:, 0] == lower, 1, -1)
    surplus = np.bincount(edge.ravel(), weights=forwards, minlength=len(unique)).astype(np.int64)
    directed = np.where(surplus[:, None] > 0, unique, unique[:, ::-1])
    return np.repeat(directed, np.abs(surplus), axis=0)


def welded(vertices: FloatArray, corners: IntArray, tolerance: float) -> IntArray:
    """The vertex (v,) that stands for each: of `corners` that lie together the first, else itself."""
    representative = np.arange(len(vertices))
    apart = distance(vertices[corners, None], vertices[corners])
    representative[corners] = corners[np.argmax(apart <= tolerance, axis=1)]
    return representative


def _loops(edges: IntArray, vertices: FloatArray) -> list[list[int]]:
    """Closed walks along all edges (e, 2), each edge once, none through the same corner twice.

    Where there is a choice the walk turns back most sharply. What is open lies between an edge of one rim and shorter
    edges of the other along it: this closes the gap between two rims instead of following either all around.
    """
    onwards: dict[int, list[int]] = {}
    for start, end in edges.tolist():
        onwards.setdefault(start, []).append(end)
    loops = []
    for start in onwards:
        walk = [start]
        while onwards[walk[-1]]:
            there = _sharpest_turn(walk, onwards[walk[-1]], vertices)
            onwards[walk[-1]].remove(there)
            if there in walk:
                loops.append(walk[walk.index(there) :])
                del walk[walk.index(there) + 1 :]
            else:
                walk.append(there)
    return loops


def _sharpest_turn(walk: list[int], choices: list[int], vertices: FloatArray) -> int:
    if len(walk) == 1 or len(choices) == 1:
        return choices[0]
    ahead = vertices[choices] - vertices[walk[-1]]
    cosines = dot(ahead, vertices[walk[-1]] - vertices[walk[-2]]) / length(ahead)
    return choices[int(np.argmin(cosines))]


def _fan(loop: list[int]) -> IntArray:
    """Triangles that walk the edges of a loop backwards, so closing the hole in it."""
    return np.array([[loop[0], after, before] for before, after in pairwise(loop[1:])]).reshape(-1, 3)
