"""Members that never move: footings, and those that end above the ground with nothing under them."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ..model.bridge.member import Member
from ..model.scenario.bodies import Support
from .contacts import TOUCHING_M, NearbyMembers

_ON_GROUND_M = 1e-3
"""Height above the ground up to which a member stands on it: as far as one may reach below it."""

STANDING = ("pier", "abutment", "wall", "wing wall")
"""Kinds of members that stand on something; where that is missing, their undersides are held."""

_IN_SOIL = "wing wall"
"""Kind of members that soil holds, though they hardly touch the abutment that they belong to."""

HELD_KINDS = ("footing", "approach slab")
"""Kinds of members that never move: what lies on the soil or in it."""


def supports_of(
    members: Sequence[Member], contacts: NearbyMembers, added: Sequence[str] = ()
) -> tuple[list[Support], list[str]]:
    """Return the supports of a bridge, and notes on members that are held though they are no footings.

    `added` are the names of supports that the file lacks.
    """
    present = {member.kind for member in members}
    held = [Support(member=kind) for kind in HELD_KINDS if kind in present]
    held += [Support(member=name) for name in added]
    notes = []
    for index, member in enumerate(members):
        height_m = float(member.solid.bounds[0, 2])
        if member.kind not in STANDING or height_m <= _ON_GROUND_M or member.name in added:
            continue
        on_something = bool(contacts.reached(member.solid, -_ON_GROUND_M).keys() - {index})
        if on_something and member.kind != _IN_SOIL:
            continue
        held.append(Support(member=member.name, face="bottom"))
        where = (
            "is held by soil that no file has" if on_something else f"ends {height_m:.2f} m above the ground on nothing"
        )
        notes.append(f"{member.name} {where}: its underside is held")
    return held, notes


def loose_members(members: Sequence[Member], contacts: NearbyMembers, connected: Collection[str]) -> list[str]:
    """Return notes on members that touch neither the ground nor another member, and so fall at once.

    Members whose name or kind is connected are held, or lie on bearings.
    """
    notes = []
    for index, member in enumerate(members):
        if member.solid.bounds[0, 2] <= _ON_GROUND_M or {member.name, member.kind} & set(connected):
            continue
        near = contacts.near(index)
        if near and near[0][0] <= TOUCHING_M:
            continue
        where = f"the nearest is {members[near[0][1]].name}, {1e3 * near[0][0]:.1f} mm off" if near else "none is near"
        notes.append(f"{member.name} touches no other member ({where}): it is not connected, and falls")
    return notes
