"""A demolition as it is looked at: with materials, under sun and sky, before a camera."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy
import numpy as np

from ...model.scenario.recording import PictureSettings
from ...model.structure.finishes import Finish, finishes
from ...model.structure.model import Model
from ..bodies import Kind, bodies_of, kind_of, member_of
from ..visibility import hide_symbols
from .materials import BUILT_AT, SurfaceMaterial, material_of
from .surroundings import surround

_OF_FINISH = {
    Finish.CAST: SurfaceMaterial.CONCRETE,
    Finish.BROKEN: SurfaceMaterial.BROKEN_CONCRETE,
    Finish.ROAD: SurfaceMaterial.ASPHALT,
}
_OF_KIND = {
    Kind.BALL: SurfaceMaterial.STEEL,
    Kind.TOOL: SurfaceMaterial.STEEL,
    Kind.CRANE: SurfaceMaterial.PAINT,
    Kind.GROUND: SurfaceMaterial.SOIL,
}
_OF_SURFACE = {"water": SurfaceMaterial.WATER, "carriageway": SurfaceMaterial.ASPHALT}
"""Of surfaces on the ground, by their kind."""


def stage(
    scene: bpy.types.Scene,
    shards: Sequence[bpy.types.Object],
    model: Model,
    points: np.ndarray,
    view: PictureSettings | None = None,
) -> None:
    """Make a demolition look real that was just built of a model, with its shards in the model's order.

    The camera sees points (k, 3), m; without a view it stands beside the road. Nothing of this takes part in the
    simulation.
    """
    _finish_shards(shards, model)
    _finish_others(bodies_of(scene))
    surround(scene, points, view)
    for layer in scene.view_layers:
        hide_symbols(layer, scene, hidden=True)


def _finish_shards(shards: Sequence[bpy.types.Object], model: Model) -> None:
    """Give the faces of shards the materials of cast and broken concrete and of asphalt."""
    materials = [material_of(_OF_FINISH[finish]) for finish in Finish]
    of_shards = finishes(model.shards, model.members, model.member_of_shard)
    for shard, of_faces in zip(shards, of_shards, strict=True):
        for material in materials:
            shard.data.materials.append(material)
        shard.data.polygons.foreach_set("material_index", of_faces.astype(np.int32))
        shard[BUILT_AT] = tuple(shard.location)


def _finish_others(bodies: Iterable[bpy.types.Object]) -> None:
    """Give ball, tools, crane and ground their materials; a ball is smooth."""
    for body in bodies:
        kind = kind_of(body)
        if kind in _OF_KIND and not body.data.materials:
            surface = _OF_SURFACE.get(member_of(body)[1], _OF_KIND[kind]) if kind == Kind.GROUND else _OF_KIND[kind]
            body.data.materials.append(material_of(surface))
        if kind == Kind.BALL:
            body.data.polygons.foreach_set("use_smooth", np.ones(len(body.data.polygons), bool))
