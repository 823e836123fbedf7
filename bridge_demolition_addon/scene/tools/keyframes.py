"""Keyframes of bodies, written all at once."""

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
    """Set keyframes of a property with k components; its other keyframes stay.

    Parameters
    ----------
    frames, values : (c,) float, (c, k) float
        The keyframes.
    constant : bool
        Whether values hold until the next keyframe, instead of going there in a straight line.
    """
    columns = np.asarray(values, float).reshape(len(frames), -1).T
    for index, column in enumerate(columns):
        curve = _curve(body, data_path, index)
        keys = {**_keys(curve), **dict(zip(np.asarray(frames, float).tolist(), column.tolist(), strict=True))}
        points = curve.keyframe_points
        points.add(len(keys) - len(points))
        points.foreach_set("co", np.array(sorted(keys.items())).ravel())
        for point in points:
            point.interpolation = "CONSTANT" if constant else "LINEAR"
        curve.update()


def _keys(curve: bpy.types.FCurve) -> dict[float, float]:
    values = np.empty(2 * len(curve.keyframe_points), np.float32)
    curve.keyframe_points.foreach_get("co", values)
    return dict(values.reshape(-1, 2).astype(float).tolist())


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
