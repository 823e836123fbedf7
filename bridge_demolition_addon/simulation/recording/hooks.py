"""Hooks of cranes: what the slings of each lift carry together, in every sub-step of a run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...model.pulls import Pull


class Hooks:
    """Loads on the hooks of all lifts, by the slings among the cables of a run."""

    def __init__(self, cables: Sequence[Pull]):
        self._rows: dict[str, list[int]] = {}
        self._masses_kg: dict[str, tuple[float, float]] = {}
        for row, cable in enumerate(cables):
            if hook := cable.hangs_on:
                lift, *masses_kg = hook
                self._rows.setdefault(lift, []).append(row)
                self._masses_kg[lift] = masses_kg[0], masses_kg[1]
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
