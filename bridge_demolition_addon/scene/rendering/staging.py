"""A demolition as it is looked at: with materials, under sun and sky, before a camera."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...model.scenario.recording import PictureSettings
from ...model.structure.model import Model
from ..bodies import bodies_of
from ..visibility import hide_symbols
from .finishes import finish_others, finish_shards
from .surroundings import surround


def stage(
    scene: bpy.types.Scene,
    shards: Sequence[bpy.types.Object],
    model: Model,
    points: np.ndarray,
    view: PictureSettings | None = None,
) -> None:
    """Make a demolition that was just built look like one; nothing of this takes part in the simulation.

    Parameters
    ----------
    scene
        Where it was built.
    shards : sequence of length n
        The shards of the model, in its order.
    model
        What they were made from.
    points : (k, 3) float
        What the camera is to see, m.
    view
        Where the camera stands; None for beside the road.
    """
    finish_shards(shards, model)
    finish_others(bodies_of(scene))
    surround(scene, points, view)
    for layer in scene.view_layers:
        hide_symbols(layer, scene, hidden=True)
