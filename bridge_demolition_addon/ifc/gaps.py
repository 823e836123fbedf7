"""Gaps of some millimetres between members that are meant to lie on each other, closed by making one longer."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
from manifold3d import Manifold, OpType

from ..engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..model.bridge.member import Member
from .contacts import TOUCHING_M, NearbyMembers

_CONVEX = 1.02
"""Volume of a hull, by that of its solid, up to which the solid is made longer as a convex one."""

_LEVEL = 1e-3
"""Least vertical part of the normal of a face that looks up or down."""

_SIMPLER_M = 1e-5
"""By how much faces of a solid that was made longer may move, so that no slivers are left between prisms."""

STEEPEST = 0.1
"""Slope of what lies above up to which a bearing is brought to it with its whole face."""

_STANDING = ("pier", "pier cap", "abutment", "wall", "wing wall", "footing")
"""Kinds of members that something lies on."""

WAYS = [np.array(way) for way in ((0, 0, -1.0), (0, 0, 1.0), (0, 1.0, 0), (0, -1.0, 0), (1.0, 0, 0), (-1.0, 0, 0))]
"""Directions in which members are moved, down first."""

_CUTTING = ((1.0, 0.21, 0.13), (0.17, 1.0, 0.19), (0.11, 0.23, 1.0))
_CUTS, _LOST = (0.13, 0.29, 0.47, 0.61, 0.83), 1e-9
"""Planes by which a solid is cut to see whether it can be, where along it, and the part of it that may be lost then."""

_UNDER_DECKS = ("girder", "arch")
_ON_SOIL = ("approach slab", "fill")
_STAYING = ("footing", "approach slab", "deck", "pier", "pier cap")
_HARDLY, _MOST, _PARTS = 0.1, 0.8, (0.1, 0.2, 0.35, 0.5, 0.75)
"""Part of a face within the gap up to which a member hardly touches, part of it that it is to touch, and parts of the
gap by which it may be moved for that."""

_LEAST_FACE_M2 = 0.01
_HALF = 0.5
_LITTLE = 1e-3
"""Face that two members have to share, part of it that has to touch, and part of a member's volume in the other one up
to which it lies on that and not within it."""


def lengthened(solid: TriangleMesh, by_m: float) -> TriangleMesh:
    """Return a solid that is longer by so much at its top, or at its bottom where that is negative.

    It is what the solid passes through when it is moved up or down: prisms on all faces that look there.
    """
    whole = to_manifold(solid)
    if whole.hull().volume() <= _CONVEX * whole.volume():
        return from_manifold(Manifold.batch_hull([whole, whole.translate((0.0, 0.0, by_m))]))
    corners = solid.corners
    areas, normals = triangle_areas_and_normals(corners)
    ahead = corners[(np.sign(by_m) * normals[:, 2] > _LEVEL) & (areas > 0.0)]
    shift = np.array((0.0, 0.0, by_m))
    prisms = [Manifold.hull_points(np.concatenate([triangle, triangle + shift])) for triangle in ahead]
    return from_manifold(Manifold.batch_boolean([whole, *prisms], OpType.Add).simplify(_SIMPLER_M))


def cut_by(solid: TriangleMesh, others: Sequence[TriangleMesh]) -> TriangleMesh:
    """Return a solid without what it has in common with others."""
    rest = Manifold.batch_boolean([to_manifold(solid), *(to_manifold(other) for other in others)], OpType.Subtract)
    return from_manifold(rest.simplify(_SIMPLER_M))


def closed_gaps(members: Sequence[Member], gap_m: float, bars: Collection[str] = ()) -> tuple[list[Member], list[str]]:
    """Close small gaps between members, so that whole faces touch; return the members and notes on them.

    A pier or cap goes on upwards to what carries the road, and else downwards to what it stands on; a girder goes on
    upwards to its deck. Bars of steel, by their names, do that alone.
    """
    done, notes = list(members), []
    contacts = NearbyMembers([member.solid for member in members])
    for upper in range(len(done)):
        for lower in _nearly_under(contacts, upper, gap_m):
            if done[upper].kind in _ON_SOIL:
                continue
            if done[lower].kind in _STANDING and done[upper].kind not in _STANDING:
                longer, other, way = lower, upper, 1.0
            elif done[upper].kind in _STANDING:
                longer, other, way = upper, lower, -1.0
            elif done[upper].kind == "deck" and done[lower].kind in _UNDER_DECKS:
                longer, other, way = lower, upper, 1.0
            else:
                continue
            if done[longer].name in bars and done[other].kind != "deck":
                continue
            solid, reach_m = done[longer].solid, gap_m
            if done[longer].kind in _STANDING:
                reach_m += min(STEEPEST * float(np.ptp(solid.vertices[:, :2], axis=0).max()), 2.0 * gap_m)
            made = largest_body(cut_by(lengthened(solid, way * reach_m), [done[other].solid]))
            done[longer] = replace(done[longer], solid=made)
            contacts.replace(longer, made)
            if done[longer].name in bars:
                notes.append(
                    f"{done[other].name} has a haunch, up to {1e3 * reach_m:.0f} mm high, over {done[longer].name}"
                )
                continue
            verb = "carry" if way > 0.0 else "stand on"
            notes.append(
                f"{done[longer].name} is made longer, by up to {1e3 * reach_m:.0f} mm, to {verb} {done[other].name}"
            )
    return done, notes


def close_small_gaps(
    members: Sequence[Member], gap_m: float, staying: Collection[str] = ()
) -> tuple[list[Member], list[str]]:
    """Return members moved against what they hardly touch, and notes on them.

    Such as an edge beam along a curved deck: both have chords, and meet at some corners only. Members named in
    `staying` are not moved.
    """
    done, notes = list(members), []
    contacts = NearbyMembers([member.solid for member in members])
    for index, member in enumerate(members):
        if member.kind in _STAYING or member.name in staying:
            continue
        already = contacts.reached(member.solid, 0.0, but=index)
        if math.fsum(already.values()) > _LITTLE * member.solid.volume:
            continue
        near = [_faces(contacts, index, way, already, TOUCHING_M) for way in WAYS]
        far = [_faces(contacts, index, way, already, gap_m) for way in WAYS]
        best = int(np.argmax(far))
        if far[best] < _LEAST_FACE_M2 or math.fsum(near) >= _HARDLY * far[best]:
            continue
        shift_m = next(
            (
                part * gap_m
                for part in _PARTS
                if _faces(contacts, index, WAYS[best], already, part * gap_m) >= _MOST * far[best]
            ),
            gap_m,
        )
        solid = TriangleMesh(member.solid.vertices + WAYS[best] * shift_m, member.solid.triangles)
        done[index] = replace(member, solid=solid)
        contacts.replace(index, solid)
        notes.append(f"{member.name} is moved by {1e3 * shift_m:.1f} mm against what it hardly touches")
    return done, notes


def _faces(contacts: NearbyMembers, index: int, way: np.ndarray, already: Mapping[int, float], shift_m: float) -> float:
    """Return the area, m², with which a member meets others when it is moved by so much."""
    solid = contacts.solid(index)
    moved = TriangleMesh(solid.vertices + way * shift_m, solid.triangles)
    reached = contacts.reached(moved, 0.0, but=index)
    return math.fsum(max(volume - already.get(other, 0.0), 0.0) for other, volume in reached.items()) / shift_m


def _nearly_under(contacts: NearbyMembers, upper: int, gap_m: float) -> list[int]:
    """Return members that lie under one with a gap, or that touch it with less than half of the face there."""
    solid = contacts.solid(upper)
    shared, near, far = (contacts.reached(solid, -shift_m) for shift_m in (0.0, TOUCHING_M, gap_m))
    found = []
    for other in sorted(far.keys() - {upper}):
        already = shared.get(other, 0.0)
        whole_m2 = (far[other] - already) / gap_m
        touching_m2 = (near.get(other, 0.0) - already) / TOUCHING_M
        if whole_m2 > _LEAST_FACE_M2 and touching_m2 < _HALF * whole_m2 and already <= _LITTLE * solid.volume:
            found.append(other)
    return found


def keeps_volume_when_cut(solid: TriangleMesh) -> bool:
    """Return whether the parts of a solid have its volume when it is cut: False where the mesh intersects itself."""
    whole = to_manifold(solid)
    for normal in _CUTTING:
        levels = solid.vertices @ np.array(normal)
        for share in _CUTS:
            level = float(levels.min() + share * np.ptp(levels))
            pieces = [piece for part in whole.split_by_plane(normal, level) for piece in part.decompose()]
            if abs(math.fsum(piece.volume() for piece in pieces) - whole.volume()) > _LOST * whole.volume():
                return False
            if any(piece.volume() < 0.0 for piece in pieces):
                return False
    return True


def largest_body(solid: TriangleMesh) -> TriangleMesh:
    """Return the largest body of a solid: what is cut off it is a lip over the edge of what it was brought to."""
    pieces = to_manifold(solid).decompose()
    return solid if len(pieces) < 2 else from_manifold(max(pieces, key=lambda piece: piece.volume()))
