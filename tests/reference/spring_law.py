# SPDX-License-Identifier: GPL-3.0-or-later
"""The law of springs between two bodies by numpy: what the compiled core has for footings and pads of bearings."""

from __future__ import annotations

import numpy as np

from bridge_demolition_addon.engineering.elasticity.springs import PressedSprings


class ReferenceSprings(PressedSprings):
    """Resistance of q springs: they press upwards, and hold sideways by their stiffness up to friction."""

    def resisted(self, gaps_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return forces (3, q) on what lies above gaps (3, q), and by how much these fall with them, (3, 3, q)."""
        wanted = -self.vertical_n_m * gaps_m[2]
        acts = self.pulls | (wanted > 0.0)
        upwards = np.where(acts, np.minimum(wanted, self.capacity_n), 0.0)
        held = -self.sideways_n_m * gaps_m[:2]
        size = np.sqrt(held[0] * held[0] + held[1] * held[1])
        limit = self._limits()
        slides = size > limit
        share = np.divide(limit, size, out=np.ones_like(size), where=slides)
        forces = np.stack((share * held[0], share * held[1], upwards))
        tangents = self.whole
        tangents[2, 2] *= acts & (wanted < self.capacity_n)
        tangents[:2, :2] *= share
        across = np.divide(share, size * size, out=np.zeros_like(size), where=slides)
        tangents[:2, :2] -= across * held[:, None] * held * self.sideways_n_m
        return forces, tangents

    def stored_j(self, gaps_m: np.ndarray) -> np.ndarray:
        """Return the energy (q,) that springs across gaps (3, q) would give back."""
        forces, stiffness = self.resisted(gaps_m)[0], np.stack((*self.sideways_n_m, self.vertical_n_m))
        doubled = np.divide(forces * forces, stiffness, out=np.zeros_like(forces), where=stiffness > 0.0)
        return 0.5 * doubled.sum(axis=0)

    def _limits(self) -> np.ndarray:
        """Largest forces sideways (q,)."""
        holds = np.isinf(self.friction)
        by_friction = np.where(holds, 0.0, self.friction) * self.pressed_n
        return np.where(holds & (self.pulls | (self.pressed_n > 0.0)), np.inf, by_friction)
