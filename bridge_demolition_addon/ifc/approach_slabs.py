"""Approach slabs that lie on what moves on bearings: held by the soil, they would clamp that from above."""

from __future__ import annotations

from .assembly import Assembly
from .contacts import NearbyMembers

_UNDER_M = 0.02
"""How far below a slab a member may end that it lies on."""

_MOVING = ("deck", "girder")


def leave_out_clamping_slabs(assembly: Assembly) -> None:
    """Leave out approach slabs that lie on decks, girders or what else is carried by bearings.

    Soil under a slab holds it from below alone. As a member that never moves it would hold the end of a deck down, too.
    """
    members = assembly.members()
    contacts = NearbyMembers([member.solid for _, member in members])
    on_bearings = {table.members[0] for table in assembly.bearing_tables().bearings}
    for number, member in members:
        if member.kind != "approach slab":
            continue
        below = [members[row][1] for row in contacts.reached(member.solid, -_UNDER_M)]
        moving = [other.name for other in below if other.kind in _MOVING or other.name in on_bearings]
        if moving:
            assembly.leave_out(
                number, f"it lies on {' and '.join(moving)}, which it would hold down as it never moves itself"
            )
