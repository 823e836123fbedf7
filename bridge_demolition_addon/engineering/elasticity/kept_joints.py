"""Elastic connections with what is known of them from one sub-step to the next: most of it changes in none.

All arrays have their components first.

All arrays have their components first.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, same
from ..core.library import function
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


_POINTER = ctypes.c_void_p


def velocities_alone(
    velocities: FloatArray,
    left: FloatArray,
    inverse_masses: FloatArray,
    inverse_inertias: FloatArray,
    loads: FloatArray,
    substep_s: float,
) -> FloatArray:
    """Return velocities (6, n) at the end of a sub-step without connections, from those at its beginning.

    Bullet leaves a share (6, n) of those of bodies that move freely; loads (6, n) act on bodies with inverse masses
    (n,) and inverse inertias (3, 3, n).
    """
    count = len(inverse_masses)
    alone = np.empty((6, count))
    arrays = [
        np.ascontiguousarray(array, float) for array in (velocities, left, inverse_masses, inverse_inertias, loads)
    ]
    for array, size in zip(arrays, (6, 6, 1, 9, 6), strict=True):
        if array.size != size * count:
            raise ValueError(f"there are {array.size} numbers of {count} bodies: expected {size * count}")
    call = function("bda_velocities_alone", ctypes.c_int64, *[_POINTER] * 5, ctypes.c_double, _POINTER, returns=None)
    call(count, *(array.ctypes.data for array in arrays), substep_s, alone.ctypes.data)
    return alone


def put_loads(
    loads: FloatArray,
    on_first: BoolArray,
    holding: BoolArray,
    parts: Sequence[tuple[IntArray, FloatArray, FloatArray]],
    substep_s: float,
) -> None:
    """Write the loads (6, m) of connections that hold (m,) in a sub-step, and 0 for the others.

    They are those on first bodies, or on second ones (m,). `parts` are numbers (k,) of some connections with their
    impulses (6, k) on both.
    """
    loads[:, ~holding] = 0.0
    for numbers, of_first, of_second in parts:
        loads[:, numbers] = np.where(on_first[numbers], of_first, of_second) / substep_s


def stored_energies(stiffness: FloatArray, strains: FloatArray) -> FloatArray:
    """Return the energy (k,) in connections of stiffness (6, 6, k) with strains (6, k)."""
    count = strains.shape[1]
    energies = np.empty(count)
    stiffness, strains = (np.ascontiguousarray(array, float) for array in (stiffness, strains))
    if stiffness.size != 36 * count or strains.size != 6 * count:
        raise ValueError(f"stiffness has shape {stiffness.shape}, strains {strains.shape}")
    call = function("bda_stored", ctypes.c_int64, *[_POINTER] * 3, returns=None)
    call(count, stiffness.ctypes.data, strains.ctypes.data, energies.ctypes.data)
    return energies
