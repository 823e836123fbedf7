"""Solids around hollows and corners, cut into parts that are convex, or nearly so.

A solid is cut along the plane of one of its own faces at an edge that points inwards. The plane that leaves least of
the parts' convex hulls empty cuts first.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np
from manifold3d import Manifold

from ..arrays import FloatArray, IntArray
from .mesh import TriangleMesh, triangle_areas_and_normals
from .solids import bodies, from_manifold, to_manifold
from .vectors import dot, length

EMPTY = 0.005
"""Part of a convex hull that may lie outside the solid: chords of a slightly curved side do."""

_MOST_PLANES = 12
"""Faces along which one cut is tried, those at the longest edges."""

_LEAST_BEND = 0.05
"""Sine of the angle by which faces bend inwards at an edge that counts, 3°."""

_LEAST_GAIN = 0.002
"""Part of the solid's volume by which a cut has to reduce what hulls have in excess."""

_LEAST_PIECE = 0.005
"""Part of the solid's volume that a piece has to have, to be a shard of its own."""

_SAME_DIRECTION = 0.998
"""Cosine of the angle between faces that count as one, 3.6°."""

_FLAT_M = 0.03
"""Distance from a plane up to which edges lie in it: a hollow that is flatter is none."""

_COMMON = 0.1
"""Part of a sliver's surface that it has to have in common, on both sides, with what it is sewn to."""

_RUBBISH = 1e-9
"""Part of the solid's volume below which a piece is rounding."""


def convex_parts(solid: TriangleMesh, most: int, least_m3: float = 0.0) -> tuple[TriangleMesh, ...]:
    """Return a solid as at most `most` touching parts without overlap that are convex; alone where it is itself.

    Fewer remain convex the fewer are allowed: the parts with most in excess are cut first. A solid stays whole where
    all parts but one are smaller than `least_m3`.
    """
    volume = solid.volume
    waiting = [_Part.of(shells) for shells in bodies(to_manifold(solid), _RUBBISH * volume)]
    done: list[_Part] = []
    while waiting and len(waiting) + len(done) < most:
        part = max(waiting, key=lambda part: part.excess_m3)
        waiting.remove(part)
        pieces = part.cut(volume) if part.excess_m3 > EMPTY * part.volume_m3 else []
        if 0 < len(pieces) <= most - len(waiting) - len(done):
            waiting += pieces
        else:
            done.append(part)
    parts = [*done, *waiting]
    if len([part for part in parts if part.volume_m3 >= least_m3]) == 1:
        return (solid,)
    return tuple(_without_films(part.body, _RUBBISH * volume) for part in parts)


class _Part:
    """A connected piece of a solid."""

    def __init__(self, body: Manifold):
        self.body = body
        self.volume_m3 = body.volume()
        self.excess_m3 = body.hull().volume() - self.volume_m3

    @classmethod
    def of(cls, shells: list[Manifold]) -> _Part:
        """Return the piece of an outer shell and the cavities in it."""
        return cls(shells[0] if len(shells) == 1 else Manifold.compose(shells))

    def cut(self, whole_m3: float) -> list[_Part]:
        """Return the pieces of the best cut through a part of a solid; none where no cut gains enough."""
        best: list[_Part] = []
        left_m3 = self.excess_m3 - _LEAST_GAIN * whole_m3
        for normal, offset in _planes_at_inward_edges(from_manifold(self.body)):
            halves = self.body.split_by_plane(normal.tolist(), float(offset))
            pieces = [_Part.of(shells) for half in halves for shells in bodies(half, _RUBBISH * self.volume_m3)]
            pieces = _without_slivers(pieces, _LEAST_PIECE * whole_m3, left_m3)
            excess_m3 = math.fsum(piece.excess_m3 for piece in pieces)
            if len(pieces) > 1 and excess_m3 < left_m3:
                best, left_m3 = pieces, excess_m3
        return best


def _without_films(body: Manifold, smallest_m3: float) -> TriangleMesh:
    """Return a piece without what sewing has left of it that encloses nothing."""
    mesh = from_manifold(body)
    return from_manifold(*itertools.chain(*bodies(to_manifold(mesh), smallest_m3)))


