# SPDX-License-Identifier: GPL-3.0-or-later
"""Cables in the stages of a demolition: a column that one pulls has the moment of statics at its foot."""

import numpy as np
import pytest
from support.steelwork import pulled_column

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.stages.reactions import supports_of
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.model import build_model


def test_it_pulls_with_its_largest_force_from_its_start_on():
    """5 kN along (4, -3) / 5: 4 kN along the road and 3 kN down, and 4 kN by 6 m about the foot."""
    scenario = pulled_column(pieces=8)
    bridge = StandingBridge(build_model(scenario), scenario.joints)
    before, after = stages_of(scenario, bridge, lambda done, total: None)
    assert (before.step, after.step) == ("as it was built", "pull by cable")
    assert after.equipment == ("cable",)
    ((force_before, _), (force_n, moment_nm)) = (
        supports_of(bridge.model)[0].reaction(stage.standing.loads) for stage in (before, after)
    )
    weight_n = STANDARD_GRAVITY_M_S2 * float(bridge.model.masses_kg.sum())
    np.testing.assert_allclose(force_before, (0.0, 0.0, weight_n), rtol=0.01, atol=1.0)
    np.testing.assert_allclose(force_n, (-4000.0, 0.0, weight_n + 3000.0), rtol=0.01, atol=1.0)
    # Weight and the force down act on what has bent by 8 mm: 0.3 % of the moment.
    assert moment_nm[1] == pytest.approx(-4000.0 * 6.0, rel=0.02)
