"""Meshes of any origin made into solids that can be cut, where that leaves no doubt about what was meant.

A boolean operation does not unite them: where two patches are the same but for rounding, it finds a gap as often as a
contact, and the result falls apart. Here the patches are taken out and the rims of the holes joined, corner to corner.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from manifold3d import triangulate

from ...errors import GeometryError
from ..arrays import BoolArray, FloatArray, IntArray
from .mesh import TriangleMesh, triangle_areas_and_normals
from .proximity import ranges
from .solids import (
    OVERLAP_TOLERANCE,
    SMALLEST_VOLUME,
    bodies,
    check_faces,
    checked_solid,
    contains,
    from_manifold,
    to_manifold,
    union,
)
from .vectors import distance, dot, length, unit


def sewn(mesh: TriangleMesh, patch: BoolArray, tolerance_m: float) -> TriangleMesh:
    """Closed meshes, joined to one, without the patches (t,) they touch along, closed again across the rims.

    The patches come in two layers, one of either mesh, that cover each other. Corners of the rims that are no further
    apart than the tolerance are one. Vertices stay; the patches' vertices are no longer used. Where a corner of one rim
    lies on an edge of the other, a triangle without area joins them.
    """
    rim = np.unique(_open_edges(mesh.triangles[~patch]))
    triangles = without_slivers(welded(mesh.vertices, rim, tolerance_m)[mesh.triangles[~patch]])
    loops = loops_of_open_edges(mesh.vertices, triangles)
    return TriangleMesh(mesh.vertices, np.concatenate([triangles, *(_fan(loop) for loop in loops)]))


def without_slivers(triangles: IntArray) -> IntArray:
    """Triangles (t, 3) without a repeated vertex."""
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


WELDING_TOLERANCE = 1e-6
"""Part of the mesh's longest extent within which corners on open edges are one: single precision keeps seven digits."""

FLATNESS_TOLERANCE = 1e-3
"""Distance of the rim of a hole from a plane, by its extent, up to which the hole is closed by it."""

_FLAT_TOLERANCE = 1e-7
"""Height of a triangle, by the longest extent of its mesh, below which it has no area: in single precision it has one
of 6e-8 of its coordinates where CAD closes a joint of three faces by it. The boolean engine loses volume there."""

_SLIT_TOLERANCE = 1e-12
"""Part of the square of a hole's extent below which its area is rounding, and its rim lies along a line."""


@dataclass(frozen=True, slots=True)
class Repaired:
    """A solid that can be cut, and what was done to the mesh for it, as text; nothing for a sound mesh."""

    solid: TriangleMesh
    repairs: tuple[str, ...]


def repaired_solid(mesh: TriangleMesh, name: str) -> Repaired:
    """The mesh as a solid: corners merged, plane holes closed, faces turned outwards, overlapping bodies united.

    Error messages begin with the name that the user gave the mesh.
    """
    check_faces(mesh, name)
    repairs: list[str] = []
    vertices, triangles = _merged(mesh)
    triangles = _without_doubles(triangles, repairs)
    triangles = _welded(vertices, triangles, repairs)
    triangles = _wound_alike(vertices, triangles, repairs)
    triangles = _closed(vertices, triangles, repairs, name)
    whole = TriangleMesh(vertices, triangles)
    if not len(triangles) or abs(whole.volume) <= SMALLEST_VOLUME * whole.cube_volume:
        raise GeometryError(f"{name}: encloses no volume; give it a thickness.")
    solid = _without_flat_triangles(_united(whole, repairs, name), repairs, name)
    crossing = first_crossing(solid.corners)
    if crossing is not None:
        position = ", ".join(f"{coordinate:.4g}" for coordinate in crossing)
        raise GeometryError(
            f"{name}: its surface crosses itself near ({position}) m, so what is inside is unknown; model it as "
            "separate closed bodies, which are united."
        )
    return Repaired(checked_solid(solid, name), tuple(repairs))


def _merged(mesh: TriangleMesh) -> tuple[FloatArray, IntArray]:
    """Vertices at exactly the same position as one, which is no repair: STL has no shared vertices."""
    unique, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    return unique, index.ravel()[mesh.triangles]


def _without_doubles(triangles: IntArray, repairs: list[str]) -> IntArray:
    """Without triangles that have a corner twice, and with one of each set of equal ones; opposite ones cancel."""
    kept = without_slivers(triangles)
    _, first, group = np.unique(np.sort(kept, axis=1), axis=0, return_index=True, return_inverse=True)
    net = np.bincount(group.ravel(), weights=_parity(kept))
    chosen = np.sort(first[net != 0])
    if dropped := len(kept) - len(chosen):
        repairs.append(f"dropped {dropped} doubled faces")
    single: IntArray = kept[chosen]
    return single


