# SPDX-License-Identifier: GPL-3.0-or-later
"""Values that change after Build: the panels say so, and no run is of anything else than they show."""

import json

import pytest
from support.checkout import REPORT_2019, SMALL

from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.schema import holds_many, is_optional, key_fields, subtable_class, value_type
from bridge_demolition_addon.ui.scenario.built import changes
from bridge_demolition_addon.ui.scenario.prop import USE, is_written_out, shown_tables, vector_length
from bridge_demolition_addon.ui.scenario.values import scenario_of

EVERYTHING = SMALL.parents[1] / "simulation" / "everything.toml"

OF_A_RUN = {"scenario.title", "blast", "recording", "pictures", "report"}
OF_A_RUN |= {"zones", "exclusion", "site", "neighbours", "equipment"}
OF_A_RUN |= {
    f"time.{name}" for name in ("stop_at_rest", "rest_speed_m_s", "rest_angular_velocity_rad_s", "rest_hold_s")
}
"""What a run takes as the panels show it when it begins."""


@pytest.fixture
def built(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    return extension


def keys_of(group, table_class, path=""):
    """Every key that a group shows, with the group that shows it and its name in a scenario."""
    for item in key_fields(table_class):
        yield group, item, f"{table_class.table}.{item.name}"
    for item in shown_tables(table_class):
        inner = getattr(group, item.name)
        if holds_many(item):
            for row in inner:
                yield from keys_of(row, subtable_class(item))
        elif not is_optional(item) or getattr(group, USE + item.name):
            yield from keys_of(inner, subtable_class(item))


def change(group, item):
    """Change a value in its panel, and return how to take that back."""
    name = item.name
    if is_optional(item):
        before = getattr(group, USE + name)
        setattr(group, USE + name, not before)
        return lambda: setattr(group, USE + name, before)
    before = getattr(group, name)
    if vector_length(item):
        before = tuple(before)
        setattr(group, name, [number + 0.125 for number in before])
    elif is_written_out(item):
        setattr(group, name, before + ", 1")
    elif value_type(item) is str:
        choices = getattr(group.bl_rna.properties[name], "enum_items", None)
        others = [choice.identifier for choice in choices or () if choice.identifier != before] or [before + "x"]
        setattr(group, name, others[0])
    elif value_type(item) is bool:
        setattr(group, name, not before)
    else:
        setattr(group, name, before + 1 if value_type(item) is int else before * 0.5 + 0.0625)
    return lambda: setattr(group, name, before)


def test_nothing_has_changed_where_nothing_was_built_or_touched(extension, settings):
    assert changes(settings) == []
    for path in (SMALL, EVERYTHING):
        settings.scenario_path = str(path)
        extension.ops.bda.build_scenario()
        assert changes(settings) == []
        extension.ops.bda.remove_demolition()
        assert settings.built_values == "" and changes(settings) == []


def test_every_value_that_changes_is_named_unless_the_run_takes_it_as_shown(extension, settings):
    settings.scenario_path = str(EVERYTHING)
    extension.ops.bda.build_scenario()
    seen = set()
    for group, item, key in list(keys_of(settings.scenario, Scenario)):
        take_back = change(group, item)
        named = {change.key.partition(" (")[0] for change in changes(settings)}
        counts = key not in OF_A_RUN and key.split(".")[0] not in OF_A_RUN
        assert named == ({key} if counts else set()), key
        take_back()
        assert changes(settings) == [], key
        seen.add(key.split(".")[0])
    assert {"scenario", "time", "bridge", "fracture", "connections", "shards", "ground"} <= seen


def test_a_value_says_what_it_was_built_with_in_its_unit(built, settings):
    settings.scenario.ball.mass_kg = 50000.0
    settings.scenario.fracture.shards = 2000
    settings.scenario.use_ball = True
    settings.scenario.bridge.span_lengths_m = "[8.5]"
    settings.scenario.shards.start_deactivated = False
    found = {change.key: (change.shown, change.built) for change in changes(settings)}
    assert found == {
        "ball.mass_kg": ("50 000 kg", f"with {read_scenario(SMALL).ball.mass_kg:,.0f} kg".replace(",", " ")),
        "fracture.shards": ("2 000", "with 30"),
        "bridge.span_lengths_m": ("8.5 m", "with 8 m"),
        "shards.start_deactivated": ("off", "on"),
    }
    settings.scenario.use_ball = False
    assert ("ball", "not used", "with it") in [(change.key, change.shown, change.built) for change in changes(settings)]


def test_a_list_that_is_written_otherwise_is_the_same_list(extension, settings):
    extension.ops.bda.new_scenario()
    settings.scenario.fracture.shards = 30
    extension.ops.bda.build_scenario()
    settings.scenario.bridge.span_lengths_m = " 13 "
    assert changes(settings) == []
    settings.scenario.bridge.span_lengths_m = "13, 13"
    assert [(change.key, change.shown) for change in changes(settings)] == [("bridge.span_lengths_m", "13, 13 m")]


@pytest.mark.parametrize("operator", ["run", "register_handler"])
def test_what_the_panels_do_not_show_is_not_run(built, settings, tmp_path, operator):
    settings.scenario.ball.mass_kg *= 5.0
    with pytest.raises(RuntimeError, match=r"ball\.mass_kg \(.* kg, built with .* kg\); build it again"):
        getattr(built.ops.bda, operator)()
    assert not (tmp_path / "results").exists()


def test_building_anew_and_running_is_one_step(built, settings, tmp_path):
    settings.scenario.ball.mass_kg = 5000.0
    settings.scenario.time.duration_s = 0.5
    settings.scenario.ball.release_time_s = 0.1
    assert built.ops.bda.run(build_anew=True) == {"FINISHED"}
    ball = next(obj for obj in built.context.scene.rigidbody_world.collection.objects if "ball" in obj.name)
    assert ball.rigid_body.mass == 5000.0
    assert read_scenario(tmp_path / "results" / "scenario_as_run.toml") == scenario_of(settings)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text(encoding="utf-8"))
    assert summary["mass_kg"]["ball"] == 5000.0


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [("output_directory", "is not saved yet"), ("force_log_path", "is not saved yet"), (None, "edited")],
)
def test_a_run_that_is_refused_has_changed_no_objects(built, settings, spoilt, said):
    if spoilt:
        settings[spoilt] = "//results"
    else:
        built.context.scene.rigidbody_world.constraints.objects[0]["bda_area_m2"] = ""
    before = {obj.name: obj.session_uid for obj in built.data.objects}
    with pytest.raises(RuntimeError, match=said):
        built.ops.bda.run(build_anew=spoilt is not None)
    assert {obj.name: obj.session_uid for obj in built.data.objects} == before


