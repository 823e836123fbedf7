"""Where points that go with a body are in a frame of a run."""

from __future__ import annotations

import numpy as np

from ..model.results.arrays import Results

_CRACK_M = 0.03
"""Widest crack that pictures show no break for."""


def moved(results: Results, row: int, body: int, points_m: np.ndarray) -> np.ndarray:
    """Return points (n, 3), m, that a body carries, given where they were at first, in row `row` of the frames."""
    frames = results.frames
    turn = frames.rotations[row, body] @ frames.rotations[0, body].T
    return frames.positions_m[row, body] + (np.asarray(points_m, float) - frames.positions_m[0, body]) @ turn.T


def boxes_of_bodies(results: Results, row: int) -> np.ndarray:
    """Return lowest and highest corners (n, 2, 3), m, of the boxes around all bodies in a row of the frames."""
    frames = results.frames
    boxes = []
    for body, vertices in enumerate(results.inventory.vertices_by_body()):
        placed = vertices @ frames.rotations[row, body].T + frames.positions_m[row, body]
        boxes.append((placed.min(axis=0), placed.max(axis=0)))
    return np.array(boxes)


def parted(results: Results) -> np.ndarray:
    """Return which connections have opened by each frame (k, m): broken, and ever since apart by more than a crack.

    Some break in a run and stay closed: nothing is to be seen of them.
    """
    inventory, frames = results.inventory, results.frames
    intact = np.asarray(frames.intact)
    opened = np.zeros(intact.shape, bool)
    if not intact.shape[1]:
        return opened
    for connection in np.flatnonzero(intact[0] & ~intact[-1]).tolist():
        point = inventory.points_m[connection]
        first, second = (_path(results, int(body), point) for body in inventory.pairs[connection])
        opened[:, connection] = ~intact[:, connection] & (np.linalg.norm(first - second, axis=1) > _CRACK_M)
    return np.logical_or.accumulate(opened, axis=0)


def _path(results: Results, body: int, point_m: np.ndarray) -> np.ndarray:
    """Return where a point (3,), m, that a body carries is in every frame (k, 3)."""
    frames = results.frames
    arm = frames.rotations[0, body].T @ (point_m - frames.positions_m[0, body])
    return frames.positions_m[:, body] + frames.rotations[:, body] @ arm
