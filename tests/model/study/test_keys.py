# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of a scenario by their dotted names."""

from dataclasses import replace

import pytest
from support.checkout import DEMOLITIONS, TESTS
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.scenario import Equipment, Removal
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study.keys import changed, keys_named, names_to_propose

CHARGES = (
    Charge(name="mid pier", position_m=(0, 0, 1), mass_kg=10, delay_ms=5),
    Charge(name="span", position_m=(1, 0, 1), mass_kg=20),
    Charge(position_m=(2, 0, 1), mass_kg=30),
)
REMOVALS = tuple(Removal(time_s=time, members=("pier 1",)) for time in (1.0, 2.0))
BLASTED = replace(I235, charges=CHARGES, removals=REMOVALS)


@pytest.mark.parametrize(
    "name, value, unit",
    [
        ("ball.drop_height_m", 5.0, "m"),
        ("bridge.deck.thickness_m", 0.25, "m"),
        ("scenario.title", I235.title, ""),
        ("ground.friction", 0.8, ""),
        ("ball.target_m.2", 0.0, "m"),
        ("bridge.span_lengths_m.1", 13.0, "m"),
        ('charges."mid pier".mass_kg', 10.0, "kg"),
        ("charges.span.mass_kg", 20.0, "kg"),
        ("charges.2.mass_kg", 20.0, "kg"),
        ('charges."Charge 3".position_m.1', 2.0, "m"),
        ("removals.2.time_s", 2.0, "s"),
        ('zones."Side road".corners_m.2.1', 23.0, "m"),
        ("connections.breaking_force_n", None, "N"),
    ],
)
def test_a_name_leads_to_its_value(name, value, unit):
    (found,) = keys_named(BLASTED, name)
    assert (found.value, found.unit) == (value, unit)


def test_a_number_becomes_the_name_where_there_is_one():
    assert keys_named(BLASTED, "charges.1.mass_kg")[0].name == 'charges."mid pier".mass_kg'
    assert keys_named(BLASTED, "removals.1.time_s")[0].name == "removals.1.time_s"
    assert keys_named(BLASTED, "'ball'.mass_kg")[0].name == "ball.mass_kg"


def test_a_list_without_a_name_leads_to_all_of_it():
    found = keys_named(BLASTED, "charges.delay_ms")
    assert [key.name for key in found] == [
        'charges."mid pier".delay_ms',
        "charges.span.delay_ms",
        'charges."Charge 3".delay_ms',
    ]
    assert [key.value for key in found] == [5.0, 0.0, 0.0]
    assert [key.name for key in keys_named(BLASTED, "charges.position_m.3")][1] == "charges.span.position_m.3"


def test_each_name_that_is_found_leads_back_to_the_same_value():
    for path in DEMOLITIONS.values():
        scenario = read_scenario(path)
        for name in ("charges.mass_kg", "zones.corners_m.1.1", "fracture.finer.factor", "connections.between.type"):
            try:
                found = keys_named(scenario, name)
            except ScenarioError as error:
                assert "it has no [[" in str(error)
                continue
            for named in found:
                assert keys_named(scenario, named.name) == (named,)


def test_tables_of_one_name_are_told_apart_by_their_numbers():
    machines = tuple(
        Equipment(
            name=name, mass_kg=30_000, position_m=(5, 0), footprint_m=(4, 3), from_s=since_s, until_s=since_s + 1.0
        )
        for since_s, name in enumerate(("breaker", "breaker", "crane"))
    )
    found = keys_named(replace(I235, equipment=machines), "equipment.mass_kg")
    assert [key.name for key in found] == ["equipment.1.mass_kg", "equipment.2.mass_kg", "equipment.crane.mass_kg"]


def test_other_values_are_those_of_the_keys_alone():
    keys = {key.name: key for key in keys_named(BLASTED, "charges.delay_ms")}
    (target,) = keys_named(BLASTED, "ball.target_m.1")
    found = changed(BLASTED, {keys["charges.span.delay_ms"]: 7.0, keys['charges."mid pier".delay_ms']: 6.0, target: 5})
    charges = (replace(CHARGES[0], delay_ms=6.0), replace(CHARGES[1], delay_ms=7.0), BLASTED.charges[2])
    assert found == replace(BLASTED, charges=charges, ball=replace(I235.ball, target_m=(5.0, 0.0)))
    assert changed(BLASTED, {}) == BLASTED


@pytest.mark.parametrize(
    "name, message",
    [
        ("", '"" is no name of a key: expected one such as ball.drop_height_m'),
        ("ball..mass_kg", '"ball..mass_kg" is no name of a key'),
        ("ball.mass_kg = 3 #", "is no name of a key"),
        ("a = 1\nb", "is no name of a key"),
        ("bal.mass_kg", "bal.mass_kg is unknown: expected a key with its table"),
        ("seed", "seed is unknown: expected a key with its table"),
        ("scenario", "scenario is unknown: expected a key with its table"),
        ("scenario.ball.mass_kg", "scenario.ball.mass_kg is unknown"),
        ("ball.mass", "ball.mass is unknown: did you mean ball.mass_kg?"),
        ("ball.zzz", "ball.zzz is unknown: expected one of mass_kg, diameter_m, "),
        ("ball", "ball is a table: expected a key of it, such as ball.mass_kg"),
        ("ball.target_m", "ball.target_m is a list: expected the number of a value after it, such as ball.target_m.1"),
        ("ball.target_m.0", "ball.target_m.0 is unknown: expected a number from 1 to 2 after ball.target_m"),
        ("ball.target_m.3", "ball.target_m.3 is unknown: expected a number from 1 to 2"),
        ("ball.mass_kg.1", "ball.mass_kg.1 is unknown: ball.mass_kg has one value"),
        ("ball.cable.length_m", "ball.cable.length_m is not in the scenario: it has no table [cable]"),
        ("connections.free.1", "connections.free.1 is not in the scenario: it has no connections.free"),
        ("saw_cuts.time_s", "saw_cuts.time_s is not in the scenario: it has no [[saw_cuts]]"),
        ("charges", "charges is a list: expected a key after it, such as charges.1.name"),
        ("charges.span", "charges.span is a table: expected a key of it, such as charges.span.name"),
        ("charges.4.mass_kg", 'charges.4.mass_kg is not in the scenario: [[charges]] has "mid pier", "span", "Charge'),
        ("charges.pier.mass_kg", "charges.pier.mass_kg is not in the scenario: [[charges]] has"),
        ("charges.delay", "charges.delay is not in the scenario: [[charges]] has"),
    ],
)
def test_what_leads_nowhere_is_refused(name, message):
    with pytest.raises(ScenarioError) as refused:
        keys_named(BLASTED, name)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_every_name_that_is_proposed_leads_to_a_key_that_can_be_drawn():
    everything = read_scenario(TESTS / "simulation" / "everything.toml")
    there = 0
    for name in names_to_propose():
        try:
            found = keys_named(everything, name)
        except ScenarioError as error:
            assert "is not in the scenario: it has no " in str(error)
            continue
        there += 1
        assert all(not isinstance(key.value, tuple) for key in found)
    assert there > 80  # all others are in tables that this scenario does without
    assert {"ball.drop_height_m", "ball.target_m.1", "charges.delay_ms", "connections.type"} <= set(names_to_propose())
    assert not {"scenario.seed", "scenario.title", "zones.name", "geometry.file"} & set(names_to_propose())
