"""Where machines beside a bridge stand and reach without cutting it: what room bodies of a run take; for looks only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.terrain.recorded import RecordedGround
from ..model.results.arrays import Results
from .dressing import DrawnPart
from .moved_surfaces import boxes_of_bodies

_CLEAR_M = 0.3
"""Least distance of a machine from what it must not cut."""

_ROWS = 12
"""Frames that are looked at for where bodies come."""

_BESIDE = ("ground", "ball", "tool", "crane")
"""Kinds of bodies that are no part of the bridge."""


@dataclass(frozen=True, slots=True, eq=False)
class StandingRoom:
    """What a machine must not cut: boxes by their lowest and highest corners, m.

    Attributes
    ----------
    built_m : (n, 2, 3) float
        Boxes around the bodies of the bridge as they are built, and around what is drawn beside it.
    reached_m : (k, 2, 3) float
        The same, and boxes around these bodies wherever they come in the run.
    ground : RecordedGround
        What machines stand on.
    """

    built_m: FloatArray
    reached_m: FloatArray
    ground: RecordedGround

    @classmethod
    def of_run(cls, results: Results, drawn: Sequence[DrawnPart] = ()) -> Self:
        """Return the room of a run, beside what is drawn with it."""
        of_bridge = np.flatnonzero(~np.isin(results.inventory.body_kinds, _BESIDE))
        rows = np.unique(np.linspace(0, len(results.frames) - 1, _ROWS).astype(int))
        by_row = [boxes_of_bodies(results, row)[of_bridge] for row in rows.tolist()]
        beside = boxes_around(drawn)
        return cls(np.concatenate((by_row[0], beside)), np.concatenate((*by_row, beside)), results.ground())

    def cuts(self, boxes_m: FloatArray, arms_m: FloatArray, thickness_m: float) -> int:
        """Return how often a machine cuts: its boxes (b, 2, 3) anything ever, its arms (a, j, 3) what is built."""
        reached = _grown(self.reached_m, _CLEAR_M)
        apart = (boxes_m[:, None, 0] > reached[None, :, 1]) | (boxes_m[:, None, 1] < reached[None, :, 0])
        built = _grown(self.built_m, thickness_m / 2.0 + _CLEAR_M)
        crossed = _crossed(arms_m[:, :-1].reshape(-1, 3), arms_m[:, 1:].reshape(-1, 3), built)
        return int((~apart.any(axis=2)).sum()) + int(crossed.sum())


def boxes_around(parts: Sequence[DrawnPart]) -> FloatArray:
    """Return the lowest and highest corners (n, 2, 3), m, of the boxes around solids."""
    corners = [(part.solid.vertices.min(axis=0), part.solid.vertices.max(axis=0)) for part in parts]
    return np.array(corners, float).reshape(-1, 2, 3)


def _grown(boxes: FloatArray, by_m: float) -> FloatArray:
    return boxes + np.array((-by_m, by_m))[:, None]


def _crossed(starts: FloatArray, ends: FloatArray, boxes: FloatArray) -> np.ndarray:
    """Return which boxes (n, 2, 3) lines between points (s, 3) go through, (s, n)."""
    along = ends - starts
    along = np.where(abs(along) < 1e-9, 1e-9, along)[:, None]
    begin, end = ((boxes[None, :, side] - starts[:, None]) / along for side in (0, 1))
    enters = np.minimum(begin, end).max(axis=2)
    leaves = np.maximum(begin, end).min(axis=2)
    return np.asarray((enters <= leaves) & (leaves >= 0.0) & (enters <= 1.0))
