# SPDX-License-Identifier: GPL-3.0-or-later
"""Load, save, new, presets and build, as they are called from Python."""

import pytest
from support.checkout import REPORT_2019, SMALL
from support.long_cases import long_but

from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.ui.scenario.prop import PRESETS, default_scenario
from bridge_demolition_addon.ui.scenario.values import scenario_of

EXAMPLE = REPORT_2019 / "single_span_explosives.toml"


def names(bpy):
    return sorted(obj.name for obj in bpy.data.objects)


def test_loading_shows_the_file_and_its_charges_and_builds_nothing(extension, settings):
    settings.scenario_path = str(EXAMPLE)
    assert extension.ops.bda.load_scenario() == {"FINISHED"}
    assert scenario_of(settings) == read_scenario(EXAMPLE)
    assert names(extension) == ["east pier", "mid span", "west pier"]
    assert extension.context.scene.rigidbody_world is None


def test_loading_again_replaces_the_charges(extension, settings):
    settings.scenario_path = str(EXAMPLE)
    for _ in range(2):
        extension.ops.bda.load_scenario()
    assert names(extension) == ["east pier", "mid span", "west pier"]


@pytest.mark.parametrize("text", [None, "not = a scenario", "[scenario]"])
def test_what_cannot_be_loaded_changes_nothing(extension, settings, tmp_path, text):
    path = tmp_path / "wrong.toml"
    if text:
        path.write_text(text)
    settings.scenario_path = str(path)
    for operator in (extension.ops.bda.load_scenario, extension.ops.bda.build_scenario):
        with pytest.raises(RuntimeError, match=r"wrong\.toml"):
            operator()
    assert scenario_of(settings) == default_scenario()
    assert names(extension) == []
    assert extension.context.scene.rigidbody_world is None


def test_a_path_from_an_unsaved_file_is_refused(extension, settings):
    settings.scenario_path = "//bridge.toml"
    with pytest.raises(RuntimeError, match="save it or give a full path"):
        extension.ops.bda.load_scenario()
    with pytest.raises(RuntimeError, match="save it or give a full path"):
        extension.ops.bda.save_scenario(filepath="//bridge.toml")


def test_what_was_saved_is_what_was_loaded(extension, settings, tmp_path):
    settings.scenario_path = str(EXAMPLE)
    extension.ops.bda.load_scenario()
    path = tmp_path / "saved.toml"
    assert extension.ops.bda.save_scenario(filepath=str(path)) == {"FINISHED"}
    assert path.read_text(encoding="utf-8") == scenario_text(read_scenario(EXAMPLE))


def test_a_saved_file_gets_its_suffix(extension, settings, tmp_path):
    extension.ops.bda.save_scenario(filepath=str(tmp_path / "saved"))
    assert read_scenario(tmp_path / "saved.toml") == default_scenario()


def test_what_cannot_be_saved_is_named_and_writes_nothing(extension, settings, tmp_path):
    settings.scenario.bridge.use_mass_kg = True
    path = tmp_path / "saved.toml"
    with pytest.raises(RuntimeError, match=r"bridge\.density_kg_m3 and bridge\.mass_kg are given together"):
        extension.ops.bda.save_scenario(filepath=str(path))
    assert not path.exists()


def test_a_place_that_cannot_be_written_is_refused(extension, settings, tmp_path):
    with pytest.raises(RuntimeError, match="cannot be written"):
        extension.ops.bda.save_scenario(filepath=str(tmp_path / "nowhere" / "saved.toml"))
    assert settings.scenario_path == ""


@pytest.mark.parametrize(
    "path", long_but(sorted(PRESETS.glob("*.toml"))[:2], sorted(PRESETS.glob("*.toml"))), ids=lambda path: path.stem
)
def test_presets_are_shown_and_can_be_built(extension, settings, path):
    extension.ops.bda.load_preset(preset=path.stem)
    assert scenario_of(settings) == read_scenario(path)
    settings.scenario.fracture.shards = 40
    extension.ops.bda.build_scenario()
    bodies = extension.context.scene.rigidbody_world.collection.objects
    count = len([body for body in bodies if body.name.startswith("Shard")])
    # Members with blast zones take a shard more for a part than they have by their size.
    assert count == 40 if not settings.scenario.blast_zones else 40 <= count <= 40 + len(settings.scenario.blast_zones)


