# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a run, by each camera, and the same from the window as without one."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread
from support.checkout import REPORT_2019
from support.long_cases import long_but
from support.scenarios import I235

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import OutputError, ScenarioError
from bridge_demolition_addon.model.run_folder.files import PICTURES
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text
from bridge_demolition_addon.model.scenario.recording import PictureSettings

BLAST = read_scenario(REPORT_2019 / "two_spans_13m_explosives.toml")
SHORT = replace(
    BLAST,
    fracture=replace(BLAST.fracture, shards=20),
    time=replace(BLAST.time, duration_s=0.5),
    blast=replace(BLAST.blast, start_s=0.1),
    pictures=PictureSettings(width_px=160, height_px=90),
)
ALIKE = 0.02
"""Mean difference of brightness: the same scene, but Blender's window keeps the user's own sky."""


def pictures(folder):
    return {name: imread(folder / "frames" / f"{name}.png")[:, :, :3] for name in PICTURES}


def run(scenario, folder):
    from bridge_demolition_addon.simulation.run import run_scenario

    run_scenario(scenario, folder, overwrite=False, pictures=True, progress=Silence())
    return pictures(folder)


@pytest.mark.long
@pytest.mark.parametrize("renderer", ["workbench", "cycles"])
def test_a_run_in_the_window_writes_the_same_pictures(extension, tmp_path, renderer):
    scenario = replace(SHORT, pictures=replace(SHORT.pictures, renderer=renderer))
    without = run(scenario, tmp_path / "without")
    extension.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = extension.context.scene
    (tmp_path / "scenario.toml").write_text(scenario_text(scenario), encoding="utf-8")
    scene.bda.scenario_path, scene.bda.output_directory = str(tmp_path / "scenario.toml"), str(tmp_path / "window")
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    scene.cycles.samples = 16
    before = (scene.render.engine, scene.render.resolution_x, scene.camera.name, set(scene.objects.keys()))
    assert extension.ops.bda.run(pictures=True) == {"FINISHED"}
    found = pictures(tmp_path / "window")
    assert sorted(path.name for path in (tmp_path / "window" / "frames").iterdir()) == sorted(
        path.name for path in (tmp_path / "without" / "frames").iterdir()
    )
    for name, picture in found.items():
        assert picture.shape == without[name].shape == (90, 160, 3)
        assert picture.std() > 0.05  # not empty
        assert abs(picture - without[name]).mean() < ALIKE, name
    assert (scene.render.engine, scene.render.resolution_x, scene.camera.name, set(scene.objects.keys())) == before
    assert extension.ops.bda.bake() == {"FINISHED"}  # Blender still knows the frames that it played


@pytest.mark.long
def test_both_renderers_show_the_same_moment(extension, tmp_path):
    """What has moved since the start is at the same places of both pictures."""
    time, fracture = replace(I235.time, duration_s=2.5), replace(I235.fracture, shards=20)
    falling = replace(I235, time=time, fracture=fracture, pictures=SHORT.pictures)
    of_cycles = run(replace(falling, pictures=replace(SHORT.pictures, renderer="cycles")), tmp_path / "cycles")
    first, second = (has_changed(found) for found in (of_cycles, run(falling, tmp_path / "workbench")))
    assert first.sum() > 100 and second.sum() > 100
    assert (first & second).sum() > 0.5 * min(first.sum(), second.sum())  # shadows are drawn otherwise


def has_changed(found):
    """Where the last picture differs from the first."""
    return abs(found["after"] - found["before"]).max(axis=2) > 0.1


@pytest.mark.parametrize("engine", long_but(["BLENDER_WORKBENCH"], ["BLENDER_WORKBENCH", "CYCLES"]))
def test_a_scene_just_built_renders_by_f12(extension, tmp_path, engine):
    scene = extension.context.scene
    scene.bda.scenario.fracture.shards = 20
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    scene.render.engine, scene.render.filepath = engine, str(tmp_path / "still.png")
    scene.render.resolution_x, scene.render.resolution_y = 160, 90
    if engine == "CYCLES":
        scene.cycles.samples, scene.cycles.use_denoising = 4, False
    assert extension.ops.render.render(write_still=True) == {"FINISHED"}
    picture = imread(tmp_path / "still.png")[:, :, :3]
    sky, bridge = picture[:10].mean(axis=(0, 1)), picture[35:65, 40:120]
    assert picture.std() > 0.05
    assert abs(bridge.mean(axis=(0, 1)) - sky).max() > 0.05  # something stands before the sky


