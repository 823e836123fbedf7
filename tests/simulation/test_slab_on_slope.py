# SPDX-License-Identifier: GPL-3.0-or-later
"""A slab in shards stays where it lies on a slope that its friction holds."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "experiments"))

from creep import measured


@pytest.mark.long
def test_a_slab_does_not_creep_down_a_slope_of_15_degrees(blender):
    """The tangent is 0.27, friction 0.36: statics has no motion. With friction along the way alone, the fastest shard
    went on by 0.6 mm/s."""
    fastest_mm_s, _ = measured("slope", "elastic", 30, 20, 10)
    assert fastest_mm_s < 0.2
