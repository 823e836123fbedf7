"""What bars of steel stand on: bearings and members below them, what their ends touch, and the ground.

Each becomes the support of a node there. What lies on a bar is none: it touches the bar as members touch.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from manifold3d import Manifold

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..engineering.geometry.vectors import dot, length
from ..model.bridge.member import Member
from ..model.scenario.bearings import FIXED, PINNED, ROCKER, SLIDING, Bearing
from ..model.scenario.joint_settings import GROUND_NAME
from .assembly import Assembly
from .bearings import HIGHEST_PLINTH_M
from .contacts import NearbyMembers
from .outcome import CONNECTION
from .several_bridges import CARRYING
from .steel_elements import SteelElement
from .supports import BELOW_GROUND_M, WIDEST_M, loose_groups

_UPRIGHT = 0.7
"""Vertical part of the direction of a bar from which on it stands, and does not lie."""

_REACH_M = 1e-3
"""How far a bar is moved beyond a gap to see what it touches."""

_LEAST_M3 = 1e-7
_EMBEDDED = 1e-3
"""Volume that two have in common where they touch, and part of a bar's volume from which on it is let into a member."""

_STANDS_ON = ("pier", "pier cap", "abutment", "wall", "wing wall", "footing")
"""Kinds of members over which a bar may end with a gap that a bearing fills, which the file does not have."""

_NEAR_END_M, _NEAR_END = 0.5, 0.05
"""How far from the ends of a frame its supports may be, in m and by its length."""

_LEAST_PART = 0.2
"""Part of all steel that bars have to be which get supports that no file has: less is a part that meets nothing."""

_STRENGTH = {FIXED: 0, PINNED: 1, ROCKER: 2}


@dataclass(frozen=True, slots=True, eq=False)
class BarSupport:
    """A support of a bar, by the number of its element: where it is (3,), its kind, and the name of what holds it.

    `is_assumed` says that the file does not have its kind. `end` is the end of the bar that touches what holds it, 0 or
    1: its node lies so far within the bar that its plates are clear of that.
    """

    bar: int
    position_m: np.ndarray
    kind: str
    held_by: str
    is_assumed: bool = False
    end: int | None = None


def bar_supports(assembly: Assembly, bars: Mapping[int, SteelElement], gap_m: float) -> list[BarSupport]:
    """Return the supports of bars on all that they touch, up to a gap.

    Those that lie on members without bearings are pinned on the first along the road, and free to move along it on all
    others. Bars that stand, or end at the side of a member, are fixed.
    """
    members = assembly.members()
    others = [(number, member) for number, member in members if number not in bars]
    contacts = NearbyMembers([member.solid for _, member in others])
    bearings = {table.members: table for table in assembly.bearing_tables().bearings}
    bearings |= {
        table.members: Bearing(members=table.members, kind=PINNED) for table in assembly.bearing_tables().connections
    }
    found: list[BarSupport] = []
    for number, member in members:
        if number not in bars:
            continue
        for (above, below), table in bearings.items():
            if above == member.name:
                found += _on_bearing(assembly, number, member, below, table)
        on_bearings = {support.held_by for support in found if support.bar == number}
        for gap, row in contacts.near_to(member.solid):
            other = others[row][1]
            if gap <= gap_m and other.name not in on_bearings:
                support = _touching(bars[number], member, other, gap)
                found += [support] if support else []
        if member.solid.bounds[0, 2] <= BELOW_GROUND_M:
            found.append(_on_ground(bars[number]))
    return _with_one_pinned(found)


