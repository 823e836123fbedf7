"""Removal of a demolition from its scene with everything that only it used, and of connections that lack a body."""

from __future__ import annotations

import bpy

from .as_built import forget_built_bodies, keep_stability
from .blast.force_fields import force_collection, force_objects
from .bodies import bodies_of, is_marked
from .connections.constraints import Breaking, constraints_of, ends_of, keep_breaking, loose_connections
from .custom_properties import keep_run_tables
from .rendering.dust import remove_dust
from .rendering.markers import clear_markers, remove_zones
from .rendering.materials import remove_unused_materials
from .rendering.surroundings import clear_surroundings
from .world import START_FRAME, remove_world, stop_animation


def remove_demolition(scene: bpy.types.Scene) -> int:
    """Remove everything that was built in a scene but the charges, and return how many bodies there were.

    The scene goes to its start frame. Sun, sky and camera go too, and what they replaced comes back. Bodies of the
    user's own stay, and the rigid-body world with them; so do meshes that something else uses.
    """
    if scene.rigidbody_world is None or scene.rigidbody_world.collection is None:
        return 0
    scene.frame_set(START_FRAME)
    bodies = [body for body in bodies_of(scene) if is_marked(body)]
    ours = set(bodies)
    _remove_in_turn(
        scene,
        [constraint for constraint in constraints_of(scene) if ours & ends_of(constraint)],
        [field for body, field in force_objects(scene).items() if body in ours],
        bodies,
    )
    remove_dust(scene)
    remove_zones(scene)
    clear_markers(scene)
    clear_surroundings(scene)
    remove_unused_materials()
    stop_animation(scene)
    keep_breaking(scene, Breaking())
    keep_run_tables(scene, ())
    forget_built_bodies(scene)
    keep_stability(scene, None)
    fields = force_collection(scene)
    if fields and not fields.all_objects:
        bpy.data.collections.remove(fields)
    others = scene.rigidbody_world.collection  # none where it was one of those that are gone now
    if others is None or not others.all_objects:
        remove_world(scene)
    return len(bodies)


def remove_loose_connections(scene: bpy.types.Scene) -> int:
    """Remove connections that lack a body, such as with a deleted shard, and return how many there were.

    The scene goes to its start frame.
    """
    if scene.rigidbody_world is None or scene.rigidbody_world.collection is None:
        return 0
    loose = loose_connections(scene)
    if loose:
        scene.frame_set(START_FRAME)
        _remove_in_turn(scene, loose)
    return len(loose)


def _remove_in_turn(scene: bpy.types.Scene, *groups: list[bpy.types.Object]) -> None:
    """Remove objects and the meshes that only they used, one group after the other.

    Blender keeps Bullet's world, and the pointers in it, until a setting changes and the start frame is evaluated. A
    body that is removed while an old connection still points to it crashes Blender when time goes on.
    """
    for group in groups:
        meshes = {obj.data for obj in group if obj.type == "MESH"}
        _take_out_of_world(scene, group)
        bpy.data.batch_remove(group)
        _restart(scene)
        bpy.data.batch_remove([mesh for mesh in meshes if not mesh.users])


def _take_out_of_world(scene: bpy.types.Scene, group: list[bpy.types.Object]) -> None:
    """Have Blender free the bodies among some objects in the world of their scene, where there are other worlds.

    Blender does not know the world of a body that it deletes. It takes the body out of every scene's world by its index
    in one of them, so that it takes another body out instead, and crashes later.
    """
    others = [other.rigidbody_world for other in bpy.data.scenes if other.rigidbody_world and other != scene]
    shared = {body for world in others if world.collection for body in world.collection.all_objects}
    bodies = [obj for obj in group if obj.rigid_body and obj not in shared]
    if others and bodies:
        chosen = {"object": bodies[0], "active_object": bodies[0], "selected_objects": bodies}
        with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0], **chosen):
            bpy.ops.rigidbody.objects_remove()


def _restart(scene: bpy.types.Scene) -> None:
    """Make Blender drop what it simulated and evaluate the scene at its start frame."""
    world = scene.rigidbody_world
    world.substeps_per_frame = world.substeps_per_frame  # any setting counts as a change
    for layer in scene.view_layers:
        layer.update()
