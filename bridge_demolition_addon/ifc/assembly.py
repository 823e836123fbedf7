"""Elements put together to a bridge: named, cut off at the ground, brought into contact, on bearings, and held."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, count

import numpy as np
from manifold3d import Manifold

from ..engineering.geometry.level_contacts import level_contacts
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.overlap import shells_left
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..engineering.units import mass_text
from ..model.bridge.member import Member
from ..model.scenario.bearings import PINNED, ROCKER, Bearing
from ..model.schema import FARTHEST_M, SHORTEST_LENGTH_M, given
from .bearings import BearingElement, BearingTables, bearing_of, bearing_tables, seated, with_one_fixed
from .bodies import Bodies, is_sound, writable
from .contacts import NearbyMembers
from .element_materials import ElementMaterial, MaterialTable
from .elements import Element
from .gaps import WAYS, close_small_gaps, closed_gaps
from .haunches import decks_with_haunches, with_haunches
from .kinds import ElementFacts
from .outcome import ADDED, BAR, CONNECTION, LEFT_OUT, MEMBER, Outcome
from .placement import Placement
from .quantities import Quantities
from .supports import (
    BELOW_GROUND_M,
    KIND,
    loose_groups,
    pads_under,
    under_bearing,
    under_ends,
    with_one_pinned,
    with_one_support_pinned,
)

_SAME = 0.99
"""Part of two members' volumes that they have in common where one is the other's double."""

_SCRAP = 0.02
"""Part of a member's volume below which a body that is cut off it is left out."""

_WITHIN = 0.5
"""Part of a member's volume in another, larger one from which on it is cut out of that, and not the other way."""

_NUDGE_M = 5e-4
"""How far a member is moved into what it is to touch: what they have in common is cut off."""

_SMALLEST_M3, _LEAST_LEFT = 1e-6, 1e-4
"""Volume below which nothing is left of a member that others are cut off, and part of its own."""

_THINNEST_M = 1.1 * SHORTEST_LENGTH_M
"""Extent below which an element is no member; dummies of grillages are 1 mm thick, give or take its rounding."""


