# SPDX-License-Identifier: GPL-3.0-or-later
"""What is written is what ran, whatever was changed in Blender after the scenario was built."""

import json
import shutil
from dataclasses import fields

import numpy as np
import pytest
from support.checkout import SMALL
from support.long_cases import long_but

from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.model.scenario.time import TimeSettings
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of
from bridge_demolition_addon.ui.scenario.built import ChangedValue, changed_in_blender

FRAMES, SHARDS = 20, 12


def of_kind(scene, kind):
    return [body for body in bodies_of(scene) if kind_of(body) == kind]


def bodies_with(kind, name, value):
    def change(scene):
        for body in of_kind(scene, kind):
            setattr(body.rigid_body, name, value)

    return change


def render(name, value):
    return lambda scene: setattr(scene.render, name, value)


def world(name, value):
    return lambda scene: setattr(scene.rigidbody_world, name, value)


CHANGES = {
    "time.frames_per_second": (render("fps", 60), 60),
    "time.frames_per_second_base": (render("fps_base", 1.001), 1.001),
    "time.substeps_per_frame": (world("substeps_per_frame", 7), 7),
    "time.farthest_per_substep_m": (lambda scene: scene.__setitem__("bda_farthest_per_substep_m", 0.02), 0.02),
    "time.solver_iterations": (world("solver_iterations", 23), 23),
    "time.split_impulse": (world("use_split_impulse", False), False),
    "time.time_scale": (world("time_scale", 0.7), 0.7),
    "time.duration_s": (lambda scene: setattr(scene, "frame_end", 15), 13 / 24),
    "shards.collision_margin_m": (bodies_with(Kind.SHARD, "collision_margin", 0.02), 0.02),
    "shards.linear_damping": (bodies_with(Kind.SHARD, "linear_damping", 0.2), 0.2),
    "shards.angular_damping": (bodies_with(Kind.SHARD, "angular_damping", 0.3), 0.3),
    "shards.use_deactivation": (bodies_with(Kind.SHARD, "use_deactivation", False), False),
    "shards.start_deactivated": (bodies_with(Kind.SHARD, "use_start_deactivated", False), False),
    "shards.deactivation_linear_velocity_m_s": (bodies_with(Kind.SHARD, "deactivate_linear_velocity", 0.1), 0.1),
    "shards.deactivation_angular_velocity_rad_s": (bodies_with(Kind.SHARD, "deactivate_angular_velocity", 0.2), 0.2),
    "ball.mass_kg": (bodies_with(Kind.BALL, "mass", 50000.0), 50000.0),
    "ball.angular_damping": (bodies_with(Kind.BALL, "angular_damping", 0.6), 0.6),
}
"""Keys of a scenario, what changes them in Blender, and the value to be written."""

SURFACES = {
    ("shards", "friction"): (Kind.SHARD, 0.3, True),
    ("shards", "restitution"): (Kind.SHARD, 0.4, True),
    ("ground", "friction"): (Kind.GROUND, 0.2, True),
    ("ground", "restitution"): (Kind.GROUND, 0.9, False),
    ("ball", "friction"): (Kind.BALL, 0.9, True),
    ("ball", "restitution"): (Kind.BALL, 0.8, False),
}
"""Bodies and values of theirs, what is set in Blender, and whether pairs make it: a shard has no restitution, and a
product with 0 says nothing of the other body."""


def first_shard(scene):
    return of_kind(scene, Kind.SHARD)[0]


def first_connection(scene):
    return scene.rigidbody_world.constraints.objects[0]


def animate_speed(scene):
    for frame, scale in ((1, 1.0), (10, 0.5)):
        scene.rigidbody_world.time_scale = scale
        scene.keyframe_insert("rigidbody_world.time_scale", frame=frame)


def move(body):
    body.location.z += 0.5


def delete(found):
    import bpy

    bpy.data.objects.remove(found)


BY_HAND = {
    "gravity": lambda scene: setattr(scene, "gravity", (0.0, 0.0, -1.62)),
    "positions, shapes or sizes": lambda scene: move(first_shard(scene)),
    "masses of bodies": lambda scene: setattr(first_shard(scene).rigid_body, "mass", 1.0),
    "how bodies move and touch": lambda scene: setattr(first_shard(scene).rigid_body, "friction", 0.1),
    "which bodies there are": lambda scene: setattr(first_shard(scene), "name", "My shard"),
    "kinds and strengths": lambda scene: setattr(first_connection(scene).rigid_body_constraint, "type", "HINGE"),
    "which connections there are": lambda scene: delete(first_connection(scene)),
    "the speed of the simulation": animate_speed,
    "the last frame, 4, which is before all": lambda scene: setattr(scene, "frame_end", 4),
}