def _without_slivers(pieces: list[_Part], least_m3: float, most_excess_m3: float) -> list[_Part]:
    """Return pieces, each smaller one sewn to the neighbour with which it is most convex; none if one has none.

    None either where the pieces would have more in excess than `most_excess_m3`: a sliver takes no more away than it
    fills.
    """
    kept = [piece for piece in pieces if piece.volume_m3 >= least_m3]
    slivers = [piece for piece in pieces if piece.volume_m3 < least_m3]
    filled_m3 = math.fsum(sliver.volume_m3 for sliver in slivers)
    if slivers and math.fsum(piece.excess_m3 for piece in kept) - filled_m3 > most_excess_m3 + least_m3:
        return []
    for sliver in slivers:
        united = [_Part(piece.body + sliver.body) for piece in kept]
        beside = [index for index, whole in enumerate(united) if _have_joined(kept[index], sliver, whole)]
        if not beside:
            return []
        index = min(beside, key=lambda index: united[index].excess_m3 - kept[index].excess_m3)
        kept[index] = united[index]
    return kept


def _have_joined(first: _Part, second: _Part, whole: _Part) -> bool:
    """Return whether two pieces had a face in common that is gone from their union on both sides."""
    area_m2 = second.body.surface_area()
    lost_m2 = first.body.surface_area() + area_m2 - whole.body.surface_area()
    return bool(lost_m2 > _COMMON * area_m2)


def _planes_at_inward_edges(mesh: TriangleMesh) -> Iterator[tuple[FloatArray, float]]:
    """Yield planes, normal (3,) and offset, along faces at edges that point inwards, longest edges first.

    Faces that are warped lie on both sides of one plane, and it would leave films of them: of each there are two
    planes, between which all such edges are.
    """
    normals, ends, lengths = _faces_at_inward_edges(mesh)
    offsets = dot(normals[:, None], ends)
    left = lengths.copy()
    for _ in range(_MOST_PLANES):
        if not left.any():
            return
        row = int(left.argmax())
        normal = normals[row]
        turned = np.where(dot(normals, normal) < 0.0, -1.0, 1.0)
        apart = abs(dot(ends, normal) - offsets[row].mean()).max(axis=1)
        alike = (turned * dot(normals, normal) > _SAME_DIRECTION) & (apart < _FLAT_M)
        alike[row] = True
        heights = dot(ends[alike], normal)
        left[alike] = 0.0
        lowest, highest = float(heights.min()), float(heights.max())
        yield normal, lowest
        if lowest != highest:
            yield normal, highest


def _faces_at_inward_edges(mesh: TriangleMesh) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return normals (f, 3) of faces at edges that point inwards, ends (f, 2, 3) of the edges, and lengths (f,)."""
    areas, normals = triangle_areas_and_normals(mesh.corners)
    first, second, ends = _edges_between(mesh.triangles)
    flat = (areas[first] > 0.0) & (areas[second] > 0.0)
    first, second, ends = first[flat], second[flat], ends[flat]
    corners = mesh.vertices[ends]
    along = corners[:, 1] - corners[:, 0]
    lengths = length(along)
    # Seen along an edge as the first face walks it, faces that bend inwards turn the other way than at a box's edge.
    inward = dot(np.cross(normals[first], normals[second]), along) < -_LEAST_BEND * lengths
    faces = np.concatenate((first[inward], second[inward]))
    return normals[faces], np.tile(corners[inward], (2, 1, 1)), np.tile(lengths[inward], 2)


def _edges_between(triangles: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Return the triangles (e,) on both sides of each edge, and its ends (e, 2) as the first of them walks it."""
    count = len(triangles)
    walks = np.concatenate([triangles[:, [corner, (corner + 1) % 3]] for corner in range(3)])
    owner = np.tile(np.arange(count), 3)
    order = np.lexsort((walks[:, 0] > walks[:, 1], *np.sort(walks, axis=1).T))
    upward, downward = order[0::2], order[1::2]
    return owner[upward], owner[downward], walks[upward]
