"""Faces that two shards have in common: where they were cut apart, or where separately made bodies touch."""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..geometry.proximity import boxes_that_meet, ranges
from ..geometry.vectors import cross_2d, dot, length, transformed, transformed_back, unit

OPPOSITE_COSINE = -1 + 1e-6
"""Two faces look at each other when the cosine between their normals is below this: they lean by less than 0.08°."""

_LEANING = 1.5e-3
"""Length that the sum of two unit normals has at most as their faces look at each other, √(2 (1 + cosine)), rounded."""

_ASKEW = np.array([0.36, 0.48, 0.8])
"""Direction along which the normals of hardly two directions of a bridge have equal parts; of length 1."""

_APART = 4.0
"""More than the parts of two normals along a direction differ by: keeps the rows of pairs apart."""

SMALLEST_AREA = 1e-12
"""Part of the larger of two triangles' areas below which what they have in common is rounding."""

_PAIRS_PER_BLOCK = 20_000
"""Pairs of meshes whose triangles are compared in one go; bounds the memory of `touching_faces`."""


@dataclass(frozen=True, eq=False, slots=True)
class SharedFaces:
    """Common faces of neighbouring shards, one row per pair of neighbours, sorted by pair."""

    pairs: IntArray  # (k, 2), the smaller index first
    areas: FloatArray  # (k,), m²
    centres: FloatArray  # (k, 3), m
    normals: FloatArray  # (k, 3), unit vectors out of the first shard, along the sum of the area vectors

    def __len__(self) -> int:
        return len(self.areas)


NO_FACES = SharedFaces(np.zeros((0, 2), dtype=np.int64), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)))
"""No pair of neighbours."""


def shared_faces(
    pairs: IntArray, areas: FloatArray, centres: FloatArray, normals: FloatArray, smallest_area: float = 0.0
) -> SharedFaces:
    """Patches (m,) between two shards each, put together to one face per pair (m, 2) of shards.

    Pairs are in any order and as often as there are patches; normals point from the first to the second. A patch
    between a shard and itself is left out, and so is a pair with no more than `smallest_area` in common, m².
    """
    apart = (pairs[:, 0] != pairs[:, 1]) & (areas > 0)
    pairs, areas, centres, normals = pairs[apart], areas[apart], centres[apart], normals[apart]
    turned = np.where(pairs[:, :1] > pairs[:, 1:], -normals, normals)
    unique, row = np.unique(np.sort(pairs, axis=1), axis=0, return_inverse=True)
    row = row.ravel()
    total = np.bincount(row, weights=areas, minlength=len(unique))
    moment = _summed(areas[:, None] * centres, row, len(unique))
    area_vector = _summed(areas[:, None] * turned, row, len(unique))
    sizes = length(area_vector)
    # A face bent back on itself has no direction, and is left out.
    kept = (total > smallest_area) & (sizes > 0)
    return SharedFaces(
        pairs=unique[kept].reshape(-1, 2),
        areas=total[kept],
        centres=moment[kept] / total[kept, None],
        normals=unit(area_vector[kept]),
    )


def joined_faces(parts: Sequence[SharedFaces]) -> SharedFaces:
    """Several sets of faces, of pairs that none of the others has, as one, sorted by pair."""
    columns = [np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(SharedFaces)]
    order = np.lexsort((columns[0][:, 1], columns[0][:, 0]))
    return SharedFaces(*(column[order] for column in columns))