def supports_of_loose(assembly: Assembly, bars: Mapping[int, SteelElement]) -> tuple[list[BarSupport], list[str]]:
    """Return more supports, for bars that nothing holds, and notes on them.

    They are on members that end up to half a metre below them, and otherwise on the ground under the ends of what hangs
    together. Bars that carry no road have none: what meets nothing falls.
    """
    members = dict(assembly.members())
    more: list[BarSupport] = []
    notes: list[str] = []
    tables = assembly.bearing_tables()
    for group in loose_groups(list(members.items()), tables, assembly.added, assembly.joined, assembly.bars):
        own = [number for number in group if number in bars]
        if not own or not any(members[number].kind in CARRYING for number in group):
            continue
        if _mass_kg(members, own) < _LEAST_PART * _mass_kg(members, bars):
            continue
        below = _above_members(own, bars, members, set(group))
        if len({support.held_by for support in below}) > 1:
            more += _with_one_pinned(below)
            names = ", ".join(dict.fromkeys(support.held_by for support in below))
            notes.append(
                f"{members[own[0]].name} and what hangs together with it end just above {names}, and the file has no "
                "bearings: their nodes have supports there, pinned at the beginning and free to move along the road at "
                "all others"
            )
            continue
        ends = _ends_of_frame([bars[number] for number in own])
        more += ends
        notes.append(
            f"nothing holds {members[own[0]].name} and what hangs together with it: {len(ends)} supports on the ground "
            "are under its ends, pinned at the beginning and free to move along the road at the other end"
        )
    return more, notes


def _mass_kg(members: Mapping[int, Member], bars: Iterable[int]) -> float:
    return math.fsum(members[number].mass_kg for number in bars if number in members)


def _on_bearing(assembly: Assembly, number: int, member: Member, below: str, table: Bearing) -> Iterator[BarSupport]:
    """Yield the supports of a bar on the bearings between it and the member below these."""
    kind = ROCKER if table.kind == SLIDING else table.kind
    for outcome in assembly.outcomes.values():
        if outcome.became == CONNECTION and outcome.part[0].name == below:
            region = _moved_into(member.solid, outcome.part[0].solid, (0.0, 0.0, -_REACH_M))
            if region is not None:
                yield BarSupport(number, region, kind, below)
    # Supports that were added under a girder have no bearing of their own.
    for added in assembly.added:
        if added.name == below:
            region = _moved_into(member.solid, added.solid, (0.0, 0.0, -_REACH_M))
            if region is not None:
                yield BarSupport(number, region, kind, below)


def _touching(bar: SteelElement, member: Member, other: Member, gap_m: float) -> BarSupport | None:
    """Return the support of a bar on a member; None where that lies on the bar, or at its side between its ends."""
    reach = gap_m + _REACH_M
    solid, theirs = to_manifold(member.solid), to_manifold(other.solid)
    common = solid ^ theirs
    if common.volume() > _EMBEDDED * solid.volume():
        end = _end_near(bar, _middle(common))
        return None if end is None else _let_in(bar, common, end, other.name)
    down, up = ((solid.translate((0.0, 0.0, way * reach)) ^ theirs) for way in (-1.0, 1.0))
    is_below, is_above = down.volume() > up.volume() + _LEAST_M3, up.volume() > down.volume() + _LEAST_M3
    if abs(float(bar.along[2])) > _UPRIGHT:
        touching = down if is_below else up
        end = _end_near(bar, _middle(touching)) if is_below or is_above else None
        return None if end is None else _at_end(bar, end, other.name)
    if is_below:
        return BarSupport(bar.number, _middle(down), ROCKER, other.name, is_assumed=True)
    if is_above:
        return None
    for way in (-1.0, 1.0):
        ahead = solid.translate(tuple((way * reach * bar.along).tolist())) ^ theirs
        if ahead.volume() > common.volume() + _LEAST_M3:
            return _at_end(bar, 0 if way < 0.0 else 1, other.name)
    return None


def _on_ground(bar: SteelElement) -> BarSupport:
    return _at_end(bar, 0 if bar.begin_m[2] <= bar.end_m[2] else 1, GROUND_NAME)


def _at_end(bar: SteelElement, end: int, held_by: str) -> BarSupport:
    return BarSupport(bar.number, (bar.begin_m, bar.end_m)[end], FIXED, held_by, end=end)


def _let_in(bar: SteelElement, common: Manifold, end: int, held_by: str) -> BarSupport | None:
    """Return the support of a bar that is let into a member, at its face; None for one that is within it altogether."""
    along = dot(from_manifold(common).vertices - bar.begin_m, bar.along)
    face = float(along.max() if end == 0 else along.min())
    if not 0.0 < face < bar.length_m:
        return None
    return BarSupport(bar.number, bar.begin_m + face * bar.along, FIXED, held_by, end=end)


