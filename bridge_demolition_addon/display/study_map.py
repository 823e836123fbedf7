"""What a study came to, on the ground of a view: how likely debris is at each place, and the limit of the reach."""

from __future__ import annotations

import numpy as np
from manifold3d import CrossSection

from ..engineering.geometry.plan_areas import outlines
from ..engineering.statistics.probability_map import ProbabilityMap
from .colour_scale import ColourMap, colours

COLOUR_MAP = ColourMap.VIRIDIS

OPACITY = 0.6

_ABOVE_M = 0.02
"""How far above the ground all is drawn, so that it is not half hidden in it."""

_TWO_TRIANGLES = (0, 1, 2, 0, 2, 3)


def map_triangles(found: ProbabilityMap) -> tuple[np.ndarray, np.ndarray]:
    """Return triangles (6 k, 3) float, m, and colours (6 k, 4) at their corners, for the k cells that any run hit.

    The colour is by the share of the runs that hit the cell, from 0 to 1.
    """
    rows, columns = np.nonzero(found.hits)
    xs, ys = found.cells.xs_m, found.cells.ys_m
    left, right, low, high = xs[columns], xs[columns + 1], ys[rows], ys[rows + 1]
    heights = np.full(len(rows), _ABOVE_M)
    corners = np.stack(
        [np.column_stack([x, y, heights]) for x, y in ((left, low), (right, low), (right, high), (left, high))], axis=1
    )
    screen = np.column_stack((colours(COLOUR_MAP, found.shares[rows, columns]), np.full(len(rows), OPACITY)))
    return corners[:, _TWO_TRIANGLES].reshape(-1, 3), np.repeat(screen, len(_TWO_TRIANGLES), axis=0)


def outline_lines(area: CrossSection) -> np.ndarray:
    """Return the outlines of an area as lines (2 k, 3) float, m, from corner to corner."""
    found = [np.zeros((0, 2, 2))]
    for ring in outlines(area):
        found.append(np.stack((ring, np.roll(ring, -1, axis=0)), axis=1))
    flat = np.concatenate(found).reshape(-1, 2)
    return np.column_stack((flat, np.full(len(flat), _ABOVE_M)))
