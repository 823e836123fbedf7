"""Solids cut across an axis, so that shards end at given planes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold

from ..geometry.mesh import TriangleMesh
from ..geometry.solids import bodies, from_manifold, to_manifold

_SAME_PLANE = 1e-7
"""Part of the solid's extent along the axis within which a plane lies in its end, and does not cut it."""

_RUBBISH = 1e-12
"""Part of the solid's volume below which a piece is rounding."""


def slabs(solid: TriangleMesh, axis: int, positions_m: Sequence[float]) -> tuple[TriangleMesh, ...]:
    """Return the connected pieces of a solid between planes across an axis, from the lowest slab to the highest."""
    whole = to_manifold(solid)
    lower, upper = solid.bounds[0][axis], solid.bounds[1][axis]
    near = _SAME_PLANE * (upper - lower)
    cuts = sorted(position for position in set(positions_m) if lower + near < position < upper - near)
    pieces: list[TriangleMesh] = []
    for position in cuts:
        above, below = whole.split_by_plane(np.eye(3)[axis].tolist(), position)
        pieces += _connected(below, solid.volume)
        whole = above
    return (*pieces, *_connected(whole, solid.volume))


def slab_between(solid: TriangleMesh, axis: int, lowest_m: float, highest_m: float) -> TriangleMesh:
    """Return the part of a solid between two planes across an axis; without faces where there is none."""
    normal = np.eye(3)[axis]
    kept = to_manifold(solid).trim_by_plane(normal.tolist(), lowest_m).trim_by_plane((-normal).tolist(), -highest_m)
    return from_manifold(kept)


def _connected(part: Manifold, volume: float) -> list[TriangleMesh]:
    return [from_manifold(*shells) for shells in bodies(part, smallest_volume=_RUBBISH * volume)]
