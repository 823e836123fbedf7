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

    An unchanged solid is the same object. A `GeometryError` names every solid that is cut away whole.
    """
    whole = [to_manifold(solid, name) for solid, name in zip(solids, names, strict=True)]
    result, removed = list(solids), np.zeros(len(solids))
    gone: list[str] = []
    for index, solid in enumerate(whole):
        before = [other for other in whole[:index] if (solid ^ other).volume() > OVERLAP_TOLERANCE * solid.volume()]
        if not before:
            continue
        rest = Manifold.batch_boolean([solid, *before], OpType.Subtract)
        shells = shells_left(rest, solid.volume(), names[index])
        if not shells:
            gone.append(names[index])
            whole[index] = Manifold()
            continue
        result[index] = from_manifold(*shells)
        removed[index] = solid.volume() - rest.volume()
        whole[index] = to_manifold(result[index], names[index])
    if gone:
        raise GeometryError(_wholly_inside(gone))
    return result, removed


def shells_left(rest: Manifold, whole_m3: float, name: str) -> list[Manifold]:
    """Shells of what is left of a solid, without films; none where it is all rounding."""
    least_m3 = _ROUNDING * whole_m3
    if rest.volume() <= least_m3:
        return []
    return [shell for body in bodies(rest, least_m3, name) if not is_film(body) for shell in body]


def _wholly_inside(names: Sequence[str]) -> str:
    if len(names) == 1:
        return f"{names[0]}: lies wholly inside members before it; leave it out, or name it first."
    return f"{', '.join(names)}: lie wholly inside members before them; leave them out, or name them first."


def _manifold(mesh: TriangleMesh, index: int) -> Manifold:
    solid = to_manifold(mesh, f"Mesh {index}")
    if solid.is_empty():
        raise GeometryError(f"Mesh {index} holds no volume; it cannot be checked for overlap.")
    return solid
