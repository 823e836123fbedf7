"""Where a line passes from one of some closed meshes that fill a solid into the next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .mesh import TriangleMesh
from .vectors import cross, distance, dot

_NUDGE_M = np.array((1.1e-6, 1.7e-6, 2.3e-6))
"""The line is looked for this far beside where it is: on an edge of triangles it would be on both of its sides."""

_GAP_M = 1e-4
"""Part of the line up to which it may be in no mesh: by that nudge and by rounding."""


@dataclass(frozen=True, slots=True, eq=False)
class Passages:
    """Where a line passes from mesh to mesh, k times. `gap_m` is how far along it first leaves all of them, or None."""

    first: IntArray  # (k,), meshes that it leaves
    second: IntArray  # (k,), meshes that it enters
    distances_m: FloatArray  # (k,), along the line from its start
    points_m: FloatArray  # (k, 3)
    directions: FloatArray  # (k, 3), of the line there, of length 1
    gap_m: float | None


def passages(path_m: FloatArray, meshes: Sequence[TriangleMesh]) -> Passages:
    """Return where a line through points (p, 3) passes from mesh to mesh."""
    lengths = distance(path_m[1:], path_m[:-1])
    ends = np.concatenate((np.zeros(1), np.cumsum(lengths)))
    stays = sorted(stay for number, mesh in enumerate(meshes) for stay in _stays(path_m, ends, mesh, number))
    first, second, at, gap_m = [], [], [], None
    reached, before = 0.0, -1
    for begin, end, number in stays:
        if begin > reached + _GAP_M:
            break
        if before >= 0 and number != before:
            first.append(before)
            second.append(number)
            at.append(begin)
        reached, before = max(reached, end), number
    if reached < ends[-1] - _GAP_M:
        gap_m = float(reached)
    distances = np.array(at, float)
    segments = np.clip(np.searchsorted(ends, distances, "right") - 1, 0, len(lengths) - 1)
    along = (path_m[segments + 1] - path_m[segments]) / lengths[segments][:, None]
    points = path_m[segments] + (distances - ends[segments])[:, None] * along
    return Passages(np.array(first, int), np.array(second, int), distances, points, along, gap_m)


def _stays(path_m: FloatArray, ends: FloatArray, mesh: TriangleMesh, number: int) -> list[tuple[float, float, int]]:
    """Return from where to where along the line it is in a mesh, with the number of the mesh."""
    lowest, highest = mesh.bounds
    corners = mesh.corners
    begins: list[float] = []
    leaves: list[float] = []
    for start, stop, begin, end in zip(path_m[:-1], path_m[1:], ends[:-1], ends[1:], strict=True):
        low, high = np.minimum(start, stop), np.maximum(start, stop)
        if (low > highest + _GAP_M).any() or (high < lowest - _GAP_M).any():
            continue
        shares, outwards = _pierced(start + _NUDGE_M, stop - start, corners)
        at = begin + shares * (end - begin)
        begins += at[~outwards].tolist()
        leaves += at[outwards].tolist()
    if not begins and not leaves:
        return []
    begins, leaves = sorted(begins), sorted(leaves)
    if leaves and (not begins or leaves[0] < begins[0]):
        begins.insert(0, 0.0)
    if begins and (not leaves or leaves[-1] < begins[-1]):
        leaves.append(float(ends[-1]))
    return [(begin, end, number) for begin, end in zip(begins, leaves, strict=False)]


def _pierced(start: FloatArray, way: FloatArray, corners: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return where on its way (3,) from a point (3,) a line pierces triangles (t, 3, 3), and whether outwards.

    T. Möller and B. Trumbore (1997), Fast, minimum storage ray/triangle intersection, Journal of Graphics Tools 2 (1).
    """
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = cross(np.broadcast_to(way, other.shape), other)
    whole = dot(one, across)
    safe = np.where(whole == 0.0, 1.0, whole)
    away = start - corners[:, 0]
    first = dot(away, across) / safe
    beside = cross(away, one)
    second = dot(np.broadcast_to(way, beside.shape), beside) / safe
    share = dot(other, beside) / safe
    met = (whole != 0.0) & (first >= 0.0) & (second >= 0.0) & (first + second <= 1.0) & (share >= 0.0) & (share < 1.0)
    outwards: BoolArray = whole[met] < 0.0
    return share[met], outwards
