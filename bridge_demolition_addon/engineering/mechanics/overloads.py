"""Connections that carry more than their strength: judged face by face, and with the sections they are part of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Indices, Struct, WrittenDoubles, WrittenIndices
from .carried_sections import (
    CUT_THROUGH,
    CarriedLoads,
    CarriedSections,
    CutsThrough,
    MemberSections,
    Resisting,
    pack,
)
from .section_cuts import ConnectedFaces, ConnectionLoads, SectionCuts, SectionForces, worst_around
from .strength import (
    Strength,
    largest_utilisations,
    rectangular_sections,
    resisting_records,
    sections_at,
    strength_at,
    utilisation,
)

MOST_REDISTRIBUTED = 3.0
"""By how much the stress in an elastic face may exceed its strength as long as its section carries the load.

A section evens out peaks of stress beside notches and edges, two to three times the mean. A sliver that is stretched
further has torn, whatever the faces beside it carry. Rigid connections share a load by chance: only the cut counts.
"""


class Judging(Struct):
    """What connections resist, and which are overloaded: `bda_judging`."""

    _fields_ = (
        *((name, Count) for name in ("connections", "entries", "most_faces")),
        ("intact", Flags),
        *((name, Doubles) for name in ("left", "by_force", "by_moment", "levers")),
        ("resisting", Resisting),
        ("pressed", Doubles),
        ("friction", Doubles),
        ("starts", Indices),
        ("through", CutsThrough),
        ("sections", CutsThrough),
        *((name, Indices) for name in ("firsts", "sizes")),
        ("whole", Flags),
        ("parts", Indices),
        ("found", WrittenIndices),
        ("noted", WrittenDoubles),
        ("lines", WrittenDoubles),
        ("rows", WrittenIndices),
        ("used", WrittenDoubles),
        ("count", Count),
    )


class LoadsInCuts(Struct):
    """Loads of connections in their cuts: `bda_loads_in_cuts`."""

    _fields_ = (
        ("count", Count),
        ("rows", Indices),
        *((name, Doubles) for name in ("axes", "forces", "moments", "points")),
        ("used", WrittenDoubles),
    )


class Overloads:
    """Judges m connections by the strength of their material.

    `moves` (n,) says whether each body moves. `member_sections` are the sections that elastic connections are judged
    by. Rigid ones, which share loads by chance, are judged by cuts through single shards, and so are elastic ones whose
    section clips an edge of a member.

    In all methods `rows` (r,) are intact connections and `axes` (r, 3, 3) their sections' axes, `loads` the loads of
    every connection; `left` (m,) is what is left of the strength of each, `intact` (m,) what still holds, `parts` (m,)
    what elastic connections hold together. `pressed` (m,) is by how much more of it is left in compression, and the
    caller keeps it up to date; None where it is as much everywhere. `friction` (m,) is what helps pressed faces against
    shear; None where it is not counted on.
    """

    def __init__(
        self,
        faces: ConnectedFaces,
        moves: BoolArray,
        strength: Strength,
        member_sections: MemberSections | None,
        pressed: FloatArray | None = None,
        friction: FloatArray | None = None,
    ):
        self._pressed, self._friction = pressed, friction
        self._pairs, self._moves, self._strength = faces.pairs, moves, strength
        self._member_sections = member_sections
        self._sections = rectangular_sections(faces.areas_m2, faces.second_moments_m4)
        self._rows, self._used = np.empty(len(faces.pairs), int), np.empty(len(faces.pairs))
        self._judging = self._core_judging(faces, SectionCuts.through(faces, moves))

    def breaking(
        self,
        intact: BoolArray,
        sections: CarriedSections,
        loads: FloatArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        left: FloatArray,
        parts: IntArray | None = None,
    ) -> IntArray:
        """Return which intact connections (k,) loads (6, m) overload alone and in sections, and each the worst around.

        Loads and places are as `over_alone` takes them. When one breaks, its neighbours take over its load: they are
        judged again after the next sub-step.
        """
        carrying = self._over_alone(intact, sections, loads, positions_m, rotations, left)
        if not self._judging.count:  # mostly: then what the others carry is not worked out
            return self._rows[:0]
        in_members = self._hand_over(self._rows[: self._judging.count], parts)
        call("bda_over_together", self._judging, carrying, in_members, MOST_REDISTRIBUTED)
        return self.worst()

    def overloaded(
        self,
        rows: IntArray,
        loads: ConnectionLoads,
        axes: FloatArray,
        intact: BoolArray,
        left: FloatArray,
        parts: IntArray | None = None,
    ) -> tuple[IntArray, FloatArray]:
        """Return which connections (k,) are overloaded alone and in their sections, and their utilisations (k,)."""
        alone = self.alone(rows, loads, axes, left)
        is_over = alone > 1.0
        rows, alone, axes = rows[is_over], alone[is_over], axes[is_over]
        if not len(rows):
            return rows, alone
        return _overloaded(rows, self.together(rows, alone, loads, axes, intact, left, parts))

    def over_alone(
        self,
        intact: BoolArray,
        sections: CarriedSections,
        loads: FloatArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        left: FloatArray,
    ) -> tuple[IntArray, FloatArray]:
        """Return which intact connections (k,) loads (6, m) overload alone, and their utilisations (k,).

        Loads are about the centres of bodies, which are at positions (3, n) in rotations (3, 3, n).
        """
        self._over_alone(intact, sections, loads, positions_m, rotations, left)
        return self._found()

    def _over_alone(
        self,
        intact: BoolArray,
        sections: CarriedSections,
        loads: FloatArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        left: FloatArray,
    ) -> CarriedLoads:
        """Let the core find what is overloaded alone; return the loads as it takes them."""
        judging, count = self._judging, len(self._pairs)
        judging.take(intact=(intact, count), left=(left, count), levers=(sections.lever_arms_m, count))
        carrying = sections.carrying(loads, positions_m, rotations)
        call("bda_over_alone", judging, carrying)
        return carrying

    def hand_over(
        self, intact: BoolArray, sections: CarriedSections, left: FloatArray, parts: IntArray | None
    ) -> Judging:
        """Return what the core judges by, which takes over what the caller keeps up to date."""
        count = len(self._pairs)
        self._judging.take(intact=(intact, count), left=(left, count), levers=(sections.lever_arms_m, count))
        self._hand_over(self._rows[:0], parts)
        return self._judging

    def judges_in_members(self, parts: IntArray | None) -> bool:
        """Whether connections are judged in sections of members."""
        return self._member_sections is not None and parts is not None

    def find_sections(self, parts: IntArray | None) -> None:
        """Find the sections of members of connections that the core has found to be overloaded alone."""
        self._hand_over(self._rows[: self._judging.count], parts)

    def worst(self) -> IntArray:
        """Return which connections (k,) the core has found to be overloaded, each the worst around."""
        rows, used = self._found()
        return rows[worst_around(self._pairs[rows], used, self._moves)] if len(rows) else rows

    def _found(self) -> tuple[IntArray, FloatArray]:
        """Return which connections (k,) the core has found, and their utilisations (k,)."""
        found = slice(self._judging.count)
        return self._rows[found].copy(), self._used[found].copy()

    def _hand_over(self, rows: IntArray, parts: IntArray | None) -> int:
        """Return whether connections (r,) are judged in sections of members, which are found then."""
        if self._member_sections is None or parts is None:
            return False
        self._member_sections.hand_over(rows, self._judging)
        self._judging.point("parts", parts, len(self._pairs))
        return True

    def _core_judging(self, faces: ConnectedFaces, cuts: SectionCuts) -> Judging:
        """Return what the core knows of the connections; arrays that the caller keeps up to date are his own."""
        count, entries, most = len(faces.pairs), len(cuts.faces), int(np.diff(cuts.starts).max(initial=0))
        if self._member_sections is not None:
            most = count
        by_force, by_moment = largest_utilisations(self._sections, self._strength)
        second = faces.second_moments_m4.reshape(-1, 4)[:, [0, 1, 3]]
        through = pack(CUT_THROUGH, face=cuts.faces, sign=cuts.signs, cosine=cuts.cosines)
        judging = Judging(connections=count, entries=entries, most_faces=most).take(
            by_force=(by_force, count),
            by_moment=(by_moment, count),
            resisting=(resisting_records(self._sections, self._strength, second), count),
            starts=(cuts.starts, 2 * count + 1),
            through=(through, entries),
            found=(np.empty(most, int), most),
            noted=(np.empty((most, 9)), 9 * most),
            lines=(np.empty((9, most)), 9 * most),
            rows=(self._rows, count),
            used=(self._used, count),
        )
        judging.point("pressed", np.ones(count) if self._pressed is None else self._pressed, count)
        if self._friction is not None:
            judging.point("friction", self._friction, count)
        return judging

    def alone(self, rows: IntArray, loads: ConnectionLoads, axes: FloatArray, left: FloatArray) -> FloatArray:
        """Utilisations (r,) of some connections, each by itself."""
        return self.of_forces(rows, loads.in_sections(rows, axes)) / left[rows]

    def of_forces(self, rows: IntArray, forces: SectionForces) -> FloatArray:
        """Utilisations (r,), of whole strengths, of some connections by forces in their axes."""
        return utilisation(forces, sections_at(self._sections, rows), self._strength_at(rows), self._friction_at(rows))

    def together(
        self,
        rows: IntArray,
        alone: FloatArray,
        loads: ConnectionLoads,
        axes: FloatArray,
        intact: BoolArray,
        left: FloatArray,
        parts: IntArray | None,
    ) -> FloatArray:
        """Utilisations (r,) of the sections of some connections, whose own (r,) are known."""
        used = self._used_together(rows, loads, axes, intact, parts) / left[rows]
        if self._member_sections is None or parts is None:
            return used
        return np.maximum(used, alone / MOST_REDISTRIBUTED)

    def _strength_at(self, rows: IntArray) -> Strength:
        """Strength (r,) of some connections, without what is lost of it in all directions."""
        strength = strength_at(self._strength, rows)
        if self._pressed is None:
            return strength
        return replace(strength, compression_pa=self._pressed[rows] * strength.compression_pa)

    def _friction_at(self, rows: IntArray) -> FloatArray | None:
        return None if self._friction is None else self._friction[rows]

    def in_cuts(self, rows: IntArray, loads: ConnectionLoads, axes: FloatArray, intact: BoolArray) -> FloatArray:
        """Mean utilisations (r,), of whole strengths, of the cuts through the two shards of some connections."""
        return self._used_together(rows, loads, axes, intact, None)

    def _used_together(
        self, rows: IntArray, loads: ConnectionLoads, axes: FloatArray, intact: BoolArray, parts: IntArray | None
    ) -> FloatArray:
        """Utilisations (r,), of whole strengths, of some connections in their sections, or in their cuts."""
        count, used = len(rows), np.empty(len(rows))
        if count and not 0 <= rows.min() <= rows.max() < len(self._pairs):
            raise ValueError(f"rows are {rows.min()} to {rows.max()} of {len(self._pairs)} connections")
        given = LoadsInCuts(count=count).take(
            rows=(rows, count),
            axes=(axes, 9 * count),
            forces=(loads.forces_n, 3 * len(self._pairs)),
            moments=(loads.moments_nm, 3 * len(self._pairs)),
            points=(loads.points_m, 3 * len(self._pairs)),
            used=(used, count),
        )
        self._judging.take(intact=(intact, len(self._pairs)))
        call("bda_used_together", self._judging, given, self._hand_over(rows, parts))
        return used


def _overloaded(rows: IntArray, used: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return the connections (r,) with utilisations (r,) above 1, and these."""
    is_over = used > 1.0
    return rows[is_over], used[is_over]
