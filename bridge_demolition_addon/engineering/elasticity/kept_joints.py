"""Elastic connections with what is known of them from one sub-step to the next: most of it changes in none.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray, same
from .joint_rows import JointFrames
from .substep import Frames, Places, deformations

_CHOICES = 2
"""Sets of connections of which a copy is kept: those that act, and those that are intact, also where bodies sleep."""


@dataclass(frozen=True, slots=True, eq=False)
class ChosenJoints:
    """Some connections (k,), in order, with what never changes of them; all of them without a copy."""

    numbers: IntArray
    stiffness: FloatArray  # (6, 6, k)
    offsets: FloatArray  # (6, k), deformations without load


@dataclass(frozen=True, slots=True, eq=False)
class _Deformed:
    """Deformations (6, r) of connections (r,), in order, and where their bodies were then."""

    positions_m: FloatArray
    rotations: FloatArray
    numbers: IntArray
    deformations: FloatArray

    def has(self, numbers: IntArray, positions_m: FloatArray, rotations: FloatArray) -> bool:
        """Whether these connections were among them, with bodies at these positions."""
        return (
            same(positions_m, self.positions_m)
            and same(rotations, self.rotations)
            and (same(numbers, self.numbers) or bool(np.isin(numbers, self.numbers).all()))
        )


class KeptJoints:
    """m connections between n bodies with a stiffness (6, 6, m), whose deformations `offsets` (6, m) count as none.

    Attributes
    ----------
    core_frames : Frames
        Their frames, as the compiled core takes them.
    """

    def __init__(self, frames: JointFrames, bodies: int, stiffness: FloatArray, offsets: FloatArray):
        self.core_frames = Frames.of(frames, bodies)
        self._count, self._stiffness, self._offsets = len(frames), stiffness, offsets
        self._chosen: list[ChosenJoints] = []  # those that were asked for last
        self._deformed: _Deformed | None = None

    def choose(self, numbers: IntArray) -> ChosenJoints:
        """Return some connections (k,), in order; copied only where others were asked for before."""
        for chosen in self._chosen:
            if same(numbers, chosen.numbers):
                return chosen
        stiffness = self._stiffness if len(numbers) == self._count else self._stiffness.take(numbers, axis=-1)
        chosen = ChosenJoints(numbers, stiffness, self._offsets.take(numbers, axis=-1))
        self._chosen = [chosen, *self._chosen[: _CHOICES - 1]]
        return chosen

    def deformations(self, chosen: ChosenJoints, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return deformations (6, k) with bodies at positions (3, n) in rotations (3, 3, n).

        They are worked out again only where bodies have moved.
        """
        kept, numbers = self._deformed, chosen.numbers
        if kept is None or not kept.has(numbers, positions_m, rotations):
            found = deformations(self.core_frames, Places.of(positions_m, rotations), numbers)
            self._deformed = kept = _Deformed(positions_m, rotations, numbers, found)
        if same(numbers, kept.numbers):
            return kept.deformations
        return kept.deformations[:, np.searchsorted(kept.numbers, numbers)]
