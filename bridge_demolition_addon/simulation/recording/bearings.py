"""Bearings of a run: what each carries in a frame, and the largest of it so far."""

from __future__ import annotations

import numpy as np

from ...engineering.mechanics.bearing_loads import BearingLoads
from ...model.results.extremes import BearingExtreme, BearingExtremes
from ...model.results.frames import Frame
from ...model.run_folder.logs import FrameBearings
from ...scene.connections.elasticity import NamedBearings


class RecordedBearings:
    """Bearings of a run with connections that break; what happens in its warm-up is no extreme."""

    def __init__(self, named: NamedBearings, pairs: np.ndarray, warm_up_s: float):
        self.names = named.names
        self._rows, self._bearings = named.rows, named.bearings
        self._bodies = pairs[named.rows]
        self._extremes = BearingExtremes(named.names, warm_up_s)

    def note(self, frame: Frame, loads: BearingLoads) -> FrameBearings:
        """Return what bearings carry in a frame; nan of those that were not solved, as their bodies have slept so far.

        They carry what is on them all the same: 0 would say that they had lifted off.
        """
        left = self._share(frame.intact[self._rows])
        sleep = self._share(frame.asleep[self._bodies].any(axis=1)) == 1.0
        loads = loads.unknown_at(sleep & loads.carry_nothing & (left > 0.0))
        self._extremes.note(frame.time_s, loads, left)
        return FrameBearings(loads, left)

    def _share(self, of_connections: np.ndarray) -> np.ndarray:
        """Return the part (b,) of the connections of each bearing of which something is true (c,)."""
        return np.bincount(self._bearings, of_connections) / np.bincount(self._bearings)

    @property
    def extremes(self) -> list[BearingExtreme]:
        """Extremes of each bearing that was read."""
        return self._extremes.known()
