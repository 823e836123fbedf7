"""Ground levelled under what stands on it, and dug away from members that go into it, as for footings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...errors import GeometryError
from ..arrays import BoolArray, FloatArray
from ..geometry.mesh import TriangleMesh, triangle_areas_and_normals
from .surface import Surface
from .thinning import Grid

STANDS_M = 1e-3
"""Largest depth of the ground below a foot that stands on it: rounding, and the precision of mesh files."""

_SAMPLES_PER_STEP = 2
"""Samples of a member in a cell of the grid, along each side."""

_REPORTED_M = 1e-3
"""Ground that is moved by less is not reported."""


@dataclass(frozen=True, slots=True)
class Levelled:
    """Change of the ground for a member."""

    name: str
    dug_m: float  # largest depth of ground taken away
    filled_m: float  # largest height of ground filled up


def levelled(
    grid: Grid, members: Sequence[tuple[str, TriangleMesh]], heights_at: Callable[[FloatArray], FloatArray]
) -> tuple[Grid, BoolArray, tuple[Levelled, ...]]:
    """Return a grid that is level under feet and inside no member, its nodes (s, s) that matter, and the changes.

    A member stands on the ground where that is as high as the middle of its lowest face. There the ground is filled up
    or dug away to the face. Wherever else the ground would go into a member, up to a cell next to it, it is dug away.

    `grid` has no gaps; members are names and solids; `heights_at` gives heights (n,) of the terrain at positions (n,
    2), nan where it has no data.
    """
    before, heights = grid.heights, grid.heights.copy()
    lows, touched, kept = [], [], np.zeros(before.shape, bool)
    for name, solid in members:
        samples = _lower_side(solid, grid.step_m / _SAMPLES_PER_STEP)
        lows.append(_nodes_below(grid, samples))
        touched.append(lows[-1] < before)
        if (foot_m := _foot(solid)) is None:
            continue
        level = foot_m[2]
        middle = float(heights_at(foot_m[None, :2])[0])
        ground = middle if np.isfinite(middle) else float(_at(grid, foot_m[:2]))
        if ground < level - STANDS_M:
            continue
        under = samples[samples[:, 2] <= level + STANDS_M]
        if np.isnan(heights_at(under[:, :2])).any():
            raise GeometryError(f"the terrain has no data under {name}")
        foot = np.isfinite(_nodes_below(grid, under))
        heights[foot] = np.maximum(heights[foot], level)
        kept |= foot
        touched[-1] = touched[-1] | foot
    for low in lows:
        heights = np.minimum(heights, _beside(low))
    done = []
    for (name, _), nodes in zip(members, touched, strict=True):
        change = (heights - before)[nodes]
        dug, filled = -float(change.min(initial=0.0)), float(change.max(initial=0.0))
        if max(dug, filled) > _REPORTED_M:
            done.append(Levelled(name, dug, filled))
    return replace(grid, heights=heights), kept | _grown(heights != before), tuple(done)


def _foot(solid: TriangleMesh) -> FloatArray | None:
    """Middle (3,) of the lowest face of a solid; None where that is no face but an edge or a corner."""
    corners = solid.corners
    level = float(corners[:, :, 2].min())
    lowest = corners[(corners[:, :, 2] <= level + STANDS_M).all(axis=1)]
    areas, _ = triangle_areas_and_normals(lowest)
    total = float(areas.sum())
    if total <= 0.0:
        return None
    middle = (areas[:, None] * lowest.mean(axis=1)).sum(axis=0) / total
    return np.array([middle[0], middle[1], level])


def _lower_side(solid: TriangleMesh, spacing_m: float) -> FloatArray:
    """Positions (n, 3) on the lower side of a solid, so close that none of its plan is farther from them than that."""
    low, high = solid.bounds[:, :2]
    counts = np.maximum(np.ceil((high - low) / spacing_m).astype(int), 1) + 1
    x, y = (np.linspace(low[axis], high[axis], counts[axis]) for axis in (0, 1))
    positions = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
    heights = -Surface(TriangleMesh(solid.vertices * (1.0, 1.0, -1.0), solid.triangles)).heights_at(positions)
    inside = np.isfinite(heights)
    return np.concatenate([np.column_stack((positions, heights))[inside], _on_edges(solid, spacing_m)])


def _on_edges(solid: TriangleMesh, spacing_m: float) -> FloatArray:
    """Positions (n, 3) along all edges: solids thinner than the spacing have no others."""
    edges = np.unique(np.sort(solid.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    first, second = solid.vertices[edges[:, 0]], solid.vertices[edges[:, 1]]
    parts = np.maximum(np.ceil(np.abs(second - first)[:, :2].max(axis=1) / spacing_m).astype(int), 1)
    rows = np.repeat(np.arange(len(edges)), parts + 1)
    numbers = np.arange(len(rows)) - np.repeat(np.cumsum(parts + 1) - (parts + 1), parts + 1)
    shares = (numbers / parts[rows])[:, None]
    points: FloatArray = first[rows] + shares * (second[rows] - first[rows])
    return points


def _nodes_below(grid: Grid, samples: FloatArray) -> FloatArray:
    """Lowest of the samples (n, 3) in the cells around each node, (s, s); inf where there are none."""
    lowest = np.full(grid.heights.shape, np.inf)
    cells = np.clip(np.floor((samples[:, :2] - grid.low) / grid.step_m).astype(np.int64), 0, grid.size - 2)
    for down in (0, 1):
        for right in (0, 1):
            np.minimum.at(lowest, (cells[:, 1] + down, cells[:, 0] + right), samples[:, 2])
    return lowest


def _beside(low: FloatArray) -> FloatArray:
    """The least value (s, s) of each node and its eight neighbours."""
    for axis in (0, 1):
        padded = np.pad(low, [(1, 1) if other == axis else (0, 0) for other in (0, 1)], constant_values=np.inf)
        first, second = (padded.take(range(at, at + low.shape[axis]), axis) for at in (0, 2))
        low = np.minimum(low, np.minimum(first, second))
    return low


def _grown(chosen: BoolArray) -> FloatArray:
    """Chosen nodes (s, s) and their neighbours."""
    return np.isfinite(_beside(np.where(chosen, 0.0, np.inf)))


def _at(grid: Grid, position: FloatArray) -> float:
    column, row = np.clip(np.rint((position - grid.low) / grid.step_m).astype(int), 0, grid.size - 1)
    return float(grid.heights[row, column])