def test_a_run_without_frames_has_changed_no_objects(extension, settings):
    settings.scenario_path = str(REPORT_2019 / "single_span_explosives.toml")
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 8
    extension.ops.bda.build_scenario()
    extension.context.scene.frame_end = 1
    before = set(extension.data.objects.keys())
    with pytest.raises(RuntimeError, match="nothing to play: the last frame, 1"):
        extension.ops.bda.run()
    assert set(extension.data.objects.keys()) == before


def test_build_anew_leaves_everything_where_it_is_refused(built, settings):
    settings.scenario.ball.target_m = (1000.0, 0.0)
    before = sorted(obj.name for obj in built.data.objects)
    with pytest.raises(RuntimeError, match=r"ball\.target_m.1"):
        built.ops.bda.build_anew()
    mine = built.data.objects.new("Mine", built.data.meshes.new("Mine"))
    built.context.scene.rigidbody_world.collection.objects.link(mine)
    settings.scenario.ball.target_m = (1.0, 0.0)
    with pytest.raises(RuntimeError, match="1 bodies that were not built here, such as 'Mine'"):
        built.ops.bda.build_anew()
    assert sorted(obj.name for obj in built.data.objects) == sorted([*before, "Mine"])


def test_values_are_set_back_and_those_of_the_run_stay(built, settings, tmp_path):
    before = scenario_of(settings)
    settings.scenario.ball.mass_kg = 123.0
    settings.scenario.bridge.deck.thickness_m = 0.0  # which nothing could be built from
    settings.scenario.use_exclusion = True
    settings.scenario.exclusion.buffer_m = 7.0
    settings.scenario.time.stop_at_rest = True
    built.ops.bda.show_built()
    now = scenario_of(settings)
    assert (now.ball, now.bridge, now.exclusion.buffer_m) == (before.ball, before.bridge, 7.0)
    assert now.time.stop_at_rest and now.time.duration_s == before.time.duration_s
    assert changes(settings) == []


def test_what_was_built_is_kept_with_the_file(built, settings, tmp_path):
    file = str(tmp_path / "scene.blend")
    built.ops.wm.save_as_mainfile(filepath=file)
    built.ops.wm.read_factory_settings(use_empty=True)
    built.ops.wm.open_mainfile(filepath=file)
    settings = built.context.scene.bda
    assert changes(settings) == []
    settings.scenario.ball.mass_kg = 50000.0
    assert [change.key for change in changes(settings)] == ["ball.mass_kg"]


def test_a_file_that_only_keeps_its_scenario_is_not_run_with_other_values(built, settings):
    """Files of earlier versions do not keep what the panels showed."""
    settings.built_values = ""
    settings.scenario.ball.mass_kg = 50000.0
    with pytest.raises(RuntimeError, match="built from other values than the panels show; build it again"):
        built.ops.bda.run()


def test_slow_motion_that_was_animated_otherwise_is_not_run(extension, settings, tmp_path):
    settings.scenario_path = str(REPORT_2019 / "single_span_explosives.toml")
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 20
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    settings.scenario.blast.use_slow_frame_ms = True
    settings.scenario.blast.slow_frame_ms = 5.0
    with pytest.raises(RuntimeError, match=r"slow motion was animated .* build it again"):
        extension.ops.bda.run()
