# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Explosion: charges in the scene, force fields, total mass, and what is ticked."""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.model.blast.charges import EXPLOSIVES
from bridge_demolition_addon.model.blast.settings import BlastSettings
from bridge_demolition_addon.model.scenario.bridge_checks import deck_top
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.scene.blast.charges import blast_of, charge_objects, charges_of, keep_blast
from bridge_demolition_addon.ui.blast import keep_shown_blast


@pytest.fixture
def built(extension, settings):
    """The small bridge with its ball, built."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    return extension


def test_a_source_point_is_added_at_the_cursor(extension, settings):
    extension.context.scene.cursor.location = (1.5, -2.0, 3.0)
    for _ in range(2):
        extension.ops.bda.add_source_point()
    first, second = charges_of(extension.context.scene)
    assert (first.name, second.name) == ("Charge 1", "Charge 2")
    assert first.position_m == (1.5, -2.0, 3.0)
    assert (first.mass_kg, first.explosive, first.delay_s) == (10.0, "TNT", 0.0)
    assert settings.charge_index == 1


def test_the_button_puts_a_charge_at_the_face_of_the_nearest_pier(extension, settings):
    """Two spans of 10 m, piers of two columns of 0.8 m by 0.6 m, in the middle of each half of a deck of 6 m."""
    bridge = settings.scenario.bridge
    bridge.span_lengths_m, bridge.deck.width_m, bridge.pier_caps.width_m = "[10.0, 10.0]", 6.0, 6.0
    bridge.piers.columns, bridge.piers.column_length_m, bridge.piers.column_width_m = 2, 0.8, 0.6
    scene = extension.context.scene
    scene.cursor.location = (12.0, -1.2, 0.0)
    extension.ops.bda.add_source_point(at_pier=True)
    (charge,) = charges_of(scene)
    assert charge.position_m == pytest.approx((10.4, -1.5, 1.0), abs=1e-6)
    assert charge.burst == "surface"


def test_a_built_pier_takes_it_and_a_cursor_on_the_bridge_keeps_it(built):
    scene = built.context.scene
    bridge = read_scenario(SMALL).bridge
    scene.cursor.location = (-5.0, 0.0, 0.0)
    built.ops.bda.add_source_point(at_pier=True)
    (first,) = charges_of(scene)
    across_m = bridge.deck.width_m * (0.5 / bridge.piers.columns - 0.5)
    face = (-bridge.piers.column_length_m / 2.0, abs(across_m), 1.0)
    assert (first.position_m[0], abs(first.position_m[1]), first.position_m[2]) == pytest.approx(face, abs=1e-5)
    scene.cursor.location = (bridge.spans_m / 2.0, 0.0, deck_top(bridge))
    built.ops.bda.add_source_point(at_pier=True)
    assert charges_of(scene)[1].position_m == pytest.approx(tuple(scene.cursor.location))
    assert charges_of(scene)[1].burst == "air"


def test_without_a_pier_it_is_at_the_cursor(extension, settings):
    settings.scenario.use_bridge = False
    extension.context.scene.cursor.location = (1.5, -2.0, 3.0)
    extension.ops.bda.add_source_point(at_pier=True)
    assert charges_of(extension.context.scene)[0].position_m == (1.5, -2.0, 3.0)


def test_choosing_a_charge_selects_it(extension, settings):
    for _ in range(3):
        extension.ops.bda.add_source_point()
    settings.charge_index = 1
    assert [selected_object.name for selected_object in extension.context.selected_objects] == ["Charge 2"]
    assert extension.context.view_layer.objects.active.name == "Charge 2"


def test_explosive_and_burst_are_those_of_the_chosen_charge(extension, settings):
    for _ in range(2):
        extension.ops.bda.add_source_point()
    settings.charge_explosive, settings.charge_burst = "C-4", "surface"
    first, second = charges_of(extension.context.scene)
    assert (first.explosive, first.burst, second.explosive, second.burst) == ("TNT", "air", "C-4", "surface")
    settings.charge_index = 0
    assert (settings.charge_explosive, settings.charge_burst) == ("TNT", "air")
    for name in EXPLOSIVES:
        settings.charge_explosive = name
        assert charges_of(extension.context.scene)[0].explosive == name


def test_deleting_takes_the_chosen_one_and_chooses_the_next(extension, settings):
    for _ in range(3):
        extension.ops.bda.add_source_point()
    settings.charge_index = 1
    extension.ops.bda.delete_source_point()
    assert [charge_object.name for charge_object in charge_objects(extension.context.scene)] == ["Charge 1", "Charge 3"]
    assert settings.charge_index == 1
    for _ in range(2):
        extension.ops.bda.delete_source_point()
    assert not extension.ops.bda.delete_source_point.poll()


def test_properties_of_a_charge_have_limits_and_tooltips(extension):
    extension.ops.bda.add_source_point()
    (charge,) = charge_objects(extension.context.scene)
    for name in ("bda_mass_kg", "bda_delay_s", "bda_explosive", "bda_burst"):
        assert charge.id_properties_ui(name).as_dict()["description"]
    for name in ("bda_mass_kg", "bda_delay_s"):
        assert charge.id_properties_ui(name).as_dict()["min"] == 0.0


def test_charges_keep_their_order_whatever_their_names(extension):
    for _ in range(11):
        extension.ops.bda.add_source_point()
    assert [charge.name for charge in charges_of(extension.context.scene)] == [f"Charge {n}" for n in range(1, 12)]


def test_total_mass_is_that_of_all_active_bodies_but_the_ball(built, settings):
    bodies = built.context.scene.rigidbody_world.collection.objects
    ball = next(body for body in bodies if "ball" in body.name)
    expected = sum(body.rigid_body.mass for body in bodies if body.rigid_body.type == "ACTIVE" and body != ball)
    # The deck is 9 m x 4 m x 0.4 m, and each of two piers 0.8 m x 2 m x 3 m, of 2400 kg/m³.
    assert expected == pytest.approx(2400 * (9 * 4 * 0.4 + 2 * 0.8 * 2 * 3), rel=1e-5)
    built.ops.bda.show_total_mass()
    assert settings.total_mass == f"{expected:,.0f} kg".replace(",", " ")


def test_every_active_body_gets_a_force_object_once(built):
    for _ in range(2):
        built.ops.bda.build_force_objects()
    fields = [obj for obj in built.context.scene.objects if obj.field and obj.field.type == "FORCE"]
    assert len(fields) == 31


def test_force_objects_leave_the_selection_as_it_is(built):
    """Whatever is selected is moved or deleted by the next key."""
    before = list(built.context.selected_objects)
    built.ops.bda.build_force_objects()
    assert list(built.context.selected_objects) == before


def test_buttons_without_a_world_are_greyed(extension):
    assert not extension.ops.bda.build_force_objects.poll()
    assert not extension.ops.bda.show_total_mass.poll()


def test_what_is_ticked_counts(built, settings):
    settings.scenario.blast.explosion = False
    built.ops.bda.build_force_objects()
    assert not blast_of(built.context.scene).explosion
    settings.scenario.blast.explosion = True
    settings.scenario.blast.start_s = 0.1
    settings.scenario.blast.apply = "direct"
    keep_shown_blast(built.context.scene)
    found = blast_of(built.context.scene)
    assert (found.explosion, found.apply, found.start_s) == (True, "direct", 0.1)


def test_settings_saved_before_are_read(extension):
    scene = extension.context.scene
    assert blast_of(scene) == BlastSettings(explosion=False)
    saved = {"explosion": True, "apply": "direct", "start_s": 0.2, "model": "kinney-graham", "loading": "reflected"}
    for name, value in (saved | {"shielding": True, "constant_decay": -1.0}).items():
        scene[f"bda_blast_{name}"] = value
    assert blast_of(scene) == BlastSettings(**saved, shielding=True)
    scene["bda_blast_constant_decay"] = 1.0
    assert blast_of(scene).constant_decay == 1.0


def test_settings_are_read_as_they_were_kept(extension):
    scene = extension.context.scene
    for settings in (BlastSettings(start_s=0.1, slow_frame_ms=2.0, constant_decay=0.0), BlastSettings()):
        keep_blast(scene, settings)
        assert blast_of(scene) == settings
