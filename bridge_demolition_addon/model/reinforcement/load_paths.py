"""Which members carry which others, by where they touch: decks with their spans, and what their supports stand on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.fracture.shared_faces import touching_faces
from ...engineering.geometry.mesh import joined_meshes
from ...engineering.geometry.own_axes import OwnAxes, lying_axes
from ..bridge.member import Member, own_axes
from ..scenario import Scenario
from ..scenario.bearings import Bearing, names_one
from ..scenario.scenario import bearing_tables

_SPANNING = ("deck", "girder", "arch")
_CARRIED = ("parapet", "bracing", "fill")
_NO_SUPPORTS = ("approach slab", "wing wall", "parapet", "bracing", "fill")
"""What touches a deck and carries nothing of it."""

_LEVEL = 0.2
"""Least vertical part of the normal of a face through which a member rests on another."""

_SMALLEST_M2 = 1e-3

_ONE_SUPPORT_M = (1.0, 2.5)
_ONE_SUPPORT = 0.04
"""Distance along a deck within which supports are one, by the deck's length, and its limits."""


@dataclass(frozen=True, slots=True, eq=False)
class Seat:
    """Where a member lies on another or, through an upright face, against it."""

    above: int
    below: int
    point_m: np.ndarray  # (3,)
    area_m2: float
    is_level: bool
    is_bearing: bool


@dataclass(frozen=True, slots=True, eq=False)
class DeckSupport:
    """A support of a deck along its line, and the members that carry it there."""

    station_m: float
    carriers: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Superstructure:
    """Decks and girders that hang together, with what they carry, and their common axes."""

    decks: tuple[int, ...]
    girders: tuple[int, ...]
    carried: tuple[int, ...]
    axes: OwnAxes
    supports: tuple[DeckSupport, ...]

    @property
    def all(self) -> tuple[int, ...]:
        return (*self.decks, *self.girders, *self.carried)


def contacts_of(scenario: Scenario, members: Sequence[Member]) -> list[Seat]:
    """Return where members touch."""
    faces = touching_faces([member.solid for member in members], member=np.arange(len(members)))
    tables = bearing_tables(scenario)
    found = []
    for pair, area, centre, normal in zip(faces.pairs, faces.areas, faces.centres, faces.normals, strict=True):
        first, second = int(pair[0]), int(pair[1])
        above, below = (first, second) if normal[2] <= 0.0 else (second, first)
        bearing = _bearing(tables, members, first, second)
        if bearing is not None:
            above, below = bearing
        is_level = abs(float(normal[2])) >= _LEVEL or bearing is not None
        if area >= _SMALLEST_M2:
            found.append(Seat(above, below, centre, float(area), is_level, bearing is not None))
    return found


def _bearing(tables: Sequence[Bearing], members: Sequence[Member], first: int, second: int) -> tuple[int, int] | None:
    """Return which of two members with a bearing lies above and which below; None where they have none."""
    for table in tables:
        for above, below in ((first, second), (second, first)):
            pairs = zip(table.members, (members[above], members[below]), strict=True)
            if all(names_one(pattern, member.name, member.kind) for pattern, member in pairs):
                return above, below
    return None


def spans(member: Member) -> bool:
    """Return whether a member is of a kind that spans between supports."""
    return member.kind in _SPANNING


def superstructures(members: Sequence[Member], contacts: Sequence[Seat]) -> list[Superstructure]:
    """Return what spans between supports, part by part. What carries others on bearings is a support itself."""
    carrying = {contact.below for contact in contacts if contact.is_bearing}
    mains = [index for index, member in enumerate(members) if spans(member) and index not in carrying]
    carried = [index for index, member in enumerate(members) if member.kind in _CARRIED]
    found = []
    for group in _groups(mains, contacts):
        with_others = _reached(group, [*group, *carried], contacts)
        decks = tuple(index for index in group if members[index].kind == "deck")
        girders = tuple(index for index in group if index not in decks)
        others = tuple(index for index in with_others if index not in group)
        axes = _axes([members[index] for index in decks or girders])
        supports = tuple(_supports(group, members, contacts, axes))
        found.append(Superstructure(decks, girders, others, axes, supports))
    return found


def _groups(indices: Sequence[int], contacts: Sequence[Seat]) -> Iterator[list[int]]:
    """Yield members that hang together without bearings."""
    left = list(indices)
    while left:
        group = _reached([left[0]], left, contacts)
        left = [index for index in left if index not in group]
        yield group


def _reached(begin: Sequence[int], among: Sequence[int], contacts: Sequence[Seat]) -> list[int]:
    found, allowed = set(begin), set(among)
    grown = True
    while grown:
        grown = False
        for contact in contacts:
            ends = {contact.above, contact.below}
            if not contact.is_bearing and ends <= allowed and len(ends & found) == 1:
                found |= ends
                grown = True
    return sorted(found)


def _axes(mains: Sequence[Member]) -> OwnAxes:
    if len(mains) == 1:
        return own_axes(mains[0])
    return lying_axes(joined_meshes([member.solid for member in mains]), np.array([1.0, 0.0]))


def _supports(
    group: Sequence[int], members: Sequence[Member], contacts: Sequence[Seat], axes: OwnAxes
) -> Iterator[DeckSupport]:
    """Yield the supports of decks and girders along their line, from its beginning."""
    resting = [
        contact
        for contact in contacts
        if contact.above in group and contact.below not in group and members[contact.below].kind not in _NO_SUPPORTS
    ]
    level = [contact for contact in resting if contact.is_level]
    chosen = level or resting
    if not chosen:
        return
    stations = axes.from_world(np.array([contact.point_m for contact in chosen]))[:, 0]
    limit = min(max(_ONE_SUPPORT * axes.length_m, _ONE_SUPPORT_M[0]), _ONE_SUPPORT_M[1])
    order = np.argsort(stations, kind="stable").tolist()
    row: list[int] = []
    for index in [*order, None]:
        if row and (index is None or stations[index] - stations[row[0]] > limit):
            middle = float(np.mean([stations[number] for number in row]))
            yield DeckSupport(middle, tuple(dict.fromkeys(chosen[number].below for number in row)))
            row = []
        if index is not None:
            row.append(index)


def carriers_of(index: int, contacts: Sequence[Seat]) -> list[Seat]:
    """Return where a member rests on others."""
    return [contact for contact in contacts if contact.above == index and contact.is_level]
