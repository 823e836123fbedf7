"""Sections across members, as far as loads spread in them: what elastic connections are judged by.

Elastic connections share a load by their stiffness, so a face beside a notch, an edge or a fixed end carries more than
the mean, and the more so the smaller the shards are. A member does not crack there before a whole section of it is
overloaded. So a face is judged with all that a plane through it parts near it, as one section that stays plane. Such a
section is as large with few shards as with many, and so is the load at which it breaks.
"""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.vectors import dot
from .carried_sections import CUT_THROUGH, pack
from .section_cuts import ConnectedFaces

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
    connections of one kind, those between the same two members. `thicknesses_m` (m,) are those of the thinner of these
    members; nan where it is not known.
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
        self._known: dict[int, np.ndarray] = {}
        self._is_known, self._are_whole = np.zeros((2, len(first)), bool)

    def are_whole(self, rows: IntArray) -> BoolArray:
        """Whether the sections of some connections (k,) are those of their members, as they were built: (k,) bool."""
        for row in rows[~self._is_known[rows]].tolist():
            self._find(row)
        return self._are_whole[rows]

    def through(self, rows: IntArray) -> tuple[IntArray, np.ndarray]:
        """Return the first face (k + 1,) of the section of each connection (k,), and all their faces (e,) packed.

        Where the section doubles back, a face carries a load, and has no area.
        """
        self.are_whole(rows)
        in_sections = [self._known[row] for row in rows.tolist()]
        starts = np.cumsum([0, *map(len, in_sections)]) // CUT_THROUGH.itemsize
        return starts, np.concatenate(in_sections).view(CUT_THROUGH)

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
        # As bytes: numpy takes long to find what records have in common.
        self._known[row] = pack(CUT_THROUGH, face=near, sign=signs, cosine=cosines).view(np.uint8)
        thickness_m = self._thicknesses[row]
        self._is_known[row], self._are_whole[row] = True, area_m2 >= WHOLE * thickness_m * thickness_m


def kinds_of(members: IntArray) -> IntArray:
    """Return a number (m,) for each pair of members that connections are between, of members (m, 2) of any type."""
    _, numbers = np.unique(members, return_inverse=True)
    low, high = np.sort(numbers.reshape(members.shape), axis=1).T
    kinds: IntArray = low * (numbers.max(initial=0) + 1) + high
    return kinds
