"""Bars of round columns: a ring of them within hoops."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ...engineering.geometry.solids import across_flats_m
from ...engineering.reinforced_concrete.columns import ColumnSection, design_moment_nm
from ...engineering.reinforced_concrete.least_areas import (
    LARGEST_SHARE,
    BarChoice,
    bar_area_m2,
    clear_m,
    diameters_from,
    of_column_m2,
)
from .design_basis import COLUMN_LINK_M, LEAST, BarDesign, Tension, column_links, column_loads
from .schedule import ScheduledBars, ScheduledLinks

_KILO = 1e3

_SIDES = ("start", "end", "right", "left")
_FEWEST = 8
"""Bars of a ring: four are the least by EN 1992-1-1:2004, 9.5.2 (4), and a ring of two on each side is round."""

_MOST_SPACING_M = 0.25


def round_column_bars(
    basis: BarDesign, names: Sequence[str], diameter_m: float, height_m: float, axial_n: float, buckling_m: float
) -> Iterator[ScheduledBars | ScheduledLinks]:
    """Yield the bars of equal round columns as a layer at each of four sides, and their hoops.

    The section of concrete is taken for the square of the same area, with the ring's bars at the distance from the
    middle at which two rows have its second moment of area, A r² / 2.
    """
    bar, required, reason = _ring(basis, names[0], diameter_m, axial_n, buckling_m)
    radius = _radius_m(basis, diameter_m, bar)
    fewest = max(_FEWEST, required / bar_area_m2(bar), math.tau * radius / _MOST_SPACING_M)
    number = 4 * math.ceil(0.25 * fewest - 1e-9)
    choice = BarChoice(number // 4, bar, 1, math.tau * radius / number)
    depth = 0.5 * across_flats_m(diameter_m) - _layer_distance_m(diameter_m, radius)
    found = Tension(choice, depth, 0.25 * required, reason)
    for side in _SIDES:
        yield basis.scheduled(names, "pier", side, "z", found, section_m2=_area_m2(diameter_m), length_m=height_m)
    loop_m = math.pi * (diameter_m - 2.0 * basis.rule.cover_m)
    yield column_links(names, bar, side_m=diameter_m, legs=2, width_m=diameter_m, loop_m=loop_m, length_m=height_m)


def _area_m2(diameter_m: float) -> float:
    return 0.25 * math.pi * (diameter_m * diameter_m)


def _radius_m(basis: BarDesign, diameter_m: float, bar_m: float) -> float:
    return 0.5 * diameter_m - basis.rule.cover_m - COLUMN_LINK_M - 0.5 * bar_m


def _layer_distance_m(diameter_m: float, radius_m: float) -> float:
    """Return how far from the middle four layers lie that are spread over their chords, and stiff as the ring.

    Two lie a to either side, A a² / 2, and two are spread over chords of 2 b, A b² / 6, with b² = D² / 4 - a²; together
    they have A r² / 2.
    """
    squared = 1.5 * (radius_m * radius_m) - 0.125 * (diameter_m * diameter_m)
    return math.sqrt(max(squared, 0.0))


def _ring(
    basis: BarDesign, name: str, diameter_m: float, axial_n: float, buckling_m: float
) -> tuple[float, float, str]:
    """Return the diameter of the bars of a ring, the area of all of them, and what it follows from."""
    area = _area_m2(diameter_m)
    least, side = of_column_m2(axial_n, area, basis.design_yield_pa), math.sqrt(area)
    for bar in diameters_from(basis.bar_m):
        radius = _radius_m(basis, diameter_m, bar)
        if radius <= 0.0:
            raise basis.rule.unexpected("cover_m", f"less: the bars of {name} would lie in its middle or beyond")
        section = ColumnSection(side, side, 0.5 * side - radius / math.sqrt(2.0), basis.concrete, basis.design_yield_pa)
        moment = design_moment_nm(axial_n, section, buckling_m)
        needed = section.bars_m2(axial_n, moment)
        if not np.isfinite(needed) or needed > LARGEST_SHARE * area:
            raise basis.refused(
                f"{name} cannot carry its design load of {axial_n / _KILO:.0f} kN with {moment / _KILO:.0f} kN·m: it "
                f"would need more than {LARGEST_SHARE:.0%} of its section of {diameter_m:g} m diameter in bars; take "
                "thicker or more columns"
            )
        required, reason = (needed, column_loads(axial_n, moment)) if needed > least else (least, LEAST)
        if required <= math.tau * radius / (bar + clear_m(bar)) * bar_area_m2(bar):
            return bar, required, reason
    raise basis.refused(f"{name} needs more bars than fit around it; take thicker or more columns")
