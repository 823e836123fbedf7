"""Curves of animation, and keyframes written all at once."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from numpy.typing import ArrayLike


def key_values(
    body: bpy.types.Object,
    data_path: str,
    frames: Sequence[float] | np.ndarray,
    values: ArrayLike,
    *,
    constant: bool = False,
) -> None:
    """Set c keyframes of a property with k components, values (c, k); its other keyframes stay.

    Values go to the next keyframe in a straight line, or hold until there where they are constant.
    """
    numbers = np.asarray(frames, float).tolist()
    for index, column in enumerate(np.asarray(values, float).reshape(len(numbers), -1).T.tolist()):
        curve = _curve(body, data_path, index)
        keys = dict(keyframes_of(curve).astype(float).tolist()) | dict(zip(numbers, column, strict=True))
        points = curve.keyframe_points
        points.add(len(keys) - len(points))
        points.foreach_set("co", np.array(sorted(keys.items())).ravel())
        for point in points:
            point.interpolation = "CONSTANT" if constant else "LINEAR"
        curve.update()


def keyframes_of(curve: bpy.types.FCurve) -> np.ndarray:
    """Return frames and values (c, 2) of a curve's keyframes, as Blender has them in single precision."""
    values = np.empty(2 * len(curve.keyframe_points), np.float32)
    curve.keyframe_points.foreach_get("co", values)
    return values.reshape(-1, 2)


def curves_of(animation: bpy.types.AnimData) -> list[bpy.types.FCurve]:
    """Return the curves of an action that is in use."""
    if not hasattr(animation, "action_slot"):  # Blender before 4.4
        return list(animation.action.fcurves)
    bags = [bag for layer in animation.action.layers for strip in layer.strips for bag in strip.channelbags]
    return [curve for bag in bags if bag.slot == animation.action_slot for curve in bag.fcurves]


def _curve(body: bpy.types.Object, data_path: str, index: int) -> bpy.types.FCurve:
    """Return the curve of a property, a new one where there is none yet."""
    curves = _curves(body)
    return curves.find(data_path, index=index) or curves.new(data_path, index=index)


def _curves(body: bpy.types.Object) -> bpy.types.bpy_prop_collection:
    animation = body.animation_data_create()
    if not animation.action:
        animation.action = bpy.data.actions.new(body.name)
    action = animation.action
    if not hasattr(action, "slots"):  # Blender before 4.4: one set of curves in an action
        return action.fcurves
    if not animation.action_slot:
        animation.action_slot = action.slots.new(id_type="OBJECT", name=body.name)
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(animation.action_slot, ensure=True).fcurves
