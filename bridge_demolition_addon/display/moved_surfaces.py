"""Points and surfaces that go with the bodies of a run, where they are in a recorded frame, lit from above."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.vectors import length, transformed
from ..model.results.arrays import Results
from ..model.results.motion import OUT_OF_REACH_M

_LIGHT = np.array((-0.3, -0.5, 0.81))
_IN_SHADOW = 0.45
"""How bright a face is that looks away from the light."""

_NEVER_SHOWN = "ground"


class MovedSurfaces:
    """Triangles of every body but the ground.

    Parameters
    ----------
    results
        Frames of a run.
    meshes : n meshes
        Surface of each of its bodies, in its own axes.

    Attributes
    ----------
    bodies : (t,) int
        The body of each triangle.
    """

    def __init__(self, results: Results, meshes: Sequence[TriangleMesh]):
        self._frames = results.frames
        shown = np.flatnonzero(results.inventory.body_kinds != _NEVER_SHOWN).tolist()
        self._corners = np.concatenate([np.zeros((0, 3, 3)), *(meshes[body].corners for body in shown)])
        self.bodies = np.repeat(np.array(shown, int), [len(meshes[body].triangles) for body in shown])

    def row_at(self, time_s: float) -> int:
        """Return the last recorded row up to a simulated time, and the first one before there is any."""
        times = np.asarray(self._frames.time_s)
        return max(int(np.searchsorted(times, time_s + 1e-6, side="right")) - 1, 0)

    def time_s(self, row: int) -> float:
        """Return the simulated time of a row, s."""
        return float(self._frames.time_s[row])

    def at(self, row: int, shift_m: Sequence[float] = (0.0, 0.0, 0.0)) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return what a frame shows, without bodies that were removed by then.

        Returns
        -------
        triangles : (s, 3, 3) float
            Corners, m, all shifted.
        brightness : (s,) float
            Of each triangle, from 0 to 1.
        bodies : (s,) int
            The body of each.
        """
        positions = np.asarray(self._frames.positions_m[row], float)
        there = np.asarray(self._frames.positions_m[0], float)[:, 2] - positions[:, 2] <= OUT_OF_REACH_M / 2.0
        chosen = there[self.bodies]
        bodies = self.bodies[chosen]
        turns = np.asarray(self._frames.rotations[row], float)[bodies]
        triangles = transformed(turns[:, None], self._corners[chosen]) + positions[bodies][:, None] + np.array(shift_m)
        return triangles, brightness_of(triangles), bodies


def brightness_of(triangles: np.ndarray) -> np.ndarray:
    """Return how bright triangles (t, 3, 3) are, from `_IN_SHADOW` to 1; a sliver is dark."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    sizes = np.maximum(length(normals), np.finfo(float).tiny)
    lit = np.clip(normals @ (_LIGHT / np.linalg.norm(_LIGHT)) / sizes, 0.0, 1.0)
    return _IN_SHADOW + (1.0 - _IN_SHADOW) * lit


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
