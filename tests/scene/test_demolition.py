# SPDX-License-Identifier: GPL-3.0-or-later
"""A demolition as Blender data, read back through Blender's own interface."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from support.scenarios import I235

from bridge_demolition_addon.engineering.structure.connections import GROUND
from bridge_demolition_addon.model.structure.model import build_model

SCENARIO = replace(I235, fracture=replace(I235.fracture, shards=30))
SLOW_NTSC = replace(
    SCENARIO.time,
    frames_per_second=30,
    frames_per_second_base=1.001,
    substeps_per_frame=7,
    time_scale=0.25,
    solver_iterations=23,
)
MODEL = build_model(SCENARIO)

# Blender keeps masses, thresholds and places in single precision: 24 binary digits.
SINGLE = 2.0**-23
# Places of up to 20 m, and a few roundings on the way.
PLACE_M = 20 * 4 * SINGLE


@pytest.fixture
def build(blender):
    from bridge_demolition_addon.scene.demolition import build_demolition

    def build(scenario=SCENARIO, model=MODEL):
        build_demolition(blender.context.scene, scenario, model)
        return blender.context.scene

    return build


def bodies(scene, kind):
    from bridge_demolition_addon.scene.bodies import bodies_of, kind_of

    return [body for body in bodies_of(scene) if kind_of(body) == kind]


def connections(scene):
    from bridge_demolition_addon.scene.connections.constraints import connections_of

    return connections_of(scene)


def solid_of(body):
    mesh = body.data
    mesh.calc_loop_triangles()
    vertices = [vertex.co[:] for vertex in mesh.vertices]
    return trimesh.Trimesh(vertices, [triangle.vertices[:] for triangle in mesh.loop_triangles], process=False)


def world_bounds(body):
    corners = np.array([body.matrix_world @ vertex.co for vertex in body.data.vertices])
    return corners.min(axis=0), corners.max(axis=0)


def test_masses(build):
    scene = build()
    shards = bodies(scene, "shard")
    assert len(shards) == 30
    np.testing.assert_allclose([body.rigid_body.mass for body in shards], MODEL.masses_kg, rtol=SINGLE)
    assert sum(body.rigid_body.mass for body in shards) == pytest.approx(107_000, rel=1e-6)
    (ball,) = bodies(scene, "ball")
    assert ball.rigid_body.mass == 10_000.0


def test_shards_have_their_origin_in_their_centre_of_mass(build):
    density = 107_000 / 44.794
    for body, centre in zip(bodies(build(), "shard"), MODEL.centres_m, strict=True):
        np.testing.assert_allclose(body.location, centre, atol=PLACE_M)
        assert np.array_equal(body.matrix_basis.to_3x3(), np.eye(3))
        solid = solid_of(body)
        assert solid.is_watertight and solid.volume > 0.0
        # Single precision in the corners of a body some metres long.
        np.testing.assert_allclose(solid.center_mass, 0.0, atol=1e-5)
        assert solid.volume * density == pytest.approx(body.rigid_body.mass, rel=1e-4)


def test_shards_are_where_the_bridge_was(build):
    scene = build()
    scene.view_layers[0].update()
    low, high = np.array([world_bounds(body) for body in bodies(scene, "shard")]).swapaxes(0, 1)
    np.testing.assert_allclose(low.min(axis=0), [-0.5, -4.25, 0.0], atol=PLACE_M)
    np.testing.assert_allclose(high.max(axis=0), [13.5, 4.25, 5.55], atol=PLACE_M)


def test_shapes_and_surfaces(build):
    settings = replace(SCENARIO.shards, friction=0.7, restitution=0.1, collision_margin_m=0.02, linear_damping=0.01)
    scene = build(replace(SCENARIO, shards=settings, ground=replace(SCENARIO.ground, friction=0.9)))
    for body in bodies(scene, "shard"):
        rigid = body.rigid_body
        assert (rigid.type, rigid.collision_shape, rigid.kinematic) == ("ACTIVE", "CONVEX_HULL", False)
        assert rigid.use_margin
        surface = (rigid.friction, rigid.restitution, rigid.collision_margin, rigid.linear_damping)
        assert surface == pytest.approx((0.7, 0.1, 0.02, 0.01), rel=SINGLE)
        assert (rigid.use_deactivation, rigid.use_start_deactivated) == (True, True)
        rest = (rigid.deactivate_linear_velocity, rigid.deactivate_angular_velocity, rigid.angular_damping)
        assert rest == pytest.approx((0.4, 0.5, 0.1), rel=SINGLE)
    (ball,), (ground,) = bodies(scene, "ball"), bodies(scene, "ground")
    assert (ball.rigid_body.type, ball.rigid_body.collision_shape) == ("ACTIVE", "SPHERE")
    assert (ball.rigid_body.linear_damping, ball.rigid_body.use_deactivation) == (0.0, False)
    assert (ground.rigid_body.type, ground.rigid_body.collision_shape) == ("PASSIVE", "BOX")
    assert ground.rigid_body.friction == pytest.approx(0.9, rel=SINGLE)


def test_ground_is_level_with_zero_and_wide(build):
    scene = build()
    scene.view_layers[0].update()
    (ground,) = bodies(scene, "ground")
    low, high = world_bounds(ground)
    assert high[2] == 0.0
    # The bridge and, to every side of it, several times its height of 5.55 m.
    assert (low[:2] < (-0.5 - 50, -4.25 - 50)).all() and (high[:2] > (13.5 + 50, 4.25 + 50)).all()


def test_ball_hangs_clear_above_its_target(build):
    scene = build()
    scene.view_layers[0].update()
    (ball,) = bodies(scene, "ball")
    # Deck at 5.55 m, 5 m of air, half of 1.34 m.
    np.testing.assert_allclose(ball.matrix_world.translation, [6.5, 0.0, 5.55 + 5.0 + 0.67], atol=PLACE_M)
    # Bullet makes its sphere from the longest side of the mesh.
    assert max(ball.dimensions) == pytest.approx(1.34, abs=PLACE_M)


@pytest.mark.parametrize(
    "time, substep_s, iterations",
    [(SCENARIO.time, 1 / 240, 10), (SLOW_NTSC, 0.25 * 1.001 / 30 / 7, 23)],
    ids=["film", "slow NTSC"],
)
@pytest.mark.parametrize("kind", ["FIXED", "POINT", "HINGE"])
def test_thresholds_are_the_breaking_force_times_the_substep(build, time, substep_s, iterations, kind):
    settings = replace(SCENARIO.connections, type=kind)
    scene = build(replace(SCENARIO, time=time, connections=settings))
    world = scene.rigidbody_world
    assert world.solver_iterations == iterations
    blenders_step = world.time_scale * scene.render.fps_base / (scene.render.fps * world.substeps_per_frame)
    assert blenders_step == pytest.approx(substep_s, rel=4 * SINGLE)
    for connection in connections(scene):
        constraint = connection.rigid_body_constraint
        assert constraint.type == kind
        assert constraint.enabled and constraint.use_breaking
        # 10 000 kgf are 98 066.5 N.
        assert constraint.breaking_threshold == pytest.approx(98_066.5 * substep_s, rel=SINGLE)


def test_step_of_the_scene(build):
    from bridge_demolition_addon.scene.world import scene_time_step

    step = scene_time_step(build(replace(SCENARIO, time=SLOW_NTSC)))
    assert step.substep_s == pytest.approx(0.25 * 1.001 / 30 / 7, rel=4 * SINGLE)


def test_connections_join_their_bodies_where_the_model_says(build):
    scene = build()
    shards, (ground,) = bodies(scene, "shard"), bodies(scene, "ground")
    found = connections(scene)
    assert len(found) == len(MODEL.connections)
    for connection, (first, second), point in zip(
        found, MODEL.connections.pairs, MODEL.connections.points, strict=True
    ):
        constraint = connection.rigid_body_constraint
        assert constraint.object1 == shards[first]
        assert constraint.object2 == (ground if second == GROUND else shards[second])
        np.testing.assert_allclose(connection.location, point, atol=PLACE_M)
    assert len({connection.name for connection in found}) == len(found)


def test_without_foundation_nothing_holds_on_to_the_ground(build):
    scenario = replace(SCENARIO, connections=replace(SCENARIO.connections, foundation=False))
    scene = build(scenario, build_model(scenario))
    (ground,) = bodies(scene, "ground")
    assert connections(scene)
    assert all(connection.rigid_body_constraint.object2 != ground for connection in connections(scene))


def test_without_connections_and_ball(build):
    apart = replace(SCENARIO.connections, method="centre", search_radius_m=1e-6, foundation=False)
    scenario = replace(SCENARIO, connections=apart, ball=None)
    scene = build(scenario, build_model(scenario))
    assert len(bodies(scene, "shard")) == 30
    assert connections(scene) == bodies(scene, "ball") == []


def test_a_single_shard(build):
    whole = MODEL.shards[0]
    model = replace(
        MODEL,
        shards=(whole,),
        masses_kg=MODEL.masses_kg[:1],
        centres_m=MODEL.centres_m[:1],
        member_of_shard=MODEL.member_of_shard[:1],
        fixed=MODEL.fixed[:1],
        connections=type(MODEL.connections)(np.zeros((0, 2), int), np.zeros((0, 3)), np.zeros(0), np.zeros((0, 3))),
        joint_of_connection=np.zeros(0, int),
        origins=np.zeros(0, str),
        second_moments_m4=np.zeros((0, 2, 2)),
    )
    scene = build(SCENARIO, model)
    (shard,) = bodies(scene, "shard")
    assert len(shard.data.vertices) == len(whole.vertices)


def test_collections_hold_what_their_names_say(build):
    scene = build()
    world = scene.rigidbody_world
    assert {child.name for child in scene.collection.children} == {"Bodies", "Connections"}
    assert (world.collection.name, world.constraints.name) == ("Bodies", "Connections")
    assert len(world.collection.objects) == 30 + 2  # ball and ground
    assert len(world.constraints.objects) == len(MODEL.connections)
    assert len(scene.objects) == 32 + len(MODEL.connections)


def users_of_all_data(blender):
    kinds = ("objects", "meshes", "collections", "actions", "materials", "cameras", "curves")
    return {(kind, data.name): data.users for kind in kinds for data in getattr(blender.data, kind)}


def test_nothing_is_left_over(blender, build):
    before = set(users_of_all_data(blender))
    build()
    made = {name: users for name, users in users_of_all_data(blender).items() if name not in before}
    assert min(made.values()) >= 1
    objects, meshes = ({name for kind, name in made if kind == wanted} for wanted in ("objects", "meshes"))
    assert len(objects) == 32 + len(MODEL.connections)
    assert len(meshes) == 32
    assert not {"Shard", "Connection"} & objects


def test_timeline_covers_the_duration(build):
    scene = build()
    cache = scene.rigidbody_world.point_cache
    # The world is made in frame 2, in which no time passes; 5 s are 120 more frames.
    assert (scene.frame_start, scene.frame_end, scene.frame_current) == (1, 122, 1)
    assert (cache.frame_start, cache.frame_end) == (1, 122)
    np.testing.assert_allclose(scene.gravity, (0.0, 0.0, -9.80665), rtol=SINGLE)


@pytest.mark.parametrize(
    "time, release_s, first_free",
    [
        (SCENARIO.time, 0.5, 15),  # 12 frames after frame 3, the first that time leads to
        (SCENARIO.time, 0.0, 3),
        (SCENARIO.time, 0.51, 16),
        (replace(SCENARIO.time, frames_per_second=30, time_scale=0.5), 0.2, 15),  # frames of 1/60 s
    ],
)
def test_ball_is_held_and_then_let_go(build, time, release_s, first_free):
    scene = build(replace(SCENARIO, time=time, ball=replace(SCENARIO.ball, release_time_s=release_s)))
    (ball,) = bodies(scene, "ball")
    assert ball.rigid_body.kinematic  # before any frame is played, too
    held = []
    for frame in range(1, first_free + 3):
        scene.frame_set(frame)
        held.append(ball.rigid_body.kinematic)
    assert held == [True] * (first_free - 1) + [False] * 3


def test_ball_falls_freely_from_its_release_frame_on(blender, build):
    scene = build()
    (ball,) = bodies(scene, "ball")
    heights = {}
    for frame in range(1, 19):
        scene.frame_set(frame)
        heights[frame] = ball.evaluated_get(blender.context.evaluated_depsgraph_get()).matrix_world.translation.z
    assert heights[14] == heights[1]
    for frame in (15, 16, 18):
        # Velocity first, then place: after n steps of h the fall is g h² n (n + 1) / 2.
        steps = 10 * (frame - 14)
        fall = 9.80665 / 240**2 * steps * (steps + 1) / 2
        assert heights[1] - heights[frame] == pytest.approx(fall, abs=steps * PLACE_M)


def described(scene):
    """Everything about a scene that a simulation depends on."""
    yield from (scene.frame_start, scene.frame_end, scene.render.fps, scene.render.fps_base, tuple(scene.gravity))
    world = scene.rigidbody_world
    yield from (world.substeps_per_frame, world.solver_iterations, world.time_scale, world.enabled)
    for kind in ("shard", "ball", "ground"):
        for body in bodies(scene, kind):
            rigid = body.rigid_body
            yield (kind, body.name, body.matrix_world.copy().freeze(), rigid.mass, rigid.type, rigid.collision_shape)
            yield (rigid.friction, rigid.restitution, rigid.linear_damping, rigid.kinematic, rigid.collision_margin)
            yield tuple(vertex.co.copy().freeze() for vertex in body.data.vertices)
    for connection in connections(scene):
        constraint = connection.rigid_body_constraint
        yield (connection.name, connection.location.copy().freeze(), constraint.type, constraint.breaking_threshold)
        yield (constraint.object1.name, constraint.object2.name, constraint.use_breaking)


def test_a_saved_scene_has_all_of_it_when_opened_again(blender, build, tmp_path):
    scene = build(replace(SCENARIO, time=SLOW_NTSC))
    scene.frame_set(1)
    before = list(described(scene))
    path = str(tmp_path / "scene.blend")
    blender.ops.wm.save_as_mainfile(filepath=path)
    blender.ops.wm.read_factory_settings(use_empty=True)
    assert not blender.data.meshes
    blender.ops.wm.open_mainfile(filepath=path)
    opened = blender.context.scene
    assert list(described(opened)) == before
    (ball,) = bodies(opened, "ball")
    opened.frame_set(200)
    assert ball.rigid_body.kinematic is False
    assert len(before) > 3 * 32 + 2 * len(MODEL.connections)


def test_unmarked_bodies_are_told_by_whether_they_move(blender, build):
    from bridge_demolition_addon.scene.bodies import Kind, kind_of

    scene = build()
    for kind, expected in (("ACTIVE", Kind.SHARD), ("PASSIVE", Kind.GROUND)):
        body = blender.data.objects.new("Mine", blender.data.meshes.new("Mine"))
        scene.rigidbody_world.collection.objects.link(body)
        body.rigid_body.type = kind
        assert kind_of(body) is expected


def test_thresholds_of_a_built_scene_follow_its_step(build):
    from bridge_demolition_addon.scene.connections.constraints import rewrite_thresholds

    scene = build()
    assert not rewrite_thresholds(scene)
    scene.render.fps, scene.rigidbody_world.substeps_per_frame = 50, 4
    assert rewrite_thresholds(scene)
    for connection in connections(scene):
        assert connection.rigid_body_constraint.breaking_threshold == pytest.approx(98_066.5 / 200, rel=SINGLE)


def test_names_are_numbered_and_go_on_in_a_second_scene(blender, build):
    first = build()
    names = [body.name for body in bodies(first, "shard")]
    assert names == [f"Shard {number:06d}" for number in range(30)]
    assert [body.data.name for body in bodies(first, "shard")] == names
    blender.context.window.scene = blender.data.scenes.new("Second")
    second = build()
    assert second != first
    assert [body.name for body in bodies(second, "shard")] == [f"Shard {number:06d}" for number in range(30, 60)]
    assert len(connections(second)) == len(connections(first)) == len(MODEL.connections)
    assert not {connection.name for connection in connections(first)} & {
        connection.name for connection in connections(second)
    }
