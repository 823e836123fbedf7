"""Pictures of a demolition through Workbench, Blender's fast renderer, which needs no screen."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

from .plain_path import rendered_to

_LENS_MM = 40.0
_SENSOR_MM = 36.0
_VIEW_FROM = Vector((-0.55, -1.0, 0.28)).normalized()
_ROOM = 1.1
_EXPOSURE = 1.0
_STUDIO_LIGHT = "outdoor.sl"
"""One of Blender's own: a bright sun, and shadows that are blue from the sky."""


def prepare_pictures(scene: bpy.types.Scene, width_px: int, height_px: int) -> None:
    """Set up the renderer, which draws materials in their plain colours."""
    render = scene.render
    render.engine = "BLENDER_WORKBENCH"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width_px, height_px, 100
    render.image_settings.file_format = "PNG"
    shading = scene.display.shading
    shading.light, shading.studio_light = "STUDIO", _STUDIO_LIGHT
    shading.color_type = "MATERIAL"
    shading.show_shadows = True
    shading.show_cavity = True
    shading.show_object_outline = True
    shading.background_type = "WORLD"
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.exposure = _EXPOSURE


def render_picture(scene: bpy.types.Scene, frame: int, path: Path) -> None:
    """Render a frame that was simulated already; Blender plays it back from its cache."""
    scene.frame_set(frame)
    with rendered_to(path) as scene.render.filepath:
        bpy.ops.render.render(write_still=True, scene=scene.name)


def aim_camera(
    scene: bpy.types.Scene, points: np.ndarray, aspect: float, collection: bpy.types.Collection | None = None
) -> bpy.types.Object:
    """Add a camera beside the road, to the scene or a collection of it, and make it the scene's.

    It sees points (n, 3) float, m, in pictures of an aspect (width : height).
    """
    camera = bpy.data.objects.new("Bridge camera", bpy.data.cameras.new("Bridge camera"))
    camera.data.lens, camera.data.sensor_width = _LENS_MM, _SENSOR_MM
    camera.data.sensor_fit = "HORIZONTAL"  # by default a picture that is higher than wide turns the sensor
    camera.rotation_euler = _VIEW_FROM.to_track_quat("Z", "Y").to_euler()
    camera.location = _viewpoint(points, np.array(camera.rotation_euler.to_matrix()), aspect)
    farthest = float(np.linalg.norm(points - camera.location, axis=1).max())
    camera.data.clip_start, camera.data.clip_end = farthest / 1000.0, farthest * 10.0
    (collection or scene.collection).objects.link(camera)
    scene.camera = camera
    return camera


def _viewpoint(points: np.ndarray, axes: np.ndarray, aspect: float) -> np.ndarray:
    """Return where a camera sees all points (n, 3); its axes (3, 3) are right, up and back, as columns."""
    middle = axes @ _middle(points @ axes)
    seen = (points - middle) @ axes
    half_width = _SENSOR_MM / 2.0 / _LENS_MM
    needed = np.maximum(abs(seen[:, 0]), abs(seen[:, 1]) * aspect) / half_width + seen[:, 2]
    return middle + axes[:, 2] * _ROOM * needed.max()


def _middle(points: np.ndarray) -> np.ndarray:
    return (points.min(axis=0) + points.max(axis=0)) / 2.0