def _with_one_pinned(found: Sequence[BarSupport]) -> list[BarSupport]:
    """Pin the supports of assumed kind on what lies first along the road."""
    assumed = [support for support in found if support.is_assumed]
    if not assumed:
        return list(found)
    first = min(assumed, key=lambda support: float(support.position_m[0])).held_by
    if all(support.held_by == GROUND_NAME for support in assumed):
        nearest = min(float(support.position_m[0]) for support in assumed)
        farthest = max(float(support.position_m[0]) for support in assumed)
        limit = 0.5 * (nearest + farthest)
        return [
            replace(one, kind=PINNED if float(one.position_m[0]) <= limit else ROCKER) if one.is_assumed else one
            for one in found
        ]
    return [replace(one, kind=PINNED if one.held_by == first else ROCKER) if one.is_assumed else one for one in found]


def _above_members(
    own: Sequence[int], bars: Mapping[int, SteelElement], members: Mapping[int, Member], group: set[int]
) -> list[BarSupport]:
    """Return supports of bars on what ends up to half a metre below them."""
    standing = [one for number, one in members.items() if number not in group and one.kind in _STANDS_ON]
    found = []
    for number in own:
        bar, member = bars[number], members[number]
        if abs(float(bar.along[2])) > _UPRIGHT:
            continue
        for other in standing:
            lowered = (0.0, 0.0, -HIGHEST_PLINTH_M)
            place = _moved_into(member.solid, other.solid, lowered)
            if place is not None:
                found.append(BarSupport(number, place, ROCKER, other.name, is_assumed=True))
    return found


def _ends_of_frame(bars: Sequence[SteelElement]) -> list[BarSupport]:
    """Return supports on the ground under the lowest ends of bars at both ends of what hangs together."""
    ends = [(bar, point) for bar in bars for point in (bar.begin_m, bar.end_m)]
    along = np.array([float(point[0]) for _, point in ends])
    within = max(_NEAR_END_M, _NEAR_END * float(np.ptp(along)))
    found: list[BarSupport] = []
    for nearest in (along.min() + within, -(along.max() - within)):
        sign = 1.0 if nearest == along.min() + within else -1.0
        there = [end for end, x in zip(ends, along.tolist(), strict=True) if sign * x <= nearest]
        lowest = min(float(point[2]) for _, point in there)
        for bar, point in there:
            is_new = all(float(length(point - other.position_m)) > WIDEST_M for other in found)
            if float(point[2]) <= lowest + WIDEST_M and is_new:
                found.append(BarSupport(bar.number, point, ROCKER, GROUND_NAME, is_assumed=True))
    return _with_one_pinned(found)


def _end_near(bar: SteelElement, position_m: np.ndarray) -> int | None:
    """Return the end of a bar, 0 or 1, that a position is near; None for one between its ends."""
    along = float(dot(position_m - bar.begin_m, bar.along))
    size = float(bar.steel_section.size_m.max())
    if along < size:
        return 0
    return 1 if along > bar.length_m - size else None


def _moved_into(solid: TriangleMesh, other: TriangleMesh, shift: tuple[float, float, float]) -> np.ndarray | None:
    """Return the middle of what a solid has in common with another as it is moved; None where it has nothing."""
    common = to_manifold(solid).translate(shift) ^ to_manifold(other)
    return _middle(common) if common.volume() > _LEAST_M3 else None


def _middle(solid: Manifold) -> np.ndarray:
    low_x, low_y, low_z, high_x, high_y, high_z = solid.bounding_box()
    return np.array(((low_x + high_x) / 2.0, (low_y + high_y) / 2.0, (low_z + high_z) / 2.0))


def stronger(one: BarSupport, other: BarSupport) -> BarSupport:
    """Return the one of two supports at a node that holds more."""
    return one if _STRENGTH[one.kind] <= _STRENGTH[other.kind] else other
