"""Renders of frames that were not played, without a crash.

A render works on copies of its own, next to the window's, and both share one Bullet world. If the render is the first
to simulate, Blender makes bodies of meshes that are not there yet, and crashes, then or at the next step. So the world
of a demolition rests while it is rendered, unless its frames were played before and are known.
"""

import bpy

from ...scene.bodies import bodies_of, is_marked


def frames_are_known(scene: bpy.types.Scene) -> bool:
    """Return whether Blender plays back frames that it has simulated, as nothing was changed since."""
    cache = scene.rigidbody_world.point_cache
    return cache.is_baked or bool(cache.info and not cache.is_outdated)


def has_to_rest(scene: bpy.types.Scene) -> bool:
    """Return whether a scene's world has to be switched off while the scene is rendered."""
    world = scene.rigidbody_world
    if not world or not world.collection or not world.enabled or frames_are_known(scene):
        return False
    return any(map(is_marked, bodies_of(scene)))