@pytest.fixture
def built(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.time.duration_s = (FRAMES - 2) / 24
    settings.scenario.fracture.shards = SHARDS
    extension.ops.bda.build_scenario()
    settings.output_directory, settings.overwrite = str(tmp_path / "results"), True
    return extension


def summary_in(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def test_every_setting_of_time_is_tried():
    taken_at_run = {"stop_at_rest", "rest_speed_m_s", "rest_angular_velocity_rad_s", "rest_hold_s"}
    assert {f"time.{field.name}" for field in fields(TimeSettings) if field.name not in taken_at_run} <= set(CHANGES)


QUICK = ("ball.mass_kg",)
QUICK_SURFACES = (("shards", "friction"),)
QUICK_BY_HAND = ("gravity", "positions, shapes or sizes")
"""Of each kind one that takes little."""


@pytest.mark.parametrize("key", long_but(QUICK, CHANGES))
def test_what_was_changed_is_written_and_runs_again_to_the_last_bit(built, settings, tmp_path, key):
    change, value = CHANGES[key]
    change(built.context.scene)
    written = written_and_run_again(built, tmp_path)
    table, name = key.split(".")
    assert getattr(getattr(written, table), name) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(("table", "name"), long_but(QUICK_SURFACES, SURFACES, several=True))
def test_a_surface_that_was_changed_is_written_as_pairs_where_pairs_make_it(built, settings, tmp_path, table, name):
    kind, value, are_pairs = SURFACES[table, name]
    bodies_with(kind, name, value)(built.context.scene)
    written = written_and_run_again(built, tmp_path)
    assert getattr(written.surface_of(getattr(written, table)), name) == pytest.approx(value, rel=1e-7)
    assert (written.contacts is not None) == are_pairs


def written_and_run_again(built, tmp_path):
    """The scenario that was written of a run, after it has run again to the last bit."""
    assert built.ops.bda.run() == {"FINISHED"}
    written = read_scenario(tmp_path / "results" / "scenario_as_run.toml")
    first = summary_in(tmp_path / "results")
    assert first["made_by_hand"] == []

    built.ops.wm.read_factory_settings(use_empty=True)
    settings = built.context.scene.bda
    settings.scenario_path = str(tmp_path / "results" / "scenario_as_run.toml")
    built.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "again")
    built.ops.bda.run()
    second = summary_in(tmp_path / "again")
    assert second["fingerprint"]["motion"] == first["fingerprint"]["motion"]
    return written


def test_several_changes_at_once_are_written_as_they_ran(built, tmp_path):
    scene = built.context.scene
    scene.render.fps, scene.rigidbody_world.substeps_per_frame, scene.frame_end = 60, 4, 32
    built.ops.bda.run()
    written = read_scenario(tmp_path / "results" / "scenario_as_run.toml")
    with np.load(tmp_path / "results" / "results.npz") as arrays:
        assert arrays["times_s"][-1] == pytest.approx(written.time.duration_s, rel=1e-6)
        assert arrays["substep_s"][1:] == pytest.approx(written.time.step.substep_s, rel=1e-6)
    # The ball is let go in the frame that it was animated for, which is three frames after time begins.
    assert written.ball.release_time_s == pytest.approx(0.1 * 24 / 60)


def test_the_panel_says_how_time_runs_otherwise_than_it_was_built(built):
    assert changed_in_blender(built.context.scene) == []
    built.context.scene.render.fps = 60
    assert changed_in_blender(built.context.scene) == [ChangedValue("time.frames_per_second", "60", "with 24")]


@pytest.mark.long
def test_a_second_run_finds_nothing_changed(built, tmp_path):
    for _ in range(2):
        built.ops.bda.run()
        assert summary_in(tmp_path / "results")["made_by_hand"] == []
        text = (tmp_path / "results" / "scenario_as_run.toml").read_text(encoding="utf-8")
        assert text == built.context.scene.bda.built_scenario


IN_PLAIN_WORDS = {
    "positions, shapes or sizes": "1 shard is moved, such as 'Shard 000000'",
    "which bodies there are": "1 shard is missing, such as 'Shard 000000'",
    "which connections there are": "1 connection fewer than built",
}
"""What the run reports of some of them; of all others it says the same as the files."""


@pytest.mark.parametrize("what", long_but(QUICK_BY_HAND, BY_HAND))
def test_what_no_scenario_can_say_is_said_beside_it(built, settings, tmp_path, capfd, what):
    BY_HAND[what](built.context.scene)
    built.ops.bda.run()
    folder = tmp_path / "results"
    told = summary_in(folder)["made_by_hand"]
    assert what in told[0]
    assert IN_PLAIN_WORDS.get(what, what) in capfd.readouterr().out
    first_line = (folder / "scenario_as_run.toml").read_text(encoding="utf-8").splitlines()[0]
    assert first_line.startswith("# Changed in Blender, and not in this scenario: ") and what in first_line
    assert scenario_text(read_scenario(folder / "scenario_as_run.toml")) == settings.built_scenario
    assert any(what in shortcoming for shortcoming in read_run(folder).shortcomings)


@pytest.mark.long
def test_frames_of_another_length_are_refused_where_slow_motion_is_animated(extension, settings, tmp_path):
    extension.ops.bda.load_preset(preset="span_of_2019_explosives")
    settings.scenario.fracture.shards = 20
    settings.scenario.time.duration_s = 0.7
    settings.scenario.blast.use_slow_frame_ms = True
    settings.scenario.blast.slow_frame_ms = 10.0
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    extension.ops.bda.run()
    assert summary_in(tmp_path / "results")["made_by_hand"] == []
    shutil.rmtree(tmp_path / "results")
    extension.context.scene.render.fps = 60
    extension.ops.bda.run()
    told = summary_in(tmp_path / "results")["made_by_hand"]
    assert len(told) == 2 and "slow motion was animated for frames of another length" in told[0]
    assert told[1] == "the speed of the simulation, which is animated"


@pytest.mark.long
def test_values_that_single_precision_rounds_are_as_they_were_built(extension):
    """0.02 m is 0.0199999996 m in a panel, and all digits of it in the scene."""
    extension.ops.bda.load_preset(preset="drilled_spans")
    extension.context.scene.bda.scenario.fracture.shards = 30
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    assert changed_in_blender(extension.context.scene) == []
    extension.context.scene["bda_farthest_per_substep_m"] = 0.03
    assert [change.shown for change in changed_in_blender(extension.context.scene)] == ["0.03 m"]
