# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of cracks that bars hold together, by numpy. All arrays have their components first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bridge_demolition_addon.engineering.arrays import FloatArray
from bridge_demolition_addon.engineering.elasticity.crack_state import DOWEL_SHARE, SHEARED, stretches_of_bars
from bridge_demolition_addon.engineering.elasticity.joint_rows import dot_products
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars, bar_response


@dataclass(frozen=True, slots=True, eq=False)
class CrackLaw:
    """Resistance of b bars, and of the sides of their cracks, in the axes of the world."""

    bars: Bars
    slips_m: FloatArray  # (3, b), deformation that stays
    flows_m: FloatArray  # (b,), length of the path of the slip
    normals: FloatArray  # (3, b), of the cracks
    directions: FloatArray  # (3, b), of the bars
    pressed_n_m: FloatArray  # (b,), stiffness where the sides press on each other
    rests_m: FloatArray  # (3, b), sliding at which they do not resist it
    grips_n: FloatArray  # (b,), by which they resist at most, of how they were pressed before

    def forces(self, gaps_m: FloatArray) -> FloatArray:
        """Return the forces (3, b) across gaps (3, b)."""
        across_m = dot_products(self.normals, gaps_m)
        slid_m = gaps_m - across_m * self.normals
        bars = bar_response(self.bars, stretches_of_bars(gaps_m, self.directions), self.slips_m, self.flows_m).forces_n
        rubs = bar_response(self.rubbing, slid_m, self.rests_m, np.zeros_like(across_m)).forces_n
        return self._together(bars, rubs, across_m)

    def linear(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the forces (3, b) across gaps (3, b), and how they change with these, (3, 3, b)."""
        normals, directions, across_m = self.normals, self.directions, dot_products(self.normals, gaps_m)
        slid_m = gaps_m - across_m * normals
        bars = bar_response(self.bars, stretches_of_bars(gaps_m, directions), self.slips_m, self.flows_m)
        rubs = bar_response(self.rubbing, slid_m, self.rests_m, np.zeros_like(across_m))
        pulls = stretches_of_bars(bars.directions, directions)
        pressed = np.where(across_m < 0.0, self.pressed_n_m, 0.0)
        even = DOWEL_SHARE * DOWEL_SHARE
        tangents: FloatArray = (pressed - rubs.across_n_m) * (normals[:, None] * normals)
        tangents += (1.0 - even) * bars.across_n_m * (directions[:, None] * directions)
        tangents += (bars.along_n_m - bars.across_n_m) * (pulls[:, None] * pulls)
        tangents += (rubs.along_n_m - rubs.across_n_m) * (rubs.directions[:, None] * rubs.directions)
        tangents[[0, 1, 2], [0, 1, 2]] += even * bars.across_n_m + rubs.across_n_m
        return self._together(bars.forces_n, rubs.forces_n, across_m), tangents

    def _together(self, bars_n: FloatArray, rubs_n: FloatArray, across_m: FloatArray) -> FloatArray:
        """Forces (3, b) of bars, of sides that rub, and of sides that press where they are closed (b,)."""
        pressing = self.pressed_n_m * np.minimum(across_m, 0.0)
        return stretches_of_bars(bars_n, self.directions) + rubs_n + pressing * self.normals

    @property
    def rubbing(self) -> Bars:
        """Friction of the sides, as of bars that yield at it."""
        return rubbing_bars(self.grips_n, self.pressed_n_m)


def rubbing_bars(grips_n: FloatArray, pressed_n_m: FloatArray) -> Bars:
    """Friction of b pressed places, as of bars that yield at it and do not harden."""
    return Bars(grips_n, SHEARED * pressed_n_m, np.zeros_like(grips_n))
