"""Voronoi cells of points in a box, as convex polyhedra: all cells are clipped together, one neighbour each at a time.

A polyhedron is kept as half-edges: every face is a loop of directed edges that runs counter-clockwise seen from outside,
and every edge is walked once in each direction. A plane cuts off corners; each face that loses some is closed along
the plane, and these closing edges, walked the other way, are the new face. Nothing depends on the order of the loops,
so one clip of thousands of cells is a handful of array operations.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .errors import GeometryError

PLANE_TOLERANCE = 1e-12
"""Part of the box's longest edge that a corner must lie beyond a plane to be cut off. Above rounding, so that a plane
that only touches a corner, as in a regular grid of points, does not cut; far below what a volume can show."""

COINCIDENCE_TOLERANCE = 1e-9
"""Part of the box's longest edge below which two points have no plane between them that could be trusted."""

_CELLS_PER_BLOCK = 512
_FIRST_NEIGHBOURS = 16

_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
_SIDES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


@dataclass(frozen=True, eq=False, slots=True)
class ConvexCell:
    """The Voronoi cell of one point: `vertices` (v, 3) in m, `triangles` (t, 3), and the `neighbours` (t,) that each
    triangle faces: the index of another point, or from the number of points upwards one of the six sides of the box.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    neighbours: np.ndarray


@dataclass(frozen=True, eq=False, slots=True)
class _Polyhedra:
    """Many convex polyhedra: corners (v, 3) and the polyhedron each belongs to (v,); half-edges from corner `start` (h,)
    to corner `end` (h,) around face `label` (h,)."""

    corners: np.ndarray
    owner: np.ndarray
    start: np.ndarray
    end: np.ndarray
    label: np.ndarray


def convex_cells(points: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> Iterator[ConvexCell]:
    """Voronoi cells of points in an axis-parallel box, in the order of the points.

    A cell is clipped by its neighbours, nearest first, until the next is further away than twice the cell's radius: no
    plane halfway to anything further can reach the cell.

    Parameters
    ----------
    points : (n, 3) float
        Inside the box.
    lower, upper : (3,) float
        Opposite corners of the box.

    Raises
    ------
    GeometryError
        When two points coincide.
    """
    extent = float(np.max(upper - lower))
    for first in range(0, len(points), _CELLS_PER_BLOCK):
        members = np.arange(first, min(first + _CELLS_PER_BLOCK, len(points)))
        cells = _clipped_by_nearest(_boxes(lower, upper, len(members), len(points)), points, members, extent)
        yield from _triangulated(cells, len(members))


def _clipped_by_nearest(cells: _Polyhedra, points: np.ndarray, members: np.ndarray, extent: float) -> _Polyhedra:
    """Cells clipped by as many neighbours as can reach them; cell k is that of point members[k]."""
    distances = _distances(points[members], points)
    distances[np.arange(len(members)), members] = np.inf
    _check_apart(distances, members, COINCIDENCE_TOLERANCE * extent)
    finished = []
    open_cells = np.arange(len(members))
    count = _FIRST_NEIGHBOURS
    while len(open_cells):
        neighbours = np.repeat(members[:, None], min(count, len(points)), axis=1)
        neighbours[open_cells] = _nearest(distances[open_cells], count)
        reach = distances[np.arange(len(members)), neighbours[:, -1]]
        for labels in neighbours.T:
            usable = np.isfinite(distances[np.arange(len(members)), labels])
            normals, offsets = _bisectors(points[members], points[labels], usable)
            cells = _clipped(cells, normals, offsets, labels, PLANE_TOLERANCE * extent)
        # What is exactly as far as the reach stays: there may be more points at that distance. It cuts nothing twice.
        distances[distances < reach[:, None]] = np.inf
        closed = 2 * _radii(cells, points[members]) <= reach
        finished.append(_selected(cells, closed))
        cells = _selected(cells, ~closed)
        open_cells = open_cells[~closed[open_cells]]
        count *= 2
    return _joined(finished)


def _distances(from_points: np.ndarray, to_points: np.ndarray) -> np.ndarray:
    """Distances (n, m), by differences: the quicker product form would lose those of close points in rounding."""
    squares = sum((from_points[:, None, axis] - to_points[None, :, axis]) ** 2 for axis in range(3))
    return np.sqrt(squares)


def _check_apart(distances: np.ndarray, members: np.ndarray, tolerance: float) -> None:
    close = np.argwhere(distances <= tolerance)
    if len(close):
        first, second = members[close[0, 0]], close[0, 1]
        raise GeometryError(f"Points {first} and {second} coincide; a cell needs a point of its own.")


def _nearest(distances: np.ndarray, count: int) -> np.ndarray:
    """Columns of the `count` smallest distances of each row, nearest first; ties in the order of the columns."""
    count = min(count, distances.shape[1])
    columns = np.sort(np.argpartition(distances, count - 1, axis=1)[:, :count], axis=1)
    order = np.argsort(np.take_along_axis(distances, columns, axis=1), axis=1, kind="stable")
    return np.take_along_axis(columns, order, axis=1)


def _boxes(lower: np.ndarray, upper: np.ndarray, count: int, first_label: int) -> _Polyhedra:
    """The same box `count` times; its sides are labelled from `first_label` upwards."""
    corners = np.tile(np.where(_CORNERS, upper, lower), (count, 1))
    owner = np.repeat(np.arange(count), len(_CORNERS))
    shift = np.repeat(np.arange(count) * len(_CORNERS), _SIDES.size)
    start = np.tile(_SIDES.ravel(), count) + shift
    end = np.tile(np.roll(_SIDES, -1, axis=1).ravel(), count) + shift
    label = np.tile(np.repeat(np.arange(first_label, first_label + len(_SIDES)), _SIDES.shape[1]), count)
    return _Polyhedra(corners, owner, start, end, label)


def _bisectors(points: np.ndarray, others: np.ndarray, usable: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Normals (n, 3) and offsets (n,) of the planes halfway to the others; infinitely far where not usable (n,)."""
    towards = np.where(usable[:, None], others - points, [1.0, 0.0, 0.0])
    normals = towards / np.linalg.norm(towards, axis=1)[:, None]
    return normals, np.where(usable, np.einsum("ij,ij->i", normals, (points + others) / 2), np.inf)


