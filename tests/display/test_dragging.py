# SPDX-License-Identifier: GPL-3.0-or-later
"""Places under a mouse, found by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.display.dragging import dragged_along, dragged_level


def test_a_ray_at_45_degrees_meets_the_ground_as_far_away_as_its_eye_is_high():
    eye, ray = np.array((1.0, 2.0, 10.0)), np.array((3.0, 0.0, -3.0))
    assert dragged_level(eye, ray, 4.0) == pytest.approx((7.0, 2.0, 4.0))


@pytest.mark.parametrize("ray", [(1.0, 0.0, 0.01), (0.0, 1.0, 0.5)], ids=["grazing", "behind the eye"])
def test_a_ray_that_does_not_meet_the_plane_leads_nowhere(ray):
    assert dragged_level(np.array((0.0, 0.0, 5.0)), np.array(ray), 0.0) is None


def test_upright_is_where_the_ray_passes_nearest():
    eye = np.array((0.0, -10.0, 6.0))
    # After 10 m the ray is 2 m lower, and passes 1 m beside the upright through the foot.
    assert dragged_along(eye, np.array((0.0, 5.0, -1.0)), np.array((1.0, 0.0, 99.0)), 2) == pytest.approx(
        (1.0, 0.0, 4.0)
    )


def test_seen_from_straight_above_nothing_can_be_lifted():
    assert dragged_along(np.array((0.0, 0.0, 9.0)), np.array((0.0, 0.001, -1.0)), np.zeros(3), 2) is None


def test_along_a_level_axis_it_is_where_the_ray_passes_over_it():
    """From 10 m beside a girder and 10 m above it, along the slope of 45 degrees and 3 m to the right."""
    eye, ray = np.array((2.0, -10.0, 15.0)), np.array((3.0, 10.0, -10.0))
    assert dragged_along(eye, ray, np.array((-7.0, 0.0, 5.0)), 0) == pytest.approx((5.0, 0.0, 5.0))
    assert dragged_along(eye, np.array((1.0, 0.0, 0.001)), np.zeros(3), 0) is None
