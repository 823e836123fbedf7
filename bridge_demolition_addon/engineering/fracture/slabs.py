"""Solids cut so that shards end at given planes and boxes, and inclined ones, such as arches, square to their slope."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from manifold3d import Manifold

from ..arrays import FloatArray
from ..geometry.mesh import TriangleMesh
from ..geometry.solids import bodies, from_manifold, to_manifold
from ..geometry.turned_boxes import TurnedBox
from ..geometry.vectors import dot, unit
from .options import FractureOptions, PointDensity
from .shards import Fracture, fracture

_SAME_PLANE = 1e-7
"""Part of the solid's extent along the axis within which a plane lies in its end, and does not cut it."""

_THINNEST_M = 0.01
"""Thinner slices are not cut off: so far apart a plane and a face of a member may be meant to be the same."""

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


def cut_out(solid: TriangleMesh, box: TurnedBox) -> tuple[TriangleMesh, ...]:
    """Return the connected pieces of a solid around a box, then those in it; the solid itself outside the box.

    The sides of the box are planes that cut off one piece after the other, so that the pieces of a convex solid are.
    """
    rest, pieces = to_manifold(box.solid_in_own_axes(solid)), list[TriangleMesh]()
    for axis, (side, level) in product(range(3), enumerate(box.corners_m)):
        lower, upper = rest.bounding_box()[axis], rest.bounding_box()[3 + axis]
        outwards, level_m = 1.0 if side else -1.0, float(level[axis])
        beyond, within = (upper - level_m, level_m - lower) if side else (level_m - lower, upper - level_m)
        if within < _THINNEST_M:
            return (solid,)
        if beyond < _THINNEST_M:
            continue
        outside, rest = rest.split_by_plane((outwards * np.eye(3)[axis]).tolist(), outwards * level_m)
        pieces += _connected(outside, solid.volume)
    inside = _connected(rest, solid.volume)
    return tuple(map(box.solid_in_world, (*pieces, *inside))) if pieces and inside else (solid,)


def cut_through(
    solid: TriangleMesh, point_m: FloatArray, normal: FloatArray, box: TurnedBox | None = None
) -> tuple[TriangleMesh, ...]:
    """Return the connected pieces behind a plane, then those before it; the solid itself where it is not cut.

    With a box only what its part of the plane meets is cut, and that right through.
    """
    across = unit(normal)
    level_m = float(dot(across, point_m))
    if not _on_both_sides(solid.vertices, across, level_m, _THINNEST_M):
        return (solid,)
    if box is not None:
        bounds, box_m, turned = box.solid_in_own_axes(solid).bounds, box.corners_m, box.direction_in_own_axes(across)
        lower, upper = np.maximum(bounds[0], box_m[0]), np.minimum(bounds[1], box_m[1])
        beside = (upper - lower < np.minimum(_THINNEST_M, np.ptp(box_m, axis=0))).any()
        corners = np.array(list(product(*zip(lower, upper, strict=True))))
        own_level_m = float(dot(turned, box.in_own_axes(np.asarray(point_m, float)[None])[0]))
        if beside or not _on_both_sides(corners, turned, own_level_m, 0.0):
            return (solid,)
    before, behind = to_manifold(solid).split_by_plane(across.tolist(), level_m)
    return (*_connected(behind, solid.volume), *_connected(before, solid.volume))


def _on_both_sides(points_m: FloatArray, across: FloatArray, level_m: float, least_m: float) -> bool:
    """Return whether points (k, 3) lie on both sides of a plane, some at least so far from it."""
    heights_m = dot(points_m, across) - level_m
    return bool(heights_m.min() <= -least_m and heights_m.max() >= least_m)


def slab_between(solid: TriangleMesh, axis: int, lowest_m: float, highest_m: float) -> TriangleMesh:
    """Return the part of a solid between two planes across an axis; without faces where there is none."""
    normal = np.eye(3)[axis]
    kept = to_manifold(solid).trim_by_plane(normal.tolist(), lowest_m).trim_by_plane((-normal).tolist(), -highest_m)
    return from_manifold(kept)


def _connected(part: Manifold, volume: float) -> list[TriangleMesh]:
    return [from_manifold(*shells) for shells in bodies(part, smallest_volume=_RUBBISH * volume)]


_THROUGH = (1.0, 1.0, 100.0)
"""So long are shards across the slope that none ends within the thickness."""


def inclined_fracture(
    solid: TriangleMesh, shard_count: int, seed: int, options: FractureOptions, direction: tuple[float, float]
) -> Fracture:
    """Fracture a solid as `fracture` does, with no shard that ends within the thickness of plates cut so.

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
