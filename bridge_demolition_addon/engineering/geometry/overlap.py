"""Common volumes of solids: cut off where members are made, and searched for where nothing may overlap."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold, OpType

from ...errors import GeometryError
from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh
from .proximity import boxes_that_meet
from .solids import OVERLAP_TOLERANCE, bodies, from_manifold, hull, is_film, to_manifold

SHARD_OVERLAP_TOLERANCE = 1e-6
"""Part of the smaller of two shards' volumes that they may have in common at the start: too little to push them."""

_ROUNDING = 1e-9
"""Part of a member's volume below which a loose piece that is left of it is rounding."""


@dataclass(frozen=True, slots=True)
class Overlaps:
    """Pairs of meshes that overlap, the largest volume first: indices (k, 2), and common volumes (k,) in m³."""

    pairs: IntArray
    volumes: FloatArray

    def __len__(self) -> int:
        return len(self.volumes)


def overlaps(meshes: Sequence[TriangleMesh], tolerance: float = SHARD_OVERLAP_TOLERANCE) -> Overlaps:
    """Pairs of closed meshes, such as shards, that have more than a part of the smaller volume in common."""
    solids = [_manifold(mesh, index) for index, mesh in enumerate(meshes)]
    volumes = np.array([solid.volume() for solid in solids])
    boxes = np.array([solid.bounding_box() for solid in solids]).reshape(-1, 2, 3)
    pairs = boxes_that_meet(boxes[:, 0], boxes[:, 1], 0.0)
    common = np.array([(solids[one] ^ solids[other]).volume() for one, other in pairs])
    large = np.flatnonzero(common > tolerance * volumes[pairs].min(axis=1)) if len(pairs) else np.zeros(0, int)
    order = large[np.argsort(-common[large], kind="stable")]
    return Overlaps(pairs[order], common[order] if len(order) else np.zeros(0))


def hulls(shards: Sequence[TriangleMesh]) -> list[TriangleMesh]:
    """Convex hulls of shards, which Blender takes them for where they collide."""
    return [from_manifold(hull(shard.vertices)) for shard in shards]


def separated(solids: Sequence[TriangleMesh], names: Sequence[str]) -> tuple[list[TriangleMesh], FloatArray]:
    """Closed solids without what they have in common with those before them, and the volumes (n,) cut off them, m³.

    An unchanged solid is the same object.
    """
    whole = [to_manifold(solid, name) for solid, name in zip(solids, names, strict=True)]
    result, removed = list(solids), np.zeros(len(solids))
    for index, solid in enumerate(whole):
        before = [other for other in whole[:index] if (solid ^ other).volume() > OVERLAP_TOLERANCE * solid.volume()]
        if not before:
            continue
        rest = Manifold.batch_boolean([solid, *before], OpType.Subtract)
        left = bodies(rest, _ROUNDING * solid.volume(), names[index])
        shells = [shell for body in left if not is_film(body) for shell in body]
        if rest.volume() <= _ROUNDING * solid.volume() or not shells:
            raise GeometryError(
                f"{names[index]}: lies wholly inside members before it; leave it out, or name it first."
            )
        result[index] = from_manifold(*shells)
        removed[index] = solid.volume() - rest.volume()
        whole[index] = to_manifold(result[index], names[index])
    return result, removed


def _manifold(mesh: TriangleMesh, index: int) -> Manifold:
    solid = to_manifold(mesh, f"Mesh {index}")
    if solid.is_empty():
        raise GeometryError(f"Mesh {index} holds no volume; it cannot be checked for overlap.")
    return solid
