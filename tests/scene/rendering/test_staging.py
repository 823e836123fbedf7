# SPDX-License-Identifier: GPL-3.0-or-later
"""A demolition that was built is framed on ground, under sky and sun; nothing of the user's is lost by it."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import REPORT_2019
from support.long_cases import long_but
from support.scenarios import I235, SHORT_RUN

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.display.camera_targets import points_to_see
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.removal import remove_demolition
from bridge_demolition_addon.scene.rendering.surroundings import stage
from bridge_demolition_addon.scene.visibility import symbols_are_hidden

SPAN = replace(I235, fracture=replace(I235.fracture, shards=20))


@pytest.fixture
def startup(blender):
    """Blender as it starts, with its cube, lamp and camera."""
    blender.ops.wm.read_homefile(use_factory_startup=True)
    return blender.context.scene


def build(scene, scenario=SPAN):
    model = build_model(scenario)
    stage(scene, build_demolition(scene, scenario, model), model, points_to_see(scenario, model.members))


def of_kind(scene, kind):
    return [body for body in bodies_of(scene) if kind_of(body) == kind]


def names(scene):
    return {obj.name for obj in scene.objects}


def test_bodies_are_of_concrete_asphalt_steel_and_soil(blender):
    scene = blender.context.scene
    build(scene)
    (ball,), (ground,) = of_kind(scene, Kind.BALL), of_kind(scene, Kind.GROUND)
    assert [material.name for material in ball.data.materials] == ["Steel"] and ball.data.materials[0].metallic > 0.5
    assert [material.name for material in ground.data.materials] == ["Soil"]
    shards = of_kind(scene, Kind.SHARD)
    cast, broken, road = shards[0].data.materials
    assert all(list(shard.data.materials) == [cast, broken, road] for shard in shards)
    assert sum(broken.diffuse_color[:3]) > sum(cast.diffuse_color[:3]) > sum(road.diffuse_color[:3])
    assert broken.roughness > cast.roughness
    deck = [shard for shard in shards if shard["bda_member_kind"] == "deck"]
    tops = [face.area for shard in deck for face in shard.data.polygons if face.material_index == 2]
    assert sum(tops) == pytest.approx(14.0 * 8.5, rel=1e-5)  # 13 m and two overhangs by the width of the I-235 span
    assert all(not image.users for image in blender.data.images)  # nothing but nodes


def test_what_blender_starts_with_is_hidden_and_comes_back(startup, blender):
    cube, lamp, camera, world = (*(startup.objects[name] for name in ("Cube", "Light", "Camera")), startup.world)
    before = names(startup)
    build(startup)
    assert all(item.hide_render and not item.visible_get() for item in (cube, lamp, camera))
    assert startup.camera.name == "Bridge camera" and startup.world.name == "Sky"
    suns = [obj for obj in startup.objects if obj.type == "LIGHT" and obj.data.type == "SUN"]
    assert len(suns) == 1
    remove_demolition(startup)
    assert names(startup) == before and startup.camera == camera and startup.world == world
    assert all(not item.hide_render and item.visible_get() for item in (cube, lamp, camera))
    assert not {material.name for material in blender.data.materials} - {"Material", "Dots Stroke"}
    assert [background.name for background in blender.data.worlds] == ["World"]
    assert not blender.data.lights.get("Sun") and not blender.data.cameras.get("Bridge camera")


def test_what_the_user_has_changed_is_left_alone(startup, blender):
    cube, camera = startup.objects["Cube"], startup.objects["Camera"]
    cube.location.x, camera.location.z = 3.0, 9.0
    sky = startup.world = blender.data.worlds.new("My sky")
    blender.context.view_layer.update()
    build(startup)
    assert cube.visible_get() and not cube.hide_render
    assert startup.camera == camera and startup.world == sky
    (collection,) = (child for child in startup.collection.children if child.name == "Surroundings")
    kept = blender.data.objects.new("Mine", None)
    collection.objects.link(kept)
    remove_demolition(startup)
    assert kept.name in startup.objects and startup.camera == camera and startup.world == sky


def test_building_twice_leaves_one_sun_one_camera_and_one_sky(startup, blender):
    build(startup)
    with blender.context.temp_override(scene=startup):
        blender.ops.rigidbody.world_remove()  # as the user may do by Blender's own button
    build(startup)
    found = [obj for obj in startup.objects if obj.type in ("LIGHT", "CAMERA")]
    assert sorted(item.name.split(".")[0] for item in found) == ["Bridge camera", "Camera", "Light", "Sun"]
    assert sorted(world.name for world in blender.data.worlds) == ["Sky", "World"]
    assert startup.camera.name == "Bridge camera"


BLASTED = read_scenario(REPORT_2019 / "two_spans_13m_explosives.toml")
BY_FIELDS = replace(
    BLASTED,
    fracture=replace(BLASTED.fracture, shards=30),
    time=replace(BLASTED.time, duration_s=0.6),
    blast=replace(BLASTED.blast, apply="fields", start_s=0.1),
)


@pytest.mark.parametrize("scenario", long_but([SHORT_RUN], [SHORT_RUN, BY_FIELDS]), ids=["ball", "force fields"])
def test_symbols_are_hidden_and_the_simulation_is_the_same(blender, tmp_path, scenario):
    from bridge_demolition_addon.simulation.motion_run import motion_run
    from bridge_demolition_addon.simulation.run import run_scenario

    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    scene = blender.context.scene
    assert symbols_are_hidden(scene.view_layers[0], scene)
    (tmp_path / "bare").mkdir()
    # Which builds bodies and connections, and nothing to look at.
    with motion_run(scenario, build_model(scenario), tmp_path / "bare") as (_, bare):
        assert bare["fingerprint"]["motion"] == summary["fingerprint"]["motion"]


def test_the_camera_sees_sky_and_patterns_know_where_shards_were_built(blender):
    scene = blender.context.scene
    build(scene)
    from bpy_extras.object_utils import world_to_camera_view
    from mathutils import Vector

    scene.view_layers[0].update()
    horizon = world_to_camera_view(scene, scene.camera, Vector((0.0, 1e5, 0.0)))
    assert 0.8 < horizon.y < 1.0  # there is sky, and not much of it
    built_at = np.array([body["bda_built_at_m"] for body in of_kind(scene, Kind.SHARD)])
    assert np.allclose(built_at, [body.location for body in of_kind(scene, Kind.SHARD)])
