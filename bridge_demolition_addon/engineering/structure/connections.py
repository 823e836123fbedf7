"""Which shards are connected, and the sections of the faces between them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..fracture.shared_faces import SharedFaces
from ..geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..geometry.plan_areas import signed_area
from ..geometry.proximity import blocks, boxes_that_meet, nearest_points, points_within, ranges
from ..geometry.vectors import dot, outer, transformed_back, unit
from ..mechanics.section_cuts import section_axes

GROUND = -1
"""Stands for the ground where a connection names its second body."""

_LEVEL_TOLERANCE_M = 1e-6
"""Distance from the ground up to which a face stands on it: rounding of coordinates of some hundred metres."""

_NEARLY_ON_GROUND_M = 1e-3
"""Distance from flat ground up to which the level underside of a shard stands on it: meshes from files are not exact,
and may reach as far below it."""

_ROUNDING = 1e-9
"""Addition to a radius in the search for vertices, in m and as a part of the radius."""


@dataclass(frozen=True, slots=True)
class Connections:
    """Connections between shards, structure of arrays.

    Where two shards share no face, the point is half-way between their centres of mass, and the normal along the line
    between these, upwards where they coincide.
    """

    pairs: IntArray  # (m, 2), shards; the second is `GROUND` for a foundation
    points: FloatArray  # (m, 3), centre of the shared face, m
    areas: FloatArray  # (m,), of the shared face, m²; 0 without one
    normals: FloatArray  # (m, 3), unit vectors from the first body to the second, at right angles to the face

    def __len__(self) -> int:
        return len(self.pairs)

    def only(self, kept: BoolArray | IntArray) -> Connections:
        """Those connections (m,) that are kept, or of these rows (k,)."""
        return Connections(self.pairs[kept], self.points[kept], self.areas[kept], self.normals[kept])


def connect(
    centres: FloatArray, faces: SharedFaces, pairs: IntArray, distances: FloatArray, limit_per_shard: int
) -> Connections:
    """Connections of neighbouring pairs (k, 2) of shards, nearest first, until a shard has as many as allowed.

    `distances` (k,) are in m or in any other order of preference; `centres` (n, 3) are centres of mass, m.
    """
    pairs = limited(pairs, distances, limit_per_shard, len(centres))
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    points = centres[pairs].mean(axis=1)
    normals = _directions(centres[pairs[:, 1]] - centres[pairs[:, 0]])
    areas = np.zeros(len(pairs))
    rows, face_rows = _matching_rows(pairs, faces.pairs, len(centres))
    points[rows] = faces.centres[face_rows]
    normals[rows] = faces.normals[face_rows]
    areas[rows] = faces.areas[face_rows]
    return Connections(pairs, points, areas, normals)


def neighbours_by_face(faces: SharedFaces) -> tuple[IntArray, FloatArray]:
    """Pairs (k, 2) of shards that share a face, and an order (k,) in which the largest face comes first."""
    return faces.pairs, -faces.areas


def neighbours_by_centre(centres: FloatArray, radius_m: float) -> tuple[IntArray, FloatArray]:
    """Pairs (k, 2) of shards whose centres of mass (n, 3) lie within a radius, and their distances (k,) in m."""
    return points_within(centres, radius_m)


def neighbours_by_count(centres: FloatArray, count: int) -> tuple[IntArray, FloatArray]:
    """Pairs (k, 2) of shards, one of them among those nearest to the other, and their distances (k,) in m.

    Each shard is connected with its `count` nearest; it may be among the nearest of more.
    """
    others, distances = nearest_points(centres, count)
    pairs = np.sort(np.column_stack((np.repeat(np.arange(len(centres)), others.shape[1]), others.ravel())), axis=1)
    pairs, rows = np.unique(pairs, axis=0, return_index=True)
    return pairs, distances.ravel()[rows]


def neighbours_by_vertex(shards: Sequence[TriangleMesh], radius_m: float) -> tuple[IntArray, FloatArray]:
    """Pairs (k, 2) of shards whose nearest vertices lie within a radius, and their distances (k,) in m."""
    corners = _Corners.of(shards)
    candidates = boxes_that_meet(corners.lower, corners.upper, radius_m)
    counts = np.diff(corners.bounds)[candidates].prod(axis=1)
    parts = [corners.distances(candidates[part], radius_m) for part in blocks(counts)]
    distances = np.concatenate([np.zeros(0), *parts])
    near = distances <= radius_m
    return candidates[near], distances[near]


def limited(pairs: IntArray, distances: FloatArray, limit_per_shard: int, shard_count: int) -> IntArray:
    """The pairs (k, 2) that remain when, nearest first, no shard may have more than its limit.

    Pairs at the same distance are taken in order of their shards, so that the result is reproducible.
    """
    order = np.lexsort((pairs[:, 1], pairs[:, 0], distances))
    pairs = pairs[order]
    if np.bincount(pairs.ravel(), minlength=1).max() <= limit_per_shard:
        return pairs
    taken = [0] * shard_count
    kept = []
    for row, (first, second) in enumerate(pairs.tolist()):
        if taken[first] < limit_per_shard and taken[second] < limit_per_shard:
            taken[first] += 1
            taken[second] += 1
            kept.append(row)
    return pairs[kept]


def foundations(
    shards: Sequence[TriangleMesh], heights_at: Callable[[FloatArray], FloatArray] | None = None
) -> Connections:
    """Connections of shards to the ground, before gaps are made, in the middle of the face that they stand on.

    `heights_at` gives heights (k,) of the ground at positions (k, 2), nan beyond it; the ground is flat at 0 without
    it.
    """
    standing = [(index, *_standing_face(shard, heights_at)) for index, shard in enumerate(shards)]
    standing = [(index, area, centre) for index, area, centre in standing if area > 0.0]
    count = len(standing)
    return Connections(
        pairs=np.array([(index, GROUND) for index, _, _ in standing], int).reshape(count, 2),
        points=np.array([centre for _, _, centre in standing], float).reshape(count, 3),
        areas=np.array([area for _, area, _ in standing], float),
        normals=np.tile([0.0, 0.0, -1.0], (count, 1)),
    )


def joined(parts: Sequence[Connections]) -> Connections:
    """Several sets of connections as one."""
    return Connections(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(Connections)))


def _standing_face(
    shard: TriangleMesh, heights_at: Callable[[FloatArray], FloatArray] | None
) -> tuple[float, FloatArray]:
    """Area and centre of the part of a shard that lies flat on the ground."""
    corners = shard.corners
    if heights_at is None:
        lowest = float(corners[:, :, 2].min())
        level = lowest if _LEVEL_TOLERANCE_M < abs(lowest) <= _NEARLY_ON_GROUND_M else 0.0
    else:
        level = corners[:, :, 2].min()
        corners = corners[(corners[:, :, 2] <= level + _LEVEL_TOLERANCE_M).all(axis=1)]
        on_ground = heights_at(corners[..., :2].reshape(-1, 2)).reshape(-1, 3)
        corners = corners[(np.abs(on_ground - corners[:, :, 2]) <= _LEVEL_TOLERANCE_M).all(axis=1)]
    flat = corners[(abs(corners[:, :, 2] - level) <= _LEVEL_TOLERANCE_M).all(axis=1)]
    if not len(flat):
        return 0.0, np.zeros(3)
    areas, _ = triangle_areas_and_normals(flat)
    total = float(areas.sum())
    centre = (areas[:, None] * flat.mean(axis=1)).sum(axis=0) / total if total > 0.0 else np.zeros(3)
    return total, centre


@dataclass(frozen=True, eq=False, slots=True)
class _Corners:
    """The shards' vertices (v, 3), where each shard begins: `bounds` (n + 1,), and the shards' boxes (n, 3)."""

    vertices: FloatArray
    bounds: IntArray
    lower: FloatArray
    upper: FloatArray

    @classmethod
    def of(cls, shards: Sequence[TriangleMesh]) -> _Corners:
        return cls(
            vertices=np.concatenate([np.zeros((0, 3)), *(shard.vertices for shard in shards)]),
            bounds=np.cumsum([0] + [len(shard.vertices) for shard in shards]),
            lower=np.array([shard.vertices.min(axis=0) for shard in shards]).reshape(-1, 3),
            upper=np.array([shard.vertices.max(axis=0) for shard in shards]).reshape(-1, 3),
        )

    def distances(self, pairs: IntArray, radius_m: float) -> FloatArray:
        """Distances (k,) between the nearest vertices of pairs (k, 2) of shards; inf where surely beyond a radius."""
        row, first = self._near_box(pairs[:, 0], pairs[:, 1], radius_m)
        other_row, second = self._near_box(pairs[:, 1], pairs[:, 0], radius_m)
        counts = np.bincount(other_row, minlength=len(pairs))
        of_first, position = ranges((np.cumsum(counts) - counts)[row], counts[row])
        row = row[of_first]
        difference = self.vertices[first[of_first]] - self.vertices[second[position]]
        squares = np.full(len(pairs), np.inf)
        np.minimum.at(squares, row, dot(difference, difference))
        return np.sqrt(squares)

    def _near_box(self, shards: IntArray, others: IntArray, radius_m: float) -> tuple[IntArray, IntArray]:
        """Row k and vertex of shards[k], for all its vertices within a radius of the box of others[k]."""
        row, vertex = ranges(self.bounds[shards], np.diff(self.bounds)[shards])
        radius_m = radius_m * (1.0 + _ROUNDING) + _ROUNDING
        positions, other = self.vertices[vertex], others[row]
        near = ((positions >= self.lower[other] - radius_m) & (positions <= self.upper[other] + radius_m)).all(axis=1)
        return row[near], vertex[near]


def _matching_rows(pairs: IntArray, face_pairs: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Rows of `pairs` (sorted) that also stand in `face_pairs`, and their rows there."""
    keys, face_keys = pairs[:, 0] * count + pairs[:, 1], face_pairs[:, 0] * count + face_pairs[:, 1]
    _, rows, face_rows = np.intersect1d(keys, face_keys, return_indices=True)
    return rows, face_rows