def _parity(triangles: IntArray) -> IntArray:
    """1 for triangles that walk their corners in rising order, -1 for the other way round, (t,)."""
    a, b, c = triangles.T
    return np.where((a < b).astype(int) + (b < c) + (c < a) == 2, 1, -1)


def _welded(vertices: FloatArray, triangles: IntArray, repairs: list[str]) -> IntArray:
    rim = np.unique(_edges_of_one_face(triangles))
    if not len(rim):
        return triangles
    tolerance = WELDING_TOLERANCE * np.ptp(vertices, axis=0).max()
    one = welded(vertices, rim, tolerance)
    if merged := int((one != np.arange(len(vertices))).sum()):
        repairs.append(f"merged {merged} doubled vertices")
    return without_slivers(one[triangles])


def _edges_of_one_face(triangles: IntArray) -> IntArray:
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    open_edges: IntArray = unique[counts == 1]
    return open_edges


def _wound_alike(vertices: FloatArray, triangles: IntArray, repairs: list[str]) -> IntArray:
    """Triangles turned so that neighbours agree; surfaces that had to be turned look outwards, cavities inwards."""
    part, flipped = _agreement(triangles)
    uneven = [index for index in range(part.max(initial=-1) + 1) if len(set(flipped[part == index].tolist())) > 1]
    if not uneven:
        return triangles
    result = np.where(flipped[:, None], triangles[:, ::-1], triangles)
    result[~np.isin(part, uneven)] = triangles[~np.isin(part, uneven)]
    surfaces = {index: TriangleMesh(vertices, result[part == index]) for index in range(part.max() + 1)}
    for index in uneven:
        corner = vertices[result[part == index][:1, 0]]
        depth = sum(_encloses(other, corner) for number, other in surfaces.items() if number != index)
        if (surfaces[index].volume < 0) != (depth % 2 == 1):
            result[part == index] = result[part == index][:, ::-1]
    turned = int((result != triangles).any(axis=1).sum())
    repairs.append(f"turned {turned} faces")
    return result


def _encloses(surface: TriangleMesh, corner: FloatArray) -> bool:
    return bool(contains(surface, corner)[0] or contains(surface.flipped(), corner)[0])


