# SPDX-License-Identifier: GPL-3.0-or-later
"""Examples and presets that do not show the settings of 2019 are bridges as they are: with bars, and standing."""

import tomllib

import pytest
from support.checkout import EXAMPLES, PRESETS, REPORT_2019
from support.long_cases import long_but

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.scenario.starter import METHODS, Answers, starter_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.design_loads import carries_design_loads
from bridge_demolition_addon.model.stages.standing import StandingBridge

IMPORTED = EXAMPLES / "imported"
"""Bridges from files that have no bars."""

WITHOUT_BARS_OF_TRAFFIC = (
    REPORT_2019,
    IMPORTED,
    EXAMPLES / "arches_and_frames",
    EXAMPLES / "steel",
    EXAMPLES / "prestressed",
    PRESETS / "steel",
)
"""Folders of bridges with other bars, or none, than a design for traffic gives, or of one piece without bearings."""


def is_as_it_is(path):
    """Whether a file is a scenario of a bridge that is designed for traffic, and not of many runs."""
    heading = tomllib.loads(path.read_text(encoding="utf-8"))
    elsewhere = set(WITHOUT_BARS_OF_TRAFFIC) & set(path.parents) or "of_2019" in path.stem
    return "scenario" in heading and not elsewhere


FILES = {
    path.stem: path for folder in (EXAMPLES, PRESETS) for path in sorted(folder.rglob("*.toml")) if is_as_it_is(path)
}

POSITIONS = {
    "three_span_box_girder": {"LM1 on span 2", "LM1 on span 1 and 2"},
    "excavator_on_the_deck": {"LM1 on span 1", "LM1 on span 1 and 2"},
    "reinforced_spans_pier_removed": {"LM1 on span 1", "LM1 on span 1 and 2"},
    "two_spans_13m_ball": {"LM1 on span 1"},
    "viaduct_pier": {"LM1 on span 1"},
}
"""Those of the loads that are tried, of several that are alike or carry less."""

SAME_BRIDGE = {"two_spans": "two_spans_13m_ball", "misfire": "two_spans_13m_ball"}
"""Examples whose bridge is that of another one, shard by shard."""
QUICK = ("reinforced_span_ball",)
"""A preset that takes least."""


def starter(folder, by):
    path = folder / "new.toml"
    path.write_text(starter_text(Answers(by=by)), encoding="utf-8")
    return path


def test_there_are_some():
    assert {"two_spans_13m_ball", "three_span_box_girder", "excavator_on_the_deck", "reinforced_span_ball"} < set(FILES)


@pytest.mark.parametrize("name", FILES)
def test_it_has_bars_and_is_elastic(name):
    scenario = read_scenario(FILES[name])
    assert scenario.bridge.reinforcement.has_bars and scenario.connections.is_elastic
    # Decks do not lie loose: all that lies on something has bearings.
    assert scenario.bridge.bearings or scenario.bearings


@pytest.mark.parametrize("by", METHODS)
def test_so_is_what_bda_new_writes(tmp_path, by):
    scenario = read_scenario(starter(tmp_path, by))
    assert scenario.bridge.reinforcement.has_bars and scenario.connections.is_elastic and scenario.bridge.bearings


@pytest.mark.parametrize("name", long_but(QUICK, FILES))
def test_it_stands_at_rest_and_every_shard_is_held(name):
    facts = "\n".join(scenario_facts(read_scenario(FILES[name])))
    assert "At rest" in facts
    for words in ("does not stand", "not held", "comes down"):
        assert words not in facts


@pytest.mark.parametrize("name", long_but(QUICK, sorted(set(FILES) - set(SAME_BRIDGE))))
def test_it_carries_1_35_times_its_weight_and_1_5_times_its_traffic(name):
    assert_carries(FILES[name], POSITIONS.get(name, ()))


@pytest.mark.long
def test_so_does_what_bda_new_writes(tmp_path):
    assert_carries(starter(tmp_path, "removal"), {"LM1 on span 1", "LM1 on span 1 and 2"})


def assert_carries(path, positions):
    scenario = read_scenario(path)
    carried = carries_design_loads(scenario, StandingBridge(checked_model(scenario), scenario.joints), positions)
    assert carried and set(positions) <= set(carried)
    assert [name for name, carries in carried.items() if not carries] == []


@pytest.mark.parametrize("name", SAME_BRIDGE)
def test_examples_of_the_same_bridge_differ_in_nothing_that_carries(name):
    scenario, other = read_scenario(FILES[name]), read_scenario(FILES[SAME_BRIDGE[name]])
    for part in ("seed", "bridge", "fracture", "connections"):
        assert getattr(scenario, part) == getattr(other, part)
