# SPDX-License-Identifier: GPL-3.0-or-later
"""One of six zones misfires: at first the bridge stands on the bars of the others."""

from dataclasses import replace

import numpy as np
import pytest
from support.example_runs import example

from bridge_demolition_addon.model.sequence.checked_model import checked_model


@pytest.mark.long
def test_a_misfire_leaves_the_bridge_on_its_bars_at_first(tmp_path):
    """It does for 1.3 s at least. 14 bars of 20 mm over 1.5 m, without a bow as in a run, resist 14 × π² E π d⁴ / 64 /
    0.75² = 0.386 MN. They may be counted on for 14 × 0.1439 A f_y = 0.316 MN: λ 2.387, curve c."""
    from bridge_demolition_addon.simulation.motion_run import motion_run

    scenario = example("drilled_misfire", duration_s=1.8, shards=50)
    scenario = replace(scenario, time=replace(scenario.time, farthest_per_substep_m=0.05))
    with motion_run(scenario, checked_model(scenario), tmp_path) as (results, summary):
        deck = results.inventory.body_member_kinds == "deck"
        fallen_m = results.frames.positions_m[0, deck, 2] - results.frames.positions_m[-1, deck, 2]
    assert [event["zone"] for event in summary["events"]][:1] == ["P2.2"]
    assert len(summary["events"]) == 5
    most_n = 14.0 * np.pi**2 * 200e9 * np.pi * 0.02**4 / 64.0 / 0.75**2
    for event in summary["events"]:
        assert event["cage_compression_n"] == pytest.approx(14.0 * 0.1439 * 500e6 * np.pi * 0.02**2 / 4.0, rel=1e-3)
        assert 0.4 * most_n < event["cage_pressed_n"] < most_n
    assert fallen_m.max() < 0.1
