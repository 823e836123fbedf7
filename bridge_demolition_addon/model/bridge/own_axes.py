"""The axes of a member that bars count in which follow it: along it, across it and up from its underside."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.own_axes import OwnAxes, lying_axes, standing_axes
from .member import Member

_LYING = ("deck", "girder", "arch", "pier cap", "parapet", "bracing", "footing", "approach slab")
_STANDING = ("pier", "leg")

_ROAD = (1.0, 0.0)
_MOST_WIDE = 3.0
"""Width of a deck by its length up to which its own line is along the road."""


def own_axes(member: Member) -> OwnAxes:
    """Return the axes of a member: along the road of a deck or a whole arch, else along its longer side on plan."""
    is_along_road = member.kind == "deck" or (member.kind == "arch" and member.is_in_pieces)
    return _axes(member.solid, is_standing(member), is_along_road)


def is_standing(member: Member) -> bool:
    """Return whether a member stands: a pier, or what is higher than long and of no kind that lies."""
    if member.kind in (*_LYING, *_STANDING):
        return member.kind in _STANDING
    sizes = np.ptp(member.solid.vertices, axis=0)
    return bool(sizes[2] >= sizes[:2].max())


@lru_cache(maxsize=64)
def _axes(solid: TriangleMesh, is_upright: bool, is_along_road: bool) -> OwnAxes:
    if is_upright:
        return standing_axes(solid)
    axes = lying_axes(solid, np.array(_ROAD)) if is_along_road else lying_axes(solid)
    if is_along_road and axes.width_m > _MOST_WIDE * axes.length_m:
        return lying_axes(solid)
    return axes
