"""Inclined solids, such as pieces of an arch, cut square to their slope."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import FloatArray
from ..geometry.mesh import TriangleMesh
from .options import FractureOptions, PointDensity
from .shards import Fracture, fracture

_THROUGH = (1.0, 1.0, 100.0)
"""So long are shards across the slope that none ends within the thickness."""


def inclined_fracture(
    solid: TriangleMesh, shard_count: int, seed: int, options: FractureOptions, direction: tuple[float, float]
) -> Fracture:
    """Return a solid in shards as `fracture` does, none of which ends within its thickness where plates are cut so.

    Parameters
    ----------
    direction
        Direction that the solid runs along, of length 1: along the road, and upwards. Its thickness is square to that.
    """
    if not options.through_plates or options.stretch is not None:
        return fracture(solid, shard_count, seed, options)
    along, up = direction
    density = options.density
    turned_density = density and PointDensity(lambda points: density.at(_turned(points, along, -up)), density.largest)
    own = replace(options, stretch=_THROUGH, density=turned_density)
    found = fracture(_turned_solid(solid, along, up), shard_count, seed, own)
    return replace(
        found,
        shards=tuple(_turned_solid(shard, along, -up) for shard in found.shards),
        centres=_turned(found.centres, along, -up),
        points=_turned(found.points, along, -up),
        faces=replace(
            found.faces,
            centres=_turned(found.faces.centres, along, -up),
            normals=_turned(found.faces.normals, along, -up),
        ),
    )


def _turned_solid(solid: TriangleMesh, along: float, up: float) -> TriangleMesh:
    return replace(solid, vertices=_turned(solid.vertices, along, up))


def _turned(vectors: FloatArray, along: float, up: float) -> FloatArray:
    """Return vectors (n, 3) with what runs in a direction, along the road and upwards, level along the road."""
    x, y, z = vectors.T
    return np.column_stack((along * x + up * z, y, along * z - up * x))