@pytest.mark.long
def test_an_orbiting_camera_goes_round_and_one_of_the_users_own_stands_where_it_is_put(extension, tmp_path):
    from bridge_demolition_addon.simulation.display.pictures import rendered_pictures

    scene = extension.context.scene
    scene.bda.scenario.fracture.shards = 20
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    scene.rigidbody_world.enabled = False  # nothing but the camera moves
    camera, objects = scene.camera, set(scene.objects.keys())
    views = {
        "framed": {},
        "orbiting": {"orbit_deg": 180.0},
        "own": {"camera_m": (6.5, -40.0, 8.0), "look_at_m": (6.5, 0.0, 3.0)},
    }
    found = {}
    for name, settings in views.items():
        view = PictureSettings(width_px=160, height_px=90, camera=name, **settings)
        list(rendered_pictures(scene, tmp_path / name, view, scene.frame_end // 2, scene.frame_end))
        found[name] = pictures(tmp_path / name)
    for name, taken in found.items():
        moved = abs(taken["after"] - taken["before"]).mean()
        assert moved > 5e-3 if name == "orbiting" else moved < 1e-3, (name, moved)
        assert all(picture.std() > 0.05 for picture in taken.values())
    assert abs(found["own"]["before"] - found["framed"]["before"]).mean() > 5e-3
    own = found["own"]["before"]  # from the middle, square to the road: left and right are the same but for the light
    assert abs(own - own[:, ::-1]).mean() < abs(found["framed"]["before"] - found["framed"]["before"][:, ::-1]).mean()
    assert scene.camera == camera and set(scene.objects.keys()) == objects
    scene.camera = None
    with pytest.raises(OutputError, match="has no camera"):
        next(rendered_pictures(scene, tmp_path / "none", PictureSettings(camera="own"), 1, 1))


def test_an_orbit_keeps_the_bridge_in_view_all_the_way(blender):
    from bpy_extras.object_utils import world_to_camera_view
    from mathutils import Vector

    from bridge_demolition_addon.scene.rendering.surroundings import aim_camera

    scene, points = blender.context.scene, np.array([(0, -4, 0), (26, -4, 0), (0, 4, 6), (26, 4, 6)], float)
    scene.frame_start, scene.frame_end = 1, 41
    scene.render.resolution_x, scene.render.resolution_y = 160, 90
    view = PictureSettings(camera="orbiting", orbit_deg=360.0)
    camera = aim_camera(scene, points, 160 / 90, view=view)
    positions = []
    for frame in range(1, 42, 5):
        scene.frame_set(frame)
        seen = np.array([world_to_camera_view(scene, camera, Vector(point)) for point in points])
        assert (seen[:, :2] > 0.0).all() and (seen[:, :2] < 1.0).all() and (seen[:, 2] > 0.0).all()
        positions.append(np.array(camera.matrix_world.translation))
    np.testing.assert_allclose(positions[0], positions[-1], atol=1e-3)  # once round
    np.testing.assert_allclose(np.mean(positions[:-1], axis=0)[:2], (13.0, 0.0), atol=1e-3)
    turned = np.arctan2(*(positions[1] - (13.0, 0.0, 0.0))[[1, 0]]) - np.arctan2(
        *(positions[0] - (13.0, 0.0, 0.0))[[1, 0]]
    )
    assert np.degrees(turned) == pytest.approx(45.0, abs=1e-3)  # counter-clockwise, an eighth of the way


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"camera_m": (1.0, 2.0, 3.0), "camera": "own"}, r"pictures\.look_at_m is missing"),
        ({"camera_m": (1.0, 2.0, 3.0), "look_at_m": (0.0, 0.0, 0.0)}, r"pictures\.camera is \"framed\""),
        ({"camera": "own", "camera_m": (1.0, 2.0, 3.0), "look_at_m": (1.0, 2.0, 3.0)}, r"pictures\.look_at_m"),
        ({"camera": "flying"}, r"pictures\.camera is \"flying\""),
    ],
)
def test_what_no_camera_can_do_is_refused(settings, message):
    with pytest.raises(ScenarioError, match=message):
        PictureSettings(**settings)


def test_without_a_window_there_is_no_camera_of_the_users_own(blender, tmp_path):
    with pytest.raises(OutputError, match=r"pictures\.camera_m"):
        run(replace(SHORT, pictures=PictureSettings(camera="own")), tmp_path / "run")
    assert not (tmp_path / "run").exists()
