"""Which bodies stand behind others, as seen from the charges.

A ray goes from every charge to the centre of mass of every body; the body is shielded if the ray passes through the
convex hull of another. A wave also bends round edges, which is not modelled: a shielded body gets nothing, and that is
too little behind anything narrow. A body that holds the charge shields nothing: it is what the charge breaks.
"""

from itertools import pairwise

import numpy as np

from ..shared_faces import ranges
from .hulls import ConvexHulls

GRAZING_M = 1e-3
"""A ray that stays this short in a body passes between it and its neighbour; rounding does not shield."""

_PAIRS_AT_ONCE = 1_000_000
"""Ray-and-body or ray-and-face pairs looked at in one array operation: some tens of megabytes."""


def shielded(hulls: ConvexHulls, centres: np.ndarray, rotations: np.ndarray, sources: np.ndarray) -> np.ndarray:
    """Which bodies are hidden from which charges.

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
        (n, c) bool.
    """
    hidden = np.zeros((len(hulls), len(sources)), bool)
    bodies_at_once = max(1, _PAIRS_AT_ONCE // max(1, len(hulls)))
    for column, source in enumerate(sources):
        shields = ~_holding(hulls, centres, rotations, source)
        for start in range(0, len(hulls), bodies_at_once):
            targets = np.arange(start, min(start + bodies_at_once, len(hulls)))
            rays, others = _near_misses(hulls, centres, source, targets)
            other_than_itself = (targets[rays] != others) & shields[others]
            rays, others = targets[rays][other_than_itself], others[other_than_itself]
            hidden[_passing_through(hulls, centres, rotations, source, rays, others), column] = True
    return hidden


def _holding(hulls: ConvexHulls, centres: np.ndarray, rotations: np.ndarray, source: np.ndarray) -> np.ndarray:
    """Which bodies (n,) hold a charge."""
    if not len(hulls):
        return np.zeros(0, bool)
    local = np.einsum("nji,nj->ni", rotations, source - centres)
    outside_by = np.einsum("fi,fi->f", hulls.normals, local[hulls.bodies]) - hulls.offsets
    return np.maximum.reduceat(outside_by, hulls.starts[:-1]) <= 0.0


def _near_misses(
    hulls: ConvexHulls, centres: np.ndarray, source: np.ndarray, targets: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Rows of targets and bodies whose bounding spheres the rays to these targets touch."""
    rays, others = centres[targets] - source, centres - source
    squares = np.einsum("ti,ti->t", rays, rays)[:, None]
    part = np.clip(np.divide(rays @ others.T, squares, out=np.zeros((len(rays), len(others))), where=squares > 0), 0, 1)
    distances = (others**2).sum(axis=1) - part * (2.0 * rays @ others.T - part * squares)
    return np.nonzero(distances < hulls.radii**2)


def _passing_through(
    hulls: ConvexHulls,
    centres: np.ndarray,
    rotations: np.ndarray,
    source: np.ndarray,
    targets: np.ndarray,
    others: np.ndarray,
) -> np.ndarray:
    """Targets whose rays pass through the hulls of the other bodies (k,) they are paired with."""
    rays = np.einsum("kji,kj->ki", rotations[others], centres[targets] - source)
    origins = np.einsum("kji,kj->ki", rotations[others], source - centres[others])
    counts = np.diff(hulls.starts)[others]
    ends = np.cumsum(counts)
    found = [np.zeros(0, int)]
    for first, last in _blocks(ends):
        rows, faces = ranges(hulls.starts[others[first:last]], counts[first:last])
        inside = _length_inside(hulls, faces, rows, origins[first:last], rays[first:last])
        found.append(targets[first:last][inside > GRAZING_M])
    return np.concatenate(found)


def _blocks(ends: np.ndarray) -> list[tuple[int, int]]:
    """Rows from and to, so that each block has some `_PAIRS_AT_ONCE` faces."""
    if not len(ends):
        return []
    edges = np.searchsorted(ends, np.arange(_PAIRS_AT_ONCE, ends[-1], _PAIRS_AT_ONCE))
    edges = np.unique([0, *edges, len(ends)])
    return list(pairwise(edges))


def _length_inside(
    hulls: ConvexHulls, faces: np.ndarray, rows: np.ndarray, origins: np.ndarray, rays: np.ndarray
) -> np.ndarray:
    """How far rays (k, 3) run inside hulls, m: what all half-spaces of a hull leave of its ray."""
    normals = hulls.normals[faces]
    slopes = np.einsum("fi,fi->f", normals, rays[rows])
    rooms = hulls.offsets[faces] - np.einsum("fi,fi->f", normals, origins[rows])
    # Along a face there is no crossing: either all of the ray is behind it or nothing.
    crossings = np.divide(rooms, slopes, out=np.where(rooms < 0.0, -np.inf, np.inf), where=slopes != 0.0)
    entries = np.where(slopes < 0.0, crossings, 0.0)
    exits = np.where(slopes < 0.0, 1.0, crossings)
    starts = np.searchsorted(rows, np.arange(len(rays)))
    entry = np.maximum(np.maximum.reduceat(entries, starts), 0.0)
    leaving = np.minimum(np.minimum.reduceat(exits, starts), 1.0)
    return np.maximum(leaving - entry, 0.0) * np.linalg.norm(rays, axis=1)
