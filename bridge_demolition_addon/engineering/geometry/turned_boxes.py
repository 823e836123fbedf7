"""Boxes that are turned in space: which of them lie in each other.

Two boxes are apart where a plane separates them, which then is square to an edge of one of them, or to an edge of both:
15 directions (S. Gottschalk, M. C. Lin, D. Manocha 1996, OBBTree, SIGGRAPH 96, section 5).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray

_PARALLEL = 1e-6
"""Size of a cross product of two edges below which they count as parallel, and say nothing new."""


@dataclass(frozen=True, slots=True, eq=False)
class TurnedBoxes:
    """Boxes (k,): their middles (k, 3), directions of their edges (k, 3, 3) as columns, and half sizes (k, 3)."""

    middles_m: FloatArray
    axes: FloatArray
    halves_m: FloatArray

    def radii_m(self, directions: FloatArray) -> FloatArray:
        """Return half of their extents (k, d) along directions (k, 3, d)."""
        along = np.abs(_products(self.axes[:, :, :, None], directions[:, :, None, :]))
        return np.asarray(_products(self.halves_m[:, :, None], along))


def lie_in_each_other(first: TurnedBoxes, second: TurnedBoxes) -> BoolArray:
    """Return which of the first boxes (k,) lie in the second ones, or touch them."""
    crosses = np.cross(first.axes[:, :, :, None], second.axes[:, :, None, :], axis=1).reshape(-1, 3, 9)
    size = np.sqrt(_products(crosses, crosses))[:, None]
    crosses = np.divide(crosses, size, out=np.zeros_like(crosses), where=size > _PARALLEL)
    directions = np.concatenate((first.axes, second.axes, crosses), axis=2)
    apart_m = np.abs(_products((second.middles_m - first.middles_m)[:, :, None], directions))
    meet: BoolArray = (apart_m <= first.radii_m(directions) + second.radii_m(directions)).all(axis=1)
    return meet


def _products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return products (k, …) of vectors (k, 3, …), summed in a fixed order."""
    return np.asarray(first[:, 0] * second[:, 0] + first[:, 1] * second[:, 1] + first[:, 2] * second[:, 2])