def _agreement(triangles: IntArray) -> tuple[IntArray, BoolArray]:
    """Part (t,) of each triangle, connected over edges of two faces, and whether it is turned against its first."""
    edges = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    forwards = edges[:, 0] < edges[:, 1]
    _, edge, counts = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(edge.ravel(), kind="stable")
    pairs = order[np.repeat(counts == 2, counts)].reshape(-1, 2)
    neighbours: list[list[tuple[int, bool]]] = [[] for _ in triangles]
    for one, other in pairs.tolist():
        against = bool(forwards[one] == forwards[other])
        neighbours[one // 3].append((other // 3, against))
        neighbours[other // 3].append((one // 3, against))
    part, flipped = np.full(len(triangles), -1), np.zeros(len(triangles), dtype=bool)
    for start in range(len(triangles)):
        if part[start] >= 0:
            continue
        part[start] = part.max() + 1
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for there, against in neighbours[here]:
                if part[there] < 0:
                    part[there], flipped[there] = part[start], flipped[here] ^ against
                    waiting.append(there)
    return part, flipped


def _closed(vertices: FloatArray, triangles: IntArray, repairs: list[str], name: str) -> IntArray:
    holes = loops_of_open_edges(vertices, triangles)
    if not holes:
        return triangles
    lids = [_lid(vertices, np.array(hole), name) for hole in holes]
    repairs.append(f"closed {len(holes)} hole{'s' if len(holes) > 1 else ''}")
    return np.concatenate([triangles, *lids])


def _lid(vertices: FloatArray, rim: IntArray, name: str) -> IntArray:
    """Triangles (t, 3) that close a hole with this rim (r,), which surrounding faces walk in this order."""
    if len(rim) < 3:
        raise GeometryError(f"{name}: not closed, an edge has faces that do not belong together; rebuild it there.")
    corners = vertices[rim]
    middle, extent = corners.mean(axis=0), np.ptp(corners, axis=0).max()
    normal = _normal(corners - middle, extent)
    if len(rim) > 3 and np.abs(dot(corners - middle, normal)).max() > FLATNESS_TOLERANCE * extent:
        raise GeometryError(
            f"{name}: not closed, the hole with {len(rim)} edges around {np.round(middle, 3).tolist()} m is not plane; "
            "close it in the program that it was made with."
        )
    arms = corners - corners[0]
    arms = arms - dot(arms, normal)[:, None] * normal
    along = unit(arms[np.argmax(dot(arms, arms))])
    flat = np.column_stack((dot(arms, along), dot(arms, np.cross(normal, along))))
    # About its own normal the rim runs anticlockwise, as the triangulation wants it; the lid walks it the other way.
    return rim[np.asarray(triangulate([flat]), dtype=np.int64).reshape(-1, 3)[:, ::-1]]


def _normal(arms: FloatArray, extent: float) -> FloatArray:
    """Unit normal (3,) of a closed loop of corners (r, 3), by Newell; 0 where it encloses no area."""
    areas = np.cross(arms, np.roll(arms, -1, axis=0)).sum(axis=0)
    return unit(areas) if length(areas) > _SLIT_TOLERANCE * extent * extent else np.zeros(3)


def _without_flat_triangles(mesh: TriangleMesh, repairs: list[str], name: str) -> TriangleMesh:
    """A closed mesh whose triangles without area are taken into their neighbours; the same where it has none."""
    corners = mesh.corners
    sides = length(corners - np.roll(corners, 1, axis=1)).max(axis=1)
    tolerance_m = _FLAT_TOLERANCE * mesh.longest_extent
    flat = 2.0 * triangle_areas_and_normals(corners)[0] <= tolerance_m * sides
    if not flat.any():
        return mesh
    simpler = to_manifold(mesh, name).simplify(tolerance_m)
    if simpler.volume() <= SMALLEST_VOLUME * mesh.cube_volume:
        return mesh  # it is flat itself, which is said of it next
    repairs.append(f"took {int(flat.sum())} triangles without area into their neighbours")
    return from_manifold(simpler)


def _united(mesh: TriangleMesh, repairs: list[str], name: str) -> TriangleMesh:
    """Bodies of the mesh as one solid without overlap; those that are inside out as a whole are turned."""
    if mesh.volume < 0:
        mesh = mesh.flipped()
    separate = [from_manifold(*shells) for shells in bodies(to_manifold(mesh, name), name=name)]
    if len(separate) < 2:
        return mesh
    whole = union(separate)
    if whole.volume >= math.fsum(body.volume for body in separate) * (1.0 - OVERLAP_TOLERANCE):
        return mesh
    repairs.append(f"united {len(separate)} overlapping bodies")
    return whole


_STRICTLY_INSIDE = 1e-7
"""Part of a triangle or edge that a crossing has to keep from its ends: what only touches does not cross."""

_CANDIDATES_PER_BLOCK = 2_000_000
"""Pairs of triangles whose boxes are compared in one go; bounds the memory."""


def first_crossing(corners: FloatArray) -> FloatArray | None:
    """Position (3,) where an edge goes through the inside of a triangle of a surface (t, 3, 3), or None.

    Triangles that lie in one plane and overlap there do not count as crossing.

    T. Möller, B. Trumbore (1997), Fast, minimum storage ray-triangle intersection, Journal of Graphics Tools 2, 21-28;
    here for the edges of one triangle in place of rays.
    """
    lower, upper = corners.min(axis=1), corners.max(axis=1)
    order = np.argsort(lower[:, 0], kind="stable")
    last = np.searchsorted(lower[order, 0], upper[order, 0], side="right")
    begin = 0
    while begin < len(order):
        # As many rows as keep the block small: each is compared with all that begin before it ends.
        counts = np.cumsum(last[begin:] - np.arange(begin, len(order)))
        end = begin + max(1, int(np.searchsorted(counts, _CANDIDATES_PER_BLOCK)))
        rows = np.arange(begin, end)
        row, second = ranges(rows + 1, last[rows] - rows - 1)
        one, other = order[begin + row], order[second]
        meet = ((lower[one] <= upper[other]) & (lower[other] <= upper[one])).all(axis=1)
        position = _crossing(corners[one[meet]], corners[other[meet]])
        if position is not None:
            return position
        begin = end
    return None


def _crossing(one: FloatArray, other: FloatArray) -> FloatArray | None:
    """Position where an edge of one of the triangles (m, 3, 3) goes through the other of its pair."""
    for through, edged in ((one, other), (other, one)):
        for corner in range(3):
            start, end = edged[:, corner], edged[:, (corner + 1) % 3]
            crosses, along = _pierced(through, start, end - start)
            if crosses.any():
                row = int(np.argmax(crosses))
                crossing: FloatArray = start[row] + along[row] * (end - start)[row]
                return crossing
    return None


def _pierced(triangles: FloatArray, starts: FloatArray, edges: FloatArray) -> tuple[BoolArray, FloatArray]:
    """Whether each edge goes through the inside of its triangle (m,), and where along the edge (m,)."""
    first, second = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(edges, second)
    volume = dot(first, across)
    size = length(np.cross(first, second)) * length(edges)
    leaning = np.abs(volume) > _STRICTLY_INSIDE * size
    scale = np.divide(1.0, volume, out=np.zeros_like(volume), where=leaning)
    offset = starts - triangles[:, 0]
    turned = np.cross(offset, first)
    u = dot(offset, across) * scale
    v = dot(edges, turned) * scale
    along = dot(second, turned) * scale
    least = np.minimum.reduce([u, v, 1.0 - u - v, along, 1.0 - along])
    return leaning & (least > _STRICTLY_INSIDE), along
