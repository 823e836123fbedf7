"""Bearings of a run: what each carries in a frame, and the largest of it so far."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...engineering.mechanics.bearing_loads import BearingLoads
from ...model.results.bearing_extremes import BearingExtremes
from ...model.run_folder.logs import FrameBearings
from ...scene.connections.bearings import NamedBearings


class RecordedBearings:
    """Bearings of a run with connections that break; what happens in its warm-up is no extreme."""

    def __init__(self, named: NamedBearings, warm_up_s: float):
        self.names = named.names
        self._rows, self._bearings = named.rows, named.bearings
        self._extremes = BearingExtremes(named.names, warm_up_s)

    def note(self, time_s: float, loads: BearingLoads, intact: np.ndarray) -> FrameBearings:
        """Return what bearings carry in a frame that ends then, with connections (m,) that are intact or not."""
        left = np.bincount(self._bearings, intact[self._rows]) / np.bincount(self._bearings)
        self._extremes.note(time_s, loads, left)
        return FrameBearings(loads, left)

    def summary(self) -> list[dict[str, Any]]:
        """Return the extremes of each bearing, ready for JSON."""
        return self._extremes.summary()
