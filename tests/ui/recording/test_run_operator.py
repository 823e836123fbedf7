# SPDX-License-Identifier: GPL-3.0-or-later
"""Run, Bake and Delete Bake, called as scripts call them."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from support.blocks import Blocks
from support.checkout import REPORT_2019

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.scene.blast.force_fields import force_objects

FRAMES = 12


@pytest.fixture
def blocks(extension):
    return Blocks()


@pytest.fixture
def scene(blocks, tmp_path):
    """A block that falls beside another that is held."""
    ground = blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    blocks.block((3, 0, 5), 100.0)
    blocks.connect("FIXED", (0, 0, 0.5), ground, blocks.block((0, 0, 1.5), 100.0))
    blocks.scene.frame_end = FRAMES
    blocks.scene.bda.output_directory = str(tmp_path / "results")
    return blocks.scene


def refusal(operator):
    with pytest.raises(RuntimeError) as refused:
        operator()
    return str(refused.value)


def falling_height(scene):
    body = scene.rigidbody_world.collection.objects["Block 1"]
    return body.evaluated_get(scene.view_layers[0].depsgraph).matrix_world.translation.z


def test_run_records_all_frames_and_writes_results(extension, scene, tmp_path):
    assert extension.ops.bda.run() == {"FINISHED"}
    folder = tmp_path / "results"
    with np.load(folder / "results.npz") as arrays:
        assert arrays["frames"].tolist() == list(range(2, FRAMES + 1))
        times, row = arrays["times_s"], arrays["body_names"].tolist().index("Block 1")
        heights = arrays["places_m"][:, row, 2]
        substep = arrays["substep_s"][-1]
    # Semi-implicit Euler falls n (n + 1) / 2 times g h² in n steps.
    steps = np.round(times / substep)
    expected = 5.0 - STANDARD_GRAVITY_M_S2 * substep**2 * steps * (steps + 1) / 2
    assert heights == pytest.approx(expected, abs=1e-5)  # Blender keeps gravity in single precision
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["completed"] is True and summary["title"] == scene.name
    with (folder / "debris_log.csv").open(newline="", encoding="utf-8") as log:
        assert len(list(csv.DictReader(log))) > 0
    assert scene.frame_current == FRAMES


def test_run_simulates_again_what_was_played_before(extension, scene, tmp_path):
    for frame in range(1, FRAMES + 1):
        scene.frame_set(frame)
    assert extension.ops.bda.run() == {"FINISHED"}
    with np.load(tmp_path / "results" / "results.npz") as arrays:
        assert arrays["frames"].tolist() == list(range(2, FRAMES + 1))


def test_run_ends_with_the_simulation_where_the_scene_goes_on(extension, scene):
    scene.rigidbody_world.point_cache.frame_end = FRAMES - 4
    assert extension.ops.bda.run() == {"FINISHED"}
    assert scene.frame_current == FRAMES - 4


def test_run_refuses(extension, scene, tmp_path):
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "notes.txt").write_text("mine")
    assert "overwriting" in refusal(extension.ops.bda.run)
    scene.bda.output_directory = "//beside"
    assert "not saved yet" in refusal(extension.ops.bda.run)
    scene.bda.output_directory = str(tmp_path / "other")
    scene.frame_end = 1
    assert "nothing to play" in refusal(extension.ops.bda.run)
    assert scene.frame_current == 1


def test_run_takes_an_empty_folder_as_the_file_browser_makes_them(extension, scene, tmp_path):
    (tmp_path / "results").mkdir()
    assert extension.ops.bda.run() == {"FINISHED"}
    assert (tmp_path / "results" / "summary.json").is_file()


def explode(extension, scene):
    """A charge beside the blocks, and a force field for each of them."""
    extension.ops.bda.add_source_point()
    scene.bda.scenario.blast.explosion = True
    scene.bda.scenario.blast.start_s = 0.1
    extension.ops.bda.build_force_objects()
    return next(obj for obj in extension.data.objects if "bda_mass_kg" in obj)


def test_a_body_added_after_the_force_fields_gets_one_when_it_runs(extension, blocks, scene):
    explode(extension, scene)
    fields = force_objects(scene)
    added = blocks.block((-3, 0, 5), 50.0)
    assert extension.ops.bda.run() == {"FINISHED"}
    assert added in force_objects(scene) and fields.items() < force_objects(scene).items()


@pytest.mark.parametrize("overwrite", [False, True])
def test_a_charge_that_cannot_go_off_is_refused_and_nothing_is_lost(extension, scene, tmp_path, overwrite):
    charge = explode(extension, scene)
    folder = tmp_path / "results"
    if overwrite:
        assert extension.ops.bda.run() == {"FINISHED"}
        scene.bda.overwrite = True
    before = sorted(folder.rglob("*"))
    charge["bda_explosive"] = "jelly"
    assert "Charge 1: explosive is 'jelly'" in refusal(extension.ops.bda.run)
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("wrong", ["no volume", "no frames", "charge"])
def test_a_run_that_comes_to_nothing_leaves_its_folder_free(extension, scene, tmp_path, wrong):
    charge = explode(extension, scene)
    body = scene.rigidbody_world.collection.objects["Block 1"]
    if wrong == "no volume":
        body.scale.x = 0.0
    elif wrong == "no frames":
        scene.frame_end = 1
    else:
        charge["bda_explosive"] = "jelly"
    assert {"no volume": "no volume", "no frames": "nothing to play", "charge": "Charge 1: explosive is 'jelly'"}[
        wrong
    ] in refusal(extension.ops.bda.run)
    assert not (tmp_path / "results").exists()
    body.scale.x, scene.frame_end, charge["bda_explosive"] = 1.0, FRAMES, "TNT"
    assert extension.ops.bda.run() == {"FINISHED"}


def test_everything_refuses_without_a_world(extension):
    operators = extension.ops.bda
    for operator in (operators.run, operators.bake):
        assert "no rigid-body world" in refusal(operator)
    assert "no bake" in refusal(operators.delete_bake)


def test_bake_is_played_back_and_deleted(extension, scene):
    assert "Nothing has been simulated" in refusal(extension.ops.bda.bake)
    extension.ops.bda.run()
    fallen = falling_height(scene)
    assert extension.ops.bda.bake() == {"FINISHED"}
    assert "baked already" in refusal(extension.ops.bda.bake)
    assert "baked" in refusal(extension.ops.bda.run)
    scene.frame_set(1)
    assert falling_height(scene) == pytest.approx(5.0)
    scene.frame_set(FRAMES)
    assert falling_height(scene) == pytest.approx(fallen)
    assert extension.ops.bda.delete_bake() == {"FINISHED"}
    scene.bda.overwrite = True
    assert extension.ops.bda.run() == {"FINISHED"}
    assert falling_height(scene) == pytest.approx(fallen)


def test_run_that_is_ended_by_a_deletion_keeps_its_frames(extension, scene, tmp_path):
    def delete(scene_, _depsgraph):
        if scene_.frame_current == 8:
            extension.data.objects.remove(scene_.rigidbody_world.constraints.objects[0])

    extension.app.handlers.frame_change_post.append(delete)
    try:
        assert extension.ops.bda.run() == {"FINISHED"}
    finally:
        extension.app.handlers.frame_change_post.remove(delete)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text(encoding="utf-8"))
    assert summary["completed"] is False
    with np.load(Path(tmp_path / "results" / "results.npz")) as arrays:
        assert arrays["frames"][-1] == 8


def test_a_run_of_a_scenario_is_told_of_as_on_the_command_line(extension, tmp_path):
    settings = extension.context.scene.bda
    settings.scenario_path = str(REPORT_2019 / "single_span_explosives.toml")
    extension.ops.bda.load_scenario()
    settings.scenario.fracture.shards = 20
    settings.scenario.time.duration_s = 0.5
    settings.scenario.connections.warm_up_s = 0.2
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    extension.ops.bda.run()
    summary = json.loads((tmp_path / "results" / "summary.json").read_text(encoding="utf-8"))
    assert summary["seed"] == 8
    assert summary["charges"]["mass_kg"] == 58.0
    assert summary["charges"]["largest_mass_at_once_kg"] == 50.0
    assert summary["settled"]["time_s"] == pytest.approx(0.2, abs=1 / 24)


@pytest.mark.parametrize("stop", [False, True])
def test_a_run_ends_at_rest_where_it_is_to(extension, tmp_path, stop):
    settings = extension.context.scene.bda
    settings.scenario_path = str(REPORT_2019 / "i235_one_span.toml")
    extension.ops.bda.load_scenario()
    settings.scenario.use_ball = False
    settings.scenario.fracture.shards = 20
    settings.scenario.time.duration_s = 2.0
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "results")
    settings.scenario.time.stop_at_rest = stop  # also when it is built already
    extension.ops.bda.run()
    summary = json.loads((tmp_path / "results" / "summary.json").read_text(encoding="utf-8"))
    assert summary["completed"]
    with np.load(tmp_path / "results" / "results.npz") as arrays:
        # Nothing wakes the bridge: it rests from the start, and has to for one second.
        assert arrays["times_s"][-1] == pytest.approx(1.0 if stop else 2.0, abs=2 / 24)
    assert extension.context.scene.frame_end == 50
