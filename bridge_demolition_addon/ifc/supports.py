"""What of a bridge never moves: its footings, and what else ends above the ground with nothing under it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ..model.bridge.member import Member
from ..model.scenario.bodies import Support
from .contacts import TOUCHING_M, NearbyMembers

_ON_GROUND_M = 1e-3
"""Height above the ground up to which a member stands on it: as far as one may reach below it."""

_STANDING = ("pier", "abutment", "wall")
"""Kinds of members that stand on something."""


def supports_of(members: Sequence[Member], contacts: NearbyMembers) -> tuple[list[Support], list[str]]:
    """Return what never moves, and sentences on what is held though it is no footing.

    Parameters
    ----------
    members : sequence of Member
        In their places.
    contacts : NearbyMembers
        Between their solids.
    """
    held = [Support(member="footing")] if any(each.kind == "footing" for each in members) else []
    notes = []
    for index, member in enumerate(members):
        height_m = float(member.solid.bounds[0, 2])
        if member.kind not in _STANDING or height_m <= _ON_GROUND_M:
            continue
        if contacts.reached(member.solid, -_ON_GROUND_M).keys() - {index}:
            continue
        held.append(Support(member=member.name, face="bottom"))
        notes.append(f"{member.name} ends {height_m:.2f} m above the ground on nothing: its underside is held")
    return held, notes


def loose_members(members: Sequence[Member], contacts: NearbyMembers, connected: Collection[str]) -> list[str]:
    """Return sentences on members that touch neither the ground nor another member, and so fall at once.

    Parameters
    ----------
    members : sequence of Member
        In their places.
    contacts : NearbyMembers
        Between their solids.
    connected : collection of str
        Names and kinds of members that are held, or lie on bearings.
    """
    found = []
    for index, member in enumerate(members):
        if member.solid.bounds[0, 2] <= _ON_GROUND_M or {member.name, member.kind} & set(connected):
            continue
        near = contacts.near(index)
        if near and near[0][0] <= TOUCHING_M:
            continue
        where = f"the nearest is {members[near[0][1]].name}, {1e3 * near[0][0]:.1f} mm off" if near else "none is near"
        found.append(f"{member.name} touches no other member ({where}): it is not connected, and falls")
    return found
