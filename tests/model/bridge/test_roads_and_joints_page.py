# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenarios of docs/roads_and_joints.md are read, stand by their own weight, and weigh what their sizes say."""

import re

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.model.bridge import bridge_members
from bridge_demolition_addon.model.scenario.file import scenario_from_text

pytestmark = pytest.mark.slow

PAGE = (ROOT / "docs/roads_and_joints.md").read_text(encoding="utf-8")
WHOLE, RAMP, DROP_IN, OTHER_PIERS = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
SLAB = re.sub(r"\[bridge.(alignment|haunches|girders)\].*?\n\n", "", WHOLE, flags=re.DOTALL)
SLAB = SLAB.replace("thickness_m = 0.25", "thickness_m = 1.1").replace("columns = 4", 'kind = "round columns"')
SLAB = re.sub(r"(column_\w+_m) = 0.8", r"\1 = 1.6", SLAB)
GERBER = re.sub(r"\[bridge.reinforcement\].*?\n\n", "", SLAB, flags=re.DOTALL).replace(
    'stiffness = "elastic"', 'stiffness = "elastic"\nstrength_factor = 50'
)


def masses(text):
    found = {}
    for member in bridge_members(scenario_from_text(text).bridge):
        found[member.kind] = found.get(member.kind, 0.0) + member.mass_kg
    return found


@pytest.mark.parametrize("text", [WHOLE, SLAB + RAMP, GERBER + DROP_IN], ids=["crest", "ramp", "drop-in span"])
def test_it_stands(text):
    assert any("stands under its own weight" in line for line in scenario_facts(scenario_from_text(text)))


def test_piers_that_differ_are_read():
    # Columns of the page are round, and leaning ones have bars by ratios: none here.
    columns = GERBER.replace('kind = "round columns"', "columns = 2")
    bridge = scenario_from_text(columns + OTHER_PIERS).bridge
    assert [(one.kind, one.batter_percent, one.feet_apart_m) for one in map(bridge.piers_of, (1, 2))] == [
        ("wall", 5.0, None),
        ("columns", 0.0, 1.6),
    ]


def test_they_weigh_what_their_sizes_say():
    haunch = 0.8 * ((5 - 0.6) / 3 + 0.6)
    girders = 4 * 0.5 * (55.2 * 1.0 + 4 * haunch)
    assert masses(WHOLE)["girder"] == pytest.approx(2500 * girders, rel=1e-3)
    assert masses(SLAB + RAMP)["deck"] == pytest.approx(2500 * 55.2 * 10 * 1.1, rel=1e-3)
    assert masses(GERBER + DROP_IN)["deck"] == pytest.approx(2500 * (55.2 - 2 * 0.03) * 10 * 1.1, rel=1e-9)