def _directions(vectors: FloatArray) -> FloatArray:
    """Unit vectors (k, 3) along vectors (k, 3); upwards where one has no length."""
    directions = unit(vectors)
    return np.where(directions.any(axis=1)[:, None], directions, (0.0, 0.0, 1.0))


_SAME_PLANE_M = 1e-6
"""Distance from the plane of a face up to which a corner belongs to it: rounding of coordinates of a bridge."""

_SAME_AREA = 1e-3
"""Largest difference of the area in a shard's mesh from that of the face, as a part of it."""


def second_moments(
    shards: Sequence[TriangleMesh], first: IntArray, areas: FloatArray, centres: FloatArray, normals: FloatArray
) -> FloatArray:
    """Second moments of area (m, 2, 2), m⁴, of faces about their own centres, by the first shard (m,) of each.

    About the section's y and z axes (`section_forces.section_axes`) they are ∫ z² dA and ∫ y² dA on the diagonal, and
    -∫ y z dA off it. Normals (m, 3) point out of the first shard; a face without area has no moments.

    The face is looked for in the mesh of its first shard: all triangles in its plane that look its way. Where these are
    not just the face, as on the underside of a deck that rests on a smaller pier cap, it is taken for a square.
    """
    moments = np.square(areas[:, None, None]) / 12.0 * np.eye(2)
    with_area = np.flatnonzero(areas > 0.0)
    for part in blocks(np.array([len(shards[shard].triangles) for shard in first[with_area]], int)):
        rows = with_area[part]
        face, corners = triangles_in_faces([shards[shard] for shard in first[rows]], centres[rows], normals[rows])
        counts = np.bincount(face, minlength=len(rows))
        # Faces of as many triangles together: each is summed as it would be alone, to the last bit.
        for count in np.unique(counts[counts > 0]):
            alike = np.flatnonzero(counts == count)
            own = corners[counts[face] == count].reshape(len(alike), count, 3, 2)
            of_faces, is_alone = _about_own_centres(own, areas[rows[alike]])
            moments[rows[alike[is_alone]]] = of_faces[is_alone]
    return moments


