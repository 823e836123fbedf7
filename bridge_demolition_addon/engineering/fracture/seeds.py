"""Points sampled from a solid at random, evenly or by a density."""

from collections.abc import Sequence
from functools import partial

import numpy as np
from manifold3d import Manifold

from ...errors import GeometryError
from ..arithmetic import cube_root
from ..arrays import FloatArray, IntArray
from ..geometry.mesh import TriangleMesh
from ..geometry.solids import bodies, contains, from_manifold, to_manifold
from ..geometry.vectors import dot
from .options import PointDensity

_MOST_MOVES = 20
"""Tries to move a point without leaving the solid, before it stays: points in corners rarely need more."""

_FILLED_ENOUGH = 0.3
"""Part of its box that a part of the solid must fill before points are tried in the box without dicing it further."""


def random_points(
    solid: TriangleMesh, count: int, generator: np.random.Generator, density: PointDensity | None = None
) -> FloatArray:
    """Points (count, 3) sampled from the volume, evenly or by a density; of several bodies each gets one first."""
    if count < 1:
        raise GeometryError(f"A solid cannot be cut into {count} shards; ask for at least one.")
    whole = to_manifold(solid)
    separate = bodies(whole)
    if count < len(separate):
        raise GeometryError(
            f"The solid consists of {len(separate)} separate bodies and cannot be cut into {count} shards; ask for at "
            f"least {len(separate)} or unite the bodies."
        )
    parts = [to_manifold(from_manifold(*shells)) for shells in separate] if len(separate) > 1 else []
    sampled = _uniform if density is None else partial(_by_density, density=density)
    firsts = [sampled(part, 1, generator) for part in parts]
    return np.concatenate([*firsts, sampled(whole, count - len(firsts), generator)])


def moved_points(solid: TriangleMesh, points: FloatArray, most_m: float, generator: np.random.Generator) -> FloatArray:
    """Points (n, 3) moved at random by up to `most_m`, each as soon as a move does not lead out of the solid."""
    moved, waiting = points.copy(), np.arange(len(points))
    for _ in range(_MOST_MOVES):
        distances = most_m * cube_root(generator.random(len(waiting)))
        tried = points[waiting] + distances[:, None] * _directions(len(waiting), generator)
        inside = contains(solid, tried)
        moved[waiting[inside]] = tried[inside]
        waiting = waiting[~inside]
        if not len(waiting):
            break
    return moved


def _directions(count: int, generator: np.random.Generator) -> FloatArray:
    """Unit vectors (count, 3), all directions alike, from uniform numbers alone, which are exact on every processor.

    G. Marsaglia (1972), Choosing a point from the surface of a sphere, Annals of Mathematical Statistics 43, 645-646.
    """
    in_circle = np.zeros((0, 2))
    while len(in_circle) < count:
        tried = generator.uniform(-1.0, 1.0, (2 * (count - len(in_circle)), 2))
        in_circle = np.concatenate([in_circle, tried[dot(tried, tried) < 1.0]])[:count]
    squares = dot(in_circle, in_circle)
    return np.column_stack((in_circle * (2.0 * np.sqrt(1.0 - squares))[:, None], 1.0 - 2.0 * squares))


def _by_density(solid: Manifold, count: int, generator: np.random.Generator, density: PointDensity) -> FloatArray:
    """Points (count, 3) by rejection: of evenly sampled ones as many stay as the density says."""
    points = np.zeros((0, 3))
    while len(points) < count:
        tried = _uniform(solid, count - len(points), generator)
        stays = generator.random(len(tried)) * density.largest < density.at(tried)
        points = np.concatenate([points, tried[stays]])
    return points


def _uniform(solid: Manifold, count: int, generator: np.random.Generator) -> FloatArray:
    """Points (count, 3) in the solid, which is diced first, so that few of the points tried miss it."""
    # Halved so often at most, there are not many more dice than points.
    dice = _diced(solid, int(count).bit_length())
    counts = [count] if len(dice) == 1 else _shared_out(count, [part.volume() for part in dice], generator)
    return np.concatenate([_uniform_by_trial(part, some, generator) for part, some in zip(dice, counts, strict=True)])


def _shared_out(count: int, volumes: Sequence[float], generator: np.random.Generator) -> IntArray:
    """Numbers of points (k,) in each part, at random by volume.

    The generator's own multinomial numbers come from logarithms that differ by processor.
    """
    ends = np.cumsum(volumes)
    return np.bincount(np.searchsorted(ends, generator.random(count) * ends[-1], side="right"), minlength=len(ends))


def _diced(solid: Manifold, depth: int) -> list[Manifold]:
    box = np.reshape(solid.bounding_box(), (2, 3))
    size = box[1] - box[0]
    if depth == 0 or solid.volume() > _FILLED_ENOUGH * size.prod():
        return [solid]
    axis = int(np.argmax(size))
    halves = solid.split_by_plane(np.eye(3)[axis].tolist(), float(box[:, axis].mean()))
    return [part for half in halves if half.volume() > 0 for part in _diced(half, depth - 1)]


def _uniform_by_trial(solid: Manifold, count: int, generator: np.random.Generator) -> FloatArray:
    lower, upper = np.reshape(solid.bounding_box(), (2, 3))
    mesh = from_manifold(solid)
    points = np.zeros((0, 3))
    while len(points) < count:
        tries = int((count - len(points)) * (upper - lower).prod() / solid.volume()) + 1
        candidates = lower + generator.random((tries, 3)) * (upper - lower)
        points = np.concatenate([points, candidates[contains(mesh, candidates)]])
    return points[:count]
