"""Members of an imported bridge that touch each other, and nothing that is held."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ..model.bridge.member import Member
from ..model.scenario.joint_settings import GROUND_NAME
from .bearings import BearingTables
from .contacts import TOUCHING_M, NearbyMembers
from .supports import HELD_KINDS, STANDING

BELOW_GROUND_M = 1e-3
"""How far a member may reach below the ground, as elsewhere."""


def loose_groups(
    members: Sequence[tuple[int, Member]],
    tables: BearingTables,
    added: Collection[Member],
    joined: Sequence[tuple[str, str]] = (),
    bars: Collection[int] = (),
) -> list[list[int]]:
    """Return the numbers of members that nothing holds, group by group.

    What touches belongs together, and what bearings or connections of the tables join. Held are piers and abutments,
    what reaches the ground, and supports that were added. `bars` of steel, by their numbers, do not hold themselves,
    and are not joined where they touch each other: pairs of names say what is `joined`, to the ground, too.
    """
    rows = {member.name: row for row, (_, member) in enumerate(members)}
    group = list(range(len(members)))

    def root(row: int) -> int:
        while group[row] != row:
            row = group[row]
        return row

    contacts = NearbyMembers([member.solid for _, member in members])
    pairs = [
        (row, other)
        for row in range(len(members))
        for gap, other in contacts.near(row)
        if gap <= TOUCHING_M and other < row and not {members[row][0], members[other][0]} <= set(bars)
    ]
    of_bearings = [table.members for table in tables.bearings] + [table.members for table in tables.connections]
    of_bearings += joined
    pairs += [(rows[one], rows[other]) for one, other in of_bearings if one in rows and other in rows]
    for one, other in pairs:
        group[root(one)] = root(other)
    held = {root(rows[one]) for one, other in joined if other == GROUND_NAME and one in rows}
    held |= {
        root(row)
        for row, (number, member) in enumerate(members)
        if number not in bars
        and (
            member.kind in (*HELD_KINDS, *STANDING)
            or member.solid.bounds[0, 2] <= BELOW_GROUND_M
            or any(member is support for support in added)
        )
    }
    groups: dict[int, list[int]] = {}
    for row, (number, _) in enumerate(members):
        if root(row) not in held:
            groups.setdefault(root(row), []).append(number)
    return list(groups.values())
