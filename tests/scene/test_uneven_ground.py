# SPDX-License-Identifier: GPL-3.0-or-later
"""Ground that is not flat in Blender: what falls on it comes to rest on it, at the height that geometry gives."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235
from support.terrain_files import HEIGHT, write_asc

from bridge_demolition_addon.engineering.geometry.solids import box, sphere
from bridge_demolition_addon.engineering.terrain.thinning import Grid, thinned
from bridge_demolition_addon.model.scenario import ContactSettings, Ground, GroundSurface, SurfaceValues, TimeSettings
from bridge_demolition_addon.model.scenario.contacts import SurfaceContact

RADIUS, SLOPE = 0.5, 0.2
LEVEL_M = 7.0
BOWL_M = 20.0
"""Radius of curvature of the bowl at its bottom: z = r² / (2 × 20)."""


def ground_of(height, cells=32, step=0.5):
    empty = Grid(np.full(2, -cells * step / 2), step, np.zeros((cells + 1, cells + 1)))
    grid = replace(empty, heights=LEVEL_M + height(*empty.places().T).reshape(cells + 1, cells + 1))
    return thinned(grid, 0.005, np.zeros(grid.heights.shape, bool), 8.0)


def at_rest(blender, height, shape, mesh, position_m, seconds=8):
    """Where the middle of a body is that fell on ground of a height, and the body's axes."""
    from bridge_demolition_addon.scene.bodies import Kind, create_body, create_terrain, mesh_of, set_surface
    from bridge_demolition_addon.scene.world import create_world

    scene = blender.context.scene
    world = create_world(scene, TimeSettings(duration_s=10.0), 24 * seconds)
    create_terrain(world, ground_of(height), SurfaceValues(0.8, 0.0))
    body = create_body(world, mesh_of("Body", mesh), Kind.SHARD, shape)
    body.location, body.rigid_body.mass = position_m, 1000.0
    set_surface(body.rigid_body, SurfaceValues(0.8, 0.0), 0.0)
    body.rigid_body.linear_damping, body.rigid_body.angular_damping = 0.3, 0.6
    for frame in range(1, 24 * seconds + 1):
        scene.frame_set(frame)
    matrix = body.evaluated_get(blender.context.evaluated_depsgraph_get()).matrix_world
    return np.array(matrix.translation), np.array(matrix.to_3x3())


# Bullet lets bodies that are pressed together sink into each other by some 0.1 to 1 mm. Margins are 0, so that nothing
# rests above the ground by one.
SUNK_M = 2e-3


def test_a_ball_comes_to_rest_at_the_bottom_of_a_bowl(blender):
    """A ball rolls to and fro and stays within a triangle or two of the bottom, where it touches the bowl at r² / 40.

    The bowl is of flat triangles with sides of half a metre, up to 0.5² / (8 × 20) = 1.6 mm above it, and thinned by
    5 mm at most.
    """
    position, _ = at_rest(
        blender, lambda x, y: (x * x + y * y) / (2 * BOWL_M), "SPHERE", sphere(RADIUS, 48), (3.0, 0.1, 9.0), 16
    )
    away = float(np.hypot(*position[:2]))
    assert away < 1.0
    # The centre of a ball in a larger sphere is at BOWL - RADIUS from its middle.
    inside = BOWL_M - RADIUS
    expected = LEVEL_M + BOWL_M - np.sqrt(inside * inside - away * away)
    assert position[2] == pytest.approx(expected, abs=SUNK_M + 0.0016 + 0.005)


def test_a_block_comes_to_rest_on_a_slope_and_leans_with_it(blender):
    """A slope of 1 in 5 holds a block with a coefficient of friction of 0.8; its middle is half its height above it."""
    position, axes = at_rest(
        blender, lambda x, y: SLOPE * x, "CONVEX_HULL", box((1.0, 1.0, 1.0)), (0.0, 0.1, LEVEL_M + 1.2)
    )
    length = np.sqrt(1.0 + SLOPE * SLOPE)
    assert (position[2] - LEVEL_M - SLOPE * position[0]) / length == pytest.approx(0.5, abs=SUNK_M)
    normal = np.array([-SLOPE, 0.0, 1.0]) / length
    # One of its axes is the slope's normal, to the angle by which a side sinks in more than the other.
    assert np.abs(axes.T @ normal).max() > np.cos(2 * SUNK_M)


WATER = GroundSurface(
    name="river", kind="water", height_m=0.4, corners_m=((-40.0, -9.0), (-3.0, -9.0), (-3.0, 9.0), (-40.0, 9.0))
)


@pytest.fixture
def built(blender, tmp_path):
    """One span on a slope down to a river, in the scene, and its inventory."""
    from bridge_demolition_addon.model.sequence.checked_model import checked_model
    from bridge_demolition_addon.scene.demolition import build_demolition

    path = write_asc(tmp_path / "slope.asc", lambda x, y: HEIGHT + 0.1 * (x - 448_350.0), count=121)
    ground = Ground(file=str(path), origin=(448_350.0, 4_607_250.0, HEIGHT), surfaces=(WATER,))
    contacts = ContactSettings(surfaces=SurfaceContact(friction=0.3))
    fracture = replace(I235.fracture, shards=14)
    scenario = replace(I235, ball=None, ground=ground, contacts=contacts, fracture=fracture)
    model = checked_model(scenario)
    build_demolition(blender.context.scene, scenario, model)
    return blender.context.scene, scenario, model


