"""Taking shards and their connections out of a scene, with everything that only they used."""

from __future__ import annotations

import bpy

from .bodies import Kind, bodies_of, kind_of
from .connections import connections_of
from .world import START_FRAME


def remove_shards(scene: bpy.types.Scene) -> int:
    """Remove all shards, their meshes, and all connections that a shard was in; how many shards there were.

    The scene goes to its start frame. Bodies that are no shards, such as the ground and the ball, stay. Meshes that
    something else uses stay, too.
    """
    if scene.rigidbody_world is None or scene.rigidbody_world.collection is None:
        return 0
    scene.frame_set(START_FRAME)
    shards = [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]
    wanted = set(shards)
    connections = [each for each in connections_of(scene) if wanted & _bodies_of_connection(each)]
    meshes = {body.data for body in shards}
    # Blender keeps Bullet's world, and the pointers in it, until it is told of a change and evaluated at the start. A
    # body that is removed while an old connection still points to it ends the process when time goes on.
    bpy.data.batch_remove(connections)
    _start_anew(scene)
    bpy.data.batch_remove(shards)
    _start_anew(scene)
    bpy.data.batch_remove([mesh for mesh in meshes if not mesh.users])
    return len(shards)


def _start_anew(scene: bpy.types.Scene) -> None:
    """Have Blender drop what it simulated, and evaluate the scene at its start frame."""
    world = scene.rigidbody_world
    world.substeps_per_frame = world.substeps_per_frame  # any setting counts as a change
    for layer in scene.view_layers:
        layer.update()


def _bodies_of_connection(connection: bpy.types.Object) -> set[bpy.types.Object | None]:
    constraint = connection.rigid_body_constraint
    return {constraint.object1, constraint.object2}
