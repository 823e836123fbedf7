"""Bars across the cracks of a run: what each crack's did in a frame, and the most of it so far."""

from __future__ import annotations

import numpy as np

from ...engineering.elasticity.crack_state import FrameCracks
from ...model.results.extremes import BarExtremes, BarsOfRun, members_of
from ...model.results.frames import Frame, Inventory

_AT_WORK = 0.01
"""Part of their yield force from which on bars of a crack are logged: a deck has hundreds that hardly open."""


class RecordedBars:
    """Bars of a run with elastic connections, of which some (m,) have bars."""

    def __init__(self, inventory: Inventory, have_bars: np.ndarray):
        self._inventory = inventory
        self._extremes = BarExtremes(inventory, have_bars)

    def note(self, frame: Frame, cracks: FrameCracks) -> tuple[list[tuple[str, ...]], FrameCracks]:
        """Return the cracks with bars at work in a frame: the names of each and of its members, and what they did."""
        self._extremes.note(frame.time_s, cracks)
        at_work = cracks.only((cracks.yield_shares >= _AT_WORK) | (cracks.ruptured_shares > 0.0))
        names = self._inventory.connection_names[at_work.rows]
        members = members_of(self._inventory, at_work.rows)
        return [(str(name), *pair) for name, pair in zip(names, members, strict=True)], at_work

    def so_far(self) -> BarsOfRun:
        """Return what bars did so far."""
        return self._extremes.so_far()
