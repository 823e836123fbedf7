"""Gaps between pairs of points on two bodies, across which bars or soil act. All arrays have their components first."""

from __future__ import annotations

from collections.abc import Callable
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


def stiffness_of_points(
    tangents_n_m: FloatArray,
    first_arms_m: FloatArray,
    second_arms_m: FloatArray,
    summed: Callable[[FloatArray], FloatArray] = lambda values: values,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the stiffness (6, 6, c) of q gaps for their first and second bodies, and between these.

    Forces across the gaps grow by tangents (3, 3, q) with their width; they act at arms (3, q) from the centres of the
    bodies. `summed` takes what is of gaps (…, q) together to what is of c connections.
    """
    turning_first, turning_second = (_across(arms, tangents_n_m) for arms in (first_arms_m, second_arms_m))
    to_first, to_second = (cross_products(arms[:, None], tangents_n_m) for arms in (first_arms_m, second_arms_m))
    about_first = cross_products(first_arms_m[:, None], turning_first)
    about_second = cross_products(second_arms_m[:, None], turning_second)
    about_both = cross_products(first_arms_m[:, None], turning_second)
    pushed = summed(tangents_n_m)
    shifted_first, shifted_second = summed(turning_first), summed(turning_second)
    moments_first, moments_second = summed(to_first), summed(to_second)
    return (
        _block(pushed, shifted_first, moments_first, summed(about_first)),
        _block(pushed, shifted_second, moments_second, summed(about_second)),
        -_block(pushed, shifted_second, moments_first, summed(about_both)),
    )


def _across(arms_m: FloatArray, tangents_n_m: FloatArray) -> FloatArray:
    """Growth (3, 3, q) of forces as the body turns, where they grow by tangents as its points shift."""
    return np.swapaxes(cross_products(arms_m[:, None], np.swapaxes(tangents_n_m, 0, 1)), 0, 1)


def _block(shifts: FloatArray, turns: FloatArray, moments: FloatArray, moments_of_turns: FloatArray) -> FloatArray:
    """Matrices (6, 6, c) of four (3, 3, c)."""
    return np.concatenate(
        (np.concatenate((shifts, turns), axis=1), np.concatenate((moments, moments_of_turns), axis=1))
    )
