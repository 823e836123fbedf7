"""Jackhammers: chisels that animation moves up and down along a path."""

from __future__ import annotations

import bpy
import numpy as np

from ...engineering.geometry.solids import cylinder
from ...engineering.timing.timeline import Timeline
from ...model.scenario import Jackhammer
from ...model.sequence.tool_paths import chisel_tip_positions
from ..bodies import Kind, create_body, mesh_of, set_surface
from .keyframes import key_values

_SIDES = 16
_STEEL = (0.15, 0.13, 0.05, 1.0)


def create_jackhammer(
    world: bpy.types.RigidBodyWorld, settings: Jackhammer, deck_top_m: float, start_frame: int, timeline: Timeline
) -> bpy.types.Object:
    """Make a chisel with a keyframe in every frame; its origin is at the tip.

    Parameters
    ----------
    deck_top_m : float
        Height of the deck.
    start_frame : int
        Frame of the time 0, the last one before time passes.
    timeline : Timeline
        The frames from there on. Blender moves a body in a straight line over the sub-steps between two frames.
    """
    solid = cylinder(settings.diameter_m / 2.0, settings.length_m, _SIDES)
    chisel = create_body(world, mesh_of("Jackhammer", solid), Kind.TOOL, "CONVEX_HULL")
    chisel.color = _STEEL
    chisel.rigid_body.type = "PASSIVE"
    chisel.rigid_body.kinematic = True
    set_surface(chisel.rigid_body, settings.friction, 0.0, 0.0)
    times = np.concatenate(([0.0], timeline.ends_s))
    frames = start_frame + np.arange(len(times))
    places = chisel_tip_positions(settings, deck_top_m, times)
    chisel.location = places[0]
    key_values(chisel, "location", frames, places)
    return chisel
