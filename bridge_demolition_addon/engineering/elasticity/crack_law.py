"""What the law of cracks rests on; the compiled core has it, `core/src/terms.c`.

Bars pull along themselves, and less across themselves, as dowels. The sides press on each other where the gap is
closed, and rub on each other as far as they are pressed.
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from .joint_rows import dot_products

DOWEL_SHARE = float(0.9 * np.sqrt(35.0 / 500.0))
"""Force across themselves that bars resist as dowels, by that along them: 0.9 √(f_c / f_y) for rough cracks, of C35/45
and B500 (fib Model Code 2010, equation 7.3-51 and table 7.3-2). Both together are on an ellipse, as normal and shear
stress by von Mises' criterion.
"""

FRICTION = 0.7
"""Friction of the rough sides of a crack: EN 1992-1-1:2004, 6.2.5 (2), and fib Model Code 2010, table 7.3-2."""

SHEARED = 0.4
"""Stiffness against sliding of sides that do not slip, by that against pressing: shear over normal stiffness of
concrete, G / E."""


def stretches_of_bars(gaps_m: FloatArray, directions: FloatArray) -> FloatArray:
    """Stretches of bars (3, b) with directions (3, b) by gaps (3, b): less across the bars, as dowels."""
    along = dot_products(gaps_m, directions)
    stretches: FloatArray = DOWEL_SHARE * gaps_m + (1.0 - DOWEL_SHARE) * along * directions
    return stretches
