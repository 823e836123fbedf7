"""Connections whose bars or sections of steel have ruptured, whose bodies meet each other again once they are apart.

A crack or a plastic hinge that opens turns its two bodies into each other, as they are rigid and what is between them
is not. Bullet would push them apart as soon as they may collide, and throw light ones by tens of metres.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.body_motion import BodyMotion, BodyMotionReader
from ...engineering.elasticity.joint_rows import components_last
from ...engineering.geometry.hulls import ConvexBody, convex_body, depth_m
from ...engineering.mechanics.reinforcement import FaceBars
from ...model.results.frames import Inventory

_USUAL_DEPTH_M = 0.02
"""Depth up to which bodies meet at once. Contacts lie as deep in each other, as each body goes by up to 1 cm in a
sub-step of a bridge with bars."""


class RupturedBars:
    """Those of connections (m,) of pairs (m, 2) of bodies that have bars (m,), which have ruptured after they yielded.

    Vertices (v, 3) of bodies are in their own axes. `reader` reads where these are.
    """

    def __init__(
        self, have_bars: np.ndarray, pairs: np.ndarray, vertices_m: Sequence[np.ndarray], reader: BodyMotionReader
    ):
        self._have_bars, self._pairs, self._vertices_m, self._reader = have_bars, pairs, vertices_m, reader
        self._yielded = np.zeros(len(pairs), bool)
        self._lie_in_each_other = np.zeros(len(pairs), bool)
        self._hulls: dict[int, ConvexBody] = {}

    @property
    def waits(self) -> bool:
        """Whether bodies lie in each other that may be apart after any sub-step."""
        return bool(self._lie_in_each_other.any())

    def lie_in_each_other(self, cracked: np.ndarray, holding: np.ndarray) -> np.ndarray:
        """Return the connections (m,) whose bodies lay deep in each other as they ruptured, and were not apart since.

        Of all connections (m,), `cracked` says which hold on past their strength, and `holding` which hold at all.
        """
        ruptured = self._yielded & ~holding
        self._yielded = (self._yielded | cracked & self._have_bars) & holding
        rows = np.flatnonzero(ruptured | self._lie_in_each_other)
        if len(rows):
            depths_m = self._depths_m(rows, self._reader.read())
            self._lie_in_each_other[rows] = depths_m > np.where(ruptured[rows], _USUAL_DEPTH_M, 0.0)
        return self._lie_in_each_other

    def _depths_m(self, rows: np.ndarray, motion: BodyMotion) -> np.ndarray:
        """Return how deep the bodies of connections (r,) lie in each other (r,)."""
        turns, places_m = components_last(motion.rotation_components), motion.position_components_m.T
        return np.array(
            [
                depth_m(*(self._hull(body).placed(turns[body], places_m[body]) for body in pair))
                for pair in self._pairs[rows].tolist()
            ]
        )

    def _hull(self, body: int) -> ConvexBody:
        """Return the hull of a body in its own axes, made when it is asked for."""
        if body not in self._hulls:
            self._hulls[body] = convex_body(self._vertices_m[body])
        return self._hulls[body]


def bars_that_rupture(bars: FaceBars | None, inventory: Inventory, reader: BodyMotionReader) -> RupturedBars | None:
    """Return the connections of shards that have bars, none of which has ruptured yet; None without any.

    Shards meet the ground at once: it is not convex.
    """
    if bars is None:
        return None
    of_shards = (inventory.body_kinds == "shard")[inventory.pairs].all(axis=1)
    have_bars = of_shards & (bars.yield_n > 0.0)
    return RupturedBars(have_bars, inventory.pairs, inventory.vertices_by_body(), reader) if have_bars.any() else None
