"""How finely members are cut, and how far off single bearings are where all cuts are alike: measured, not derived."""

from __future__ import annotations

import math

from ..arithmetic import cube_root

_MEASURED_SINGLE = ((0.0, 0.05), (25.0, 0.11))
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


def expected_single_deviation(skew_deg: float) -> float | None:
    """Return the largest relative error of single bearings of decks whose cuts are alike; None with more skew."""
    return next((share for most, share in _MEASURED_SINGLE if abs(skew_deg) <= most), None)
