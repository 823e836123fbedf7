# SPDX-License-Identifier: GPL-3.0-or-later
"""Every key of a scenario has a property, with the unit, the limits and the meaning of the key."""

from typing import get_args, get_origin

import pytest

import bridge_demolition_addon
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.model.scenario import Charge, ConnectionSettings, Scenario
from bridge_demolition_addon.model.schema import (
    holds_many,
    is_optional,
    key_fields,
    key_of,
    subtable_class,
    subtable_fields,
    value_type,
)
from bridge_demolition_addon.ui.scenario.prop import (
    ENSEMBLES,
    all_tables,
    group_name,
    label_of,
    materials_to_propose,
    registered_group,
    shown_keys,
    shown_tables,
)

KEYS = [(table, item) for table in all_tables() for item in shown_keys(table)]
NUMBERS = [(table, item) for table, item in KEYS if {float, int} & {value_type(item), *get_args(value_type(item))}]
UNITS = {"m": "LENGTH", "kg": "MASS", "s": "TIME_ABSOLUTE", "m/s": "VELOCITY", "m³": "VOLUME", "m/s²": "ACCELERATION"}
SINGLE = 6e-8
"""Half of the last digit that single precision has."""


@pytest.fixture(scope="module", autouse=True)
def registered():
    """The extension, switched on once: what is looked at here is its classes, and no scene."""
    bridge_demolition_addon.register()
    yield
    bridge_demolition_addon.unregister()


def property_of(table, name):
    # Every group of Blender's has a name of its own, listed before ours, which takes its place.
    return [prop for prop in registered_group(group_name(table)).bl_rna.properties if prop.identifier == name][-1]


def tables_within(table):
    for item in subtable_fields(table):
        inner = subtable_class(item)
        yield inner
        yield from tables_within(inner)


def test_every_table_but_the_charges_has_a_group():
    roots = (Scenario, *ENSEMBLES.values())
    within = {table for root in roots for table in tables_within(root)}
    assert set(all_tables()) == {*roots, *within} - {Charge}


def test_every_key_has_a_property_that_says_what_it_means():
    for table, item in KEYS:
        name = f"{table.table}.{item.name}"
        found = property_of(table, item.name)
        first_words = item.metadata["key"].description.replace("`", "").rstrip(".")
        assert found.description.startswith(first_words), name
        assert name in found.description
        assert not found.description.endswith("."), name  # Blender ends the sentence
        assert found.name == label_of(table, item), name
        if is_optional(item):
            assert property_of(table, "use_" + item.name).type == "BOOLEAN", name


def test_every_number_has_its_unit_and_limits():
    assert len(NUMBERS) > 300
    for table, item in NUMBERS:
        assert_unit_and_limits(table, item)


def assert_unit_and_limits(table, item):
    rule, held = item.metadata["key"], value_type(item)
    found = property_of(table, item.name)
    if found.type == "STRING":  # a list of any length
        assert get_origin(held) is tuple
        assert f"({rule.unit})" in found.description or not rule.unit
        return
    if found.type == "FLOAT" and rule.unit in UNITS:
        assert found.unit == UNITS[rule.unit]
    elif rule.unit == "1/s":
        assert "per Second" in found.name
    elif rule.unit:
        assert found.name.endswith(f"({rule.unit})")
    if rule.at_least is not None:
        assert found.hard_min == pytest.approx(rule.at_least, rel=SINGLE)
    if rule.above is not None:
        assert found.hard_min == rule.above + (1 if held is int else 0)
    if rule.at_most is not None:
        assert found.hard_max == pytest.approx(rule.at_most, rel=SINGLE)


def test_choices_are_a_menu():
    for table, item in KEYS:
        choices = item.metadata["key"].choices
        if choices and value_type(item) is str and not item.metadata["key"].or_else:
            found = tuple(property_of(table, item.name).enum_items.keys())
            assert found == choices, f"{table.table}.{item.name}"


def test_labels_end_with_no_unit_that_blender_shows_itself():
    labels = {f"{table.table}.{item.name}": label_of(table, item) for table, item in KEYS}
    assert labels["bridge.deck.width_m"] == "Width"
    assert labels["connections.breaking_force_kgf"] == "Breaking Force (kgf)"
    assert labels["shards.deactivation_angular_velocity_rad_s"] == "At Rest Below Turning Speed (rad/s)"
    assert labels["bridge.density_kg_m3"] == "Density (kg/m³)"


def test_labels_use_the_words_of_the_glossary():
    labels = {f"{table.table}.{item.name}": label_of(table, item) for table, item in KEYS}
    assert labels["search.trials"] == "Runs"
    assert labels["neighbours.position_m"] == "Position"
    assert labels["time.rest_angular_velocity_rad_s"] == "Rest Angular Velocity (rad/s)"
    assert not {"Trials", "Draws", "Place", "Spin"} & {word for label in labels.values() for word in label.split()}


def test_names_of_one_group_do_not_meet():
    for table in all_tables():
        names = [item.name for item in shown_keys(table)]
        for item in subtable_fields(table):
            names += [item.name, item.name + "_index"] if holds_many(item) else [item.name]
        names += ["use_" + item.name for item in (*shown_keys(table), *shown_tables(table)) if is_optional(item)]
        assert len(set(names)) == len(names)


def test_materials_of_the_users_own_are_proposed_beside_the_others():
    import bpy

    scenario = bpy.context.scene.bda.scenario
    scenario.materials.add().name = "my concrete"
    (rule,) = (key_of(item) for item in key_fields(ConnectionSettings) if item.name == "material")
    assert materials_to_propose(scenario.connections, rule) == [*MATERIALS, "my concrete"]
    scenario.connections.material = "my concrete"
    assert scenario.connections.material == "my concrete"
    scenario.materials.clear()
    scenario.connections.property_unset("material")
