"""Bars of blast zones that stand bare between shards of a world, since their zone fired."""

from __future__ import annotations

import numpy as np

from ...bullet.body_motion import BodyMotion, BodyMotionReader
from ...engineering.drilled_charges.cages import BareBars, Cages
from ...engineering.elasticity.joint_rows import turned, turned_back
from ...model.changes.bare_bars import StandingBars


class StandingBarsOfZones:
    """All bars that stand bare, of bodies with masses (n,), beside m connections, in a bridge as it was built."""

    def __init__(self, reader: BodyMotionReader, built: BodyMotion, masses_kg: np.ndarray, connections: int):
        self.law = Cages(connections)
        self._reader, self._built, self._masses_kg = reader, built, masses_kg
        self._added = False

    def bare(self, bars: StandingBars, holding: np.ndarray) -> np.ndarray:
        """Let bars stand bare, before connections of their zone are cut; return the numbers (g,) of their groups.

        Bars that no connection (m,) that is holding connects to a shard are gone.
        """
        holds = holding[bars.connections].all(axis=1) & (self._masses_kg[bars.bodies] > 0.0).any(axis=1)
        bodies, motion, built = bars.bodies[holds], self._reader.read(), self._built
        points = []
        for end, places in zip(bodies.T, np.moveaxis(bars.points_m[holds], 1, 0), strict=True):
            from_centre = places.T - built.position_components_m[:, end]
            anchors = turned_back(built.rotation_components[..., end], from_centre)
            points.append(motion.position_components_m[:, end] + turned(motion.rotation_components[..., end], anchors))
        alike = [np.full(len(bodies), value) for value in (bars.count, bars.diameter_m, bars.yield_pa)]
        groups = BareBars(bodies[:, 0], bodies[:, 1], points[0], points[1], *alike)
        self._added = True
        return self.law.add(groups, motion.position_components_m, motion.rotation_components)

    def take_added(self) -> bool:
        """Return whether bars were added since the last call."""
        added, self._added = self._added, False
        return added
