# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets by picture and by name: all examples, and the scenarios made for them."""

import pytest
from PIL import Image
from support.checkout import DEMOLITIONS, EXAMPLES

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.ui.messages import messages_of
from bridge_demolition_addon.ui.scenario.values import scenario_of

SMALLEST_PX = (256, 192)
LETTERS_PT, BELOW_PICTURE_PX = 11, 80
"""Height of letters in the window, and what it draws whole below a picture of 4.5 lines: 78 is, 85 is cut off."""
FOLDERS = ("arches_and_frames", "steel", "prestressed")
KINDS = {path.stem: path for folder in FOLDERS for path in (EXAMPLES / folder).glob("*.toml")}
"""Examples of arches, frames, bridges of steel, and prestressed ones."""


@pytest.fixture
def presets(extension):
    from bridge_demolition_addon.ui.scenario import preset_menu

    yield preset_menu
    preset_menu.unregister()


def test_it_holds_all_examples(presets):
    files = presets.preset_files()
    assert set(DEMOLITIONS) | set(KINDS) < set(files)
    assert len(files) == len(DEMOLITIONS) + len(KINDS) + len(list(presets.PRESETS.rglob("*.toml")))


def test_each_has_a_picture_that_shows_something(presets):
    for name in presets.preset_files():
        with Image.open(presets.picture_of_preset(name)) as picture:
            assert picture.size == SMALLEST_PX
            darkest, brightest = picture.convert("L").getextrema()
        assert brightest - darkest > 60, name


def test_a_preset_says_what_it_is(presets):
    shown = presets.described_preset("reinforced_span_ball")
    scenario = read_scenario(presets.preset_file("reinforced_span_ball"))
    assert shown.startswith(f"{scenario.title}: {scenario.fracture.shards} shards, {scenario.time.duration_s:g} s. ")


def test_blender_loads_the_pictures_and_lets_go_of_them(extension, presets):
    pictures = presets.loaded_pictures()
    assert set(pictures) == set(presets.preset_files())
    assert tuple(pictures["i235_one_span"].image_size) == SMALLEST_PX
    presets.unregister()
    assert presets.loaded_pictures() is not pictures


def test_an_example_is_shown_as_its_file_says(extension, settings, presets):
    shown = ("i235_two_spans", "jackhammer_dismantling", "two_spans_20m_delays", *KINDS)
    for name in shown:
        assert extension.ops.bda.load_preset(preset=name) == {"FINISHED"}
        assert scenario_of(settings) == read_scenario((DEMOLITIONS | KINDS)[name])


def test_the_first_has_bars_and_is_elastic(presets):
    first = read_scenario(next(iter(presets.preset_files().values())))
    assert first.bridge.reinforcement.has_bars and first.connections.is_elastic


def test_presets_are_found_by_the_names_that_they_had(presets):
    for earlier, name in (
        ("one_span_wrecking_ball", "span_of_2019_ball"),
        ("one_span_explosives", "span_of_2019_explosives"),
    ):
        assert presets.preset_file(earlier) == presets.preset_files()[name]


def test_labels_are_all_different(presets):
    names = list(presets.preset_files())
    assert len({presets.label_of_preset(name) for name in names}) == len(names)
    assert presets.label_of_preset("i235_one_span") == "I-235 one span"


def test_names_below_pictures_are_all_different_and_are_not_cut_off(presets):
    import blf  # is there once bpy is

    names = [presets.label_below_picture(name) for name in presets.preset_files()]
    assert len(set(names)) == len(names)
    blf.size(0, LETTERS_PT)
    assert [name for name in names if blf.dimensions(0, name)[0] > BELOW_PICTURE_PX] == []


def test_choosing_a_picture_loads_its_preset(extension, settings, presets):
    for name in ("reinforced_span_ball", "i235_two_spans"):
        settings.preset = name
        assert scenario_of(settings) == read_scenario(presets.preset_file(name))
        assert settings.preset == name


def test_a_preset_that_is_loaded_otherwise_is_the_picture_shown(extension, settings, presets):
    extension.ops.bda.load_preset(preset="i235_one_span")
    assert settings.preset == "i235_one_span"
    settings.scenario.title = "My own bridge"
    assert settings.preset == "NONE"
    extension.ops.bda.new_scenario()
    assert settings.preset == "reinforced_span_ball"


def test_a_picture_that_cannot_be_loaded_now_says_why_in_the_panel(extension, settings, presets):
    cube = extension.data.objects.new("Cube", extension.data.meshes.new("Cube"))
    extension.context.collection.objects.link(cube)
    extension.context.view_layer.objects.active = cube
    extension.ops.object.mode_set(mode="EDIT")
    settings.preset = "i235_two_spans"
    extension.ops.object.mode_set(mode="OBJECT")
    assert [message.text for message in messages_of(extension.context.scene)] == ["Go to object mode first"]
    assert settings.preset == "reinforced_span_ball"


def test_no_two_scenarios_have_one_title(presets):
    """The title says which picture is shown."""
    titles = [read_scenario(path).title for path in presets.preset_files().values()]
    assert len(set(titles)) == len(titles)
