"""Whether a scene can be recorded."""

from __future__ import annotations

import bpy

from ...errors import SimulationError
from ...scene.bodies import bodies_of, lacks_ground
from ...scene.connections.constraints import connections_of, loose_connections, sections_of


def check_recordable(scene: bpy.types.Scene) -> None:
    """Refuse a scene that cannot be recorded as it is."""
    world = scene.rigidbody_world
    if world is None or world.collection is None:
        raise SimulationError(f"scene {scene.name!r} has no rigid-body world: build a demolition in it first")
    if not bodies_of(scene):
        raise SimulationError(f"the rigid-body world of scene {scene.name!r} has no bodies: build a demolition first")
    if not world.enabled:
        raise SimulationError(f"the rigid-body world of scene {scene.name!r} is switched off: switch it on first")
    if world.point_cache.is_baked:
        raise SimulationError(
            f"the simulation of scene {scene.name!r} is baked and only played back: delete the bake first"
        )
    if world.time_scale == 0.0:
        raise SimulationError(f"the rigid-body world of scene {scene.name!r} has a speed of 0: set it to 1 first")
    unit_scale = scene.unit_settings.scale_length
    if unit_scale != 1.0:
        raise SimulationError(
            f"scene {scene.name!r} has a unit scale of {unit_scale:g}, and Bullet takes every unit for a metre: "
            "set the unit scale to 1 and build the scene in metres"
        )
    loose = loose_connections(scene)
    if loose and lacks_ground(scene):
        raise SimulationError(
            f"the ground of scene {scene.name!r} is gone: undo what took it away, or build the scenario again"
        )
    if loose:
        more = f", and so do {len(loose) - 1} more" if len(loose) > 1 else ""
        raise SimulationError(
            f"connection {loose[0].name!r} lacks a body{more}: give each two, or remove loose connections first"
        )
    sections_of(connections_of(scene))  # refuses connections that were edited by hand