def touching_faces(
    meshes: Sequence[TriangleMesh], tolerance_m: float = 1e-4, member: IntArray | None = None
) -> SharedFaces:
    """Faces where closed meshes stand on or against each other with plane faces that look at each other.

    Only faces in the same plane count: bodies that overlap in space or meet along an edge do not touch in this sense.
    Two faces may be apart, or inside each other, by the tolerance. Only meshes of different bridge members (n,) are
    compared, if these are given.
    """
    lower = np.array([mesh.vertices.min(axis=0) for mesh in meshes]).reshape(-1, 3)
    upper = np.array([mesh.vertices.max(axis=0) for mesh in meshes]).reshape(-1, 3)
    pairs = boxes_that_meet(lower, upper, tolerance_m)
    if member is not None:
        pairs = pairs[np.asarray(member)[pairs[:, 0]] != np.asarray(member)[pairs[:, 1]]]
    patches = [(NO_FACES.pairs, NO_FACES.areas, NO_FACES.centres, NO_FACES.normals)]
    surface = _Surface.of(meshes)
    for first in range(0, len(pairs), _PAIRS_PER_BLOCK):
        patches.append(_touching_patches(surface, pairs[first : first + _PAIRS_PER_BLOCK], lower, upper, tolerance_m))
    pairs, areas, centres, normals = (np.concatenate(column) for column in zip(*patches, strict=True))
    return shared_faces(pairs, areas, centres, normals)


