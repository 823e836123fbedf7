"""How finely members are cut, and by how much results are off for that: measured, not derived.

`scripts/experiments/elastic_bridges.py` compares five bridges with what OpenSees calculates for them, medians of five
seeds (README.md). What decides is by how many shards the members that span are long.
"""

from __future__ import annotations

import math

from ..arithmetic import cube_root

_MEASURED = ((5.0, 0.30), (11.0, 0.25), (17.0, 0.10), (float("inf"), 0.09))
"""Shards along members that span, up to these, and the largest deviation of reactions, moments, deflections and
frequencies then. At acute corners of skewed slabs, where little arrives, reactions are off by more."""

_MEASURED_AT_ACUTE_CORNERS = ((11.0, 0.70), (17.0, 0.50), (25.0, 0.30), (float("inf"), 0.20))
"""The same for reactions at acute corners of a slab with a skew of 40°: the largest deviation of five seeds, not their
median, as the sign differs from seed to seed."""


_MEASURED_SINGLE = ((0.0, 0.05), (25.0, 0.08))
"""Skew, in degrees, up to which single bearings of girders cast with their slab, and of slabs on rows of columns, are
off by no more than this beside meshes of bricks and plates (OpenSees), in 60 to 400 shards."""


def spacing_m(volume_m3: float, count: int, thickness_m: float, width_m: float) -> float:
    """Return how far apart the middles are of the shards that a bar or plate of these sizes is cut into.

    Where shards are larger than it is thick, they lie side by side in one layer; where larger than its width, in a row.
    """
    each = volume_m3 / count
    cube = float(cube_root(each))
    if cube <= thickness_m:
        return cube
    square = math.sqrt(each / thickness_m)
    return square if square <= width_m else each / (thickness_m * width_m)


def expected_deviation(shards_along: float) -> float:
    """Return the largest relative error of results for a number of shards along the members that span."""
    return next(share for most, share in _MEASURED if shards_along <= most)


def expected_corner_deviation(shards_along: float) -> float:
    """Return the largest relative error of reactions at acute corners of a skewed bridge."""
    return next(share for most, share in _MEASURED_AT_ACUTE_CORNERS if shards_along <= most)


def expected_single_deviation(skew_deg: float) -> float | None:
    """Return the largest relative error of single bearings of decks whose cuts are alike; None with more skew."""
    return next((share for most, share in _MEASURED_SINGLE if abs(skew_deg) <= most), None)
