# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball begins beside all members, or is refused."""

from dataclasses import replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import GeometryError
from bridge_demolition_addon.model.bridge.preparation import extent
from bridge_demolition_addon.model.scenario import Ball, BallCable, FractureSettings
from bridge_demolition_addon.model.sequence.checked_model import checked_model

SPAN = replace(I235, fracture=FractureSettings(shards=20))


def swinging(crane_z_m):
    """A ball of 1 m that hangs straight down at mid span, on a cable of 5 m."""
    cable = BallCable(crane_point_m=(10.0, 0.0, crane_z_m), length_m=5.0, angle_degrees=0.001)
    return replace(SPAN, ball=Ball(mass_kg=1000.0, diameter_m=1.0, cable=cable))


@pytest.mark.parametrize(("above_m", "allowed"), [(-0.5, False), (0.4, False), (0.6, True)])
def test_a_ball_on_a_cable_begins_outside_all_members(above_m, allowed):
    top_m = extent(checked_model(SPAN).members)[1][2]
    scenario = swinging(float(top_m) + 5.0 + above_m)
    if allowed:
        assert checked_model(scenario).shards
        return
    with pytest.raises(GeometryError, match=r"ball begins within member 'deck'.*draw it aside"):
        checked_model(scenario)
