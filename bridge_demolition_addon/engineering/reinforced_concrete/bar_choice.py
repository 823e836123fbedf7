"""Bars that make up an area: how many of which diameter, in how many rows, and where their middle is."""

from __future__ import annotations

import math
from dataclasses import dataclass

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
    """Return how far the middle of all rows is from the outer edge of the bars."""
    return 0.5 * diameter_m + 0.5 * (rows - 1) * (diameter_m + clear_m(diameter_m))


def diameters_from(preferred_m: float) -> tuple[float, ...]:
    """Return a diameter, and the larger usual ones."""
    return (preferred_m, *(diameter for diameter in DIAMETERS_M if diameter > preferred_m * (1.0 + 1e-9)))


def bars_in_rows(
    area_m2: float, room_m: float, diameter_m: float, rows: int, *, least_spacing_m: float, most_spacing_m: float
) -> BarChoice | None:
    """Return bars of a diameter with an area at least, in so many rows over a width; None where they do not fit.

    `room_m` is from the outer edge of the first bar to that of the last.
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
