"""Straight bars near their ends, which bond alone holds: EN 1992-1-1:2004, 8.4."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray

_BOND = 2.25
"""Bond strength of ribbed bars in good bond conditions by the tensile strength of concrete: ibid., equation 8.2, for
bars up to 32 mm. With the mean strength instead of the design value, as everywhere here, it has no factor of safety."""


def anchorage_length_m(diameter_m: float, yield_pa: float, tensile_pa: float) -> float:
    """Return the length in which bond takes up the yield stress of a bar: ibid., equation 8.3."""
    return 0.25 * diameter_m * yield_pa / (_BOND * tensile_pa)


def anchored_shares(from_end_m: FloatArray, length_m: float) -> FloatArray:
    """Return the parts (k,) of their yield force that bars resist so far (k,) from their ends: bond is even."""
    shares: FloatArray = np.clip(from_end_m / length_m, 0.0, 1.0)
    return shares
