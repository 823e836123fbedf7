"""What the faces of shards look like: cast, broken, or paved."""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum

import numpy as np

from ...engineering.fracture.gaps import is_cut
from ...engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..bridge.member import Member

ROAD_KINDS = ("deck", "bridge")
"""Members that carry the road on their upper face."""

_LEVEL = 0.9
"""Least height of the normal of a face that can be driven on: steeper than 25° is no road."""

_BELOW_TOP = 0.5
"""Part of the member's height within which the road is: the floor of a box girder is level too."""


class Finish(IntEnum):
    CAST = 0
    BROKEN = 1
    ROAD = 2


def finishes(
    shards: Sequence[TriangleMesh], members: Sequence[Member], member_of_shard: np.ndarray
) -> list[np.ndarray]:
    """Return the finish (t,) int of the triangles of each shard, before gaps are made.

    A face is broken where it does not lie in the surface of its member, and a road where it is level and near the top
    of a member that carries one.
    """
    return [_finish(shard, members[row]) for shard, row in zip(shards, member_of_shard.tolist(), strict=True)]


def _finish(shard: TriangleMesh, member: Member) -> np.ndarray:
    broken = is_cut(shard, member.solid)
    finish = np.where(broken, Finish.BROKEN, Finish.CAST)
    if member.kind in ROAD_KINDS:
        _, normals = triangle_areas_and_normals(shard.corners)
        # On a road that rises, heights are those that it would have on a level one.
        heights = member.without_skew(member.solid.vertices)[:, 2]
        bottom, top = heights.min(), heights.max()
        is_high = member.without_skew(shard.corners)[:, :, 2].min(axis=1) > top - _BELOW_TOP * (top - bottom)
        finish[~broken & is_high & (normals[:, 2] > _LEVEL)] = Finish.ROAD
    return finish
