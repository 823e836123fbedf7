"""Connections that carry more than their strength: judged face by face, and with the sections they are part of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Indices, Struct, WrittenDoubles, WrittenIndices
from .carried_sections import CUT_THROUGH, CarriedSections, CutsThrough, MemberSections, Resisting, pack
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

_MOST_REDISTRIBUTED = 3.0
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
        ("starts", Indices),
        ("through", CutsThrough),
        ("parts", Indices),
        ("used", WrittenDoubles),
    )


class Overloads:
    """Judges m connections by the strength of their material.

    `moves` (n,) says whether each body moves. `member_sections` are the sections that elastic connections are judged
    by. Rigid ones, which share loads by chance, are judged by cuts through single shards, and so are elastic ones whose
    section clips an edge of a member.

    In all methods `rows` (r,) are intact connections and `axes` (r, 3, 3) those of their sections, `loads` those of
    all; `left` (m,) is what is left of the strength of each, `intact` (m,) what still holds, `parts` (m,) what elastic
    connections hold together. `pressed` (m,) is by how much more of it is left in compression, and the caller keeps it
    up to date; None where it is as much everywhere. `friction` (m,) is what helps pressed faces against shear; None
    where it is not counted on.
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
        if self._member_sections is None or parts is None:
            rows, used = self._judged("bda_over_in_cuts", intact, sections, loads, positions_m, rotations, left)
        else:
            places = loads, positions_m, rotations
            rows, used = self.over_alone(intact, sections, *places, left)
            if len(rows):  # mostly nothing is overloaded: then what the others carry is not worked out
                of_all, axes = sections.loads_at_once(*places), sections.carried_axes(rows, rotations)
                rows, used = _overloaded(rows, self.together(rows, used, of_all, axes, intact, left, parts))
        return rows[worst_around(self._pairs[rows], used, self._moves)] if len(rows) else rows

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
        return self._judged("bda_over_alone", intact, sections, loads, positions_m, rotations, left)

    def _judged(
        self,
        name: str,
        intact: BoolArray,
        sections: CarriedSections,
        loads: FloatArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        left: FloatArray,
    ) -> tuple[IntArray, FloatArray]:
        """Return what a function of the core finds overloaded, as `over_alone` does."""
        judging, count = self._judging, len(self._pairs)
        judging.take(intact=(intact, count), left=(left, count), levers=(sections.lever_arms_m, count))
        call(name, judging, sections.carrying(loads, positions_m, rotations))
        found = slice(judging.count)
        return self._rows[found].copy(), self._used[found].copy()

    def _core_judging(self, faces: ConnectedFaces, cuts: SectionCuts) -> Judging:
        """Return what the core knows of all connections; arrays that the caller keeps up to date are his own."""
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
        if self._member_sections is None or parts is None:
            return self.in_cuts(rows, loads, axes, intact) / left[rows]
        used = self._in_members(self._member_sections, rows, loads, axes, intact, parts) / left[rows]
        return np.maximum(used, alone / _MOST_REDISTRIBUTED)

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
        in_cuts, used = self._given(rows, loads, axes)
        self._judging.take(intact=(intact, len(self._pairs)))
        call("bda_used_in_cuts", self._judging, in_cuts)
        return used

    def _given(self, rows: IntArray, loads: ConnectionLoads, axes: FloatArray) -> tuple[LoadsInCuts, FloatArray]:
        """Loads of all connections with the axes of some as the core takes them, and where it writes utilisations."""
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
        return given, used

    def _in_members(
        self,
        members: MemberSections,
        rows: IntArray,
        loads: ConnectionLoads,
        axes: FloatArray,
        intact: BoolArray,
        parts: IntArray,
    ) -> FloatArray:
        """Utilisations (r,), of whole strengths, of the sections of some connections."""
        whole = members.are_whole(rows)
        used = np.empty(len(rows))
        if whole.any():
            in_sections, found = self._given(rows[whole], loads, axes[whole])
            starts, through = members.through(rows[whole])
            in_sections.take(
                starts=(starts, len(starts)), through=(through, len(through)), parts=(parts, len(self._pairs))
            )
            self._judging.take(intact=(intact, len(self._pairs)))
            call("bda_used_in_sections", self._judging, in_sections)
            used[whole] = found
        if not whole.all():
            used[~whole] = self.in_cuts(rows[~whole], loads, axes[~whole], intact)
        return used


def _overloaded(rows: IntArray, used: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return those of connections (r,) whose utilisations (r,) are above 1, with these."""
    is_over = used > 1.0
    return rows[is_over], used[is_over]
