# SPDX-License-Identifier: GPL-3.0-or-later
"""Gravity that changes evenly from frame to frame, so that nothing swings when concrete cracks under its weight."""

from __future__ import annotations

import bpy

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.scene.tools.keyframes import curves_of


def animate_gravity(scene: bpy.types.Scene, shares: dict[float, float], axis: int = 2) -> None:
    """Let gravity be shares of the standard one, downwards along z, by the frames between which they change evenly."""
    sign = -1.0 if axis == 2 else 1.0
    for frame, share in shares.items():
        scene.gravity[axis] = sign * share * STANDARD_GRAVITY_M_S2
        scene.keyframe_insert("gravity", index=axis, frame=frame)
    for curve in curves_of(scene.animation_data):
        for keyframe_point in curve.keyframe_points:
            keyframe_point.interpolation = "LINEAR"
    _evaluate_before_bodies_move(scene, axis)


def _evaluate_before_bodies_move(scene: bpy.types.Scene, axis: int) -> None:
    """Let the place of a body depend on gravity.

    Blender may otherwise simulate a frame before it has animated gravity, as its threads happen to run: four of forty
    runs had one frame with the gravity of the frame before.
    """
    driver = scene.rigidbody_world.collection.objects[0].driver_add("delta_location", axis).driver
    driver.expression = "0 * gravity"
    variable = driver.variables.new()
    variable.name = "gravity"
    variable.targets[0].id_type = "SCENE"
    variable.targets[0].id = scene
    variable.targets[0].data_path = f"gravity[{axis}]"
