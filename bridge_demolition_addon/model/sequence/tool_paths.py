"""Positions of tools over time: the tip of a jackhammer's chisel, and a ball that is lifted for its next hit."""

from __future__ import annotations

import numpy as np

from ...engineering.arithmetic import cosine
from ...engineering.geometry.vectors import length
from ..scenario import Jackhammer

_RAISED_M = 1.0
"""How far a chisel is raised after its last blow."""

_RAISING_S = 1.0
"""How long raising takes."""


def chisel_tip_positions(hammer: Jackhammer, deck_top_m: float, times_s: np.ndarray) -> np.ndarray:
    """Return the positions (k, 3) of a chisel's tip at given times (k,), m.

    It goes up and down as a cosine between the top of its stroke and its depth below the deck, beginning at the top.
    """
    times = np.asarray(times_s, float)
    worked_s = np.clip(times, hammer.start_time_s, hammer.end_time_s) - hammer.start_time_s
    level = _points_along(np.array(hammer.path_m), hammer.speed_m_s * worked_s)
    blows = hammer.blows_per_second * worked_s
    raised = 0.5 * (1.0 + cosine(2.0 * np.pi * (blows - np.floor(blows))))
    height = deck_top_m - hammer.depth_m + hammer.stroke_m * raised
    share = np.clip((times - hammer.end_time_s) / _RAISING_S, 0.0, 1.0)
    clear = deck_top_m - hammer.depth_m + hammer.stroke_m + _RAISED_M
    return np.column_stack((level, height + share * (clear - height)))


def lift_path(start_m: np.ndarray, end_m: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Return the positions of a lifted ball: straight up, then level to its next drop.

    It goes up by the way that it came down. Its speed rises from 0 and falls to 0 again, with 3 s² - 2 s³ of the way
    after the share s of the time, and is at most 1.5 times the mean: what lies on the ball is pushed off, not flung.

    Parameters
    ----------
    start_m, end_m : (3,) float
        Where the lift begins and ends, m.
    shares : (k,) float
        Shares of the time that have passed, from 0 to 1.

    Returns
    -------
    (k, 3) float
        Positions, m.
    """
    start, end = np.asarray(start_m, float), np.asarray(end_m, float)
    path = np.array([start, [*start[:2], end[2]], end])
    time = np.asarray(shares, float)
    return _points_along(path, time * time * (3.0 - 2.0 * time) * length(np.diff(path, axis=0)).sum())


def _points_along(path_m: np.ndarray, distances_m: np.ndarray) -> np.ndarray:
    """Return the points (k, d) of a path (p, d) at distances (k,) from its beginning; its end beyond it."""
    passed = np.concatenate(([0.0], np.cumsum(length(np.diff(path_m, axis=0)))))
    return np.column_stack([np.interp(distances_m, passed, column) for column in path_m.T])
