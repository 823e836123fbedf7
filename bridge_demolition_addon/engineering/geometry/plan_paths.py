"""Paths of bodies in plan, by the corners that they have at steps of time: where a path is straight."""

from __future__ import annotations

from bisect import bisect_right

import numpy as np

from ..arrays import FloatArray
from .vectors import transformed


def path_of_corners(rotations: FloatArray, positions: FloatArray, corners: FloatArray) -> FloatArray:
    """Corners (v, 3) of a body in plan (k, v, 2) at all steps, by its rotations (k, 3, 3) and positions (k, 3)."""
    return transformed(rotations[:, None, :2], corners) + positions[:, None, :2]


def ends_of_straight_parts(plans: FloatArray, off: float) -> list[int]:
    """Steps at which straight parts of a path of corners (k, v, 2) meet, and the first and last.

    Corners stray from a straight way, or from the position at which they stay, by `off` at most.
    """
    last = len(plans) - 1
    bends, moves = bends_and_moves(plans)
    bent, leaves_at_once = np.cumsum(bends).tolist(), (moves > off).tolist()
    ends = [0]
    while ends[-1] < last:
        start = ends[-1]
        away = 0 if leaves_at_once[start] else _steps_near(plans, start, off)
        ends.append(start + max(1, away, _straight_steps(bent, start, last, off)))
    return ends if last else [0, 0]


def bends_and_moves(plans: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Largest second difference of a coordinate of corners (k, v, 2) at each step, and largest way to the next, (k,).

    Both are 0 at the last step, and bends at the first.
    """
    bends, moves = np.zeros(len(plans)), np.zeros(len(plans))
    bends[1:-1] = np.abs(np.diff(plans, 2, axis=0)).max(axis=(1, 2), initial=0.0)
    moves[:-1] = np.abs(np.diff(plans, axis=0)).max(axis=(1, 2), initial=0.0)
    return bends, moves


def _steps_near(plans: FloatArray, start: int, off: float) -> int:
    """How many steps after one all corners stay where they were."""
    is_away = np.abs(plans[start + 1 :] - plans[start]).max(axis=(1, 2)) > off
    return int(is_away.argmax()) if is_away.any() else len(is_away)


def _straight_steps(bent: list[float], start: int, last: int, off: float) -> int:
    """How many steps after one lie on a straight line, by the sums of second differences up to each step.

    A way of n steps strays from its chord by n / 4 times the sum of its second differences at most.
    """
    steps = range(1, last - start + 1)
    return bisect_right(steps, off, key=lambda step: step / 4.0 * (bent[start + step - 1] - bent[start]))
