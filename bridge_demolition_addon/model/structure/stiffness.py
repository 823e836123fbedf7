"""How stiff the connections of a model are, by their faces, materials, and the length of shards behind them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.elasticity.section_stiffness import SectionStiffness, section_stiffness
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import dot
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.section_forces import section_axes
from ...engineering.structure.connections import GROUND, Connections
from ...errors import GeometryError
from ..bridge.member import Member

_DEEP = 0.75
"""Part of a member's extent from which on a shard counts as being as deep as the member."""


def connection_stiffness(
    connections: Connections,
    second_moments_m4: np.ndarray,
    joints: Sequence[Joint],
    joint_of_connection: np.ndarray,
    shards: Sequence[TriangleMesh],
    points_m: np.ndarray,
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    fixed: np.ndarray,
) -> SectionStiffness:
    """Return the stiffness of m connections.

    `points_m` (n, 3) are those whose Voronoi cells the shards are: from there the shards' length to a face counts.
    `member_of_shard` (n,) and `joint_of_connection` (m,) are indices; `fixed` (n,) shards do not deform.
    """
    without = np.flatnonzero(connections.areas <= 0.0)
    if len(without):
        first, second = connections.pairs[without[0]].tolist()
        raise GeometryError(
            f"{len(without)} connections have no area, the first between shards {first} and {second}: elastic "
            "connections need shared faces"
        )
    young, shear = (
        np.array([getattr(joint.moduli, name) for joint in joints])[joint_of_connection]
        for name in ("young_pa", "shear_pa")
    )
    ends = connections.pairs.T
    deforms = np.append(~fixed, False)[ends]  # the ground, at index -1, does not
    depths = np.abs(dot(connections.points - points_m[ends], connections.normals)) * deforms
    axes = section_axes(connections.normals)[:, :, 1:]
    deep = [
        _is_deep(bodies, axes, shards, members, member_of_shard) | ~moves[:, None]
        for bodies, moves in zip(ends, deforms, strict=True)
    ]
    return section_stiffness(young, shear, connections.areas, second_moments_m4, depths.sum(axis=0), deep[0] & deep[1])


def _is_deep(
    chosen: np.ndarray,
    axes: np.ndarray,
    shards: Sequence[TriangleMesh],
    members: Sequence[Member],
    member_of_shard: np.ndarray,
) -> np.ndarray:
    """Return whether shards (m,) are as deep as their members along axes (m, 3, 2); the ground is."""
    deep = np.ones((len(chosen), 2), bool)
    for row, shard in enumerate(chosen.tolist()):
        if shard == GROUND:
            continue
        member = members[member_of_shard[shard]].solid.vertices
        for side in range(2):
            axis = axes[row, :, side]
            deep[row, side] = np.ptp(dot(shards[shard].vertices, axis)) >= _DEEP * np.ptp(dot(member, axis))
    return deep
