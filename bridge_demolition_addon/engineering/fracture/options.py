"""Options of cutting a solid: density of its points, finer near positions or where painted, stretch and recursion; and
plates, whose shards go through them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import GeometryError
from ..arrays import FloatArray
from ..geometry.mesh import TriangleMesh
from ..geometry.solids import hull
from ..geometry.vectors import distance

_PAIRS_PER_BLOCK = 2_000_000
"""Distances computed in one go; bounds the memory."""


@dataclass(frozen=True, slots=True)
class PointDensity:
    """Relative density of points: `at` gives it (n,) at positions (n, 3) in m; it is above 0 and at most `largest`."""

    at: Callable[[FloatArray], FloatArray]
    largest: float


@dataclass(frozen=True, slots=True)
class Recursion:
    """Shards that are cut again: a random `share` of those that hold at least `smallest_m3`, each into `shards`."""

    share: float
    shards: int
    smallest_m3: float = 0.0


@dataclass(frozen=True, slots=True)
class FractureOptions:
    """Density, disorder and stretch of the shards of a solid, and which are cut again."""

    density: PointDensity | None = None  # where points lie closer; evenly by default
    # How far points are moved at random, as a part of a shard's mean size (volume / shards)^(1/3): sampled points stay
    # as random as they are, chosen ones lose their order.
    noise: float = 0.0
    # Relative lengths of shards along x, y and z; by default alike, or through plates.
    stretch: tuple[float, float, float] | None = None
    through_plates: bool = False  # where no stretch is given, no shard ends within the thickness of a plate
    recursion: Recursion | None = None


PLAIN = FractureOptions()
"""Points sampled evenly, and nothing else."""


def density_around(positions_m: FloatArray, radii_m: Sequence[float], factors: Sequence[float]) -> PointDensity:
    """Density `factor`, at least 1, in each position (k, 3), that falls evenly to 1 at its radius.

    Where several overlap, the largest counts.
    """
    positions = np.asarray(positions_m, dtype=float).reshape(-1, 3)
    radii, surplus = np.asarray(radii_m, dtype=float), np.asarray(factors, dtype=float) - 1.0

    def at(points: FloatArray) -> FloatArray:
        distances = distance(points[:, None], positions)
        densities: FloatArray = 1.0 + (surplus * np.maximum(0.0, 1.0 - distances / radii)).max(axis=1, initial=0.0)
        return densities

    return PointDensity(at, 1.0 + float(surplus.max(initial=0.0)))


def densest(densities: Sequence[PointDensity]) -> PointDensity:
    """The largest of one or more densities, everywhere."""
    return PointDensity(
        lambda points: np.array([density.at(points) for density in densities]).max(axis=0),
        max(density.largest for density in densities),
    )


def painted_density(points_m: FloatArray, weights: FloatArray, factor: float) -> PointDensity:
    """Density between 1, where nothing is painted, and `factor`, at least 1, where the paint is full.

    Weights (k,), from 0 to 1, are known at points (k, 3), such as a mesh's vertices. Between these they are
    interpolated by inverse squared distances: D. Shepard (1968), A two-dimensional interpolation function for
    irregularly-spaced data, Proc. 23rd ACM National Conference, 517-524.
    """
    known, weights = np.asarray(points_m, dtype=float).reshape(-1, 3), np.asarray(weights, dtype=float)
    if not len(known) or len(known) != len(weights):
        raise GeometryError(f"{len(known)} painted points have {len(weights)} weights; give each point one.")
    if not ((weights >= 0.0) & (weights <= 1.0)).all() or not factor >= 1.0:
        raise GeometryError("Painted weights go from 0 to 1, and the factor of the density is at least 1.")

    def at(points: FloatArray) -> FloatArray:
        rows = max(1, _PAIRS_PER_BLOCK // len(known))
        blocks = [_shepard(points[first : first + rows], known, weights) for first in range(0, len(points), rows)]
        return 1.0 + (factor - 1.0) * np.concatenate([np.zeros(0), *blocks])

    return PointDensity(at, factor)


def _shepard(points: FloatArray, known: FloatArray, weights: FloatArray) -> FloatArray:
    # A position on a painted point takes its weight: the least distance keeps the division finite.
    pull = 1.0 / np.square(np.maximum(distance(points[:, None], known), 1e-9))
    return np.clip((pull * weights).sum(axis=1) / pull.sum(axis=1), 0.0, 1.0)


_THINNEST = 0.5
"""Least length by the next one up to which a solid is a plate. Slabs and walls of EN 1992-1-1, 5.3.1, are wider than
four times their thickness; strips of them are not, and skewed ones are longer along the axes."""

_FULL = 0.9
"""Part of its convex hull that a plate fills: box girders, T-sections and frames do not."""

_THROUGH = 100.0
"""So long are shards along the thickness that none ends within it."""


def through_thickness(solid: TriangleMesh) -> tuple[float, float, float] | None:
    """Return the stretch of shards that go through the whole thickness of a plate, None for any other solid."""
    lower, upper = solid.bounds
    lengths = upper - lower
    thickness, width, _ = sorted(lengths.tolist())
    if thickness > _THINNEST * width or solid.volume < _FULL * hull(solid.vertices).volume():
        return None
    x, y, z = (_THROUGH if axis == lengths.argmin() else 1.0 for axis in range(3))
    return x, y, z
