"""What judging reads of a connection, packed so that it lies together in memory.

The core judges few connections here and there, between sub-steps in which Bullet drives out of the processor's cache
what was read before. So what counts is not how much it calculates, but how many cache lines it waits for, and how many
of Bullet's own they take the place of.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.structs import Pointer

_CACHE_LINE = 64

CARRIED = np.dtype(
    {
        "names": ["body", "sign", "point", "axes"],
        "formats": [np.int64, float, (float, 3), (float, (3, 3))],
        "offsets": [0, 8, 16, 40],
        "itemsize": 2 * _CACHE_LINE,
    }
)
"""A connection in the axes of the body that its load is known on: what the load of a cut needs is in the first line."""

RESISTING = np.dtype(
    [
        ("area", float),
        ("second", float, 3),
        ("directions", float, 4),
        ("moduli", float, 2),
        ("torsion_modulus", float),
        ("strength", float, 5),
    ]
)
"""Its section, and its strength in the order of `Strength`: what a cut needs of its faces is in the first line."""

CUT_THROUGH = np.dtype([("face", np.int64), ("sign", float), ("cosine", float)])
"""One face of a cut."""


class Carried(Pointer):
    """`const bda_carried *`."""

    dtype = CARRIED


class Resisting(Pointer):
    """`const bda_resisting *`."""

    dtype = RESISTING


class CutsThrough(Pointer):
    """`const bda_cut_through *`."""

    dtype = CUT_THROUGH


def pack(kind: np.dtype[Any], **values: FloatArray | IntArray) -> np.ndarray:
    """Return records (m,) that begin at cache lines, by values (m, ...) of their fields."""
    count = len(next(iter(values.values())))
    room = np.zeros(count * kind.itemsize + _CACHE_LINE, np.uint8)
    start = -room.ctypes.data % _CACHE_LINE
    records = room[start : start + count * kind.itemsize].view(kind)
    for name, of_all in values.items():
        records[name] = of_all
    return records
