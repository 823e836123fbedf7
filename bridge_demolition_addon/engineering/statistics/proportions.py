"""Confidence limits for a proportion.

References
----------
C. J. Clopper and E. S. Pearson (1934), The use of confidence or fiducial limits illustrated in the case of the
binomial, Biometrika 26, 404-413.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from .binomial import binomial_cdf_inverse


def upper_limit(happened: ArrayLike, runs: int, confidence: float) -> FloatArray:
    """Largest probability that so many of the runs leave possible, with a one-sided confidence.

    Parameters
    ----------
    happened : int or array of int
        In how many runs it happened, 0 to `runs`.
    runs
        How many runs there were, at least 1, independent of each other.
    confidence
        Above 0 and below 1.
    """
    return binomial_cdf_inverse(happened, runs, 1.0 - confidence)


def lower_limit(happened: ArrayLike, runs: int, confidence: float) -> FloatArray:
    """Smallest probability that so many of the runs leave possible; see `upper_limit`."""
    return 1.0 - upper_limit(runs - np.asarray(happened), runs, confidence)
