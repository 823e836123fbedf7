# SPDX-License-Identifier: GPL-3.0-or-later
"""The span that a crane takes down in four picks: what its header says of loads on the hook and of what stands."""

import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.lifted import HANGS, lift_rows
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge

pytestmark = pytest.mark.long

FILE = EXAMPLES / "steel" / "span_lifted_out.toml"

DECK_T = 2.5 * 5.6 * 0.2 * 25.0
"""2500 kg/m³, 5.6 m wide, 0.2 m thick, 25 m long."""


def test_it_stands_in_all_stages_and_the_hook_carries_what_hangs_on_it():
    scenario = read_scenario(FILE)
    bridge = StandingBridge(checked_model(scenario), scenario.joints)
    stages = stages_of(scenario, bridge, lambda done, total: None)
    assert len(stages) == 15
    factors = [stage.collapse_factor for stage in stages]
    assert factors[0] == pytest.approx(5.6, abs=0.05) and min(factors) == pytest.approx(3.9, abs=0.05)
    hanging = {row["lift"]: row for row in lift_rows(stages) if row["state"] == HANGS}
    tonnes = {name: row["part_kg"] / 1e3 for name, row in hanging.items()}
    panels_t, girders_t = list(tonnes.values())[:2], list(tonnes.values())[2:]
    assert sum(panels_t) == pytest.approx(DECK_T, rel=1e-3)
    # A cross frame at each of six nodes, half of it with each girder; plates of nodes come to that (found 2 %).
    girder_t = 7.85 * 25.0 * section_named("PG 1000x12x300x20x400x30").area_m2
    frames_t = 0.5 * 7.85 * 6 * 3.0 * section_named("HEA 300").area_m2
    assert girders_t == [pytest.approx(girder_t + frames_t, rel=0.03)] * 2
    for row in hanging.values():
        assert row["hook_t"] == pytest.approx(row["part_kg"] / 1e3, rel=1e-3)
    assert [round(100 * row["hook_used"]) for row in hanging.values()] == [73, 83, 15, 15]
    radii_m = [row["radius_m"] for row in hanging.values()]
    assert (min(radii_m), max(radii_m)) == (pytest.approx(12.6, abs=0.05), pytest.approx(15.5, abs=0.05))
