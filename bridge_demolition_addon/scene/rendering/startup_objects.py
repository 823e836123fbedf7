"""Cube, lamp and camera that Blender starts with: hidden while a bridge is there, and never deleted."""

from __future__ import annotations

import bpy
from mathutils import Matrix, Vector

from ..custom_properties import kept_numbers

_PUT_AWAY = "bda_put_away"
"""Property of a hidden object: whether it was hidden in renders before, and whether it was the scene's camera."""

_NEAR_M = 1e-3
_PLACES = {
    "MESH": ("Cube", Vector((0.0, 0.0, 0.0))),
    "LIGHT": ("Light", Vector((4.0762, 1.0055, 5.9039))),
    "CAMERA": ("Camera", Vector((7.3589, -6.9258, 4.9583))),
}
_CUBE_CORNERS = 8


def put_startup_objects_away(scene: bpy.types.Scene) -> None:
    """Hide the objects of Blender's start-up file that are as they were, and take their camera from the scene."""
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
    """Show what was hidden, and give the scene its camera back where it has none now."""
    for obj in scene.objects:
        if _PUT_AWAY in obj:
            hidden, was_camera = kept_numbers(obj, _PUT_AWAY, (0.0, 0.0))
            del obj[_PUT_AWAY]
            obj.hide_render = bool(hidden)
            for layer in scene.view_layers:
                if obj.name in layer.objects:
                    obj.hide_set(False, view_layer=layer)
            if was_camera and scene.camera is None:
                scene.camera = obj


def _is_untouched(obj: bpy.types.Object) -> bool:
    if obj.type not in _PLACES or obj.library or obj.rigid_body or obj.modifiers or obj.parent:
        return False
    name, position = _PLACES[obj.type]
    is_there = obj.name == name and (obj.matrix_basis.translation - position).length < _NEAR_M
    if obj.type != "MESH":
        return is_there and not obj.animation_data
    return is_there and len(obj.data.vertices) == _CUBE_CORNERS and obj.matrix_basis == Matrix.Identity(4)
