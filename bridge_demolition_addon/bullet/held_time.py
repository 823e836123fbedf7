"""Letting no time pass in the frame in which Blender makes its Bullet world.

Blender takes the first step in the same breath as it makes the world, before anything can be asked of that world. With
a time scale of 0 it makes the world and takes no step. The time scale is written into the evaluated copy of the scene
only: setting it through Python would touch the user's scene, and would mark the point cache as outdated, so that
nothing could be played back afterwards.
"""

from __future__ import annotations

import bpy

from . import checks
from .layout import platform_layout
from .memory import write_float


def hold_time(scene: bpy.types.Scene) -> None:
    """Let no simulated time pass in the coming frame.

    Raises
    ------
    LayoutError
        Memory is not as expected; nothing has been written.
    """
    for world in _evaluated_worlds(scene):
        _write_time_scale(world, 0.0)


def time_is_held(depsgraph: bpy.types.Depsgraph) -> bool:
    """Whether no simulated time passed in the frame that a dependency graph was evaluated for."""
    return depsgraph.scene_eval.rigidbody_world.time_scale == 0.0


def release_time(scene: bpy.types.Scene) -> None:
    """Let time pass again as the scene says."""
    for world in _evaluated_worlds(scene):
        if world.time_scale == 0.0:
            _write_time_scale(world, scene.rigidbody_world.time_scale)


def _evaluated_worlds(scene: bpy.types.Scene) -> list[bpy.types.RigidBodyWorld]:
    graphs = [layer.depsgraph for layer in scene.view_layers if layer.depsgraph]
    return [graph.scene_eval.rigidbody_world for graph in graphs if graph.scene_eval.rigidbody_world]


def _write_time_scale(world: bpy.types.RigidBodyWorld, time_scale: float) -> None:
    layout = platform_layout()
    checks.check_settings(layout, world)
    write_float(world.as_pointer() + layout.blender.world_time_scale, time_scale)
