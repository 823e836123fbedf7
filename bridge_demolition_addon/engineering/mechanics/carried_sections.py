"""Sections of connections that turn with bodies, and the loads in them.

What judging reads of a connection is packed so that it lies together in memory. The core judges few connections here
and there, between sub-steps in which Bullet drives out of the processor's cache what was read before. So what counts is
not how much it calculates, but how many cache lines it waits for, and how many of Bullet's own they take the place of.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Pointer, Struct
from ..geometry.vectors import carried_axes, length
from .section_cuts import ConnectionLoads

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


class CarriedLoads(Struct):
    """Loads of connections, about the centres of bodies, after sub-steps: `bda_carried_loads`."""

    _fields_ = (
        *((name, Count) for name in ("substeps", "connections", "bodies")),
        *((name, Doubles) for name in ("loads", "positions", "rotations")),
        ("carried", Carried),
    )


@dataclass(frozen=True, eq=False)
class CarriedSections:
    """Sections of m connections, each fixed in the body that its load is known on, and in the axes of that body."""

    bodies: IntArray  # (m,)
    signs: FloatArray  # (m,), 1 where that is the first body of the connection, -1 where it is the second
    points_m: FloatArray  # (m, 3), of the connections, from the centres of the bodies
    axes: FloatArray  # (m, 3, 3), of the sections, as columns

    @cached_property
    def lever_arms_m(self) -> FloatArray:
        """Distances (m,) of the connections from the centres of the bodies."""
        return length(self.points_m)

    @cached_property
    def _records(self) -> np.ndarray:
        """All of it, as the core takes it."""
        return pack(CARRIED, body=self.bodies, sign=self.signs, point=self.points_m, axes=self.axes)

    @cached_property
    def _ends(self) -> tuple[int, int]:
        """First and last body."""
        return int(self.bodies.min(initial=0)), int(self.bodies.max(initial=0))

    def carrying(self, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> CarriedLoads:
        """Return the loads of all connections after each of s sub-steps, as the core takes them.

        Loads (6, s, m) are forces, and moments about the centres of the bodies, at positions (3, s, n) in rotations
        (3, 3, s, n); s may be left out where it is 1.
        """
        (*_, bodies), count = positions_m.shape, len(self.bodies)
        substeps = positions_m.size // max(3 * bodies, 1)
        first, last = self._ends
        if count and not 0 <= first <= last < bodies:
            raise ValueError(f"connections are known on bodies {first} to {last} of {bodies}")
        # One of its own each time: loads of a frame are worked out in a second thread while connections are judged.
        return CarriedLoads(substeps=substeps, connections=count, bodies=bodies).take(
            carried=(self._records, count),
            loads=(loads, 6 * substeps * count),
            positions=(positions_m, 3 * substeps * bodies),
            rotations=(rotations, 9 * substeps * bodies),
        )

    def loads(self, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> ConnectionLoads:
        """Return the loads of all connections after each of s sub-steps, as arrays (s, m, 3).

        All is given as `carrying` takes it. Each component lies together in memory.
        """
        found = np.empty((3, 3, loads.shape[1], len(self.bodies)))
        call("bda_carry", self.carrying(loads, positions_m, rotations), *found)
        return ConnectionLoads(*(components.transpose(1, 2, 0) for components in found))

    def loads_at_once(self, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> ConnectionLoads:
        """Return the loads (6, m) of all connections at one time, as arrays (m, 3)."""
        found = self.loads(loads[:, None], positions_m, rotations)
        return ConnectionLoads(found.forces_n[0], found.moments_nm[0], found.points_m[0])

    def carried_axes(self, rows: IntArray, rotations: FloatArray) -> FloatArray:
        """Return the axes (r, 3, 3) of connections (r,), as columns, under rotations (3, 3, n) of the bodies."""
        return carried_axes(self.axes[rows], self.bodies[rows], rotations.transpose(2, 0, 1))
