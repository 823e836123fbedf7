"""Cutting anew leaves nothing of the old shards behind; supports hold; paint is read."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bridge_demolition_addon.core.density import painted_density
from bridge_demolition_addon.core.errors import GeometryError
from bridge_demolition_addon.core.model import build_model
from bridge_demolition_addon.core.scenario import FractureSettings, Support
from bridge_demolition_addon.core.scenario.file import read_scenario
from bridge_demolition_addon.core.solids import box
from bridge_demolition_addon.scene.bodies import Kind, bodies_of, create_shards, kind_of
from bridge_demolition_addon.scene.connections import connections_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.painting import painted_points
from bridge_demolition_addon.scene.removal import remove_shards
from bridge_demolition_addon.scene.world import off_scene

I235 = replace(
    read_scenario(Path(__file__).parents[2] / "examples" / "i235_one_span.toml"), fracture=FractureSettings(shards=30)
)


def shards_of(scene):
    return [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]


@pytest.mark.parametrize("played", [0, 12])
def test_no_shard_mesh_or_connection_is_left(blender, played):
    scene = blender.context.scene
    build_demolition(scene, I235, build_model(I235))
    for frame in range(1, played + 1):
        scene.frame_set(frame)
    assert remove_shards(scene) == 30
    assert scene.frame_current == 1
    assert shards_of(scene) == [] and connections_of(scene) == []
    assert {kind_of(body) for body in bodies_of(scene)} == {Kind.GROUND, Kind.BALL}
    assert len(blender.data.meshes) == 2 and not any(mesh.users == 0 for mesh in blender.data.meshes)
    assert not [each for each in blender.data.objects if each.rigid_body_constraint]
    assert remove_shards(scene) == 0


def test_cut_anew_and_played_again(blender):
    scene = blender.context.scene
    model = build_model(I235)
    build_demolition(scene, I235, model)
    for frame in range(1, 8):
        scene.frame_set(frame)
    for _ in range(3):
        remove_shards(scene)
        with off_scene(scene) as (bodies, _):
            create_shards(bodies, I235.shards, model.shards, model.centres_m, model.masses_kg)
        for frame in range(1, 40):
            scene.frame_set(frame)
        assert len(shards_of(scene)) == 30 and len(blender.data.meshes) == 32


def test_a_scene_without_bodies_has_nothing_to_remove(blender):
    assert remove_shards(blender.context.scene) == 0


def test_meshes_that_are_used_elsewhere_stay(blender):
    scene = blender.context.scene
    build_demolition(scene, I235, build_model(I235))
    mesh = shards_of(scene)[0].data
    blender.data.objects.new("copy", mesh)
    remove_shards(scene)
    assert mesh.name in blender.data.meshes and len(blender.data.meshes) == 3


def test_supports_hold_their_shards(blender):
    scenario = replace(
        I235,
        ball=None,
        supports=[Support(member="pier cap")],
        shards=replace(I235.shards, start_deactivated=False, use_deactivation=False),
    )
    scene, model = blender.context.scene, build_model(scenario)
    build_demolition(scene, scenario, model)
    shards = shards_of(scene)
    assert [body.rigid_body.type == "PASSIVE" for body in shards] == model.held.tolist()
    assert model.held.any() and not model.held.all()
    places = [body.location.copy() for body in shards]
    for each in connections_of(scene):
        each.rigid_body_constraint.enabled = False
    for frame in range(1, 20):
        scene.frame_set(frame)
    graph = blender.context.evaluated_depsgraph_get()
    moved = [
        (body.evaluated_get(graph).matrix_world.translation - place).length
        for body, place in zip(shards, places, strict=True)
    ]
    assert max(np.array(moved)[model.held]) == 0.0
    assert max(np.array(moved)[~model.held]) > 0.01  # overhanging ends of the deck come down


def test_paint_becomes_density(blender):
    mesh, solid = blender.data.meshes.new("deck"), box([4, 2, 1])
    mesh.from_pydata(solid.vertices, [], solid.faces.tolist())
    body = blender.data.objects.new("deck", mesh)
    blender.context.scene.collection.objects.link(body)
    body.location, body.scale = (10, 0, 0), (2, 1, 1)
    group = body.vertex_groups.new(name="finer")
    group.add([index for index, vertex in enumerate(mesh.vertices) if vertex.co.x > 0], 0.5, "REPLACE")
    blender.context.view_layer.update()
    points, weights = painted_points(body, "finer")
    np.testing.assert_allclose(points, np.asarray(solid.vertices) * (2, 1, 1) + (10, 0, 0), atol=1e-6)
    assert sorted(set(weights)) == [0.0, 0.5]
    at = painted_density(points, weights, 5.0).at(np.array([[14.0, 1.0, 0.5], [6.0, 1.0, 0.5], [10.0, 0.0, 0.0]]))
    assert at == pytest.approx([3, 1, 2], rel=1e-6)
    with pytest.raises(GeometryError, match=r"deck: has no vertex group 'coarse'; paint one, or choose from: finer"):
        painted_points(body, "coarse")
    empty = blender.data.objects.new("empty", None)
    with pytest.raises(GeometryError, match="empty: is of type EMPTY, not a mesh"):
        painted_points(empty, "finer")
