"""Copies between arrays and structures as loops, which Numba compiles: import this only where it is installed.

A loop over structures finds all fields of one in the same lines of the cache; numpy goes through all structures for
each field.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np

compiled = numba.njit(cache=True, nogil=True, error_model="numpy")


@compiled
def copied(values: Any, starts: Any, offsets: Any) -> Any:
    """Return values (c, n) at offsets (c,) from starts (n,)."""
    found = np.empty((len(offsets), len(starts)), values.dtype)
    for structure in range(len(starts)):
        for field in range(len(offsets)):
            found[field, structure] = values[starts[structure] + offsets[field]]
    return found


@compiled
def write(values: Any, starts: Any, offsets: Any, written: Any) -> None:
    """Write values (c, n) to offsets (c,) from starts (n,)."""
    for structure in range(len(starts)):
        for field in range(len(offsets)):
            values[starts[structure] + offsets[field]] = written[field, structure]


@compiled
def write_limits(values: Any, starts: Any, lower: Any, upper: Any, held: Any, resists: Any, limits: Any) -> None:
    """Write limits (c, n) where they are held, both alike; those of what is held and does not resist leave it free."""
    for structure in range(len(starts)):
        for field in range(len(lower)):
            if held[field, structure]:
                rests = resists[field, structure]
                values[starts[structure] + lower[field]] = limits[field, structure] if rests else 1.0
                values[starts[structure] + upper[field]] = limits[field, structure] if rests else -1.0


@compiled
def are_inertias(tensors: Any, symmetric: float) -> bool:
    """Return whether tensors (3, 3, n) are finite, `symmetric` by a part of the largest number, and not negative."""
    for body in range(tensors.shape[2]):
        largest, difference = 0.0, 0.0
        for axis in range(3):
            if not tensors[axis, axis, body] >= 0.0:
                return False
            for other in range(3):
                size = abs(tensors[axis, other, body])
                if not size < np.inf:
                    return False
                largest = max(largest, size)
                difference = max(difference, abs(tensors[axis, other, body] - tensors[other, axis, body]))
        if not difference <= symmetric * largest:
            return False
    return True
