"""All members of a scenario, ready to be cut into shards, and the box around them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.geometry.overlap import separated
from ...engineering.geometry.vectors import cross_2d, length
from ...errors import GeometryError, ScenarioError
from ..scenario import Scenario
from ..schema import FARTHEST_M, SHORTEST_LENGTH_M, given
from ..terrain.built import check_under
from ..terrain.placed import Terrain, terrain_of
from . import bridge_members, deck_top_at
from .member import Member
from .mesh_files import geometry_members
from .steelwork import steelwork_members

_DEBRIS_ROOM = 10.0
"""Ground to each side of the bridge, as a multiple of its height; debris of a felled bridge stays well inside."""

_ON_EDGE = 1e-9
"""How far outside a triangle, as a part of it, a position may lie and still be on it."""


def extent(members: Sequence[Member]) -> np.ndarray:
    """Return the lowest and the highest corner (2, 3), m, of the box around all members."""
    boxes = np.array([member.solid.bounds for member in members])
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def ground_half_size(members: Sequence[Member], clear_height_m: float) -> float:
    """Return how far the ground extends from the origin to every side, m, with room for debris.

    A ball hangs `clear_height_m` above the members; 0 without one.
    """
    lower, upper = extent(members)
    farthest = float(length(np.maximum(abs(lower[:2]), abs(upper[:2]))))
    across = float(length((upper - lower)[:2]))
    height = float(upper[2]) - min(float(lower[2]), 0.0)
    return max(across, farthest) + _DEBRIS_ROOM * (height + clear_height_m)


def room_around(scenario: Scenario, members: Sequence[Member]) -> float:
    """Return how far the ground of a scenario with these members extends from the origin to every side, m."""
    return ground_half_size(members, scenario.ball.largest_height_m(0.0) if scenario.ball else 0.0)


def surface_height(scenario: Scenario, members: Sequence[Member], position_m: tuple[float, float]) -> float:
    """Return the height of the highest member at a position along and across the road, m.

    A bridge alone has the height of its deck, which joints do not interrupt.
    """
    if scenario.bridge and not scenario.geometry and not scenario.steelwork:
        return deck_top_at(scenario.bridge, *position_m)
    corners = np.concatenate([member.solid.corners for member in members])
    heights = _heights_above(corners, np.asarray(position_m, dtype=float))
    if not len(heights):
        raise GeometryError(
            f"No member lies under {list(position_m)}; aim the ball at a position that has something under it."
        )
    return float(heights.max())


def _heights_above(corners: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Return the heights of the triangles (t, 3, 3) that lie over or under a position (2,)."""
    origin = corners[:, 0]
    first, second = corners[:, 1] - origin, corners[:, 2] - origin
    area = cross_2d(first, second)
    lies = np.abs(area) > 0.0
    origin, first, second, area = origin[lies], first[lies], second[lies], area[lies]
    offset = position - origin[:, :2]
    u, v = cross_2d(offset, second) / area, cross_2d(first, offset) / area
    inside = (u >= -_ON_EDGE) & (v >= -_ON_EDGE) & (u + v <= 1.0 + _ON_EDGE)
    return (origin[:, 2] + u * first[:, 2] + v * second[:, 2])[inside]


@dataclass(frozen=True, slots=True)
class PreparedMembers:
    """Members without overlap, and sentences on what was repaired and cut off to get there."""

    members: tuple[Member, ...]
    notes: tuple[str, ...]


def prepared_members(scenario: Scenario) -> PreparedMembers:
    """Return all members of a scenario: the bridge's first, then members from files, each cut by all before it.

    Steelwork comes last, and nothing is cut off it.
    """
    terrain = terrain_of(scenario)
    of_bridge = _bridge_on(terrain, scenario) if scenario.bridge else ()
    of_steel = steelwork_members(scenario.steelwork)
    if not scenario.geometry:
        return PreparedMembers((*of_bridge, *of_steel), ())
    from_files, repairs = geometry_members(scenario.geometry, is_flat=terrain is None)
    prepared = without_overlap([*of_bridge, *from_files])
    if of_steel:
        _check_names([*prepared.members, *of_steel])
        prepared = replace(prepared, members=(*prepared.members, *of_steel))
    for position in (position for action in scenario.actions for position in action.starts_above()):
        surface_height(scenario, prepared.members, position)  # refuses what nothing lies under
    return PreparedMembers(prepared.members, repairs + prepared.notes)


def _check_names(members: Sequence[Member]) -> None:
    names = [member.name for member in members]
    for name in names:
        if names.count(name) > 1:
            raise ScenarioError(f'two members are called "{name}": expected a name of its own for each')
    for member in members:
        of_kind = next((other.name for other in members if other.kind == member.name != member.kind), None)
        if of_kind is not None:
            raise ScenarioError(
                f'the member "{member.name}" has the name of a kind, that of {of_kind}: expected another name, or that '
                "kind, as keys that name one would mean both"
            )


def _bridge_on(terrain: Terrain | None, scenario: Scenario) -> tuple[Member, ...]:
    bridge = given(scenario.weighed_bridge)
    if terrain is None:
        members = bridge_members(bridge)
        _check_above_ground(members)
        return members
    on_plan = bridge_members(bridge, lambda _name, _x_m, _y_m: -FARTHEST_M)
    check_under(terrain, [(bridge_member.name, bridge_member.solid) for bridge_member in on_plan])

    def height(name: str, x_m: float, y_m: float) -> float:
        height_m = float(terrain.heights_at(np.array([[x_m, y_m]]))[0])
        if not np.isfinite(height_m):
            where = terrain.place_text(np.array([x_m, y_m]))
            raise GeometryError(
                f"{terrain.name}: the terrain has no data under {name}, at {where}; give it heights there, or move the "
                "bridge by ground.origin; ground.scale is metres in a unit of the file."
            )
        return height_m

    return bridge_members(bridge, height)


def _check_above_ground(members: Sequence[Member]) -> None:
    """Check that no deck and girder on a line of its own is below level ground."""
    for member in members:
        lowest = member.solid.vertices[member.solid.vertices[:, 2].argmin()]
        if member.line and lowest[2] < SHORTEST_LENGTH_M:
            raise GeometryError(
                f"The underside of {member.name} is at {lowest[2]:.2f} m, below the ground at 0, around "
                f"x = {lowest[0]:.2f} m; make the bridge higher, bridge.alignment flatter, or the ground lower by "
                "ground.profile_m."
            )


def without_overlap(members: Sequence[Member]) -> PreparedMembers:
    """Cut off each member what it has in common with those before it."""
    _check_names(members)
    names = [member.name for member in members]
    solids, removed = separated([member.solid for member in members], names)
    notes = [
        f"{name}: {volume:.4g} m³ cut off, as members before it take that room"
        for name, volume in zip(names, removed, strict=True)
        if volume > 0.0
    ]
    apart = (
        member if solid is member.solid else replace(member, solid=solid, parts=())
        for member, solid in zip(members, solids, strict=True)
    )
    return PreparedMembers(tuple(apart), tuple(notes))
