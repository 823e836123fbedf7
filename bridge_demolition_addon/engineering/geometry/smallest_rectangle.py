"""The smallest rectangle around points on plan.

A side of it lies along a side of the hull: H. Freeman, R. Shapira (1975), Communications of the ACM 18, 409-413.
"""

from __future__ import annotations

import math

import numpy as np
from manifold3d import CrossSection

from ..arrays import FloatArray
from .vectors import cross_2d, dot, unit

_ALIKE = 1.0 - 1e-9


def longer_side(points: FloatArray) -> FloatArray:
    """Return the direction (2,) of the longer side of the smallest rectangle around points (n, 2)."""
    middle = points.mean(axis=0)
    (corners,) = CrossSection.hull_points(points - middle).to_polygons()
    sides = np.roll(corners, -1, axis=0) - corners
    best_area, best = math.inf, np.array([1.0, 0.0])
    for side in unit(sides):
        long, wide = float(np.ptp(dot(corners, side))), float(np.ptp(cross_2d(side, corners)))
        if long * wide < best_area * _ALIKE:
            best_area = long * wide
            best = side if long >= wide * _ALIKE else np.array([-side[1], side[0]])
    return best
