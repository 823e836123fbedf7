"""Drill holes of a zone by the rules of blasting manuals: burden, spacing, stemming, depth, and what a hole holds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray

LEAST_STEMMING_M = 0.15
"""No hole has less, whatever its burden."""

USUAL_DEPTH_SHARES = (0.5, 0.75)
"""Part of the thickness that a hole is deep: two thirds as a rule. A deeper one blows out at the far side."""

SPACING_OVER_BURDEN = (1.0, 1.8)
"""Spacing along a row by the burden, of reinforced concrete."""

_DEPTH_SHARE = 2.0 / 3.0
_ONE_ROW_UP_TO_M = 0.6
"""A thickness above this takes two rows, staggered."""


@dataclass(frozen=True, slots=True)
class HolesByRule:
    """Holes that the rules give a zone."""

    rows: int
    burden_m: float
    spacing_m: tuple[float, float]  # least and largest
    depth_m: float
    stemming_m: float  # at least


def holes_by_rule(thickness_m: float, width_m: float) -> HolesByRule:
    """Return what the rules say for a member of a thickness along its holes, and a width across them.

    One row in the middle of the width has half of it as its burden; of two rows, each has a quarter.
    """
    rows = 1 if width_m <= _ONE_ROW_UP_TO_M else 2
    burden = width_m / (2 * rows)
    least, largest = SPACING_OVER_BURDEN
    return HolesByRule(
        rows=rows,
        burden_m=burden,
        spacing_m=(least * burden, largest * burden),
        depth_m=_DEPTH_SHARE * thickness_m,
        stemming_m=max(burden, LEAST_STEMMING_M),
    )


def hole_area_m2(diameter_m: float) -> float:
    """Return the cross-section of a hole."""
    return np.pi * diameter_m * diameter_m / 4.0


def hole_capacity_kg(depth_m: float, stemming_m: float, diameter_m: float, density_kg_m3: float) -> float:
    """Return the explosive that a hole holds below its stemming."""
    return hole_area_m2(diameter_m) * max(depth_m - stemming_m, 0.0) * density_kg_m3


def charge_length_m(charge_kg: float, diameter_m: float, density_kg_m3: float) -> float:
    """Return the length that a charge takes up in its hole."""
    return charge_kg / (hole_area_m2(diameter_m) * density_kg_m3)


def hole_positions_m(rows: int, holes_a_row: int, spacing_m: float, row_distance_m: float) -> FloatArray:
    """Return where holes are (rows, holes, 2), along their rows and across them, from the middle of the zone.

    Every second row is staggered by half a spacing, and all of them together lie evenly about the middle.
    """
    along = spacing_m * (np.arange(holes_a_row) - (holes_a_row - 1) / 2.0)
    across = row_distance_m * (np.arange(rows) - (rows - 1) / 2.0)
    stagger = spacing_m / 4.0 if rows > 1 else 0.0
    shifts = np.where(np.arange(rows) % 2 == 0, -stagger, stagger)
    return np.stack(np.broadcast_arrays(along + shifts[:, None], across[:, None]), axis=2)


def zone_height_m(larger_side_m: float, bar_diameter_m: float, factor: float = 1.5, diameters: float = 40.0) -> float:
    """Return the height that the rule gives a zone: factor (1.5 to 2) times (larger side + 30 to 50 bar diameters)."""
    return factor * (larger_side_m + diameters * bar_diameter_m)
