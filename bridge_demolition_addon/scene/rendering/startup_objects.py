"""Cube, lamp and camera that Blender starts with: out of the way while a bridge is there, and never deleted."""

from __future__ import annotations

import bpy
from mathutils import Matrix, Vector

_PUT_AWAY = "bda_put_away"
"""Property of an object that was put away: whether it was hidden in renders before, and the scene's camera."""

_NEAR_M = 1e-3
_PLACES = {
    "MESH": ("Cube", Vector((0.0, 0.0, 0.0))),
    "LIGHT": ("Light", Vector((4.0762, 1.0055, 5.9039))),
    "CAMERA": ("Camera", Vector((7.3589, -6.9258, 4.9583))),
}
_CUBE_CORNERS = 8


def put_startup_objects_away(scene: bpy.types.Scene) -> None:
    """Hide the objects of Blender's start-up file that nobody has touched, and take their camera from the scene."""
    for obj in scene.objects:
        if _PUT_AWAY not in obj and _is_untouched(obj):
            obj[_PUT_AWAY] = [obj.hide_render, scene.camera == obj]
            obj.hide_render = True
            for layer in scene.view_layers:
                if obj.name in layer.objects:
                    obj.hide_set(True, view_layer=layer)
            if scene.camera == obj:
                scene.camera = None


def bring_startup_objects_back(scene: bpy.types.Scene) -> None:
    """Show what was put away, and give the scene its camera back where it has none by now."""
    for obj in scene.objects:
        if _PUT_AWAY in obj:
            hidden, was_camera = obj[_PUT_AWAY]
            del obj[_PUT_AWAY]
            obj.hide_render = bool(hidden)
            for layer in scene.view_layers:
                if obj.name in layer.objects:
                    obj.hide_set(False, view_layer=layer)
            if was_camera and scene.camera is None:
                scene.camera = obj


def _is_untouched(found: bpy.types.Object) -> bool:
    if found.type not in _PLACES or found.library or found.rigid_body or found.modifiers or found.parent:
        return False
    name, place = _PLACES[found.type]
    is_there = found.name == name and (found.matrix_basis.translation - place).length < _NEAR_M
    if found.type != "MESH":
        return is_there and not found.animation_data
    return is_there and len(found.data.vertices) == _CUBE_CORNERS and found.matrix_basis == Matrix.Identity(4)
