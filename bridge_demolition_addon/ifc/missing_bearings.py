"""Bearings that a file lacks: pads in the gap between a girder and what it ends just above."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box, from_manifold, to_manifold
from ..model.bridge.member import Member
from ..model.scenario.bearings import PINNED, ROCKER, Bearing
from .bearings import HIGHEST_PLINTH_M, SEAT_M
from .contacts import NearbyMembers
from .gaps import cut_by, largest_body, lengthened

_CARRYING = ("pier", "pier cap", "abutment", "wall", "girder", "footing")
"""Kinds of members that a girder or deck may lie on."""

_LONGEST_M, _WITHIN = 0.4, 0.9
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
    size = np.minimum((high - low)[:2], (_LONGEST_M, np.inf)) * (1.0, _WITHIN)
    if size.min() < _LEAST_M or high[2] <= low[2] or lowest <= low[2]:
        return None
    middle = (low + high)[:2] / 2.0
    column = box((*size.tolist(), top - float(low[2])), (*middle.tolist(), (top + float(low[2])) / 2.0))
    lowered = TriangleMesh(below.solid.vertices - (0.0, 0.0, SEAT_M), below.solid.triangles)
    pieces = to_manifold(cut_by(column, [member.solid, lowered])).decompose()
    # What is left above the member, or beside its web, is no pad.
    under = [piece for piece in pieces if piece.bounding_box()[2] < lowest + SEAT_M and piece.volume() > 0.0]
    if not under:
        return None
    solid = largest_body(from_manifold(max(under, key=lambda piece: -piece.bounding_box()[2])))
    return Pad(solid, member.name, below.name)