@dataclass(slots=True)
class Assembly:
    """A bridge in the making.

    Attributes
    ----------
    outcomes
        By the elements' numbers in the file, then, with negative numbers, of what was added.
    notes
        What was assumed and mended.
    added
        Supports that the file lacks.
    bars
        Numbers of elements that are bars of steel.
    joined
        Pairs of names of members that bars join, or that hold bars, though they may not touch.
    unfit
        Why elements that are too thin or too far away for members are left out, by their titles.
    """

    elements: Sequence[Element]
    made_of: Mapping[int, ElementMaterial]
    quantities: Mapping[int, Quantities]
    bodies: Bodies
    outcomes: dict[int, Outcome] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    added: list[Member] = field(default_factory=list)
    bars: Collection[int] = ()
    joined: list[tuple[str, str]] = field(default_factory=list)
    unfit: dict[str, str] = field(default_factory=dict)
    _bearings: list[tuple[BearingElement, str]] = field(default_factory=list)
    _more_bearings: list[Bearing] = field(default_factory=list)
    _on_pads: list[Bearing] = field(default_factory=list)
    _before: dict[int, TriangleMesh] = field(default_factory=dict)
    _unheld: list[str] = field(default_factory=list)
    _first: list[int] = field(default_factory=list)
    _names_above: list[str] = field(default_factory=list)

    def add_members(self, solids: Mapping[int, TriangleMesh]) -> None:
        """Take in all elements: elements with solids become members."""
        for element in self.elements:
            number = element.entity.id()
            if not element.is_member:
                self._leave_out(element, element.why_left_out)
            elif number in self.bodies.missing:
                self._leave_out(element, self.bodies.missing[number], is_lost=True)
            elif element.kind != "bearing":
                self._add_member(element, solids[number])

    def _add_member(self, element: Element, solid: TriangleMesh) -> None:
        number = element.entity.id()
        substance, known = self.made_of[number], self.quantities[number]
        kept = _above_ground(solid)
        if kept is None:
            self._leave_out(element, "it lies below the ground")
            return
        notes = [substance.note, *self.bodies.repairs[number]]
        off = solid.volume / known.volume_m3 - 1.0 if known.volume_m3 else 0.0
        if abs(off) > 0.01:
            theirs = f"{100.0 * off:+.1f} % from the {known.volume_m3:.4g} m³ in the file"
            notes.append(f"its volume, {solid.volume:.4g} m³, is {theirs}")
        if kept is not solid:
            notes.append("cut off at the ground")
        member = Member(element.facts.member_name, element.member_kind, kept, substance.density_kg_m3)
        why = "; ".join(filter(None, notes))
        became = BAR if number in self.bars else MEMBER
        self.outcomes[number] = Outcome(
            element.facts, member, substance, became, why, None, known.volume_m3, known.mass_kg
        )
        if unfit := _unfit(kept):
            self.unfit[element.title] = unfit
            self.leave_out(number, f"it {unfit}")

    def _leave_out(self, element: Element, why: str, *, is_lost: bool = False) -> None:
        """Leave an element out; where it `is_lost`, its mass is said."""
        number = element.entity.id()
        known = self.quantities[number]
        if is_lost:
            substance = self.made_of.get(number)
            mass = known.mass_kg
            if mass is None and known.volume_m3 and substance:
                mass = known.volume_m3 * substance.density_kg_m3
            why += f"; {mass_text(mass).strip()} are missing" if mass else "; its mass is not known, and missing"
        self.outcomes[number] = Outcome(element.facts, None, None, LEFT_OUT, why, None, known.volume_m3, known.mass_kg)

    def leave_out(self, number: int, why: str) -> None:
        """Leave out what was a member; its mass is said."""
        outcome = self.outcomes[number]
        mass = mass_text(given(outcome.member).mass_kg).strip()
        why = f"{why}; {mass} are missing"
        self.outcomes[number] = replace(outcome, member=None, substance=None, became=LEFT_OUT, why=why)

    def members(self) -> list[tuple[int, Member]]:
        """Return the members that are left, with the numbers of their elements in the file."""
        return [
            (number, given(outcome.member))
            for number, outcome in self.outcomes.items()
            if outcome.member and outcome.became != CONNECTION
        ]

    def fit_together(self) -> None:
        """Leave out doubles, and have members that lie within larger ones cut out of these: columns in walls."""
        members = self.members()
        solids = [to_manifold(member.solid) for _, member in members]
        contacts = NearbyMembers([member.solid for _, member in members])
        gone: set[int] = set()
        inner: list[int] = []
        for row, (number, member) in enumerate(members):
            shared = {other: volume for other, volume in contacts.reached(member.solid, 0.0).items() if other != row}
            own = solids[row].volume()
            for other, volume in shared.items():
                if other in gone or row in gone:
                    continue
                others = solids[other].volume()
                if volume > _SAME * max(own, others) and other < row:
                    gone.add(row)
                    self.leave_out(number, f"{members[other][1].name} takes all of its room")
                elif volume > _WITHIN * own and own < others and not {number, members[other][0]} <= set(self.bars):
                    inner.append(number)
                    self.notes.append(f"{member.name} lies within {members[other][1].name}: it is cut out of that")
        volumes = {number: member.volume_m3 for number, member in members}
        self._first = sorted(dict.fromkeys(inner), key=lambda number: volumes[number])

    def ordered(self) -> dict[int, Outcome]:
        """Return all outcomes by their numbers; what an earlier one takes is cut off a later one."""
        first = [number for number in self._first if self.outcomes[number].member]
        rest = [number for number in self.outcomes if number not in first]
        return {number: self.outcomes[number] for number in (*first, *rest)}

    def drop_consumed(self) -> None:
        """Leave out members that the ones before them cut away whole."""
        taken: list[TriangleMesh] = []
        waiting = deque(self.ordered())
        while waiting:
            number = waiting.popleft()
            outcome = self.outcomes[number]
            if outcome.member is None or outcome.became in (BAR, CONNECTION):
                continue
            solid = outcome.member.solid
            rest = to_manifold(solid)
            for other in taken:
                if _boxes_meet(other, solid):
                    rest -= to_manifold(other)
            least_m3 = max(_SMALLEST_M3, _LEAST_LEFT * solid.volume)
            if rest.volume() <= least_m3 or not shells_left(rest, solid.volume, outcome.member.name):
                self.leave_out(number, "members before it take all of its room")
                continue
            waiting += self._part(number, rest)  # which others may take in their turn
            taken.append(given(self.outcomes[number].member).solid)
        self._lose_loose()

    def _part(self, number: int, rest: Manifold) -> list[int]:
        """Make members of the bodies that others cut a member into, and return their numbers; a shard is one body."""
        outcome = self.outcomes[number]
        member = given(outcome.member)
        bodies = sorted(rest.decompose(), key=lambda body: -body.volume())
        large = [body for body in bodies if body.volume() >= _SCRAP * rest.volume()]
        below = {name for _, name in self._bearings} | {bearing.members[1] for bearing in self._on_pads}
        if len(bodies) < 2 or member.name in below:
            return []
        parts = []
        self.outcomes[number] = replace(outcome, member=replace(member, solid=from_manifold(large[0])))
        for row, body in enumerate(large[1:], start=2):
            part = replace(member, name=f"{member.name} part {row}", solid=from_manifold(body))
            parts.append(min(0, *self.outcomes) - 1)
            self.outcomes[parts[-1]] = replace(outcome, member=part, file_volume_m3=None, file_mass_kg=None)
        if len(large) > 1:
            self.notes.append(f"{member.name} is cut into {len(large)} members, of as many bodies")
        return parts

    def make_writable(self) -> None:
        """Give all meshes coordinates that a file holds; what is no solid with them is simplified, or left out."""
        for number, outcome in list(self.outcomes.items()):
            if outcome.member is None or outcome.became == BAR:
                continue
            solid = writable(outcome.mesh or outcome.member.solid)
            if number in self._before and (solid is None or not is_sound(solid)):
                solid = writable(self._before[number])
                self.notes.append(f"{outcome.member.name} is left as it was: made longer it would be no sound solid")
            if solid is None:
                self.leave_out(number, "with the digits that a file holds it is no closed solid")
            elif outcome.mesh is not None:
                self.outcomes[number] = replace(outcome, mesh=solid)
            else:
                self.outcomes[number] = replace(outcome, member=replace(outcome.member, solid=solid))

        self._drop_bearings_without_contact()

    def _drop_bearings_without_contact(self) -> None:
        """Leave out bearings of added supports that what lies on them does not touch any more."""
        by_name = {member.name: member for _, member in self.members()}
        kept = []
        for bearing in self._more_bearings:
            above, below = (by_name.get(name) for name in bearing.members)
            if above and below and level_contacts(above.solid, below.solid):
                kept.append(bearing)
            elif above and below:
                self.notes.append(f"{above.name} does not lie level on {below.name}: they have no bearing")
        self._more_bearings = kept

    def close_gaps(self, gap_m: float) -> None:
        """Bring members that end just above others down onto them."""
        members = self.members()
        bars = {member.name for number, member in members if number in self.bars}
        done, haunches = with_haunches([member for _, member in members])
        done, notes = closed_gaps(done, gap_m, bars)
        done = decks_with_haunches([member for _, member in members], done, bars)
        done, more = close_small_gaps(done, gap_m, bars)
        for (number, before), after in zip(members, done, strict=True):
            if after is not before:
                self._before[number] = before.solid
                self.outcomes[number] = replace(self.outcomes[number], member=after)
        self.notes += [*haunches, *notes, *more]

    def add_bearings(
        self,
        bearings: Sequence[Element],
        solids: Mapping[int, TriangleMesh],
        placement: Placement,
        gap_m: float,
        table: MaterialTable,
    ) -> None:
        """Put bearings between members; one that lies on nothing gets a support."""
        members = self.members()
        contacts = NearbyMembers([member.solid for _, member in members])
        names = [member.name for _, member in members]
        numbers: list[int] = []
        for element in bearings:
            number = element.entity.id()
            bearing = bearing_of(element, solids[number], contacts, names, placement, gap_m)
            if isinstance(bearing, str):
                self._leave_out(element, bearing)
                continue
            if bearing.below is None:
                column = under_bearing(bearing.solid)
                if column is None:
                    self._leave_out(element, "nothing touches it from below")
                    continue
                below, substance = self._add_support(column, f"Support under {element.facts.name}", table)
            else:
                below, substance = self.outcomes[members[bearing.below][0]].part
            part = Member(below.name, below.kind, bearing.solid, below.density_kg_m3)
            self.outcomes[number] = Outcome(element.facts, part, substance, CONNECTION, "", seated(bearing.solid))
            self._bearings.append((bearing, below.name))
            numbers.append(number)
        self._names_above = names
        if gap_m:
            along = {member.name: float(member.solid.bounds[:, 0].mean()) for _, member in self.members()}
            self._bearings = with_one_fixed(self._bearings, along)
        for number, (bearing, below_name) in zip(numbers, self._bearings, strict=True):
            above = " and ".join(names[index] for index in bearing.above)
            notes = (bearing.closed, bearing.source)
            why = "; ".join([f"between {above} and {below_name}, of which it is part", *filter(None, notes)])
            self.outcomes[number] = replace(self.outcomes[number], why=why)

    def _add_support(self, solid: TriangleMesh, name: str, table: MaterialTable) -> tuple[Member, ElementMaterial]:
        taken = {member.name for _, member in self.members()}
        name = next(text for text in chain([name], (f"{name} {n}" for n in count(2))) if text not in taken)
        row = given(table.row("concrete") or (table.materials[0] if table.materials else None))
        substance = ElementMaterial("concrete", row.density_kg_m3, row)
        member = Member(name, KIND, solid, row.density_kg_m3)
        facts = ElementFacts(name=name, global_id="", classes=("",))
        why = "the file has nothing there: it stands on the ground and never moves"
        self.outcomes[min(0, *self.outcomes) - 1] = Outcome(facts, member, substance, ADDED, why)
        self.added.append(member)
        return member, substance

    def hold(self, gap_m: float, table: MaterialTable) -> None:
        """Have all members held: what touches nothing is brought to what is near, put on supports, or left out."""
        for _ in range(2):
            loose = loose_groups(self.members(), self.bearing_tables(), self.added, self.joined, self.bars)
            for group in loose:
                if set(group) <= set(self.bars):
                    continue
                if not self._move(group, gap_m) and not self._put_on_pads(group):
                    self._put_on_supports(group, table)
        if self._unheld:
            names = ", ".join(self._unheld[:3]) + (" and more" if len(self._unheld) > 3 else "")
            self.notes.append(
                f"nothing holds {names}: {2 * len(self._unheld)} supports, which never move, are put under their ends, "
                "pinned at the beginning of what hangs together and free to move along the road at all others"
            )
        self._lose_loose()

    def _lose_loose(self) -> None:
        """Leave out what touches nothing that is held."""
        for group in loose_groups(self.members(), self.bearing_tables(), self.added, self.joined, self.bars):
            for number in group:
                self.leave_out(number, "it touches no other member that is held, and would fall at once")

    def _move(self, group: list[int], gap_m: float) -> bool:
        """Move members by a gap to what is near, and return whether there is such a gap."""
        own = [given(self.outcomes[number].member) for number in group]
        others = [member for number, member in self.members() if number not in group]
        contacts = NearbyMembers([member.solid for member in others])
        gaps = sorted(
            ((gap, row, other) for row, member in enumerate(own) for gap, other in contacts.near_to(member.solid)),
        )
        for gap, row, other in (found for found in gaps if found[0] <= gap_m):
            for way in WAYS:
                shift = way * (gap + _NUDGE_M)
                moved = TriangleMesh(own[row].solid.vertices + shift, own[row].solid.triangles)
                if other in contacts.reached(moved, 0.0):
                    for number, member in zip(group, own, strict=True):
                        solid = TriangleMesh(member.solid.vertices + shift, member.solid.triangles)
                        outcome = self.outcomes[number]
                        self.outcomes[number] = replace(outcome, member=replace(member, solid=solid))
                        if before := self._before.get(number):
                            self._before[number] = TriangleMesh(before.vertices + shift, before.triangles)
                    names = " and ".join(member.name for member in own[:3])
                    self.notes.append(f"{names} moved by {1e3 * gap:.1f} mm, to touch {others[other].name}")
                    return True
        return False

    def _put_on_pads(self, group: list[int]) -> bool:
        """Put what carries the road in a group of members on pads on what it ends just above, and return whether."""
        within = set(group)
        members = self.members()
        chosen = _carrying([member for number, member in members if number in within])
        pads = pads_under(chosen, [member for number, member in members if number not in within])
        if not pads or {pad.above for pad in pads} != {member.name for member in chosen}:
            return False
        outcomes = {member.name: self.outcomes[number] for number, member in members}
        for pad in pads:
            below, substance = outcomes[pad.below].part
            part = Member(below.name, below.kind, pad.solid, below.density_kg_m3)
            facts = ElementFacts(name=f"Pad under {pad.above}", global_id="", classes=("",))
            why = f"between {pad.above} and {pad.below}, of which it is part; the file has nothing there"
            self.outcomes[min(0, *self.outcomes) - 1] = Outcome(facts, part, substance, CONNECTION, why)
        self._on_pads += with_one_support_pinned(pads)
        names = ", ".join(member.name for member in chosen[:3]) + (" and more" if len(chosen) > 3 else "")
        highest_m = max(float(np.ptp(pad.solid.vertices[:, 2])) for pad in pads)
        self.notes.append(
            f"{names} end just above what they lie on, and the file has no bearings: {len(pads)} pads, up to "
            f"{1e3 * highest_m:.0f} mm high, are put there, pinned at the beginning and free to move along the road at "
            "all others"
        )
        return True

    def _put_on_supports(self, group: list[int], table: MaterialTable) -> None:
        """Put what carries the road in a group of members on supports at its ends."""
        chosen = _carrying([given(self.outcomes[number].member) for number in group])
        if not chosen:
            return
        for support, is_pinned in with_one_pinned([support for member in chosen for support in under_ends(member)]):
            added, _ = self._add_support(support.solid, f"Support of {support.above}", table)
            kind = PINNED if is_pinned else ROCKER
            self._more_bearings.append(Bearing(members=(support.above, added.name), kind=kind))
        self._unheld += [member.name for member in chosen]

    def bearing_tables(self) -> BearingTables:
        """Return the tables of the bearings."""
        tables = bearing_tables(self._bearings, self._names_above)
        present = {member.name for _, member in self.members()}
        more = (*self._more_bearings, *self._on_pads)
        bearings = [table for table in (*tables.bearings, *more) if present.issuperset(table.members)]
        connections = [table for table in tables.connections if present.issuperset(table.members)]
        return BearingTables(tuple(bearings), tuple(connections), tables.notes)


