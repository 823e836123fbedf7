"""Voronoi cells of points in a box, as convex polyhedra: all cells are clipped together, one neighbour each at a time.

A polyhedron is kept as half-edges: every face is a loop of directed edges, counter-clockwise seen from outside, and
every edge is walked once in each direction. A plane cuts off corners; each face that loses some is closed along
the plane, and these closing edges, walked the other way, are the new face. Nothing depends on the order of the loops,
so one clip of thousands of cells is a handful of array operations.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...errors import GeometryError
from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.mesh import TriangleMesh
from ..geometry.vectors import distance, dot, length, unit

PLANE_TOLERANCE = 1e-12
"""Part of the box's largest coordinate that a corner must lie beyond a plane to be cut off. Above rounding, so that a
plane that only touches a corner, as in a regular grid of points, does not cut; far below what a volume can show."""

COINCIDENCE_TOLERANCE = 1e-9
"""Part of the box's largest coordinate below which two points have no plane between them that could be trusted."""

_CELLS_PER_BLOCK = 512
"""Cells clipped together: enough to make an array operation worth its call, few enough for the cache."""

_NEIGHBOURS_PER_ROUND = 16
"""Neighbours clipped by between two looks at which others can still cut: about as many as a cell has faces."""

_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
_SIDES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


@dataclass(frozen=True, eq=False, slots=True)
class ConvexCell:
    """The Voronoi cell of one point.

    Each triangle faces one of the `neighbours` (t,): another point or, from the number of points upwards, a side of the
    box.
    """

    mesh: TriangleMesh
    neighbours: IntArray


@dataclass(frozen=True, eq=False, slots=True)
class _Polyhedra:
    """Many convex polyhedra: `corners` (v, 3) and the polyhedron that is the `owner` (v,) of each; half-edges from
    corner `start` (h,) to corner `end` (h,) around the face with that `label` (h,)."""

    corners: FloatArray
    owner: IntArray
    start: IntArray
    end: IntArray
    label: IntArray


def convex_cells(points: FloatArray, lower: FloatArray, upper: FloatArray) -> Iterator[ConvexCell]:
    """Voronoi cells of points (n, 3) in an axis-parallel box around them, in the order of the points.

    A cell is clipped by its neighbours, nearest first, until no point is left whose plane would cut off a corner.
    Points further away than twice the cell's radius need no look: a plane halfway to them cannot meet the cell.
    """
    scale = float(np.max(np.abs([lower, upper])))
    for first in range(0, len(points), _CELLS_PER_BLOCK):
        members = np.arange(first, min(first + _CELLS_PER_BLOCK, len(points)))
        cells = _clipped_by_nearest(_boxes(lower, upper, len(members), len(points)), points, members, scale)
        yield from _triangulated(cells, len(members))


def _clipped_by_nearest(cells: _Polyhedra, points: FloatArray, members: IntArray, scale: float) -> _Polyhedra:
    """Cells clipped by all points that can cut them; cell k belongs to point members[k]."""
    own = points[members]
    tolerance = PLANE_TOLERANCE * scale
    # The neighbours still to come, by distance; infinitely far are those that are done with or cannot cut any more.
    distances = distance(own[:, None], points)
    distances[np.arange(len(members)), members] = np.inf
    _check_apart(distances, members, COINCIDENCE_TOLERANCE * scale)
    while np.isfinite(distances).any():
        nearest = _nearest(distances, _NEIGHBOURS_PER_ROUND)
        usable = np.isfinite(np.take_along_axis(distances, nearest, axis=1))
        for neighbours, are_usable in zip(nearest.T, usable.T, strict=True):
            normals, offsets = _bisectors(own, points[neighbours], are_usable)
            cells = _clipped(cells, normals, offsets, neighbours, tolerance)
        np.put_along_axis(distances, nearest, np.inf, axis=1)
        _drop_what_cannot_cut(distances, cells, own, points, tolerance)
    return _sorted_by_owner(cells)


def _drop_what_cannot_cut(
    distances: FloatArray, cells: _Polyhedra, own: FloatArray, points: FloatArray, tolerance: float
) -> None:
    """Set to infinity the distance of every point whose plane lies beyond all corners of a cell."""
    corners = _sorted_by_owner(cells)
    bounds = np.searchsorted(corners.owner, np.arange(len(own) + 1))
    for cell, (first, last) in enumerate(pairwise(bounds)):
        arms = corners.corners[first:last] - own[cell]
        within = np.flatnonzero(distances[cell] < 2 * length(arms).max())
        towards = points[within] - own[cell]
        heights = dot(towards[:, None], arms).max(axis=1) / distances[cell, within] - distances[cell, within] / 2
        cutting = within[heights > tolerance]
        still = distances[cell, cutting]
        distances[cell] = np.inf
        distances[cell, cutting] = still


def _check_apart(distances: FloatArray, members: IntArray, tolerance: float) -> None:
    close = np.argwhere(distances <= tolerance)
    if len(close):
        first, second = members[close[0, 0]], close[0, 1]
        raise GeometryError(f"Points {first} and {second} coincide; a cell needs a point of its own.")


def _nearest(distances: FloatArray, count: int) -> IntArray:
    """Columns of the `count` smallest distances of each row, nearest first; equal ones in the order of the columns."""
    count = min(count, distances.shape[1])
    farthest = np.partition(distances, count - 1, axis=1)[:, count - 1, None]
    nearer, level = distances < farthest, distances == farthest
    chosen = nearer | (level & (np.cumsum(level, axis=1) <= count - nearer.sum(axis=1, keepdims=True)))
    columns = np.nonzero(chosen)[1].reshape(-1, count)
    order = np.argsort(np.take_along_axis(distances, columns, axis=1), axis=1, kind="stable")
    return np.take_along_axis(columns, order, axis=1)


