"""Gaps between pairs of points on two bodies, across which bars or soil act. All arrays have their components first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .joint_rows import cross_products


@dataclass(frozen=True, slots=True, eq=False)
class Gaps:
    """Gaps between q pairs of points."""

    first: IntArray  # (q,), bodies of the first points
    second: IntArray
    first_arms_m: FloatArray  # (3, q), from the centre of the body to where the force acts
    second_arms_m: FloatArray
    widths_m: FloatArray  # (3, q), from the first points to the second

    def rates(self, velocities: FloatArray) -> FloatArray:
        """Return how fast the gaps (3, q) open, with velocities and angular velocities (6, n) of the bodies."""
        first, second = velocities[:, self.first], velocities[:, self.second]
        moving = second[:3] + cross_products(second[3:], self.second_arms_m)
        return moving - first[:3] - cross_products(first[3:], self.first_arms_m)


@dataclass(frozen=True, slots=True, eq=False)
class SolvedTangents:
    """The tangents of q gaps for which the equations were made last, among those of all p gaps."""

    tangents_n_m: FloatArray  # (3, 3, p), of all gaps; written to
    rows: IntArray  # (q,)

    def differ(self, tangents_n_m: FloatArray) -> BoolArray:
        """Return whether each gap (q,) now has other tangents."""
        differ: BoolArray = (tangents_n_m != self.tangents_n_m[..., self.rows]).any(axis=(0, 1))
        return differ

    def take_over(self, gaps: IntArray, tangents_n_m: FloatArray) -> None:
        """Note the tangents (3, 3, k) of some of the gaps (k,)."""
        self.tangents_n_m[..., self.rows[gaps]] = tangents_n_m


def motion_of_points(arms_m: FloatArray) -> FloatArray:
    """Return matrices (3, 6, q) that give the velocities of points at arms (3, q) from those of their bodies."""
    x, y, z = arms_m
    matrices = np.zeros((3, 6, len(x)))
    matrices[[0, 1, 2], [0, 1, 2]] = 1.0
    matrices[0, 4], matrices[0, 5] = z, -y
    matrices[1, 3], matrices[1, 5] = -z, x
    matrices[2, 3], matrices[2, 4] = y, -x
    return matrices
