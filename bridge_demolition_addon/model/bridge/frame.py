"""A frame as solids: its legs, and the deck with its haunches."""

from __future__ import annotations

import numpy as np

from ...engineering.geometry.arches import RoadProfile, across_road
from ...engineering.geometry.vectors import unit
from ..scenario import Bridge
from ..scenario.bridge_axes import leg_axes_m
from ..schema import given
from .ground import GroundHeight, foot_m
from .layout import deck_top
from .member import Member

LEG = "leg"


def frame_legs(bridge: Bridge, ground: GroundHeight) -> list[Member]:
    """Return every leg, down to the ground under the middle of its foot. They are numbered along the road."""
    frame, axes = given(bridge.frame), leg_axes_m(bridge)
    members = []
    for number, (axis, lean) in enumerate(zip(axes, frame.leans_m(len(axes)), strict=True), start=1):
        for leg in range(frame.legs):
            name = f"leg {number}" if frame.legs == 1 else f"leg {number}.{leg + 1}"
            across = bridge.deck.width_m * ((leg + 0.5) / frame.legs - 0.5)
            members.append(_leg(bridge, name, (axis, across), lean, ground))
    return members


def deck_profile(bridge: Bridge, begin_m: float, end_m: float) -> RoadProfile:
    """Return the deck with its haunches between its ends along the road."""
    frame = given(bridge.frame)
    half = 0.5 * frame.leg_thickness_m
    away = half + frame.haunch_length_m
    corners = [
        (axis + side, frame.clear_height_m - (frame.haunch_depth_m if abs(side) == half else 0.0))
        for axis in leg_axes_m(bridge)
        for side in (-away, -half, half, away)
    ]
    along, heights = (np.array(column) for column in zip(*corners, strict=True))
    inside = (along > begin_m) & (along < end_m)
    x = np.concatenate(([begin_m], along[inside], [end_m]))
    undersides = np.interp(x, along, heights)
    return RoadProfile(np.column_stack((x, undersides)), np.column_stack((x, np.full(len(x), deck_top(bridge)))))


def _leg(bridge: Bridge, name: str, top_m: tuple[float, float], lean_m: float, ground: GroundHeight) -> Member:
    frame, (axis, across) = given(bridge.frame), top_m
    half, top = 0.5 * frame.leg_thickness_m, frame.leg_top_m
    foot = foot_m(name, axis + lean_m, across, top, ground)
    at_foot = axis + lean_m
    corners = [(at_foot - half, foot), (at_foot + half, foot), (axis + half, top), (axis - half, top)]
    solid = across_road(np.array(corners), frame.leg_width_m, across)
    if lean_m == 0.0:
        return Member(name, LEG, solid)
    along, up = unit(np.array([-lean_m, top - foot])).tolist()
    return Member(name, LEG, solid, parts=(solid,), directions=((along, up),))
