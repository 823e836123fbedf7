"""Where a bridge's members begin and end: axes along the road, heights, skew, and the ground under them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import transformed, turn_in_plane
from ...errors import GeometryError
from ..actions import Fact
from ..scenario import Bridge
from ..scenario.bridge_checks import arch_axis, leg_axes_m
from ..schema import given


def pier_axes(bridge: Bridge) -> np.ndarray:
    """Positions along the road of the axes of piers and abutments, in the middle of the road, (spans + 1,) in m."""
    return np.concatenate(([0.0], np.cumsum(bridge.span_lengths_m)))


def deck_underside(bridge: Bridge) -> float:
    """Height above the ground of what lies on piers and abutments, m: slab, girders or box girder."""
    if bridge.frame:
        return bridge.frame.clear_height_m
    if bridge.piers is None:
        return given(given(bridge.abutments).height_m)
    cap_height = bridge.pier_caps.height_m if bridge.pier_caps else 0.0
    return bridge.piers.height_m + cap_height


def slab_underside(bridge: Bridge) -> float:
    """Height of the slab's underside above the ground, m: higher than that of the girders or the box it lies on."""
    below = bridge.girders or bridge.box_girder
    return deck_underside(bridge) + (below.depth_m if below else 0.0)


def deck_top(bridge: Bridge) -> float:
    """Height of the road surface above the ground, m."""
    return slab_underside(bridge) + bridge.deck.thickness_m


def deck_ends(bridge: Bridge) -> list[tuple[float, float]]:
    """Begin and end along the road of every deck, in the middle of the road, m: one, or one for each span."""
    overhang = bridge.deck.overhang_m
    first, last = -overhang, bridge.spans_m + overhang
    if not bridge.deck.per_span:
        return [(first, last)]
    half_gap = bridge.deck.joint_gap_m / 2.0
    joints = [side for axis in pier_axes(bridge)[1:-1] for side in (axis - half_gap, axis + half_gap)]
    return list(pairwise([first, *joints, last]))[::2]


def bridge_facts(bridge: Bridge, *, is_flat: bool) -> Iterator[Fact]:
    """Yield what a planner wants to know of a bridge before a run."""
    yield "length", f"{bridge.length_m:.2f} m"
    yield "spans", " + ".join(f"{span:.2f}" for span in bridge.span_lengths_m) + " m"
    if bridge.arch:
        arch = arch_axis(bridge)
        yield "arch", f"span {arch.span_m:.2f} m, rise {arch.rise_m:.2f} m"
    if bridge.frame and len(leg_axes_m(bridge)) > 1:
        clear = (after - before - bridge.frame.leg_thickness_m for before, after in pairwise(leg_axes_m(bridge)))
        yield "frame", f"clear {' + '.join(f'{span:.2f}' for span in clear)} m at the deck"
    yield "deck top above ground" if is_flat else "height of deck top", f"{deck_top(bridge):.2f} m"


def skewed(bridge: Bridge, solid: TriangleMesh) -> TriangleMesh:
    """Return a solid sheared along the road by the skew; its volume and its sections along the road stay the same."""
    if bridge.skew_deg == 0.0:
        return solid
    vertices = solid.vertices.copy()
    vertices[:, 0] += vertices[:, 1] * bridge.shift_across
    return replace(solid, vertices=vertices)


def without_shear(bridge: Bridge) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the rows that take positions on plan of what is sheared by the skew back to where it was."""
    return (1.0, -bridge.shift_across), (0.0, 1.0)


def without_turn(bridge: Bridge) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the rows that take positions on plan of what is rotated with its axis back, but for where it stands."""
    (first, second), (third, fourth) = turn_in_plane(math.radians(bridge.skew_deg)).tolist()
    return (first, second), (third, fourth)


def turned_with_axis(bridge: Bridge, solid: TriangleMesh, along: float, across: float) -> TriangleMesh:
    """Return a solid at a position on an unskewed axis, moved to the skewed axis and rotated with it."""
    if bridge.skew_deg == 0.0:
        return solid
    rotation = turn_in_plane(-math.radians(bridge.skew_deg))
    on_axis = np.array((along + across * bridge.shift_across, across))
    vertices = solid.vertices.copy()
    vertices[:, :2] = transformed(rotation, vertices[:, :2] - (along, across)) + on_axis
    return replace(solid, vertices=vertices)


GroundHeight = Callable[[str, float, float], float]
"""How high the ground is, m, under a member of a name with its middle at x and y."""

_SHORTEST_M = 0.1
"""Least height of what stands on the ground."""


def level_ground(_name: str, _x_m: float, _y_m: float) -> float:
    """Height of ground that is flat, m."""
    return 0.0


def foot_m(name: str, x_m: float, y_m: float, top_m: float, ground: GroundHeight) -> float:
    """Return the height of the ground under a member, m.

    Raises
    ------
    GeometryError
        The ground is above its top, or nearly so.
    """
    foot = ground(name, x_m, y_m)
    if foot > max(top_m - _SHORTEST_M, 0.0):  # on level ground the keys say how high a pier has to be
        raise GeometryError(
            f"The ground is at {foot:.2f} m under {name}, whose top is at {top_m:.2f} m; make the bridge "
            "higher, or the ground lower there: ground.profile_m, or ground.origin of a file."
        )
    return foot
