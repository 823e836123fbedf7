"""Cameras that see a bridge: from beside the road, going round it, or from a position of the user's own."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...model.scenario.recording import CameraKind, PictureSettings
from ..tools.keyframes import key_values

_LENS_MM = 40.0
_SENSOR_MM = 36.0
_VIEW_FROM = Vector((-0.55, -1.0, 0.28)).normalized()
_ROOM = 1.1


def aim_camera(
    scene: bpy.types.Scene,
    points: np.ndarray,
    aspect: float,
    collection: bpy.types.Collection | None = None,
    view: PictureSettings | None = None,
) -> bpy.types.Object:
    """Add a camera to the scene, or to a collection of it, and make it the scene's.

    Unless the view gives its position, it sees points (n, 3), m, from beside the road or on its way round the bridge.
    The aspect is width : height of the pictures.
    """
    camera = bpy.data.objects.new("Bridge camera", bpy.data.cameras.new("Bridge camera"))
    camera.data.lens, camera.data.sensor_width = _LENS_MM, _SENSOR_MM
    camera.data.sensor_fit = "HORIZONTAL"  # by default a picture that is higher than wide turns the sensor
    if view and view.camera_m:
        stand(camera, view.camera_m, Vector(view.camera_m) - Vector(view.look_at_m))
    elif view and view.camera == CameraKind.ORBITING:
        _orbit(scene, camera, points, aspect, view.orbit_deg)
    else:
        stand(camera, _viewpoint(points, _axes(_VIEW_FROM), aspect), _VIEW_FROM)
    farthest = float(np.linalg.norm(points - camera.location, axis=1).max())
    camera.data.clip_start, camera.data.clip_end = farthest / 1000.0, farthest * 10.0
    (collection or scene.collection).objects.link(camera)
    scene.camera = camera
    return camera


def stand(camera: bpy.types.Object, position: Sequence[float] | np.ndarray, back: Vector) -> None:
    """Put a camera at a position, with this direction behind it."""
    camera.location, camera.rotation_euler = position, back.to_track_quat("Z", "Y").to_euler()


def _orbit(
    scene: bpy.types.Scene, camera: bpy.types.Object, points: np.ndarray, aspect: float, turn_deg: float
) -> None:
    """Animate a camera that goes round the middle of points, so far away that it always sees all of them."""
    frames = np.arange(scene.frame_start, scene.frame_end + 1)
    turns = np.radians(turn_deg) * np.linspace(0.0, 1.0, len(frames))
    middle = _middle(points)
    backs = [Matrix.Rotation(turn, 3, "Z") @ _VIEW_FROM for turn in turns.tolist()]
    distance = _ROOM * max(_needed(points, middle, _axes(back), aspect) for back in backs)
    stand(camera, middle + distance * np.array(_VIEW_FROM), _VIEW_FROM)
    key_values(camera, "location", frames, middle + distance * np.array(backs))
    first = np.array(camera.rotation_euler)
    key_values(camera, "rotation_euler", frames, first + np.outer(turns, (0.0, 0.0, 1.0)))


def _axes(back: Vector) -> np.ndarray:
    """Return right, up and back of a camera as columns (3, 3)."""
    return np.array(back.to_track_quat("Z", "Y").to_matrix())


def _viewpoint(points: np.ndarray, axes: np.ndarray, aspect: float) -> np.ndarray:
    """Return where a camera sees all points (n, 3); its axes (3, 3) are right, up and back, as columns."""
    middle = axes @ _middle(points @ axes)
    return middle + axes[:, 2] * _ROOM * _needed(points, middle, axes, aspect)


def _needed(points: np.ndarray, middle: np.ndarray, axes: np.ndarray, aspect: float) -> float:
    """Return how far from the middle (3,) of its picture a camera has to stand to see all points, m."""
    seen = (points - middle) @ axes
    half_width = _SENSOR_MM / 2.0 / _LENS_MM
    return float((np.maximum(abs(seen[:, 0]), abs(seen[:, 1]) * aspect) / half_width + seen[:, 2]).max())


def _middle(points: np.ndarray) -> np.ndarray:
    return (points.min(axis=0) + points.max(axis=0)) / 2.0
