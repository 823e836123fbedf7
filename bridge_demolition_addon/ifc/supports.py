"""What holds an imported bridge: members that never move, and supports and bearings that its file lacks.

Never move footings, and what ends above the ground with nothing under it. Supports are added under bearings that lie on
nothing and under the ends of a bridge without piers; bearings are pads in the gap between a girder and what it ends
just above.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box, from_manifold, to_manifold
from ..engineering.geometry.vectors import cross_2d, dot, length, transformed_back, turn_in_plane, unit
from ..model.bridge.member import Member
from ..model.scenario.bearings import PINNED, ROCKER, Bearing
from ..model.scenario.bodies import Support
from ..model.scenario.joint_settings import GROUND_NAME
from .bearings import HIGHEST_PLINTH_M, SEAT_M, BearingTables
from .contacts import TOUCHING_M, NearbyMembers
from .gaps import STEEPEST, cut_by, largest_body, lengthened

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


KIND = "pier"
WIDEST_M = 0.5
"""Length along the road of a support under the end of a girder; also the least width of one under a bearing."""

_INSET_M, _WITHIN, _LEAST_WIDTH_M = 0.05, 0.9, 0.2
"""Where a support is under the underside of a girder: behind its end, and so much of its width."""

CLEARANCE_M = 5.0
"""Height of the road's underside above the ground, where no part of the file stands on it and none is given."""


@dataclass(frozen=True, slots=True)
class AddedSupport:
    """A support that never moves, and the member that lies on it."""

    solid: TriangleMesh
    above: str


def under_bearing(solid: TriangleMesh) -> TriangleMesh | None:
    """Return a column from the ground to just within the underside of a bearing; None where that lies on the ground."""
    low, high = solid.bounds
    if low[2] <= 0.0:
        return None
    size = np.maximum(high - low, WIDEST_M)[:2]
    return box((*size.tolist(), float(low[2])), (*((low + high) / 2.0)[:2].tolist(), float(low[2]) / 2.0))


def under_ends(member: Member) -> list[AddedSupport]:
    """Return supports under the first and the other end of a member that carries the road, from the ground to it."""
    points = member.solid.vertices
    middle, along = _along(points[:, :2])
    arms = points[:, :2] - middle
    way = dot(arms, along)
    across = np.array((-along[1], along[0]))
    supports = []
    for side in (-1.0, 1.0):
        end = float((side * way).max())
        near = side * way >= end - WIDEST_M
        low = float(points[near, 2].min())
        # What lies at the end, and of that its lowest parts: the bottom flange of a girder, not its wings.
        lowest = near & (points[:, 2] <= low + 0.05)
        beside = dot(arms[lowest], across)
        width = _WITHIN * max(float(np.ptp(beside)), _LEAST_WIDTH_M)
        centre = (
            middle
            + along * side * (end - _INSET_M - 0.5 * WIDEST_M)
            + across * float(beside.min() + beside.max()) / 2.0
        )
        top = low + STEEPEST * WIDEST_M
        column = box((WIDEST_M, width, top), (0.0, 0.0, top / 2.0))
        turn = turn_in_plane(-float(np.arctan2(along[1], along[0])))
        vertices = np.column_stack((transformed_back(turn, column.vertices[:, :2]) + centre, column.vertices[:, 2]))
        supports.append(TriangleMesh(vertices, column.triangles))
    return [AddedSupport(_below(solid, member.solid), member.name) for solid in supports]


def with_one_pinned(supports: Sequence[AddedSupport]) -> list[tuple[AddedSupport, bool]]:
    """Return the supports of what hangs together, and whether each is pinned: those at its beginning alone.

    With others pinned too, such as at the first end of each span, the bridge would be an arch between them.
    """
    middles = [float(support.solid.bounds[:, 0].mean()) for support in supports]
    spans = [abs(end - begin) for begin, end in zip(middles[::2], middles[1::2], strict=True)]
    first = min(middles) + 0.5 * min(spans)
    return [(support, middle < first) for support, middle in zip(supports, middles, strict=True)]


