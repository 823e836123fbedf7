"""Hooks of cranes: what the slings of each lift carry together, in every sub-step of a run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...model.lifts import Sling
from ...model.pulls import Pull


class Hooks:
    """Loads on the hooks of all lifts, by the slings among the cables of a run."""

    def __init__(self, cables: Sequence[Pull]):
        slings = [(row, cable) for row, cable in enumerate(cables) if isinstance(cable, Sling)]
        self._rows: dict[str, list[int]] = {}
        for row, sling in slings:
            self._rows.setdefault(sling.lift, []).append(row)
        self._masses_kg = {sling.lift: (sling.part_kg, sling.volume_kg or sling.part_kg) for _, sling in slings}
        self._largest = dict.fromkeys(self._rows, (0.0, 0.0))

    def measure(self, time_s: float, upwards_n: np.ndarray) -> None:
        """Take note of upright forces (c,) of all cables in a sub-step."""
        for lift, rows in self._rows.items():
            load_n = math.fsum(upwards_n[rows].tolist())
            if load_n > self._largest[lift][0]:
                self._largest[lift] = load_n, time_s

    def summary(self) -> list[dict[str, Any]]:
        """Return the largest load on each hook so far, and the weights of its part, ready for JSON."""
        return [
            {
                "name": lift,
                "largest_hook_N": load_n,
                "largest_hook_s": time_s,
                "weight_N": STANDARD_GRAVITY_M_S2 * self._masses_kg[lift][0],
                "volume_weight_N": STANDARD_GRAVITY_M_S2 * self._masses_kg[lift][1],
            }
            for lift, (load_n, time_s) in self._largest.items()
        ]
