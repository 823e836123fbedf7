"""Sections of connections that turn with bodies and across members, and the loads in them.

What judging reads of a connection is packed so that it lies together in memory. The core judges few connections here
and there, between sub-steps in which Bullet drives out of the processor's cache what was read before. So what counts is
not how much it calculates, but how many cache lines it waits for, and how many of Bullet's own they take the place of.

Elastic connections share a load by their stiffness, so a face next to a notch, an edge or a fixed end carries more than
the mean, and the more so the smaller the shards are. A member does not crack there before a whole section of it is
overloaded. So a face is judged with all that a plane through it parts near it, as one section that stays plane. Such a
section is as large with few shards as with many, and so is the load at which it breaks.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Pointer, Struct
from ..geometry.vectors import dot, length
from .section_cuts import ConnectedFaces, ConnectionLoads

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
        """Return the connections' loads after each of s sub-steps, as the core takes them.

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
        """Return the connections' loads after each of s sub-steps, as arrays (s, m, 3).

        All is given as `carrying` takes it. Each component lies together in memory.
        """
        found = np.empty((3, 3, loads.shape[1], len(self.bodies)))
        call("bda_carry", self.carrying(loads, positions_m, rotations), *found)
        return ConnectionLoads(*(components.transpose(1, 2, 0) for components in found))

    def loads_at_once(self, loads: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> ConnectionLoads:
        """Return the connections' loads (6, m) at one time, as arrays (m, 3)."""
        found = self.loads(loads[:, None], positions_m, rotations)
        return ConnectionLoads(found.forces_n[0], found.moments_nm[0], found.points_m[0])


SPREAD = 7.0
"""Extent of a section from its middle, by the thickness of the member.

A ball of 1 m that punches through a plate of 0.25 m is resisted along 4 × 1 m + 4 π × 0.25 m, the control perimeter of
EN 1992-1-1:2004, 6.4.2. Two sections, one on either side, have that length if they extend by seven thicknesses.
"""

WHOLE = 2.0
"""Area, by the square of the thickness, from which on a section is one of its member: half that of a square bar, whose
thickness is half its side. Smaller ones clip an edge."""


class MemberSections:
    """Sections through m connections as they were built, between n bodies.

    `moves` (n,): a body that does not move is behind its faces, wherever its centre is. `kinds` (m,): a section has
    connections of one kind, those between the same two members. `thicknesses_m` (m,) are of the thinner member; nan
    where it is not known.
    """

    def __init__(
        self,
        faces: ConnectedFaces,
        centres_m: FloatArray,
        moves: BoolArray,
        kinds: IntArray,
        thicknesses_m: FloatArray,
    ):
        self._connected, self._kinds, self._thicknesses = faces, kinds, thicknesses_m
        self._extents = np.where(np.isfinite(thicknesses_m), SPREAD * thicknesses_m, 0.0)
        beyond = 2.0 * self._extents[:, None] * faces.normals
        first, second = faces.pairs.T
        self._before = np.where(moves[first, None], centres_m[first], faces.points_m - beyond)
        self._behind = np.where(moves[second, None], centres_m[second], faces.points_m + beyond)
        count = len(first)
        count = len(first)
        self._through, self._end = np.zeros(0, CUT_THROUGH), 0  # faces of the sections that were asked for, one by one
        self._firsts, self._sizes = np.full(count, -1), np.zeros(count, int)
        self._are_whole = np.zeros(count, bool)

    def are_whole(self, rows: IntArray) -> BoolArray:
        """Whether some connections (k,) still have the sections of their members as built: (k,) bool."""
        for row in rows[self._firsts[rows] < 0].tolist():
            self._find(row)
        return self._are_whole[rows]

    def hand_over(self, rows: IntArray, judging: Struct) -> None:
        """Let the core find the sections of some connections (k,)."""
        self.are_whole(rows)
        judging.point("sections", self._through, len(self._through))
        for name, of_all in (("firsts", self._firsts), ("sizes", self._sizes), ("whole", self._are_whole)):
            judging.point(name, of_all, len(of_all))

    def through(self, row: int) -> np.ndarray:
        """Return the faces (e,) of the section of a connection.

        Where the section doubles back, a face carries a load, and has no area.
        """
        self.are_whole(np.array([row]))
        return self._through[self._firsts[row] :][: self._sizes[row]]

    def _find(self, row: int) -> None:
        """Find the connections in the section of one, on which side of it their first bodies are, and their cosines."""
        point, normal = self._connected.points_m[row], self._connected.normals[row]
        apart = self._connected.points_m - point
        near = np.flatnonzero(dot(apart, apart) <= self._extents[row] * self._extents[row])
        near = near[(self._kinds[near] == self._kinds[row]) | (near == row)]
        before, behind = dot(self._before[near] - point, normal), dot(self._behind[near] - point, normal)
        parted = (before * behind < 0.0) | (near == row)
        near, before, behind = near[parted], before[parted], behind[parted]
        signs = np.where((before < behind) | (near == row), 1.0, -1.0)
        cosines = np.maximum(signs * dot(self._connected.normals[near], normal), 0.0)
        area_m2 = (self._connected.areas_m2[near] * cosines).sum()
        start, self._end = self._end, self._end + len(near)
        if self._end > len(self._through):
            self._through = np.concatenate((self._through, np.zeros(self._end, CUT_THROUGH)))
        for name, values in (("face", near), ("sign", signs), ("cosine", cosines)):
            self._through[name][start : self._end] = values
        self._firsts[row], self._sizes[row] = start, len(near)
        thickness_m = self._thicknesses[row]
        self._are_whole[row] = area_m2 >= WHOLE * thickness_m * thickness_m


def kinds_of(members: IntArray) -> IntArray:
    """Return a number (m,) for each pair of members that connections are between, of members (m, 2) of any type."""
    _, numbers = np.unique(members, return_inverse=True)
    low, high = np.sort(numbers.reshape(members.shape), axis=1).T
    kinds: IntArray = low * (numbers.max(initial=0) + 1) + high
    return kinds