def overlaps(first: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return areas (m,) and centres (m, 3) that triangles (m, 3, 3) that look at each other have in common.

    Both of a pair have an area, nearly the same plane and nearly opposite normals; corners run counter-clockwise seen
    from outside. The centre is in the plane of the first triangle; its first corner where there is no overlap.

    I. Sutherland, G. Hodgman (1974), Reentrant polygon clipping, Communications of the ACM 17, 32-42; here all corners
    that are cut off are moved onto the cutting line instead of being dropped, which leaves area and centre right and
    every polygon with the same number of corners.
    """
    origin = first[:, 0]
    along = unit(first[:, 1] - origin)
    across = np.cross(unit(np.cross(along, first[:, 2] - origin)), along)
    frame = np.stack([along, across], axis=2)
    window = transformed_back(frame[:, None], first - origin[:, None])
    polygon = transformed_back(frame[:, None], second - origin[:, None])[:, ::-1]
    for corner in range(3):
        edge = window[:, (corner + 1) % 3] - window[:, corner]
        polygon = _left_of_line(polygon, window[:, corner], unit(edge))
    areas, centres = _polygon_areas_and_centres(polygon)
    return areas, origin + transformed(frame, centres)


@dataclass(frozen=True, eq=False, slots=True)
class _Surface:
    """The meshes' triangles with their boxes, and where each mesh begins: `bounds` (n + 1,)."""

    corners: FloatArray
    areas: FloatArray
    normals: FloatArray
    lower: FloatArray
    upper: FloatArray
    bounds: IntArray

    @classmethod
    def of(cls, meshes: Sequence[TriangleMesh]) -> "_Surface":
        parts = [mesh.corners for mesh in meshes]
        corners = np.concatenate([np.zeros((0, 3, 3)), *parts])
        areas, normals = triangle_areas_and_normals(corners)
        bounds = np.cumsum([0] + [len(part) for part in parts])
        return cls(corners, areas, normals, corners.min(axis=1), corners.max(axis=1), bounds)


def _touching_patches(
    surface: _Surface, pairs: IntArray, lower: FloatArray, upper: FloatArray, tolerance: float
) -> tuple[IntArray, FloatArray, FloatArray, FloatArray]:
    """Pairs, areas, centres and normals of the common patches, triangle by triangle, of these pairs of meshes."""
    row, first, second = _facing_triangles(surface, pairs, lower, upper, tolerance)
    areas, centres = overlaps(surface.corners[first], surface.corners[second])
    gap = dot(centres - surface.corners[second, 0], surface.normals[second])
    real = areas > SMALLEST_AREA * np.maximum(surface.areas[first], surface.areas[second])
    touch = real & (np.abs(gap) <= tolerance)
    return pairs[row[touch]], areas[touch], centres[touch], surface.normals[first[touch]]


def _facing_triangles(
    surface: _Surface, pairs: IntArray, lower: FloatArray, upper: FloatArray, tolerance: float
) -> tuple[IntArray, IntArray, IntArray]:
    """Row of the pair, triangle of its first and triangle of its second mesh, wherever the two may touch."""
    lower, upper = lower - tolerance, upper + tolerance
    row, first = _triangles_in_box(surface, pairs[:, 0], lower[pairs[:, 1]], upper[pairs[:, 1]])
    own_row, second = _triangles_in_box(surface, pairs[:, 1], lower[pairs[:, 0]], upper[pairs[:, 0]])
    of_first, position = _opposite(surface.normals, row, first, own_row, second)
    row, first, second = row[of_first], first[of_first], second[position]
    for axis in range(3):
        near = (surface.lower[first, axis] <= surface.upper[second, axis] + tolerance) & (
            surface.lower[second, axis] <= surface.upper[first, axis] + tolerance
        )
        row, first, second = row[near], first[near], second[near]
    facing = dot(surface.normals[first], surface.normals[second]) < OPPOSITE_COSINE
    return row[facing], first[facing], second[facing]


def _opposite(
    normals: FloatArray, row: IntArray, first: IntArray, own_row: IntArray, second: IntArray
) -> tuple[IntArray, IntArray]:
    """Positions in two lists of triangles, by the rows of their pairs, wherever normals may be opposite; in order.

    Along any direction opposite normals have opposite parts: what is sorted by these need not be compared with all.
    """
    of_first, of_second = dot(normals[first], _ASKEW), dot(normals[second], _ASKEW)
    keys = _APART * own_row + of_second
    order = np.argsort(keys, kind="stable")
    sought = _APART * row - of_first
    begins = np.searchsorted(keys[order], sought - _LEANING)
    found, place = ranges(begins, np.searchsorted(keys[order], sought + _LEANING) - begins)
    position = order[place]
    in_order = np.lexsort((position, found))
    return found[in_order], position[in_order]


def _triangles_in_box(
    surface: _Surface, meshes: IntArray, lower: FloatArray, upper: FloatArray
) -> tuple[IntArray, IntArray]:
    """Row k and triangle of meshes[k], for all triangles of it whose box meets the box k."""
    row, triangle = ranges(surface.bounds[meshes], surface.bounds[meshes + 1] - surface.bounds[meshes])
    meets = ((surface.lower[triangle] <= upper[row]) & (surface.upper[triangle] >= lower[row])).all(axis=1)
    return row[meets], triangle[meets]


def _left_of_line(polygons: FloatArray, point: FloatArray, direction: FloatArray) -> FloatArray:
    """Polygons (m, k, 2) cut to the left of a line each, with twice the corners, some of them doubled."""
    leftwards = np.stack([-direction[:, 1], direction[:, 0]], axis=1)
    heights = dot(polygons - point[:, None], leftwards[:, None])
    next_heights, next_corners = np.roll(heights, -1, axis=1), np.roll(polygons, -1, axis=1)
    onto_line = polygons - np.minimum(heights, 0)[..., None] * leftwards[:, None]
    crosses = (heights < 0) != (next_heights < 0)
    fraction = np.divide(heights, heights - next_heights, out=np.zeros_like(heights), where=crosses)
    crossing = polygons + fraction[..., None] * (next_corners - polygons)
    between = np.where(crosses[..., None], crossing, onto_line)
    return np.stack([onto_line, between], axis=2).reshape(len(polygons), 2 * polygons.shape[1], 2)


def _polygon_areas_and_centres(polygons: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Areas (m,) and centres (m, 2) of polygons (m, k, 2); the first corner where there is no area."""
    base = polygons[:, :1]
    here = polygons - base
    there = np.roll(here, -1, axis=1)
    crossed = cross_2d(here, there)
    areas = crossed.sum(axis=1) / 2
    moments = (crossed[..., None] * (here + there)).sum(axis=1) / 6
    offsets = np.divide(moments, areas[:, None], out=np.zeros_like(moments), where=areas[:, None] > 0)
    return np.maximum(areas, 0), base[:, 0] + offsets


def _summed(rows: FloatArray, group: IntArray, count: int) -> FloatArray:
    """Sums (count, 3) of the rows (m, 3) of each group."""
    columns = [np.bincount(group, weights=column, minlength=count) for column in rows.T]
    return np.column_stack(columns)
