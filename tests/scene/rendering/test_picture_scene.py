# SPDX-License-Identifier: GPL-3.0-or-later
"""Dressed pictures show bodies where they were recorded, say their time and scale, and change nothing of the run."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread
from support.checkout import REPORT_2019
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.display.approaches import approaches
from bridge_demolition_addon.display.dressing import LOOKS_ONLY, Stuff
from bridge_demolition_addon.display.moved_surfaces import boxes_of_bodies, moved, parted
from bridge_demolition_addon.display.road_furniture import road_furniture
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import read_scenario

BLASTED = read_scenario(REPORT_2019 / "single_span_explosives.toml")
RUN = replace(
    BLASTED,
    fracture=replace(BLASTED.fracture, shards=30),
    time=replace(BLASTED.time, duration_s=1.2, stop_at_rest=False),
    blast=replace(BLASTED.blast, start_s=0.1),
    pictures=replace(BLASTED.pictures, width_px=160, height_px=90, renderer="realistic"),
)
BALL = replace(SHORT_RUN, pictures=replace(SHORT_RUN.pictures, width_px=160, height_px=90, renderer="realistic"))


@pytest.fixture
def ran(blender, tmp_path):
    """Scene and results of a short run of a bridge that is blasted."""
    from bridge_demolition_addon.simulation.run import run_scenario

    run_scenario(RUN, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    return blender.context.scene, load_results(tmp_path / "run"), tmp_path


def names(blender):
    groups = ("scenes", "objects", "meshes", "materials", "collections", "curves", "cameras", "actions")
    return {group: set(getattr(blender.data, group).keys()) for group in groups}


def places(scene):
    scene.frame_set(scene.frame_end)
    layer = scene.view_layers[0].depsgraph
    bodies = scene.rigidbody_world.collection.objects
    return np.array([body.evaluated_get(layer).matrix_world for body in bodies])


def test_time_scale_and_places_are_those_of_the_run_and_nothing_of_it_changes(blender, ran):
    from bridge_demolition_addon.scene.rendering.picture_scene import dressed_pictures

    scene, results, folder = ran
    before, there = places(scene), names(blender)
    frame = scene.frame_end
    with dressed_pictures(scene, results, RUN.pictures, has_bars=True) as dressed:
        dressed.scene.cycles.samples = 1
        dressed.render(frame, folder / "end.png")
        texts = {obj.name.split(".")[0]: obj.data.body for obj in dressed.scene.objects if obj.type == "FONT"}
        shown = {obj.name.split(".")[0]: np.array(obj.matrix_world) for obj in dressed.scene.objects}
        rates = scene.render.fps / scene.render.fps_base
        shards = {body.name: np.array(body.location) for body in scene.rigidbody_world.collection.objects}
    rows = {str(name): row for row, name in enumerate(results.inventory.body_names)}
    # The first frame of a run is Blender's second: the time follows from the rate of frames.
    assert texts["Time"] == f"t = {(frame - results.frames.number[0]) / rates:.2f} s"
    assert all(texts[f"{name} shade"] == texts[name] for name in ("Time", "Note", "Scale"))
    assert texts["Note"] == LOOKS_ONLY and texts["Scale"] == f"bar: {dressed.bar.text}"
    assert shards and all(name in rows for name in shards)
    assert {"Looks white", "Looks concrete", "Looks black", "Dust 0"} <= set(shown)
    assert imread(folder / "end.png")[..., :3].std() > 0.05
    assert names(blender) == there
    assert np.array_equal(places(scene), before)


@pytest.mark.long
def test_copies_stand_where_bodies_were_recorded_and_rough_ones_are_no_larger(blender, ran):
    from bridge_demolition_addon.scene.rendering.picture_scene import dressed_pictures

    scene, results, folder = ran
    with dressed_pictures(scene, results, RUN.pictures, has_bars=False) as dressed:
        dressed.scene.cycles.samples = 1
        dressed.render(scene.frame_end, folder / "end.png")
        rough = 0
        for row, name in enumerate(results.inventory.body_names.tolist()):
            copies = [obj for obj in dressed.scene.objects if obj.name.split(".")[0] == name.split(".")[0]]
            match = [
                obj
                for obj in copies
                if np.allclose(obj.matrix_world.translation, results.frames.positions_m[-1, row], atol=1e-4)
            ]
            original = scene.objects[name]
            if original.rigid_body.type != "ACTIVE":
                continue
            assert match, name
            (copy,) = match
            corners = np.array([vert.co for vert in copy.data.vertices])
            of_run = np.array([vert.co for vert in original.data.vertices])
            assert (corners.min(axis=0) >= of_run.min(axis=0) - 1e-5).all()
            assert (corners.max(axis=0) <= of_run.max(axis=0) + 1e-5).all()
            rough += len(corners) > len(of_run)
    assert rough


@pytest.mark.long
def test_nothing_is_seen_of_a_break_before_it_opens(ran):
    _, results, _ = ran
    opened, intact = parted(results), np.asarray(results.frames.intact)
    assert not opened[0].any() and opened[-1].any()
    assert not (opened & intact).any()
    connection = int(np.flatnonzero(opened[-1])[0])
    point = results.inventory.points_m[connection][None]
    first, second = (moved(results, -1, int(body), point) for body in results.inventory.pairs[connection])
    assert np.linalg.norm(first - second) > 0.03


@pytest.mark.long
def test_banks_hide_no_body_of_the_run(ran):
    _, results, _ = ran
    moving = np.flatnonzero(results.inventory.masses_kg > 0.0)
    parts = [part for part in approaches(results) if part.stuff in (Stuff.SOIL, Stuff.ASPHALT, Stuff.CONCRETE)]
    assert parts
    for row in range(len(results.frames)):
        boxes = boxes_of_bodies(results, row)[moving]
        for part in parts:
            begin, end = part.solid.vertices[:, 0].min(), part.solid.vertices[:, 0].max()
            assert not ((boxes[:, 1, 0] > begin) & (boxes[:, 0, 0] < end)).any()


@pytest.mark.long
def test_railings_and_markings_stand_on_the_deck_and_go_with_its_shards(ran):
    _, results, _ = ran
    parts = road_furniture(results)
    boxes = boxes_of_bodies(results, 0)
    kinds = results.inventory.body_member_kinds
    assert {part.stuff for part in parts} == {Stuff.CONCRETE, Stuff.STEEL, Stuff.WHITE}
    for part in parts:
        assert kinds[part.body] in ("deck", "bridge")
        assert part.solid.vertices[:, 2].min() >= boxes[part.body, 1, 2] - 1e-6
    markings = [part for part in parts if part.stuff == Stuff.WHITE]
    width = np.ptp(boxes[np.isin(kinds, ("deck", "bridge"))][..., 1])
    across = np.concatenate([part.solid.vertices[:, 1] for part in markings])
    assert np.ptp(across) < width


def test_a_ball_hangs_on_a_rope_all_the_time(blender, tmp_path):
    from bridge_demolition_addon.display.crawlers import StandingRoom, ball_cranes
    from bridge_demolition_addon.simulation.run import run_scenario

    run_scenario(BALL, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run")
    (ball,) = results.inventory.of_kind("ball")
    room = StandingRoom.of_run(results)
    for row in (0, len(results.frames) - 1):
        rope = ball_cranes(results, row, room)[0].solid.vertices
        reaches = np.linalg.norm(rope - results.frames.positions_m[row, ball], axis=1).min()
        assert reaches < 0.1


def test_how_long_pictures_take_is_said_before():
    from bridge_demolition_addon.model.scenario.recording import PictureSettings
    from bridge_demolition_addon.simulation.display.pictures import stage_of_pictures, time_of_cycles_text

    small, large = PictureSettings(width_px=640, height_px=360), PictureSettings(width_px=1920, height_px=1080)
    assert time_of_cycles_text(small, 2) == "which takes about 20 s on 2 processors with nothing else to do"
    assert time_of_cycles_text(large, 1) == "which takes about 7 min on 1 processor with nothing else to do"
    assert "by Cycles, which takes about" in stage_of_pictures(replace(small, renderer="realistic"))
    assert stage_of_pictures(small) == "rendering pictures"