def _below(column: TriangleMesh, solid: TriangleMesh) -> TriangleMesh:
    """Return a column up to the underside of a solid, without its remains next to a web above a flange."""
    pieces = to_manifold(cut_by(column, [solid])).decompose()
    return from_manifold(max(pieces, key=lambda piece: piece.volume()))


def _along(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a point among points (n, 2), and the direction across which they are least wide, towards positive x."""
    (corners,) = CrossSection.hull_points(np.ascontiguousarray(points)).to_polygons()
    sides = np.roll(corners, -1, axis=0) - corners
    ways = unit(sides[length(sides) > 0.0])
    widths = np.ptp(cross_2d(ways[:, None], corners[None]), axis=1)
    along = ways[int(widths.argmin())]
    return corners.mean(axis=0), along if along[0] > 0.0 or (along[0] == 0.0 and along[1] > 0.0) else -along


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


_CARRYING = ("pier", "pier cap", "abutment", "wall", "girder", "footing")
"""Kinds of members that a girder or deck may lie on."""

_LONGEST_M, _PAD_WITHIN = 0.4, 0.9
"""Length of a pad along the road, and the part of the girder's width that it takes."""

_LEAST_M = 0.05
"""Least length and width of a pad."""


@dataclass(frozen=True, slots=True)
class Pad:
    """A pad that touches the member that lies on it, and is let into the one below; both by their names."""

    solid: TriangleMesh
    above: str
    below: str


def pads_under(carried: Sequence[Member], others: Sequence[Member]) -> list[Pad]:
    """Return pads between members and what is up to half a metre below them, of those alone that get two or more.

    One on a single support would fall all the same.
    """
    standing = [member for member in others if member.kind in _CARRYING]
    contacts = NearbyMembers([member.solid for member in standing])
    pads: list[Pad] = []
    for member in carried:
        below = contacts.reached(lengthened(member.solid, -HIGHEST_PLINTH_M), 0.0)
        own = [_pad(member, standing[row]) for row in below]
        found = [pad for pad in own if pad]
        if len(found) > 1:
            pads += found
    return pads


def with_one_support_pinned(pads: Sequence[Pad]) -> list[Bearing]:
    """Return the bearings of pads: pinned on what is at the beginning of the road, free to move along it elsewhere."""
    first = min(pads, key=lambda pad: float(pad.solid.bounds[:, 0].mean())).below
    pairs = dict.fromkeys((pad.above, pad.below) for pad in pads)
    return [Bearing(members=pair, kind=PINNED if pair[1] == first else ROCKER) for pair in pairs]


def _pad(member: Member, below: Member) -> Pad | None:
    """Return the pad between two members; None where there is no room for one."""
    gap = to_manifold(lengthened(member.solid, -HIGHEST_PLINTH_M)) ^ to_manifold(below.solid)
    low, high = from_manifold(gap).bounds
    lowest = member.solid.vertices[:, 2].min()
    top = float(member.solid.bounds[1, 2])
    size = np.minimum((high - low)[:2], (_LONGEST_M, np.inf)) * (1.0, _PAD_WITHIN)
    if size.min() < _LEAST_M or high[2] <= low[2] or lowest <= low[2]:
        return None
    middle = (low + high)[:2] / 2.0
    column = box((*size.tolist(), top - float(low[2])), (*middle.tolist(), (top + float(low[2])) / 2.0))
    lowered = TriangleMesh(below.solid.vertices - (0.0, 0.0, SEAT_M), below.solid.triangles)
    pieces = to_manifold(cut_by(column, [member.solid, lowered])).decompose()
    # What is left above the member, or next to its web, is no pad.
    under = [piece for piece in pieces if piece.bounding_box()[2] < lowest + SEAT_M and piece.volume() > 0.0]
    if not under:
        return None
    solid = largest_body(from_manifold(max(under, key=lambda piece: -piece.bounding_box()[2])))
    return Pad(solid, member.name, below.name)