def _carrying(members: Sequence[Member]) -> list[Member]:
    """Return the members that carry the road down to supports: girders, and else decks or arches."""
    of_kinds = ([member for member in members if member.kind == kind] for kind in ("girder", "deck", "arch"))
    return next(filter(None, of_kinds), [])


def _unfit(solid: TriangleMesh) -> str:
    """Return why a solid can be no member; empty for one that can."""
    thinnest_m, farthest_m = float(np.ptp(solid.bounds, axis=0).min()), float(np.abs(solid.bounds).max())
    if thinnest_m < _THINNEST_M:
        return f"is {1e3 * thinnest_m:.3g} mm thick, too thin for a member"
    if farthest_m > FARTHEST_M:
        return f"reaches {farthest_m:.4g} m from the beginning of the bridge"
    return ""


def _above_ground(solid: TriangleMesh) -> TriangleMesh | None:
    """Return the part of a solid above the ground; None where there is no such part."""
    if solid.bounds[0, 2] >= -BELOW_GROUND_M:
        return solid
    kept = to_manifold(solid).trim_by_plane((0.0, 0.0, 1.0), 0.0)
    if kept.is_empty() or kept.bounding_box()[5] < BELOW_GROUND_M:
        return None
    return from_manifold(kept)


def _boxes_meet(one: TriangleMesh, other: TriangleMesh) -> bool:
    (low, high), (other_low, other_high) = one.bounds, other.bounds
    return bool((low < other_high).all() and (high > other_low).all())
