"""A bridge after some changes: which connections are left, what was taken away, and which bars stand bare."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from ...engineering.drilled_charges.cages import BareBars
from ...engineering.elasticity.tendons import CutTendon
from ..changes.bare_bars import StandingBars
from ..changes.change import Event
from ..structure.model import Model


@dataclass(frozen=True, slots=True)
class BaredZone:
    """A blast zone whose bars stand bare, and what they resist."""

    bars: StandingBars
    groups: np.ndarray  # (k,), which of the groups of bars stand


@dataclass(frozen=True, slots=True)
class PressedBars:
    """What the bars of a blast zone carry at rest, above 0 in tension, and what they resist that way."""

    zone: str
    force_n: float
    resisted_n: float

    @property
    def used(self) -> float:
        """Utilisation at rest. Where their load comes upon them at once, it is up to twice as much."""
        return abs(self.force_n) / self.resisted_n if self.resisted_n else np.inf


@dataclass(frozen=True, slots=True, eq=False)
class ChangedBridge:
    """A bridge of m connections between n shards after changes."""

    intact: np.ndarray  # (m,)
    left: np.ndarray  # (m,), part of its strength that each has; 1 for those that are gone
    removed: np.ndarray  # (n,), shards that were taken away or thrown out
    zones: tuple[BaredZone, ...] = ()
    cuts: tuple[CutTendon, ...] = ()  # of tendons

    @classmethod
    def as_built(cls, model: Model) -> Self:
        """Return a bridge before any change."""
        count = len(model.connections)
        return cls(np.ones(count, bool), np.ones(count), np.zeros(len(model.shards), bool))

    def after(self, events: Sequence[Event]) -> ChangedBridge:
        """Return it after events, in their order."""
        bridge = self
        for event in events:
            bridge = bridge._after_one(event)
        return bridge

    @property
    def bare(self) -> BareBars | None:
        """Return all bars that stand bare, at points of the bridge as it was built; None without any."""
        if not any(len(zone.groups) for zone in self.zones):
            return None
        bodies = np.concatenate([zone.bars.bodies[zone.groups] for zone in self.zones])
        points_m = np.concatenate([zone.bars.points_m[zone.groups] for zone in self.zones])
        each = [
            np.concatenate([np.full(len(zone.groups), getattr(zone.bars, name)) for zone in self.zones])
            for name in ("count", "diameter_m", "yield_pa")
        ]
        return BareBars(bodies[:, 0], bodies[:, 1], points_m[:, 0].T, points_m[:, 1].T, *each)

    def pressed_bars(self, forces_n: np.ndarray) -> tuple[PressedBars, ...]:
        """Return what the bars of each zone carry, by the forces (g,) of `bare`."""
        found, begun = [], 0
        for zone in self.zones:
            force_n = float(forces_n[begun : begun + len(zone.groups)].sum())
            begun += len(zone.groups)
            if force_n:  # bars that have folded or ruptured are gone
                resisted_n = zone.bars.tension_n if force_n > 0.0 else zone.bars.compression_n
                found.append(PressedBars(zone.bars.zone, force_n, resisted_n))
        return tuple(found)

    def _after_one(self, event: Event) -> ChangedBridge:
        intact, left, removed = self.intact.copy(), self.left.copy(), self.removed.copy()
        zones = self.zones
        if bars := event.bars:
            holds = intact[bars.connections].all(axis=1) & ~self._is_gone(bars.bodies)
            zones = (*zones, BaredZone(bars, np.flatnonzero(holds)))
        removed[event.bodies] = True
        intact[event.connections] &= event.factor > 0.0
        if event.factor > 0.0:
            left[event.connections] *= event.factor
        changed, cuts = ChangedBridge(intact, left, removed), (*self.cuts, *event.tendons)
        kept = (_without(zone, changed._is_gone(zone.bars.bodies)) for zone in zones)
        return ChangedBridge(intact, left, removed, tuple(kept), cuts)

    def _is_gone(self, bodies: np.ndarray) -> np.ndarray:
        """Return whether one of the two bodies (k, 2) was taken away; the ground is none of the shards."""
        gone: np.ndarray = np.append(self.removed, False)[bodies].any(axis=1)
        return gone


def _without(zone: BaredZone, is_gone: np.ndarray) -> BaredZone:
    groups = zone.groups[~is_gone[zone.groups]]
    return BaredZone(zone.bars, groups)
