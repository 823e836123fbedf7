"""Buckling curves of steel bars in compression (EN 1993-1-1:2005, 6.3.1.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray

IMPERFECTIONS = {"a0": 0.13, "a": 0.21, "b": 0.34, "c": 0.49, "d": 0.76}
"""Imperfection factor α of each buckling curve: EN 1993-1-1:2005, table 6.1."""

NO_BUCKLING = 0.2
"""Slenderness up to which a bar does not buckle: EN 1993-1-1:2005, 6.3.1.2 (4)."""


def reduction_factor(slenderness: ArrayLike, curve: str) -> FloatArray:
    """Return χ of a buckling curve, the part of its yield force that a bar resists: equation 6.49."""
    slender = np.maximum(np.asarray(slenderness, float), NO_BUCKLING)  # at which χ is 1
    phi = 0.5 * (1.0 + IMPERFECTIONS[curve] * (slender - NO_BUCKLING) + slender * slender)
    reduced: FloatArray = np.minimum(1.0, 1.0 / (phi + np.sqrt(phi * phi - slender * slender)))
    return reduced
