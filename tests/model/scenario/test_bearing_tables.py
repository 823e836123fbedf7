# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of bearings: what goes together, and what is refused."""

import pytest
from support.bearing_decks import deck_text
from support.checkout import ROOT

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.bearings import Bearing
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text


def bearing(**keys):
    return Bearing(members=("deck", "pier"), **keys)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"kind": "hinged"}, 'bearings.kind is "hinged": expected one of'),
        ({"kind": "sliding"}, 'bearings.friction is missing: expected it with kind "sliding"'),
        ({"kind": "pinned", "friction": 0.1}, 'bearings.friction is 0.1: expected none with kind "pinned"'),
        ({"kind": "elastomeric", "shear_mn_m": 2.0}, "bearings.stiffness_mn_m is missing"),
        ({"kind": "rocker", "shear_mn_m": 2.0}, 'bearings.shear_mn_m is 2.0: expected none with kind "rocker"'),
        ({"kind": "pinned", "pads": 2, "positions_m": (0.0,)}, "bearings.pads is 2: expected none with"),
        ({"kind": "pinned", "spacing_m": 2.0}, "bearings.spacing_m is 2.0: expected none without two or more"),
        ({"kind": "pinned", "pad_m": (0.3, 0.3)}, "bearings.pads is missing: expected it with bearings.pad_m"),
    ],
)
def test_keys_that_do_not_go_together(keys, said):
    with pytest.raises(ScenarioError) as caught:
        bearing(**keys)
    assert said in str(caught.value)


def test_springs_of_a_kind():
    """An elastomeric one with 20 MN·m/rad and 2000 MN/m has its springs 0.1 m before and behind its axis."""
    elastomeric = bearing(kind="elastomeric", stiffness_mn_m=2000.0, shear_mn_m=2.0, rotation_mnm_rad=20.0)
    assert elastomeric.arm_m(0.6) == pytest.approx(0.1)
    assert elastomeric.sideways_n_m == (2e6, 2e6)
    assert bearing(kind="rocker").sideways_n_m[0] == 0.0
    assert bearing(kind="pinned").arm_m(0.6) == 0.0
    # Two rows resist as an even bed: 2 a² / 2 = L² / 12.
    assert bearing(kind="fixed").arm_m(0.6) == pytest.approx((0.6**2 / 12.0) ** 0.5)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        (
            'kind = "elastomeric"\nstiffness_mn_m = 100\nshear_mn_m = 1',
            "bearings.stiffness_mn_m is 100.0: expected none",
        ),
        ('kind = "pinned"\nstiffness_mn_m = 100', "bearings.stiffness_mn_m is 100.0: expected none"),
    ],
)
def test_stiffness_needs_elastic_connections(keys, said):
    text = deck_text((("pier", keys),), stiffness="rigid").replace("elastic_modulus_n_mm2 = 30000\n", "")
    with pytest.raises(ScenarioError, match="bearings"):
        scenario_from_text(text)


def test_the_example_of_the_documentation_can_be_read():
    page = (ROOT / "docs" / "connections.md").read_text(encoding="utf-8").partition("## Bearings")[2]
    tables = page.split("```toml")[1].split("```")[0]
    kinds = [table.kind for table in scenario_from_text(deck_text(()) + tables).bearings]
    assert kinds == ["pinned", "sliding", "elastomeric"]


def test_a_scenario_is_written_as_it_was_read():
    scenario = scenario_from_text(
        deck_text((("pier *", 'kind = "sliding"\nfriction = 0.05\npad_m = [0.3, 0.4]\npads = 3'),))
    )
    assert scenario_from_text(scenario_text(scenario)) == scenario
