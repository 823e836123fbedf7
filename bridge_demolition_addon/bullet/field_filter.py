"""Having Blender pass over the force fields of a scene in frames in which none of them pushes.

In every sub-step Blender applies every field to every body, even fields without strength: with a thousand of each, a
frame takes three times as long. If the rigid-body world is limited to a collection, only fields in it act. Blender
finds none in the scene's own root collection, which users cannot choose as the limit.

So a pointer to that collection is written, into the evaluated copy of the scene only: set through Python, the limit
would belong to the user's scene, and would have all of Blender's relations built again.
"""

from __future__ import annotations

import bpy
import numpy as np

from ..errors import LayoutError
from ..scene.world import evaluated_scenes
from .memory import POINTERS, read, read_pointer

INFLUENCES = (
    *("all", "force", "vortex", "magnetic", "wind", "curve_guide", "texture", "harmonic"),
    *("charge", "lennardjones", "boid", "turbulence", "drag", "smokeflow", "gravity"),
)
"""Weights of the kinds of fields and of gravity: floats behind the pointer to the collection, which mark it."""


def ignore_fields(scene: bpy.types.Scene) -> None:
    """Let no field act in the coming frames, until `let_fields_act` or the next update of the scene's evaluated copy.

    A world that its user has limited to a collection stays. Raises a `LayoutError` if memory is not as expected.
    """
    for evaluated in evaluated_scenes(scene):
        if evaluated.rigidbody_world.effector_weights.collection is None:
            _limit(evaluated, evaluated.collection.as_pointer())


def let_fields_act(scene: bpy.types.Scene) -> None:
    """Let fields act again. Raises a `LayoutError` if memory is not as expected."""
    for evaluated in evaluated_scenes(scene):
        if evaluated.rigidbody_world.effector_weights.collection == evaluated.collection:
            _limit(evaluated, 0)


def _limit(scene: bpy.types.Scene, collection: int) -> None:
    weights = scene.rigidbody_world.effector_weights
    address = weights.as_pointer()  # the structure begins with the pointer
    limited_to = weights.collection.as_pointer() if weights.collection else 0
    raw = read(address + 8, 4 * len(INFLUENCES)) or b""
    shown = np.array([getattr(weights, name) for name in INFLUENCES], np.float32)
    if read_pointer(address) != limited_to or raw != shown.tobytes():
        raise LayoutError("the limit of the rigid-body world's force fields is not where it is expected")
    POINTERS.write(address, collection)
