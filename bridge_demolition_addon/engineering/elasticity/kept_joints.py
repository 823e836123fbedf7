"""Elastic connections with what is known of them from one sub-step to the next: most of it changes in none.

All arrays have their components first.
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Doubles
from .joint_rows import JointFrames
from .substep import Frames, Places, deformations


class KeptJoints:
    """m connections between n bodies with a stiffness (6, 6, m), whose deformations `offsets` (6, m) count as none.

    Attributes
    ----------
    core_frames : Frames
        Their frames, as the compiled core takes them.
    stiffness, offsets : (6, 6, m) float, (6, m) float
        As they were given.
    """

    def __init__(self, frames: JointFrames, bodies: int, stiffness: FloatArray, offsets: FloatArray):
        self.core_frames = Frames.of(frames, bodies)
        self.stiffness = Doubles.checked("stiffness", np.ascontiguousarray(stiffness), 36 * len(frames))
        self.offsets = Doubles.checked("offsets", np.ascontiguousarray(offsets), 6 * len(frames))

    def stored_j(self, numbers: IntArray, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the energy (m,) in some connections (k,), in order, and none in the others."""
        count = self.core_frames.count
        deformed = deformations(self.core_frames, Places.of(positions_m, rotations), numbers)
        stored = np.empty(count)
        call("bda_stored", count, self.stiffness, self.offsets, len(numbers), numbers, deformed, stored)
        return stored


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
    call("bda_velocities_alone", count, *arrays, substep_s, alone)
    return alone