def triangles_in_faces(
    shards: Sequence[TriangleMesh], centres: FloatArray, normals: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Face (t,), in ascending order, and corners (t, 3, 2) of the triangles in the planes of k faces.

    Corners are in the face's own y and z, about its centre. There is a first shard for each face.
    """
    vertex_counts = np.array([len(shard.vertices) for shard in shards])
    faces, _ = ranges(np.zeros(len(shards), int), vertex_counts)
    arms = np.concatenate([shard.vertices for shard in shards]) - centres[faces]
    is_near = abs(dot(arms, normals[faces])) <= _SAME_PLANE_M
    face, _ = ranges(np.zeros(len(shards), int), np.array([len(shard.triangles) for shard in shards]))
    first_vertices = np.cumsum(vertex_counts) - vertex_counts
    triangles = np.concatenate([shard.triangles for shard in shards]) + first_vertices[face][:, None]
    lies = is_near[triangles].all(axis=1)
    in_plane = section_axes(normals)[:, :, 1:]
    return face[lies], transformed_back(in_plane[face[lies]][:, None], arms[triangles[lies]])


def _about_own_centres(corners: FloatArray, areas: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Second moments (k, 2, 2) of faces by corners (k, t, 3, 2) of triangles, and whether they are alone (k,).

    They are not where the triangles' area differs from the face's own (k,).
    """
    triangle_areas = signed_area(corners)
    whole = triangle_areas.sum(axis=1)
    is_alone = abs(whole - areas) <= _SAME_AREA * areas
    moments = (triangle_areas[..., None] * corners.mean(axis=2)).sum(axis=1)
    middles = np.divide(moments, whole[:, None], out=np.zeros_like(moments), where=is_alone[:, None])
    corners = corners - middles[:, None, None]
    # ∫ u v dA over a triangle is A/12 (Σ u v + Σ u Σ v), sums over its corners.
    sums = corners.sum(axis=2)
    products = outer(corners, corners).sum(axis=2) + outer(sums, sums)
    integrals = (triangle_areas[..., None, None] * products).sum(axis=1) / 12.0
    yy, yz, zz = integrals[:, 0, 0], integrals[:, 0, 1], integrals[:, 1, 1]
    return np.stack((np.stack((zz, -yz), axis=-1), np.stack((-yz, yy), axis=-1)), axis=-2), is_alone
