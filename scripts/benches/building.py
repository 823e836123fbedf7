# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast thousands of bodies and connections are built, next to the plain way, in the same run.

The plain way copies a template for every body and for every connection, which Blender puts into the collection of the
scene's rigid-body world by itself, and sets what differs. It gives them neither names of their own nor the sections
that ours know, which would take longer still. Both are timed until all objects are there. Blender's first evaluation of
the scene after that is its own work, and is shown beside.
"""

import math
import time
from collections.abc import Callable

import bpy
import numpy as np

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.mechanics.strength import Joint
from bridge_demolition_addon.engineering.structure.connections import Connections
from bridge_demolition_addon.model.scenario import ShardSettings, SurfaceValues, TimeSettings
from bridge_demolition_addon.scene.bodies import create_flat_ground, create_shards
from bridge_demolition_addon.scene.connections.constraints import create_connections, set_joints
from bridge_demolition_addon.scene.world import create_world, off_scene

SIZES = ((500, 2_250), (3_000, 13_500), (10_000, 45_000))
SMALLEST_SIZES = ((20, 40), (40, 80))
"""Numbers of bodies and of connections."""
PLAIN_UP_TO = 3_000
TIME = TimeSettings(duration_s=1.0)
BREAKING_FORCE_N = 1e5


def main(smallest: bool) -> None:
    """Print the seconds of both ways for each number of bodies, the best of some runs, and how our time grows."""
    print(f"{'bodies':>8}{'ours, s':>10}{'plain, s':>10}{'ratio':>8}{'first evaluation, s':>21}")
    sizes, repeats = (SMALLEST_SIZES, 1) if smallest else (SIZES, 3)
    times = []
    for count, connection_count in sizes:
        shards, connections = _structure(count, connection_count)
        ours, evaluation = np.min([_seconds(_ours, shards, connections) for _ in range(repeats)], axis=0)
        shown = " " * 18
        if count <= PLAIN_UP_TO:
            plain, _ = _seconds(_plain, shards, connections)
            shown = f"{plain:>10.2f}{plain / ours:>8.1f}"
        print(f"{count:>8}{ours:>10.2f}{shown}{evaluation:>21.2f}", flush=True)
        times.append(ours)
    growth = math.log(times[-1] / times[0]) / math.log(sizes[-1][0] / sizes[0][0])
    print(f"our time grows with the number of bodies to the power of {growth:.2f}")


def _structure(count: int, connection_count: int) -> tuple[list[TriangleMesh], Connections]:
    """Cubes in a row, each connected with the next ones."""
    shards = [box((0.9, 0.9, 0.9))] * count
    first = np.arange(connection_count) % count
    pairs = np.column_stack((first, (first + 1 + np.arange(connection_count) // count) % count))
    normals = np.tile([1.0, 0.0, 0.0], (connection_count, 1))
    return shards, Connections(pairs, _places(count)[first], np.ones(connection_count), normals)


def _places(count: int) -> np.ndarray:
    return np.column_stack((np.arange(count, dtype=float), np.zeros(count), np.full(count, 5.0)))


def _seconds(way: Callable, shards: list[TriangleMesh], connections: Connections) -> tuple[float, float]:
    """Time for building, and for Blender's first evaluation after it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    create_world(scene, TIME, 100)
    ground = create_flat_ground(scene.rigidbody_world, 100.0, SurfaceValues(0.6, 0.0))
    began = time.perf_counter()
    way(scene, ground, shards, connections)
    built = time.perf_counter()
    bpy.context.view_layer.update()
    return built - began, time.perf_counter() - built


def _ours(
    scene: bpy.types.Scene, ground: bpy.types.Object, shards: list[TriangleMesh], connections: Connections
) -> None:
    positions, masses = _places(len(shards)), np.full(len(shards), 100.0)
    joints, moments = [Joint("FIXED", breaking_force_n=BREAKING_FORCE_N)], np.tile(np.eye(2), (len(connections), 1, 1))
    with off_scene(scene) as (bodies, constraints):
        made = create_shards(bodies, ShardSettings(), SurfaceValues(0.6, 0.0), shards, positions, masses)
        held = create_connections(constraints, connections, made, ground, moments)
        set_joints(held, joints, np.zeros(len(held), int), TIME.step)


def _plain(
    scene: bpy.types.Scene, _ground: bpy.types.Object, shards: list[TriangleMesh], connections: Connections
) -> None:
    world = scene.rigidbody_world
    body_template = bpy.data.objects.new("Shard", bpy.data.meshes.new("Shard"))
    world.collection.objects.link(body_template)
    body_template.rigid_body.collision_shape = "CONVEX_HULL"
    connection_template = bpy.data.objects.new("Connection", None)
    world.constraints.objects.link(connection_template)
    constraint = connection_template.rigid_body_constraint
    constraint.type, constraint.use_breaking = "FIXED", True
    constraint.breaking_threshold = TIME.step.impulse(BREAKING_FORCE_N)
    bodies = []
    for shard, position in zip(shards, _places(len(shards)), strict=True):
        body = body_template.copy()
        body.data = bpy.data.meshes.new("Shard")
        body.data.from_pydata(shard.vertices, [], shard.triangles.tolist())
        body.location, body.rigid_body.mass = position, 100.0
        bodies.append(body)
    for (first, second), point in zip(connections.pairs.tolist(), connections.points, strict=True):
        connection = connection_template.copy()
        connection.location = point
        constraint = connection.rigid_body_constraint
        constraint.object1, constraint.object2 = bodies[first], bodies[second]
    for template in (body_template, connection_template):
        bpy.data.objects.remove(template)
