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
        self._known: dict[int, tuple[FloatArray, FloatArray, FloatArray]] = {}

    def are_whole(self, rows: IntArray) -> BoolArray:
        """Whether the sections of some connections (k,) are those of their members, as they were built: (k,) bool."""
        in_sections = map(self._faces, rows.tolist())
        areas = np.array([(self._connected.areas_m2[faces] * cosines).sum() for faces, _, cosines in in_sections])
        return areas >= WHOLE * np.square(self._thicknesses[rows])

    def through(self, rows: IntArray, parts: IntArray) -> tuple[IntArray, np.ndarray]:
        """Return the first face (k + 1,) of the section of each intact connection (k,), and all faces (e,).

        `parts` (m,) are numbers of what hangs together, which no section goes beyond; negative for broken connections.
        """
        in_sections = [self._faces(row) for row in rows.tolist()]
        owners = np.repeat(np.arange(len(rows)), [len(faces) for faces, _, _ in in_sections])
        faces, signs, cosines = (np.concatenate(arrays) for arrays in zip(*in_sections, strict=True))
        holds = parts[faces] == parts[rows][owners]
        starts = np.searchsorted(owners[holds], np.arange(len(rows) + 1))
        return starts, pack(CUT_THROUGH, face=faces[holds], sign=signs[holds], cosine=cosines[holds])

    def _faces(self, row: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Connections (e,) in the section of one, on which side of it their first bodies are, and their cosines.

        Where the section doubles back, a face carries a load, and has no area.
        """
        if row not in self._known:
            point, normal = self._connected.points_m[row], self._connected.normals[row]
            apart = self._connected.points_m - point
            near = np.flatnonzero(dot(apart, apart) <= self._extents[row] * self._extents[row])
            near = near[(self._kinds[near] == self._kinds[row]) | (near == row)]
            before, behind = dot(self._before[near] - point, normal), dot(self._behind[near] - point, normal)
            parted = (before * behind < 0.0) | (near == row)
            near, before, behind = near[parted], before[parted], behind[parted]
            signs = np.where((before < behind) | (near == row), 1.0, -1.0)
            cosines = np.maximum(signs * dot(self._connected.normals[near], normal), 0.0)
            self._known[row] = near, signs, cosines
        return self._known[row]


def kinds_of(members: IntArray) -> IntArray:
    """Return a number (m,) for each pair of members that connections are between, of members (m, 2) of any type."""
    _, numbers = np.unique(members, return_inverse=True)
    low, high = np.sort(numbers.reshape(members.shape), axis=1).T
    kinds: IntArray = low * (numbers.max(initial=0) + 1) + high
    return kinds
