"""Distances in plan, and how paths in it bend, as loops, which Numba compiles: import this only where it is installed.

They give the same bits as `plan_areas` and `plan_paths`, which are read, changed and tested first: every operation here
stands there, in the same order.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled


@compiled
def distances_outside(points: Any, starts: Any, ends: Any) -> Any:
    """Distances (p,) of points (p, 2) from an area with sides from (s, 2) to (s, 2); 0 within it."""
    sides = ends - starts
    lengths_squared = np.maximum(sides[:, 0] * sides[:, 0] + sides[:, 1] * sides[:, 1], np.finfo(np.float64).tiny)
    distances = np.zeros(len(points))
    for row in range(len(points)):
        x, y = points[row]
        if _winding(x, y, starts, ends, sides) <= 0:
            distances[row] = _distance_to_sides(x, y, starts, sides, lengths_squared)
    return distances


@compiled
def _winding(x: float, y: float, starts: Any, ends: Any, sides: Any) -> int:
    winding = 0
    for side in range(len(starts)):
        is_left = sides[side, 0] * (y - starts[side, 1]) - sides[side, 1] * (x - starts[side, 0])
        if starts[side, 1] <= y < ends[side, 1] and is_left > 0.0:
            winding += 1
        elif ends[side, 1] <= y < starts[side, 1] and is_left < 0.0:
            winding -= 1
    return winding


@compiled
def _distance_to_sides(x: float, y: float, starts: Any, sides: Any, lengths_squared: Any) -> float:
    nearest = np.inf
    for side in range(len(starts)):
        along = (x - starts[side, 0]) * sides[side, 0] + (y - starts[side, 1]) * sides[side, 1]
        share = min(max(along / lengths_squared[side], 0.0), 1.0)
        x_off = x - (starts[side, 0] + share * sides[side, 0])
        y_off = y - (starts[side, 1] + share * sides[side, 1])
        square = x_off * x_off + y_off * y_off
        if np.isnan(square):
            return np.nan
        nearest = min(nearest, square)
    return float(np.sqrt(nearest))


@compiled
def path_of_corners(rotations: Any, positions: Any, corners: Any) -> Any:
    """Corners (v, 3) in plan (k, v, 2) by rotations (k, 3, 3) and positions (k, 3)."""
    path = np.empty((len(rotations), len(corners), 2))
    for step in range(len(rotations)):
        for corner in range(len(corners)):
            for axis in range(2):
                turned = rotations[step, axis, 0] * corners[corner, 0]
                turned = turned + rotations[step, axis, 1] * corners[corner, 1]
                turned = turned + rotations[step, axis, 2] * corners[corner, 2]
                path[step, corner, axis] = turned + positions[step, axis]
    return path


@compiled
def bends_and_moves(plans: Any) -> Any:
    """Largest change of a coordinate of points in plan (k, v, 2) in each step, and of that change from step to step.

    Both are (k,): moves to the next step, 0 for the last, and bends at a step, 0 for the first and last.
    """
    bends, moves = np.zeros(len(plans)), np.zeros(len(plans))
    for step in range(len(plans) - 1):
        for corner in range(plans.shape[1]):
            for axis in range(2):
                change = plans[step + 1, corner, axis] - plans[step, corner, axis]
                moves[step] = max(moves[step], abs(change))
                if step:
                    before = plans[step, corner, axis] - plans[step - 1, corner, axis]
                    bends[step] = max(bends[step], abs(change - before))
    return bends, moves
