"""Least and greatest areas of bars that EN 1992-1-1 asks for, whatever the load, and bars that make up an area."""

from __future__ import annotations

import math
from dataclasses import dataclass

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


DIAMETERS_M = (0.008, 0.010, 0.012, 0.014, 0.016, 0.020, 0.025, 0.028, 0.032, 0.040)
_LEAST_CLEAR_M = 0.025
"""Largest aggregate of 20 mm and 5 mm: EN 1992-1-1:2004, 8.2 (2)."""
MOST_ROWS = 4


@dataclass(frozen=True, slots=True)
class BarChoice:
    """Equal bars in one or more rows."""

    number: int
    diameter_m: float
    rows: int
    spacing_m: float  # from axis to axis within a row; nan of a single bar

    @property
    def area_m2(self) -> float:
        return self.number * bar_area_m2(self.diameter_m)


def bar_area_m2(diameter_m: float) -> float:
    return math.pi * (diameter_m * diameter_m) / 4.0


def clear_m(diameter_m: float) -> float:
    """Return the least clear distance of bars of a diameter: EN 1992-1-1:2004, 8.2 (2)."""
    return max(diameter_m, _LEAST_CLEAR_M)


def row_depth_m(diameter_m: float, rows: int) -> float:
    """Return how far the middle of the rows is from the outer edge of the bars."""
    return 0.5 * diameter_m + 0.5 * (rows - 1) * (diameter_m + clear_m(diameter_m))


def diameters_from(preferred_m: float) -> tuple[float, ...]:
    """Return a diameter, and the larger usual ones."""
    return (preferred_m, *(diameter for diameter in DIAMETERS_M if diameter > preferred_m * (1.0 + 1e-9)))


def bars_in_rows(
    area_m2: float, room_m: float, diameter_m: float, rows: int, *, least_spacing_m: float, most_spacing_m: float
) -> BarChoice | None:
    """Return bars of a diameter with an area at least, in rows over a width; None where they do not fit.

    `room_m` is from outer edge to outer edge of the first and last bars.
    """
    between = max(room_m - diameter_m, 0.0)
    least = max(least_spacing_m, diameter_m + clear_m(diameter_m))
    most_in_row = 1 + int(between / least + 1e-9)
    fewest_in_row = 1 + math.ceil(between / most_spacing_m - 1e-9)
    number = max(math.ceil(area_m2 / bar_area_m2(diameter_m) - 1e-9), 1)
    in_row = max(math.ceil(number / rows), min(fewest_in_row, most_in_row))
    if in_row > most_in_row:
        return None
    number = max(number, in_row) if rows == 1 else number
    return BarChoice(number, diameter_m, rows, between / (in_row - 1) if in_row > 1 else math.nan)
