# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures: what the camera sees, and that something is drawn."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from matplotlib.image import imread
from support.scenarios import I235

from bridge_demolition_addon.model.scenario.recording import PictureSettings
from bridge_demolition_addon.model.structure.model import build_model

BRIDGE = np.array(list(product((-0.5, 13.5), (-4.25, 4.25), (0.0, 5.55))))
TOWER = np.array(list(product((0.0, 2.0), (0.0, 2.0), (0.0, 80.0))))
TOY = BRIDGE / 200.0
VIADUCT = BRIDGE * (100.0, 1.0, 2.0)


@pytest.mark.parametrize("size", [(160, 90), (90, 160), (100, 100)], ids="{0[0]}x{0[1]}".format)
@pytest.mark.parametrize(
    "points", [BRIDGE, TOWER, TOY, VIADUCT, BRIDGE + 500.0], ids=["bridge", "tower", "toy", "viaduct", "far off"]
)
def test_camera_sees_everything_and_wastes_little(blender, points, size):
    from bpy_extras.object_utils import world_to_camera_view
    from mathutils import Vector

    from bridge_demolition_addon.scene.rendering.stills import prepare_pictures
    from bridge_demolition_addon.scene.rendering.surroundings import aim_camera

    scene = blender.context.scene
    prepare_pictures(scene, PictureSettings(width_px=size[0], height_px=size[1]))
    aim_camera(scene, points, size[0] / size[1])
    scene.view_layers[0].update()
    seen = np.array([world_to_camera_view(scene, scene.camera, Vector(point)) for point in points])
    across = seen[:, :2]
    assert (across > 0.0).all() and (across < 1.0).all()
    assert (seen[:, 2] > scene.camera.data.clip_start).all() and (seen[:, 2] < scene.camera.data.clip_end).all()
    # In perspective the near half is larger than the far one: the bridge fills half of the picture in one direction.
    assert np.ptp(across, axis=0).max() > 0.5


def test_camera_stands_above_the_ground_beside_the_road(blender):
    from bridge_demolition_addon.scene.rendering.surroundings import aim_camera

    aim_camera(blender.context.scene, BRIDGE, 160 / 90)
    x, y, z = blender.context.scene.camera.location
    assert x < 6.5 and y < -4.25 and z > 0.0


def test_a_picture_shows_the_bridge_and_the_ball(blender, tmp_path):
    from bpy_extras.object_utils import world_to_camera_view
    from mathutils import Vector

    from bridge_demolition_addon.scene.demolition import build_demolition
    from bridge_demolition_addon.scene.rendering.stills import prepare_pictures, render_picture
    from bridge_demolition_addon.scene.rendering.surroundings import stage

    scenario = replace(I235, fracture=replace(I235.fracture, shards=20))
    scene, model = blender.context.scene, build_model(scenario)
    shards = build_demolition(scene, scenario, model)
    prepare_pictures(scene, PictureSettings(width_px=640, height_px=360))
    stage(scene, shards, model, np.vstack((BRIDGE, (6.5, 0.0, 11.9))))
    render_picture(scene, 1, tmp_path / "before.png")
    picture = imread(tmp_path / "before.png")[:, :, :3]
    assert picture.shape == (360, 640, 3)

    def brightness(place):
        x, y, _ = world_to_camera_view(scene, scene.camera, Vector(place))
        row, column = round((1.0 - y) * 359), round(x * 639)
        return np.median(picture[row - 2 : row + 3, column - 2 : column + 3])  # whatever outline crosses there

    (x, y, z), (end, _, top) = min(
        (member.solid.bounds for member in model.members if member.kind == "pier"), key=lambda b: b[0, 1]
    )
    # The ball of steel and the asphalt are dark, the cast side of a pier is light, and the soil lies between.
    ball, road, pier = (
        brightness((6.5, 0.0, 11.22)),
        brightness((6.5, 0.0, 5.55)),
        brightness(((x + end) / 2, y, 0.6 * top + z)),
    )
    soil = brightness((12.0, -8.0, 0.0))
    assert max(ball, road) < soil - 0.05 < soil + 0.05 < pier
    assert not (tmp_path / "before.png.png").exists()


def test_a_picture_shows_a_charge_until_it_goes_off(blender, tmp_path):
    from bridge_demolition_addon.model.blast.charges import Charge
    from bridge_demolition_addon.scene.blast.charges import create_charges, show_never, show_until
    from bridge_demolition_addon.scene.rendering.stills import prepare_pictures, render_picture
    from bridge_demolition_addon.scene.rendering.surroundings import aim_camera

    scene = blender.context.scene
    charges = [
        Charge(name=name, position_m=position, mass_kg=1.0) for name, position in (("a", (-1, 0, 0)), ("b", (1, 0, 0)))
    ]
    first, second = create_charges(scene, charges)
    prepare_pictures(scene, PictureSettings(width_px=160, height_px=90))
    aim_camera(scene, np.array(list(product((-1.5, 1.5), (-0.5, 0.5), (-0.5, 0.5)))), 160 / 90)
    show_until(first, 5)
    show_until(second, 99)
    assert first.instance_collection == second.instance_collection
    red = []
    for frame in (1, 4, 5, 9):
        render_picture(scene, frame, tmp_path / f"{frame}.png")
        picture = imread(tmp_path / f"{frame}.png")
        red.append(int((picture[:, :, 0] > 2.0 * picture[:, :, 1:3].max(axis=2)).sum()))
    show_until(first, 9)  # as of another run
    scene.frame_set(8)
    assert not first.hide_render
    show_never(first)
    scene.frame_set(9)
    assert not first.hide_render and first.instance_type == "NONE"
    # Two red balls of 0.6 m in a view of some 3 m, and then one of them.
    assert red[0] > 200 and red[1] == red[0] and red[2] == red[3]
    assert 0.3 < red[2] / red[0] < 0.7
