"""Jackhammers: chisels that animation moves up and down along a path."""

from __future__ import annotations

import bpy

from ...engineering.geometry.solids import cylinder
from ...model.scenario import Jackhammer
from ..bodies import Kind, create_body, mesh_of, set_surface
from .build_site import BuildSite
from .keyframes import key_values

_SIDES = 16
_STEEL = (0.15, 0.13, 0.05, 1.0)


def create_jackhammer(site: BuildSite, settings: Jackhammer) -> bpy.types.Object:
    """Make a chisel with a keyframe in every frame; its origin is at the tip.

    Blender moves a body in a straight line over the sub-steps between two frames.
    """
    solid = cylinder(settings.diameter_m / 2.0, settings.length_m, _SIDES)
    chisel = create_body(site.world, mesh_of("Jackhammer", solid), Kind.TOOL, "CONVEX_HULL")
    chisel.color = _STEEL
    chisel.rigid_body.type = "PASSIVE"
    chisel.rigid_body.kinematic = True
    set_surface(chisel.rigid_body, site.surface_of(settings), 0.0)
    frames, times_s = site.frames_and_times()
    positions = settings.tip_positions(site.height_at(settings.path_m[0]), times_s)
    chisel.location = positions[0]
    key_values(chisel, "location", frames, positions)
    return chisel
