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
from ..scenario.bridge_checks import (
    SHORTEST_SUPPORT_M,
    arch_axis,
    axis_line,
    deck_top_at,
    leg_axes_m,
    road_line,
)
from ..scenario.half_joints import DeckPart, deck_parts


def pier_axes(bridge: Bridge) -> np.ndarray:
    """Positions along the road of the axes of piers and abutments, in the middle of the road, (spans + 1,) in m."""
    return np.concatenate(([0.0], np.cumsum(bridge.span_lengths_m)))


def deck_ends(bridge: Bridge) -> list[tuple[float, float]]:
    """Begin and end along the road of every deck, in the middle of the road, m: one, or one for each span."""
    overhang = bridge.deck.overhang_m
    first, last = -overhang, bridge.spans_m + overhang
    if bridge.half_joints:
        return [part.slab_m for part in parts_of_deck(bridge)]
    if not bridge.deck.per_span:
        return [(first, last)]
    half_gap = bridge.deck.joint_gap_m / 2.0
    joints = [side for axis in pier_axes(bridge)[1:-1] for side in (axis - half_gap, axis + half_gap)]
    return list(pairwise([first, *joints, last]))[::2]


def parts_of_deck(bridge: Bridge) -> list[DeckPart]:
    """Return the parts that half-joints divide a deck into."""
    ends = -bridge.deck.overhang_m, bridge.spans_m + bridge.deck.overhang_m
    return deck_parts(bridge.half_joints, pier_axes(bridge).tolist(), ends)


def deck_seats(bridge: Bridge) -> list[tuple[float, ...]]:
    """Return the positions along the road at which each deck is carried, m."""
    if bridge.half_joints:
        return [part.seats_m for part in parts_of_deck(bridge)]
    axes = tuple(pier_axes(bridge).tolist())
    decks = len(deck_ends(bridge))
    return [axes[deck : deck + 2] if decks > 1 else axes for deck in range(decks)]


def deck_prefixes(bridge: Bridge) -> list[str]:
    """Return what the names of decks, and of girders below them, begin with."""
    decks, kind = len(deck_ends(bridge)), "part" if bridge.half_joints else "span"
    return [f"{kind} {number} " for number in range(1, decks + 1)] if decks > 1 else [""]


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
    tops = [deck_top_at(bridge, along, 0.0) for along in pier_axes(bridge).tolist()]
    shown = dict.fromkeys(f"{top:.2f}" for top in (min(tops), max(tops)))
    yield "deck top above ground" if is_flat else "height of deck top", f"{' to '.join(shown)} m"


def skewed(bridge: Bridge, solid: TriangleMesh) -> TriangleMesh:
    """Return a solid sheared along the road by the skew; its volume and its sections along the road stay the same."""
    if bridge.skew_deg == 0.0:
        return solid
    vertices = solid.vertices.copy()
    vertices[:, 0] += vertices[:, 1] * bridge.shift_across
    return replace(solid, vertices=vertices)


def placed(bridge: Bridge, solid: TriangleMesh) -> TriangleMesh:
    """Return what was made straight, square and level on the line of the road."""
    line = road_line(bridge)
    return skewed(bridge, solid) if line is None else line.carried(solid)


def seated(bridge: Bridge, axis_m: float, solid: TriangleMesh, foot_m: float | None = None) -> TriangleMesh:
    """Return what carries the deck at an axis, skewed already, with its top in the plane of the deck there.

    What has a foot is level there, at that height; else its underside follows too.
    """
    line = axis_line(bridge, axis_m)
    if line is None:
        return solid
    own = solid.vertices.copy()
    own[:, 0] -= own[:, 1] * bridge.shift_across
    vertices = line.to_world(own)
    if foot_m is not None:
        vertices[solid.vertices[:, 2] == solid.vertices[:, 2].min(), 2] = foot_m
    return replace(solid, vertices=vertices)


def seat_m(bridge: Bridge, axis_m: float, across_m: float, height_m: float) -> tuple[float, float, float]:
    """Return where the middle of the top of what carries the deck at an axis is, for a height at the first axis."""
    line = axis_line(bridge, axis_m)
    if line is None:
        return axis_m + across_m * bridge.shift_across, across_m, height_m
    x, y, z = line.to_world(np.array([axis_m, across_m, height_m])).tolist()
    return x, y, z


Rows = tuple[tuple[float, float], tuple[float, float]]


def without_shear(bridge: Bridge, axis_m: float = 0.0) -> Rows:
    """Return the rows that take positions on plan of what is sheared by the skew back to where it was.

    On a curve, which has no skew, they take it back from the heading of its axis, but for where it stands.
    """
    turn = _heading_rad(bridge, axis_m)
    return _turned_back(turn) if turn else ((1.0, -bridge.shift_across), (0.0, 1.0))


def without_turn(bridge: Bridge, axis_m: float) -> Rows:
    """Return the rows that take positions on plan of what is rotated with its axis back, but for where it stands."""
    return _turned_back(_heading_rad(bridge, axis_m) - math.radians(bridge.skew_deg))


def _heading_rad(bridge: Bridge, axis_m: float) -> float:
    line = axis_line(bridge, axis_m)
    return 0.0 if line is None else line.heading_rad


def _turned_back(angle_rad: float) -> Rows:
    (first, second), (third, fourth) = turn_in_plane(-angle_rad).tolist()
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


def level_ground(_name: str, _x_m: float, _y_m: float) -> float:
    """Height of ground that is flat, m."""
    return 0.0


def foot_m(name: str, top_m: tuple[float, float, float], ground: GroundHeight, *, is_level: bool = True) -> float:
    """Return the height of the ground under a member with the middle of its top at a position, m.

    Raises
    ------
    GeometryError
        The ground is above its top, or nearly so.
    """
    x, y, height = top_m
    foot, highest = ground(name, x, y), height - SHORTEST_SUPPORT_M
    # Of a level bridge on level ground the keys say how high a pier has to be.
    if foot > (max(highest, 0.0) if is_level else highest):
        raise GeometryError(
            f"The ground is at {foot:.2f} m under {name}, whose top is at {height:.2f} m; make the bridge "
            "higher, or the ground lower there: ground.profile_m, or ground.origin of a file."
        )
    return foot