def _boxes(lower: FloatArray, upper: FloatArray, count: int, first_label: int) -> _Polyhedra:
    """The same box `count` times; its sides are labelled from `first_label` upwards."""
    corners = np.tile(np.where(_CORNERS, upper, lower), (count, 1))
    owner = np.repeat(np.arange(count), len(_CORNERS))
    shift = np.repeat(np.arange(count) * len(_CORNERS), _SIDES.size)
    start = np.tile(_SIDES.ravel(), count) + shift
    end = np.tile(np.roll(_SIDES, -1, axis=1).ravel(), count) + shift
    label = np.tile(np.repeat(np.arange(first_label, first_label + len(_SIDES)), _SIDES.shape[1]), count)
    return _Polyhedra(corners, owner, start, end, label)


def _bisectors(points: FloatArray, others: IntArray, usable: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Normals (n, 3) and offsets (n,) of the planes halfway to the others; infinitely far where not usable (n,)."""
    towards = np.where(usable[:, None], others - points, [1.0, 0.0, 0.0])
    normals = unit(towards)
    return normals, np.where(usable, dot(normals, (points + others) / 2), np.inf)


def _clipped(
    cells: _Polyhedra, normals: FloatArray, offsets: FloatArray, labels: IntArray, tolerance: float
) -> _Polyhedra:
    """Each cell without what is beyond its plane of normal (n, 3) and offset (n,); the cut is labelled (n,)."""
    heights = dot(cells.corners, normals[cells.owner]) - offsets[cells.owner]
    removed = heights > tolerance
    if not removed.any():
        return cells
    starts_removed, ends_removed = removed[cells.start], removed[cells.end]
    leaving = np.flatnonzero(~starts_removed & ends_removed)
    leaving = leaving[np.lexsort((cells.end[leaving], cells.start[leaving]))]
    returning = np.flatnonzero(starts_removed & ~ends_removed)
    # In this order the k-th returning half-edge is the k-th leaving one walked backwards: they share their new corner.
    returning = returning[np.lexsort((cells.start[returning], cells.end[returning]))]
    kept, lost = cells.start[leaving], cells.end[leaving]
    inside = np.minimum(heights[kept], 0)
    fraction = inside / (inside - heights[lost])
    new_corners = cells.corners[kept] + fraction[:, None] * (cells.corners[lost] - cells.corners[kept])
    new = len(cells.corners) + np.arange(len(leaving))

    start, end = cells.start.copy(), cells.end.copy()
    end[leaving], start[returning] = new, new
    # A face is left and entered equally often: sorted by face, each exit stands opposite the entry that closes it.
    by_exit = np.lexsort((cells.label[leaving], cells.owner[kept]))
    by_entry = np.lexsort((cells.label[returning], cells.owner[kept]))
    remains = ~(starts_removed & ends_removed)
    return _compacted(
        _Polyhedra(
            corners=np.concatenate([cells.corners, new_corners]),
            owner=np.concatenate([cells.owner, cells.owner[kept]]),
            start=np.concatenate([start[remains], new[by_exit], new[by_entry]]),
            end=np.concatenate([end[remains], new[by_entry], new[by_exit]]),
            label=np.concatenate(
                [cells.label[remains], cells.label[leaving[by_exit]], labels[cells.owner[kept[by_exit]]]]
            ),
        ),
        np.concatenate([~removed, np.ones(len(new), dtype=bool)]),
    )


def _compacted(cells: _Polyhedra, used: BoolArray) -> _Polyhedra:
    """The cells without the corners that are not used (v,)."""
    renumbered = np.cumsum(used) - 1
    return _Polyhedra(
        cells.corners[used], cells.owner[used], renumbered[cells.start], renumbered[cells.end], cells.label
    )


def _sorted_by_owner(cells: _Polyhedra) -> _Polyhedra:
    order = np.argsort(cells.owner, kind="stable")
    position = np.empty_like(order)
    position[order] = np.arange(len(order))
    return _Polyhedra(cells.corners[order], cells.owner[order], position[cells.start], position[cells.end], cells.label)


def _triangulated(cells: _Polyhedra, count: int) -> Iterator[ConvexCell]:
    """Each cell by itself; every face a fan from its first corner."""
    owner = cells.owner[cells.start]
    order = np.lexsort((cells.start, cells.label, owner))
    owner, label, start, end = owner[order], cells.label[order], cells.start[order], cells.end[order]
    is_first = np.concatenate([[True], (owner[1:] != owner[:-1]) | (label[1:] != label[:-1])])
    apex = start[is_first][np.cumsum(is_first) - 1]
    opposite = (start != apex) & (end != apex)
    triangles = np.column_stack([apex, start, end])[opposite]
    label, owner = label[opposite], owner[opposite]
    corner_bounds = np.searchsorted(cells.owner, np.arange(count + 1))
    triangle_bounds = np.searchsorted(owner, np.arange(count + 1))
    for cell in range(count):
        corners = slice(*corner_bounds[cell : cell + 2])
        rows = slice(*triangle_bounds[cell : cell + 2])
        yield ConvexCell(TriangleMesh(cells.corners[corners], triangles[rows] - corner_bounds[cell]), label[rows])
