"""Least and greatest areas of bars that EN 1992-1-1 asks for, whatever the load."""

from __future__ import annotations

import math

from .materials import Concrete

SECONDARY_SHARE = 0.2
"""Bars across the main ones of a slab, by these: EN 1992-1-1:2004, 9.3.1.1 (2)."""

USUAL_LARGEST_SHARE = 0.04
LARGEST_SHARE = 0.08
"""Greatest area of bars by that of the section, outside of laps and at them: 9.2.1.1 (3) and 9.5.2 (3)."""

_MEGA = 1e6


def of_beam_m2(width_m: float, depth_m: float, concrete: Concrete, yield_pa: float) -> float:
    """Return the least bars in tension of a beam or slab, by the width in tension: 9.2.1.1 (1) and 9.3.1.1 (1).

    `yield_pa` is the characteristic strength.
    """
    return max(0.26 * concrete.tension_pa / yield_pa, 0.0013) * width_m * depth_m


def of_links_m2_m(width_m: float, concrete: Concrete, yield_pa: float) -> float:
    """Return the least links of a beam by its length, m²/m: 9.2.2 (5). `yield_pa` is the characteristic strength."""
    return 0.08 * math.sqrt(concrete.strength_pa / _MEGA) / (yield_pa / _MEGA) * width_m


def of_column_m2(axial_n: float, section_m2: float, design_yield_pa: float) -> float:
    """Return the least bars along a column, all together, by its design axial force: 9.5.2 (2)."""
    return max(0.1 * axial_n / design_yield_pa, 0.002 * section_m2)


def upright_of_wall_m2(section_m2: float) -> float:
    """Return the least upright bars of a wall, both faces together: 9.6.2 (1)."""
    return 0.002 * section_m2


def level_of_wall_m2(upright_m2_m: float, thickness_m: float) -> float:
    """Return the least level bars of a wall by its height, m²/m, both faces together: 9.6.3 (1)."""
    return max(0.25 * upright_m2_m, 0.001 * thickness_m)


def column_link_spacing_m(smallest_bar_m: float, smallest_side_m: float) -> float:
    """Return the largest distance of links in a column: 9.5.3 (3)."""
    return min(20.0 * smallest_bar_m, smallest_side_m, 0.4)


def column_link_bar_m(largest_bar_m: float) -> float:
    """Return the least diameter of links in a column: 9.5.3 (1)."""
    return max(0.006, 0.25 * largest_bar_m)
