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


def parted(results: Results, row: int = -1) -> np.ndarray:
    """Return which connections (m,) are broken in a row of the frames, with their two sides apart by more than a crack.

    Some break in a run and stay closed: nothing is to be seen of them.
    """
    inventory, intact = results.inventory, np.asarray(results.frames.intact)
    apart = np.zeros(len(inventory.pairs), bool)
    for connection in np.flatnonzero(intact[0] & ~intact[row]) if len(inventory.pairs) else ():
        point = inventory.points_m[connection][None]
        first, second = (moved(results, row, int(body), point) for body in inventory.pairs[connection])
        apart[connection] = float(np.linalg.norm(first - second)) > _CRACK_M
    return apart