def test_a_preset_that_is_not_there_changes_nothing(extension, settings):
    with pytest.raises(RuntimeError, match="no such file"):
        extension.ops.bda.load_preset(preset="three_spans")
    assert scenario_of(settings) == default_scenario()


def test_new_takes_everything_back(extension, settings):
    settings.scenario_path = str(EXAMPLE)
    extension.ops.bda.load_scenario()
    extension.ops.bda.new_scenario()
    assert scenario_of(settings) == default_scenario()
    assert (settings.scenario_path, names(extension)) == ("", [])


def test_building_takes_what_the_panels_show(extension, settings):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 25
    settings.scenario.title = "Twenty-five"
    extension.ops.bda.build_scenario()
    assert len(extension.context.scene.rigidbody_world.collection.objects) == 27


def test_building_again_switches_contours_off_as_nothing_is_run_yet(extension, settings):
    extension.ops.bda.build_scenario()
    settings.contours = True
    extension.ops.bda.build_anew()
    assert not settings.contours


def test_building_loads_a_file_that_was_not_loaded_yet(extension, settings):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    assert scenario_of(settings) == read_scenario(SMALL)
    assert len(extension.context.scene.rigidbody_world.collection.objects) == 32


def test_building_keeps_the_charges_that_are_there(extension, settings):
    extension.ops.bda.load_preset(preset="span_of_2019_explosives")
    settings.scenario.fracture.shards = 30
    charge = extension.context.scene.objects["West pier"]
    charge.location.x = 0.25
    extension.ops.bda.build_scenario()
    charges = [obj for obj in extension.context.scene.objects if "bda_mass_kg" in obj]
    assert [named.name for named in charges] == ["West pier", "East pier", "Mid span"]
    assert charges[0] == charge and charge.location.x == 0.25


def test_building_what_contradicts_itself_changes_nothing(extension, settings):
    settings.scenario.ball.target_m = (100.0, 0.0)
    with pytest.raises(RuntimeError, match=r"ball\.target_m.1 is 100\.0: expected a position on the deck"):
        extension.ops.bda.build_scenario()
    assert names(extension) == []
    assert extension.context.scene.rigidbody_world is None


def test_lists_grow_move_and_shrink(extension, settings):
    path = "bda.scenario.connections.between"
    connections = settings.scenario.connections
    for members in ("a", "b", "c"):
        extension.ops.bda.add_table(path=path)
        connections.between[connections.between_index].members = members
    extension.ops.bda.move_table(path=path, direction="UP")
    assert [rule.members for rule in connections.between] == ["a", "c", "b"]
    assert connections.between_index == 1
    extension.ops.bda.move_table(path=path, direction="DOWN")
    extension.ops.bda.move_table(path=path, direction="DOWN")
    assert [rule.members for rule in connections.between] == ["a", "b", "c"]
    extension.ops.bda.remove_table(path=path)
    assert [rule.members for rule in connections.between] == ["a", "b"]
    for _ in range(2):
        extension.ops.bda.remove_table(path=path)
    with pytest.raises(RuntimeError, match="Choose what to remove"):
        extension.ops.bda.remove_table(path=path)
    with pytest.raises(RuntimeError, match="no such list"):
        extension.ops.bda.add_table(path="bda.scenario.nothing")


def test_settings_are_saved_with_the_file(extension, settings, tmp_path):
    settings.scenario_path = str(EXAMPLE)
    extension.ops.bda.load_scenario()
    settings.scenario.bridge.deck.width_m = 8.75
    expected = scenario_of(settings)
    file = str(tmp_path / "scene.blend")
    extension.ops.wm.save_as_mainfile(filepath=file)
    extension.ops.wm.read_factory_settings(use_empty=True)
    extension.ops.wm.open_mainfile(filepath=file)
    assert scenario_of(extension.context.scene.bda) == expected


def test_building_by_its_button_leaves_the_selection(extension, settings):
    """The shards are selected meanwhile, for the view to show them."""
    context = extension.context
    settings.scenario_path = str(SMALL)
    charge = extension.data.objects.new("Charge", None)
    context.scene.collection.objects.link(charge)
    charge.select_set(True)
    extension.ops.bda.build_scenario("INVOKE_DEFAULT")
    assert list(context.selected_objects) == [charge]
