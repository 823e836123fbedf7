"""The law of springs between two bodies: what footings on soil and pads of bearings resist.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, slots=True, eq=False)
class PressedSprings:
    """Resistance of q springs: they press upwards, and hold sideways by their stiffness up to friction."""

    vertical_n_m: FloatArray  # (q,), stiffness
    sideways_n_m: FloatArray  # (2, q), stiffness along x and y
    capacity_n: FloatArray  # (q,), largest pressing force; may be infinite
    friction: FloatArray  # (q,), largest force sideways by the pressing force; infinite where they do not slide
    pulls: BoolArray  # (q,), whether they hold what is lifted
    pressed_n: FloatArray  # (q,), pressing force by which they hold sideways

    def only(self, which: IntArray) -> PressedSprings:
        """Return some of the springs."""
        return PressedSprings(*(getattr(self, item.name)[..., which] for item in fields(self)))

    @property
    def whole(self) -> FloatArray:
        """Stiffness (3, 3, q) of springs that neither lift off, nor slide, nor yield."""
        tangents = np.zeros((3, 3, len(self.vertical_n_m)))
        tangents[0, 0], tangents[1, 1], tangents[2, 2] = *self.sideways_n_m, self.vertical_n_m
        return tangents

    def resisted(self, gaps_m: FloatArray) -> tuple[FloatArray, FloatArray]:
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

    def stored_j(self, gaps_m: FloatArray) -> FloatArray:
        """Return the energy (q,) that springs across gaps (3, q) would give back."""
        forces, stiffness = self.resisted(gaps_m)[0], np.stack((*self.sideways_n_m, self.vertical_n_m))
        doubled = np.divide(forces * forces, stiffness, out=np.zeros_like(forces), where=stiffness > 0.0)
        stored: FloatArray = 0.5 * doubled.sum(axis=0)
        return stored

    def _limits(self) -> FloatArray:
        """Largest forces sideways (q,)."""
        holds = np.isinf(self.friction)
        by_friction = np.where(holds, 0.0, self.friction) * self.pressed_n
        return np.where(holds & (self.pulls | (self.pressed_n > 0.0)), np.inf, by_friction)
