"""All members of a scenario, of the bridge and of the user's own files, ready to be cut into shards."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.geometry.overlap import separated
from ...errors import GeometryError, ScenarioError
from ..scenario import Scenario
from ..schema import given
from ..terrain.built import check_under
from ..terrain.placed import Terrain, terrain_of
from . import bridge_members
from .extent import surface_height
from .member import Member
from .mesh_files import geometry_members
from .steelwork import steelwork_members


@dataclass(frozen=True, slots=True)
class PreparedMembers:
    """Members without overlap, and sentences on what was repaired and cut off to get there."""

    members: tuple[Member, ...]
    notes: tuple[str, ...]


def prepared_members(scenario: Scenario) -> PreparedMembers:
    """Return all members of a scenario: those of the bridge first, then those from files, cut by all before them.

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
        return bridge_members(bridge)
    check_under(terrain, [(bridge_member.name, bridge_member.solid) for bridge_member in bridge_members(bridge)])

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
