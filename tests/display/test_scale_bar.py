# SPDX-License-Identifier: GPL-3.0-or-later
"""The scale bar is as long as it says, in equal stripes, and has a round length."""

import numpy as np
import pytest

from bridge_demolition_addon.display.scale_bar import scale_bar
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.terrain.surface import RecordedGround, Surface

FLAT = RecordedGround()
CORNERS = np.array(((-50.0, -50.0, -5.0), (50.0, -50.0, 5.0), (50.0, 50.0, 5.0), (-50.0, 50.0, -5.0)))
SLOPE = RecordedGround(Surface(TriangleMesh(CORNERS, np.array(((0, 1, 2), (0, 2, 3))))))
"""Ground that rises by a tenth along x."""


@pytest.mark.parametrize(("long_m", "length_m"), [(26.0, 5.0), (30.0, 10.0), (12.0, 2.0), (8.0, 2.0), (400.0, 100.0)])
def test_it_is_as_long_as_it_says(long_m, length_m):
    points = np.array(((-3.0, -4.0, 0.0), (long_m - 3.0, 5.0, 7.0)))
    bar = scale_bar(points, FLAT)
    solids = [part.solid for part in bar.parts()]
    corners = np.concatenate([solid.vertices for solid in solids])
    assert np.ptp(corners[:, 0]) == pytest.approx(length_m)
    assert [float(np.ptp(solid.vertices[:, 0])) for solid in solids] == pytest.approx([length_m / len(solids)] * 5)
    assert bar.text == f"{length_m:g} m"
    assert corners[:, 2].min() == pytest.approx(0.0)  # it lies on the ground
    assert corners[:, 0].min() >= -3.0 and corners[:, 0].max() <= long_m - 3.0


def test_its_stripes_are_black_and_white_in_turn():
    stuff = [part.stuff for part in scale_bar(np.array(((0.0, 0.0, 0.0), (20.0, 5.0, 5.0))), FLAT).parts()]
    assert stuff == ["white", "black", "white", "black", "white"]


def test_on_a_slope_it_is_level_and_lies_on_the_higher_end_with_a_leg_under_the_other():
    bar = scale_bar(np.array(((-15.0, -4.0, 0.0), (15.0, 5.0, 7.0))), SLOPE)
    assert bar.start_m[2] == pytest.approx(0.5) and bar.length_m == 10.0  # 0.1 of 5 m, its end
    assert bar.legs_m == pytest.approx((1.0, 0.0))
    *stripes, leg = bar.parts()
    assert {round(float(part.solid.vertices[:, 2].min()), 6) for part in stripes} == {0.5}
    assert leg.solid.bounds[:, 2] == pytest.approx((-0.5, 0.5)) and len(stripes) == 5
