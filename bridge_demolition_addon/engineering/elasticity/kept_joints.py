"""Elastic connections with what is known of them from one sub-step to the next: most of it changes in none.

All arrays have their components first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray, same
from .joint_forces import ActingJoints, deformations
from .joint_rows import JointFrames, JointRows

_CHOICES = 2
"""Sets of connections of which a copy is kept: those that act, and those that are intact, also where bodies sleep."""


@dataclass(frozen=True, slots=True, eq=False)
class ChosenJoints:
    """Some connections (k,), in order, with what never changes of them; all of them without a copy."""

    numbers: IntArray
    frames: JointFrames
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
    """m connections with a stiffness (6, 6, m), whose deformations `offsets` (6, m) count as none."""

    def __init__(self, frames: JointFrames, stiffness: FloatArray, offsets: FloatArray):
        self._frames, self._stiffness, self._offsets = frames, stiffness, offsets
        self._rows = JointRows.empty(len(frames))
        self._chosen: list[ChosenJoints] = []  # those that were asked for last
        self._deformed: _Deformed | None = None
        self._acting: tuple[ChosenJoints, float, FloatArray, ActingJoints] | None = None

    def choose(self, numbers: IntArray) -> ChosenJoints:
        """Return some connections (k,), in order; copied only where others were asked for before."""
        for chosen in self._chosen:
            if same(numbers, chosen.numbers):
                return chosen
        stiffness, offsets = self.stiffness_of(numbers), self._offsets.take(numbers, axis=-1)
        chosen = ChosenJoints(numbers, self._frames.only(numbers), stiffness, offsets)
        self._chosen = [chosen, *self._chosen[: _CHOICES - 1]]
        return chosen

    def stiffness_of(self, numbers: IntArray) -> FloatArray:
        """Return the stiffness (6, 6, k) of some connections (k,), in order."""
        return self._stiffness if len(numbers) == len(self._frames) else self._stiffness.take(numbers, axis=-1)

    def set_rows(self, numbers: IntArray, rows: JointRows) -> None:
        """Take over the rows of some connections (k,)."""
        if len(numbers) == len(self._frames):
            self._rows = rows
        else:
            self._rows.set(numbers, rows)
        self._acting = None

    def acting(self, chosen: ChosenJoints, substep_s: float, damping_s: FloatArray) -> ActingJoints:
        """Return connections with their rows as they are now, in sub-steps of a length, with damping (m,)."""
        kept = self._acting
        if kept is None or kept[0] is not chosen or kept[1] != substep_s or kept[2] is not damping_s:
            implicit = substep_s * (substep_s + damping_s[chosen.numbers])
            rows = self._rows.only(chosen.numbers)
            kept = chosen, substep_s, damping_s, ActingJoints(chosen.frames, rows, chosen.stiffness, implicit)
            self._acting = kept
        return kept[3]

    def deformations(self, chosen: ChosenJoints, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return deformations (6, k) with bodies at positions (3, n) in rotations (3, 3, n).

        They are worked out again only where bodies have moved.
        """
        kept, numbers = self._deformed, chosen.numbers
        if kept is None or not kept.has(numbers, positions_m, rotations):
            found = deformations(chosen.frames, positions_m, rotations)
            self._deformed = kept = _Deformed(positions_m, rotations, numbers, found)
        if same(numbers, kept.numbers):
            return kept.deformations
        return kept.deformations[:, np.searchsorted(kept.numbers, numbers)]
