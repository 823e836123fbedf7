"""Gaps between pairs of points on two bodies, across which bars or soil act. All arrays have their components first."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import FloatArray
from .joint_rows import cross_products


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
