"""The way of a jackhammer's chisel."""

from __future__ import annotations

import numpy as np

from ..scenario import Jackhammer

_RAISED_M = 1.0
"""How far it is raised after its last blow."""

_RAISING_S = 1.0
"""How long raising takes."""


def tip_places(hammer: Jackhammer, deck_top_m: float, times_s: np.ndarray) -> np.ndarray:
    """Where the tip of the chisel is at times (k,), (k, 3) in m.

    It goes up and down as a cosine between the top of its stroke and its depth below the deck, beginning at the top.
    """
    start_s, end_s = hammer.start_time_s, hammer.end_time_s
    worked_s = np.clip(np.asarray(times_s, float), start_s, end_s) - start_s
    level = _along(np.array(hammer.path_m), hammer.speed_m_s * worked_s)
    raised = 0.5 * (1.0 + np.cos(2.0 * np.pi * hammer.blows_per_second * worked_s))
    height = deck_top_m - hammer.depth_m + hammer.stroke_m * raised
    share = np.clip((np.asarray(times_s) - end_s) / _RAISING_S, 0.0, 1.0)
    clear = deck_top_m - hammer.depth_m + hammer.stroke_m + _RAISED_M
    return np.column_stack((level, height + share * (clear - height)))


def _along(path_m: np.ndarray, distances_m: np.ndarray) -> np.ndarray:
    """Points (k, 2) of a path (p, 2) at distances (k,) from its beginning; its end beyond it."""
    gone = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(path_m, axis=0), axis=1))))
    return np.column_stack([np.interp(distances_m, gone, path_m[:, axis]) for axis in range(2)])