def _clipped(
    cells: _Polyhedra, normals: np.ndarray, offsets: np.ndarray, labels: np.ndarray, tolerance: float
) -> _Polyhedra:
    """Each cell without what is beyond its plane of normal (n, 3) and offset (n,); the cut is labelled (n,)."""
    heights = np.einsum("ij,ij->i", cells.corners, normals[cells.owner]) - offsets[cells.owner]
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
    # A face is left and entered equally often; sorted by face, each exit stands opposite the entry that closes its loop.
    by_exit = np.lexsort((cells.label[leaving], cells.owner[kept]))
    by_entry = np.lexsort((cells.label[returning], cells.owner[kept]))
    remains = ~(starts_removed & ends_removed)
    return _compacted(
        _Polyhedra(
            corners=np.concatenate([cells.corners, new_corners]),
            owner=np.concatenate([cells.owner, cells.owner[kept]]),
            start=np.concatenate([start[remains], new[by_exit], new[by_entry]]),
            end=np.concatenate([end[remains], new[by_entry], new[by_exit]]),
            label=np.concatenate([cells.label[remains], cells.label[leaving[by_exit]], labels[cells.owner[kept[by_exit]]]]),
        ),
        np.concatenate([~removed, np.ones(len(new), dtype=bool)]),
    )


def _compacted(cells: _Polyhedra, used: np.ndarray) -> _Polyhedra:
    """The cells without the corners that are not used (v,)."""
    renumbered = np.cumsum(used) - 1
    return _Polyhedra(
        cells.corners[used], cells.owner[used], renumbered[cells.start], renumbered[cells.end], cells.label
    )


def _radii(cells: _Polyhedra, points: np.ndarray) -> np.ndarray:
    """Distance (n,) of each point from the furthest corner of its cell."""
    radii = np.zeros(len(points))
    np.maximum.at(radii, cells.owner, np.linalg.norm(cells.corners - points[cells.owner], axis=1))
    return radii


def _selected(cells: _Polyhedra, wanted: np.ndarray) -> _Polyhedra:
    """Only the cells whose owner is wanted (n,)."""
    corner_wanted = wanted[cells.owner]
    edge_wanted = corner_wanted[cells.start]
    edges = _Polyhedra(
        cells.corners, cells.owner, cells.start[edge_wanted], cells.end[edge_wanted], cells.label[edge_wanted]
    )
    return _compacted(edges, corner_wanted)


def _joined(parts: list[_Polyhedra]) -> _Polyhedra:
    """All parts as one, sorted by owner."""
    shifts = np.cumsum([0] + [len(part.corners) for part in parts[:-1]])
    corners, owner, label = (np.concatenate([getattr(part, name) for part in parts]) for name in ("corners", "owner", "label"))
    start = np.concatenate([part.start + shift for part, shift in zip(parts, shifts, strict=True)])
    end = np.concatenate([part.end + shift for part, shift in zip(parts, shifts, strict=True)])
    by_owner = np.argsort(owner, kind="stable")
    position = np.empty_like(by_owner)
    position[by_owner] = np.arange(len(by_owner))
    return _Polyhedra(corners[by_owner], owner[by_owner], position[start], position[end], label)


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
        yield ConvexCell(cells.corners[corners], triangles[rows] - corner_bounds[cell], label[rows])
