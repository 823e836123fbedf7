"""How much of each body stands free, as seen from the charges.

Rays go from every charge to every body: to its centre of mass, and to the points half-way from there to the vertices of
its hull. A ray is stopped by the convex hull of any other body that it passes through; the visible share is that of
the rays that are not. A wave also bends round edges, which is not modelled: behind anything narrow the load is more
than this share. A body that holds the charge stops nothing: it is what the charge breaks.
"""

from itertools import pairwise

import numpy as np

from ..geometry.hulls import ConvexHulls
from ..geometry.proximity import ranges
from ..geometry.vectors import dot, transformed, transformed_back

GRAZING_M = 1e-3
"""Hulls stop rays this much inside their faces, so that none is stopped between bodies that touch, or by rounding."""

_HALF_WAY = 0.5
"""Where between centre and vertices the rays end: well inside the body, which so is never hidden by one it touches."""

_PAIRS_AT_ONCE = 1_000_000
"""Ray-and-body or ray-and-face pairs looked at in one array operation: some tens of megabytes."""


def visible_shares(hulls: ConvexHulls, centres: np.ndarray, rotations: np.ndarray, sources: np.ndarray) -> np.ndarray:
    """Shares of the bodies that the charges see.

    Parameters
    ----------
    hulls
        Convex hulls of n bodies.
    centres, rotations
        (n, 3) centres of mass in m, and (n, 3, 3) from the axes of each body to those of the world.
    sources
        (c, 3) places of the charges, m.

    Returns
    -------
    numpy.ndarray
        (n, c) from 0, hidden, to 1, free.
    """
    owners, targets = _targets(hulls, centres, rotations)
    counts = np.bincount(owners, minlength=len(hulls))
    shares = np.zeros((len(hulls), len(sources)))
    for column, source in enumerate(sources):
        shields = ~_holding(hulls, centres, rotations, source)
        stopped = np.zeros(len(targets), bool)
        for first, last in _blocks(np.full(len(targets), len(hulls))):
            rays, bodies = _near_misses(hulls, centres, source, targets[first:last])
            rays += first
            others = (owners[rays] != bodies) & shields[bodies]
            rays, bodies = rays[others], bodies[others]
            passing = _pass_through(hulls, centres, rotations, source, targets[rays], bodies)
            stopped[rays[passing]] = True
        shares[:, column] = np.bincount(owners, ~stopped, len(hulls)) / counts
    return shares


def _targets(hulls: ConvexHulls, centres: np.ndarray, rotations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bodies (t,) and places (t, 3) that rays go to."""
    bodies = np.arange(len(hulls))
    owners = np.repeat(bodies, np.diff(hulls.vertex_starts))
    half_way = centres[owners] + _HALF_WAY * transformed(rotations[owners], hulls.vertices)
    return np.concatenate((bodies, owners)), np.concatenate((centres, half_way))


def _holding(hulls: ConvexHulls, centres: np.ndarray, rotations: np.ndarray, source: np.ndarray) -> np.ndarray:
    """Which bodies (n,) hold a charge."""
    if not len(hulls):
        return np.zeros(0, bool)
    local = transformed_back(rotations, source - centres)
    outside_by = dot(hulls.normals, local[hulls.bodies]) - hulls.offsets
    return np.maximum.reduceat(outside_by, hulls.starts[:-1]) <= 0.0


def _near_misses(
    hulls: ConvexHulls, centres: np.ndarray, source: np.ndarray, targets: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Rows of targets (t, 3), and the bodies whose bounding spheres the rays to them touch."""
    rays, others = targets - source, centres - source
    along, squares = dot(rays[:, None], others), dot(rays, rays)[:, None]
    nearest = np.clip(np.divide(along, squares, out=np.zeros(along.shape), where=squares > 0.0), 0.0, 1.0)
    distances = dot(others, others) - nearest * (2.0 * along - nearest * squares)
    return np.nonzero(distances < hulls.radii**2)


def _pass_through(
    hulls: ConvexHulls,
    centres: np.ndarray,
    rotations: np.ndarray,
    source: np.ndarray,
    targets: np.ndarray,
    bodies: np.ndarray,
) -> np.ndarray:
    """Whether rays to targets (k, 3) pass through the bodies (k,) that they are paired with."""
    rays = transformed_back(rotations[bodies], targets - source)
    origins = transformed_back(rotations[bodies], source - centres[bodies])
    counts = np.diff(hulls.starts)[bodies]
    passing = np.zeros(len(bodies), bool)
    for first, last in _blocks(counts):
        rows, faces = ranges(hulls.starts[bodies[first:last]], counts[first:last])
        passing[first:last] = _cross(hulls, rows, faces, origins[first:last], rays[first:last])
    return passing


def _cross(
    hulls: ConvexHulls, rows: np.ndarray, faces: np.ndarray, origins: np.ndarray, rays: np.ndarray
) -> np.ndarray:
    """Whether rays (k, 3) cross hulls, given as faces with the row of the ray: what all half-spaces leave of each."""
    normals = hulls.normals[faces]
    slopes = dot(normals, rays[rows])
    rooms = hulls.offsets[faces] - GRAZING_M - dot(normals, origins[rows])
    # Along a face there is no crossing: either all of the ray is behind it or nothing.
    crossings = np.divide(rooms, slopes, out=np.where(rooms < 0.0, -np.inf, np.inf), where=slopes != 0.0)
    entries = np.where(slopes < 0.0, crossings, 0.0)
    exits = np.where(slopes < 0.0, 1.0, crossings)
    starts = np.searchsorted(rows, np.arange(len(rays)))
    return np.maximum.reduceat(entries, starts).clip(min=0.0) < np.minimum.reduceat(exits, starts).clip(max=1.0)


def _blocks(counts: np.ndarray) -> list[tuple[int, int]]:
    """Rows from and to, so that the counts (k,) of each block add up to some `_PAIRS_AT_ONCE`."""
    block_of = np.cumsum(counts) // _PAIRS_AT_ONCE
    edges = np.flatnonzero(np.diff(block_of)) + 1
    return [(first, last) for first, last in pairwise([0, *edges.tolist(), len(counts)]) if first < last]