def test_the_ground_is_passive_and_met_at_its_triangles(built):
    from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of

    scene, _, model = built
    ground, river = (body for body in bodies_of(scene) if kind_of(body) == Kind.GROUND)
    assert (ground.name, river.name) == ("Ground", "river")
    for body in (ground, river):
        assert (body.rigid_body.type, body.rigid_body.collision_shape) == ("PASSIVE", "MESH")
        assert body.rigid_body.collision_margin == 0.0
    assert len(ground.data.polygons) == model.ground.facts.triangles
    assert river.rigid_body.friction * np.sqrt(0.6) == pytest.approx(0.3, rel=1e-6)
    assert ground.rigid_body.friction * np.sqrt(0.6) == pytest.approx(0.5, rel=1e-6)


def test_what_is_run_has_the_friction_that_was_set_by_hand(built):
    from bridge_demolition_addon.scene.run_setup import run_setup_of

    scene, scenario, _ = built
    assert run_setup_of(scene).effective_scenario(scenario)[0] == scenario
    scene.objects["river"].rigid_body.friction = 0.25
    contacts = run_setup_of(scene).effective_scenario(scenario)[0].contacts
    assert contacts.surfaces.friction == pytest.approx(0.25 * np.sqrt(0.6), rel=1e-6)
    assert (contacts.shards.friction, contacts.ground.friction) == (0.6, 0.5)


def test_a_run_keeps_its_ground_and_the_bridge_stands_on_it(built, tmp_path):
    """For a quarter of a second: nothing breaks, and the heights are there when the results are read again."""
    from bridge_demolition_addon.model.results.arrays import load_results
    from bridge_demolition_addon.simulation.motion_run import motion_run

    _, scenario, model = built
    short = replace(scenario, time=replace(scenario.time, duration_s=0.25))
    with motion_run(short, model, tmp_path) as (results, _):
        results.save(tmp_path / "results.npz")
        fallen = results.frames.positions_m[0, :, 2] - results.frames.positions_m[-1, :, 2]
        assert results.frames.intact.all()
        # Unheld it would have fallen by 0.3 m.
        assert np.abs(fallen).max() < 0.01
    ground = load_results(tmp_path / "results.npz").ground()
    positions = np.random.default_rng(4).uniform(-30.0, 30.0, (100, 2))
    # Single precision of Blender, of heights up to some metres.
    np.testing.assert_allclose(ground.terrain.heights_at(positions), model.ground.heights_at(positions), atol=1e-5)
    (river,) = ground.surfaces
    assert (river.name, river.kind) == ("river", "water")
    assert river.plan().area() == pytest.approx(37.0 * 18.0, rel=1e-6)
    np.testing.assert_allclose(ground.heights_at(np.array([[-20.0, 0.0], [20.0, 0.0]])), [0.4, 2.0], atol=1e-5)


def test_what_is_laid_and_looked_at_follows_the_ground(built, blender, tmp_path):
    """A picture of 40 m lies on the slope, a ray from above meets it there, and the land is as low as it gets."""
    from mathutils import Vector

    from bridge_demolition_addon.scene.bodies import terrain_facts
    from bridge_demolition_addon.scene.rendering.ground import ground_of, lay_site_plan, terrain_under
    from bridge_demolition_addon.scene.rendering.surroundings import surround

    scene, _, model = built
    image = blender.data.images.new("Plan", 8, 8)
    image.filepath_raw, image.file_format = str(tmp_path / "plan.png"), "PNG"
    image.save()
    lay_site_plan(scene, tmp_path / "plan.png", 40.0, 90.0, (0.5, 0.5))
    scene.view_layers[0].update()
    plan = scene.objects["Site plan"]
    corners = np.array([plan.matrix_world @ vertex.co for vertex in plan.data.vertices])
    heights = np.where((corners[:, 0] < -3.0) & (abs(corners[:, 1]) < 9.0), 0.4, -np.inf)  # the river
    far = np.abs(corners[:, 0] - 6.5) > 8.0  # from the columns, under which the ground is level
    expected = np.maximum(0.1 * corners[:, 0], heights) + 0.01
    np.testing.assert_allclose(corners[far, 2], expected[far], atol=1e-4)
    position = terrain_under(scene, Vector((30.0, 5.0, 50.0)), Vector((0.0, 0.0, -1.0)))
    assert tuple(position) == pytest.approx((30.0, 5.0, 3.0), abs=1e-4)
    assert terrain_under(scene, Vector((30.0, 5.0, 50.0)), Vector((0.0, 0.0, 1.0))) is None
    assert terrain_facts(scene)["triangles"] == model.ground.facts.triangles
    assert ground_of(scene).surfaces[0].name == "river"
    surround(scene, np.array([(0.0, 0.0, 0.0), (13.0, 0.0, 5.0)]))
    land = max((scene.objects["Land"].matrix_world @ vertex.co).z for vertex in scene.objects["Land"].data.vertices)
    assert land == pytest.approx(model.ground.facts.lowest_m - 0.01, abs=1e-3)
