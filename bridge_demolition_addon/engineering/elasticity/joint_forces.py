"""What elastic connections do in a sub-step, before and after the compiled core solves it.

All arrays have their components first.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.library import function

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
