# SPDX-License-Identifier: GPL-3.0-or-later
"""From a scenario to the sidebar's properties and back: nothing is lost, and nothing wrong is taken."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import DEMOLITIONS, SMALL
from support.long_cases import long_but
from support.random_scenarios import varied

from bridge_demolition_addon.engineering.single_precision import shortest
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Charge
from bridge_demolition_addon.model.scenario.connections import LARGE_MODEL, MATERIAL_OF_LARGE_MODELS
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.ui.scenario.hints import breaking_note
from bridge_demolition_addon.ui.scenario.prop import PRESETS, default_scenario
from bridge_demolition_addon.ui.scenario.values import scenario_of, show_scenario

FILES = sorted([*DEMOLITIONS.values(), *PRESETS.rglob("*.toml"), SMALL])


def test_a_new_scene_shows_the_default(settings):
    assert scenario_of(settings) == default_scenario()


@pytest.mark.long  # the next test shows it too
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_example_comes_back_as_it_was(settings, path):
    scenario = read_scenario(path)
    show_scenario(settings, scenario)
    assert scenario_of(settings) == scenario


def test_another_scenario_leaves_nothing_of_the_one_before(settings):
    scenarios = [read_scenario(path) for path in FILES]
    for scenario in (*scenarios, *reversed(scenarios)):
        show_scenario(settings, scenario)
        assert scenario_of(settings) == scenario


@pytest.mark.parametrize("seed", long_but((7, 10), range(12)))
def test_random_scenarios_come_back_as_they_were(settings, seed):
    random = np.random.default_rng(seed)
    scenario = varied(read_scenario(FILES[seed % len(FILES)]), random)
    charge = Charge(
        position_m=tuple(random.normal(size=3)), mass_kg=random.uniform(0, 9), delay_ms=random.uniform(0, 9)
    )
    time = replace(scenario.time, duration_s=max(scenario.time.duration_s, scenario.blast.start_s + 1.0))
    scenario = replace(scenario, time=time, charges=(*scenario.charges, charge, replace(charge, name="x" * 80)))
    show_scenario(settings, scenario)
    assert scenario_of(settings) == scenario


def test_a_typed_number_is_the_decimal_that_was_typed(settings):
    random = np.random.default_rng(7)
    for number in [0.1, 0.35, 1e-3, 12.34, 299.9, *random.integers(1, 10**6, 300) / 1000.0]:
        settings.scenario.bridge.deck.width_m = number
        assert settings.scenario.bridge.deck.width_m != number or number == np.float32(number)
        assert shortest(settings.scenario.bridge.deck.width_m) == number


def test_a_number_changed_after_loading_is_the_new_one_and_others_stay(settings):
    scenario = default_scenario()
    deck = replace(scenario.bridge.deck, width_m=8.512345678901, thickness_m=0.312345678901)
    scenario = replace(scenario, bridge=replace(scenario.bridge, deck=deck))
    show_scenario(settings, scenario)
    settings.scenario.bridge.deck.width_m = 8.6
    found = scenario_of(settings).bridge.deck
    assert (found.width_m, found.thickness_m) == (8.6, 0.312345678901)


def test_check_boxes_take_optional_keys_and_tables_away(settings):
    settings.scenario.use_ball = False
    settings.scenario.bridge.use_pier_caps = False
    settings.scenario.bridge.use_density_kg_m3 = False
    settings.scenario.bridge.use_mass_kg = True
    settings.scenario.bridge.mass_kg = 107000
    found = scenario_of(settings)
    assert found.ball is None
    assert found.bridge.pier_caps is None
    assert (found.bridge.density_kg_m3, found.bridge.mass_kg) == (None, 107000.0)


@pytest.mark.parametrize("text", ["[13.0, 20]", "13.0, 20", " [13, 20.0,] "])
def test_a_list_may_be_written_with_or_without_brackets(settings, text):
    settings.scenario.bridge.span_lengths_m = text
    assert scenario_of(settings).bridge.span_lengths_m == (13.0, 20.0)


@pytest.mark.parametrize(
    "text", ["", "thirteen", "[13.0", "13; 20", "1]\nother = [2", "13, -1", '["13"]', "{}", "[" * 999]
)
def test_what_is_no_list_of_lengths_is_refused_by_name(settings, text):
    settings.scenario.bridge.span_lengths_m = text
    with pytest.raises(ScenarioError, match=r"^bridge\.span_lengths_m.* expected a.* number"):
        scenario_of(settings)


def test_limits_that_blender_cannot_hold_are_refused_by_name(settings):
    settings.scenario.time.duration_s = 0.0
    with pytest.raises(ScenarioError, match=r"time\.duration_s is 0.0: expected a number above 0 \(s\)"):
        scenario_of(settings)


def test_one_of_a_list_that_is_wrong_is_named_by_its_number(settings):
    between = settings.scenario.connections.between
    for members in ('["deck", "pier cap"]', '["deck"]'):
        between.add().members = members
    with pytest.raises(ScenarioError, match=r"\[\[connections\.between\]\] number 2: connections\.between\.members"):
        scenario_of(settings)


def test_two_zones_of_one_name_are_refused_with_both_places(settings):
    for name in ("road", "road"):
        zone = settings.scenario.zones.add()
        zone.name, zone.corners_m = name, "[[0, 0], [9, 0], [9, 9]]"
    with pytest.raises(ScenarioError, match=r'number (\d) and \[\[zones\]\] number (\d) have one name, "road"'):
        scenario_of(settings)


def test_charges_are_read_from_where_they_are_now(settings):
    scene = settings.id_data
    scenario = read_scenario(PRESETS / "span_of_2019_explosives.toml")
    show_scenario(settings, scenario)
    charge = scene.objects["East pier"]
    charge.location.x = 12.5
    charge["bda_mass_kg"] = 75.5
    charge["bda_delay_s"] = 0.025
    charge.name = "Third"
    found = scenario_of(settings).charges[1]
    assert found == replace(scenario.charges[1], name="Third", position_m=(12.5, 0.0, 1.0), mass_kg=75.5, delay_ms=25.0)


def test_a_charge_with_a_wrong_property_is_refused(settings):
    show_scenario(settings, read_scenario(PRESETS / "span_of_2019_explosives.toml"))
    settings.id_data.objects["East pier"]["bda_explosive"] = "jelly"
    with pytest.raises(ScenarioError, match="jelly"):
        scenario_of(settings)


def test_the_panel_says_what_breaks_the_connections_of_a_large_model(settings):
    show_scenario(settings, read_scenario(PRESETS / "span_of_2019_ball.toml"))
    scenario, connections = settings.scenario, settings.scenario.connections
    assert breaking_note(scenario) == ""
    scenario.fracture.shards = LARGE_MODEL
    assert "One force for all" in breaking_note(scenario)
    connections.use_breaking_force_kgf = connections.use_search_radius_m = False
    assert breaking_note(scenario).startswith("Choose")
    connections.method = "face"
    assert MATERIAL_OF_LARGE_MODELS in breaking_note(scenario)
    assert scenario_of(settings).connections.material == MATERIAL_OF_LARGE_MODELS
    scenario.fracture.shards = LARGE_MODEL - 1
    assert breaking_note(scenario).startswith("Choose")
