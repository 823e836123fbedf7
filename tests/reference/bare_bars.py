# SPDX-License-Identifier: GPL-3.0-or-later
"""Bare bars that fold, by numpy: what the compiled core has for groups of them between two bodies."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from bridge_demolition_addon.engineering.drilled_charges.bare_bars import (
    hinge_arm_m,
    largest_compression_n,
    yield_force_n,
)
from bridge_demolition_addon.engineering.elasticity.steel_bars import YIELD_PA


def bow_m(bared_m: ArrayLike, shortened_m: ArrayLike) -> np.ndarray:
    """Return how far the middle of a bar moves aside that folds in its middle and at its ends: (l / 2) sin θ.

    Its ends come closer by l (1 - cos θ).
    """
    bared = np.asarray(bared_m, float)
    straight = 1.0 - np.clip(np.asarray(shortened_m, float) / bared, 0.0, 1.0)
    bow: np.ndarray = 0.5 * bared * np.sqrt(1.0 - straight * straight)
    return bow


def folding_force_n(
    diameter_m: ArrayLike,
    bared_m: ArrayLike,
    shortened_m: ArrayLike,
    yield_pa: ArrayLike = YIELD_PA,
    *,
    straight: bool = True,
) -> np.ndarray:
    """Return what a bar resists in compression whose ends have come closer for good.

    At first that is what one resists that is `straight`, or else what it may be counted on for.

    The hinges resist N w = 2 M, with M = M_p (1 - (N / N_p)²) of a rectangle, which a round bar has within 3 % of M_p:
    limit analysis, as in N. Jones (2011), Structural Impact, 2nd edition, chapter 9. M_p is f_y d³ / 6.
    """
    squash, bow, arm = yield_force_n(diameter_m, yield_pa), bow_m(bared_m, shortened_m), hinge_arm_m(diameter_m)
    share = (np.sqrt(bow * bow + 4.0 * arm * arm) - bow) / (2.0 * arm)
    return np.minimum(largest_compression_n(diameter_m, bared_m, yield_pa, straight=straight), share * squash)
