# SPDX-License-Identifier: GPL-3.0-or-later
"""Bearings of a parametric bridge by one short table: one at each support of its deck, and what they carry."""

import pytest
from support.bearing_decks import standing_deck

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.scenario.scenario import bearing_tables

pytestmark = pytest.mark.slow

BRIDGE = """
[scenario]
title = "bridge with bearings"
seed = 2
[time]
duration_s = 1.0
frames_per_second = 24
[bridge]
span_lengths_m = [8.0, 10.0]
density_kg_m3 = 2400.0
{bearings}
[bridge.deck]
width_m = 6.0
thickness_m = 0.4
{deck}
[bridge.piers]
columns = {columns}
column_length_m = 0.8
column_width_m = 1.0
height_m = 4.0
{parts}
[fracture]
shards = 40
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
"""
CAPS = "[bridge.pier_caps]\nlength_m = 1.2\nwidth_m = 6.0\nheight_m = 0.6"
ABUTMENTS = "[bridge.abutments]\nlength_m = 1.0\nwidth_m = 6.0"
GIRDERS = "[bridge.girders]\nnumber = 2\nwidth_m = 0.5\ndepth_m = 0.8\nspacing_m = 3.0"


def bridge_with_bearings(*parts, deck="overhang_m = 0.5", columns=2, bearings=""):
    return BRIDGE.format(bearings=f"[bridge.bearings]\n{bearings}", deck=deck, columns=columns, parts="\n".join(parts))


@pytest.mark.parametrize(
    ("text", "kinds"),
    [
        (
            bridge_with_bearings(CAPS),
            {f"deck on pier {n} cap": "rocker" for n in (2, 3)} | {"deck on pier 1 cap": "pinned"},
        ),
        (
            bridge_with_bearings(ABUTMENTS, CAPS, bearings="pinned_at = 2\nfriction = 0.05"),
            {"deck on abutment 1": "sliding", "deck on pier 1 cap": "pinned", "deck on abutment 2": "sliding"},
        ),
        (
            bridge_with_bearings(columns=1),
            {"deck on pier 1": "pinned", "deck on pier 2": "rocker", "deck on pier 3": "rocker"},
        ),
        (
            bridge_with_bearings(CAPS, GIRDERS, columns=1),
            {
                f"girder {girder} on pier {pier} cap": "pinned" if pier == 1 else "rocker"
                for pier in (1, 2, 3)
                for girder in (1, 2)
            },
        ),
        (
            bridge_with_bearings(CAPS, deck="overhang_m = 0.5\nper_span = true\njoint_gap_m = 0.1"),
            {
                "span 1 deck on pier 1 cap": "pinned",
                "span 1 deck on pier 2 cap": "rocker",
                "span 2 deck on pier 2 cap": "pinned",
                "span 2 deck on pier 3 cap": "rocker",
            },
        ),
        (
            bridge_with_bearings(),
            {
                f"deck on pier {pier} column {column}": "pinned" if pier == 1 else "rocker"
                for pier in (1, 2, 3)
                for column in (1, 2)
            },
        ),
    ],
    ids=["caps", "abutments", "one column", "girders", "deck per span", "columns"],
)
def test_a_bridge_has_a_bearing_at_each_support_that_carries_its_deck(text, kinds):
    scenario = scenario_from_text(text)
    model, _, forces = standing_deck(text)
    joints = list(scenario.named_joints)
    of_bearings = [
        joints[model.joint_of_connection[model.bearings.rows_of(row)[0]]] for row in range(len(model.bearings.names))
    ]
    tables = [bearing_tables(scenario)[joint.of] for joint in of_bearings if joint.kind == "bearing"]
    assert {name: table.kind for name, table in zip(model.bearings.names, tables, strict=True)} == kinds
    above_kg = sum(member.mass_kg for member in model.members if member.kind in ("deck", "girder"))
    assert sum(bearing.force_n[2] for bearing in forces.values()) == pytest.approx(
        STANDARD_GRAVITY_M_S2 * above_kg, rel=1e-3
    )


def test_bearings_of_the_scenario_come_before_those_of_its_bridge():
    more = '[[bearings]]\nmembers = ["deck", "pier 2 cap"]\nkind = "fixed"\n'
    model, _, forces = standing_deck(bridge_with_bearings(CAPS) + more)
    assert len(model.bearings.names) == 3
    assert abs(forces["pier 2 cap"].moment_nm[1]) > 1e3 > 1e3 * abs(forces["pier 1 cap"].moment_nm[1])
    lines = "\n".join(scenario_facts(scenario_from_text(bridge_with_bearings(CAPS) + more)))
    assert "deck on pier 2 cap: fixed, in a line" in lines
    assert "deck on pier 3 cap: rocker, in a line" in lines
    assert lines.count(" kN up, ") == 3


def test_a_bridge_with_bearings_is_written_as_it_was_read():
    scenario = scenario_from_text(bridge_with_bearings(CAPS, bearings="pinned_at = 3\nfriction = 0.1\npads = 4"))
    assert scenario_from_text(scenario_text(scenario)) == scenario


@pytest.mark.parametrize(
    ("keys", "deck", "said"),
    [
        ("pinned_at = 4", "", "bridge.bearings.pinned_at is 4: expected at most 3"),
        ("pinned_at = 1", "per_span = true\njoint_gap_m = 0.1", "bridge.bearings.pinned_at is 1: expected none with"),
        ("pinned_at = 0", "", "bridge.bearings.pinned_at is 0"),
        ("pinend_at = 1", "", "did you mean bridge.bearings.pinned_at"),
    ],
)
def test_bearings_of_a_bridge_that_cannot_be(keys, deck, said):
    with pytest.raises(ScenarioError, match=said):
        scenario_from_text(bridge_with_bearings(CAPS, deck=deck, bearings=keys))


def test_a_bridge_of_one_solid_has_no_bearings():
    text = bridge_with_bearings(CAPS).replace("density_kg_m3 = 2400.0", "density_kg_m3 = 2400.0\nmerge = true")
    with pytest.raises(ScenarioError, match=r"bridge\.bearings is given: expected none with bridge\.merge"):
        scenario_from_text(text)
