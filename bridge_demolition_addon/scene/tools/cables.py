"""Cables that pull parts of a bridge, as they are drawn: from their anchors to the shards that they are fixed to."""

from __future__ import annotations

import math
from collections.abc import Sequence

import bpy
import numpy as np

from ...engineering.arithmetic import cosine, sine
from ...engineering.geometry.mesh import TriangleMesh
from ...model.as_built import Structure
from ...model.pulls import Pull
from ..bodies import mesh_of
from ..collections import ROLE, collection_for, find_collection, remove_marked

_CABLES, _NAME = "pulls", "bda_pull"

_SIDES = 8
_RADIUS_M = 0.04
"""Thicker than a cable, so that it is seen."""

_STEEL = (0.08, 0.09, 0.10, 1.0)


def create_cables(
    scene: bpy.types.Scene, pulls: Sequence[Pull], structure: Structure, shards: Sequence[bpy.types.Object]
) -> None:
    """Draw cables in place of those that were drawn before. They go with their shards, and are no bodies."""
    remove_marked(scene, _CABLES)
    for number, pull in enumerate(pulls, start=1):
        placed = pull.placed(structure, number)
        shard = int(placed.bodies[0])
        end = bpy.data.objects.new(f"{pull.name} end", None)
        end.empty_display_size = 0.3
        end.parent = shards[shard]
        end.location = placed.arms_m[0]
        cable = bpy.data.objects.new(pull.name, mesh_of(pull.name, _rod()))
        cable.location, cable.color = pull.anchor_m, _STEEL
        stretch = cable.constraints.new("STRETCH_TO")
        stretch.target, stretch.rest_length, stretch.volume = end, 1.0, "NO_VOLUME"
        cable[_NAME] = pull.name
        for made in (end, cable):
            made[ROLE] = _CABLES
            collection_for(scene, _CABLES).objects.link(made)


def drawn_cables(scene: bpy.types.Scene) -> list[tuple[bpy.types.Object, bpy.types.Object, np.ndarray]]:
    """Return each drawn cable with the shard that it is fixed to, and where (3,), m, in the shard's own axes."""
    found = find_collection(scene, _CABLES)
    cables = [obj for obj in found.objects if _NAME in obj] if found else []
    ends = [(cable, cable.constraints[0].target) for cable in cables if cable.constraints]
    return [(cable, end.parent, np.array(end.location)) for cable, end in ends if end and end.parent]


def hide_cables(scene: bpy.types.Scene, names: Sequence[str]) -> None:
    """Hide cables that have let go, from this frame on."""
    if not names:
        return
    for cable in collection_for(scene, _CABLES).objects:
        if cable.get(_NAME) in names and not cable.hide_render:
            for name in ("hide_render", "hide_viewport"):
                cable.keyframe_insert(name, frame=scene.frame_current - 1)
                setattr(cable, name, True)
                cable.keyframe_insert(name, frame=scene.frame_current)


def _rod() -> TriangleMesh:
    """A rod of 1 m along y, which is stretched."""
    angles = 2.0 * math.pi * np.arange(_SIDES) / _SIDES
    ring = _RADIUS_M * np.column_stack((cosine(angles), np.zeros(_SIDES), sine(angles)))
    here = np.arange(_SIDES)
    after = np.roll(here, -1)
    sides = np.concatenate(
        (np.column_stack((here, after, after + _SIDES)), np.column_stack((here, after + _SIDES, here + _SIDES)))
    )
    return TriangleMesh(np.concatenate((ring, ring + np.array((0.0, 1.0, 0.0)))), sides)
