"""Pictures of a demolition through Workbench, Blender's fast renderer, which needs no screen."""

from __future__ import annotations

import math
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

_LENS_MM = 40.0
_SENSOR_MM = 36.0
_VIEW_FROM = Vector((-0.55, -1.0, 0.42)).normalized()
_ROOM = 1.25
_SKY = (0.80, 0.86, 0.92)


def prepare_pictures(scene: bpy.types.Scene, low: np.ndarray, high: np.ndarray, width_px: int, height_px: int) -> None:
    """Aim a camera at the box from `low` to `high`, (3,) each in m, and set up the renderer."""
    scene.camera = _camera(scene, low, high, width_px / height_px)
    render = scene.render
    render.engine = "BLENDER_WORKBENCH"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width_px, height_px, 100
    render.image_settings.file_format = "PNG"
    shading = scene.display.shading
    shading.light = "STUDIO"
    shading.color_type = "OBJECT"
    shading.show_shadows = True
    shading.show_cavity = True
    shading.show_object_outline = True
    shading.background_type = "WORLD"
    scene.world = scene.world or bpy.data.worlds.new("Sky")
    scene.world.color = _SKY
    scene.view_settings.view_transform = "Standard"


def render_picture(scene: bpy.types.Scene, frame: int, path: Path) -> None:
    """Render one frame that was simulated already; Blender plays it back from its cache."""
    scene.frame_set(frame)
    scene.render.filepath = str(path)
    with bpy.context.temp_override(scene=scene):
        bpy.ops.render.render(write_still=True, scene=scene.name)


def _camera(scene: bpy.types.Scene, low: np.ndarray, high: np.ndarray, aspect: float) -> bpy.types.Object:
    """Camera beside the road that sees the whole box."""
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens, camera.data.sensor_width, camera.data.clip_end = _LENS_MM, _SENSOR_MM, 1e4
    middle = Vector((low + high) / 2.0)
    camera.rotation_euler = _VIEW_FROM.to_track_quat("Z", "Y").to_euler()
    camera.location = middle + _VIEW_FROM * _distance(low, high, camera.rotation_euler.to_matrix(), aspect)
    scene.collection.objects.link(camera)
    return camera


def _distance(low: np.ndarray, high: np.ndarray, rotation, aspect: float) -> float:
    """How far the camera has to be from the middle of the box for all corners to be in the picture."""
    corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    seen = (corners - (low + high) / 2.0) @ np.array(rotation)
    half_width = math.tan(math.atan(_SENSOR_MM / 2.0 / _LENS_MM))
    half_height = half_width / aspect
    needed = np.maximum(abs(seen[:, 0]) / half_width, abs(seen[:, 1]) / half_height) + seen[:, 2]
    return _ROOM * float(needed.max())
