"""Blast zones of the panels as they lie in their members, and the dragging of them and of their ends."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import bpy

from ...errors import GeometryError, ScenarioError
from ...model.blast.blast_zones import BlastZone
from ...model.bridge.member import Member
from ...model.bridge.preparation import prepared_members
from ...model.scenario import Scenario
from ...model.schema import named
from ...model.structure.blast_zones import PlacedZone, placed_zone
from ..scenario.prop import INDEX, shown_tables
from ..scenario.values import inner_of, scenario_of

_FIELDS = {item.name: item for item in shown_tables(Scenario)}
_OF_MEMBERS = tuple(name for name in ("bridge", "geometry", "ground") if name in _FIELDS)

_STEP_M = 0.01
"""Ends of zones are dragged to whole centimetres."""

_kept: dict[str, Any] = {}
"""Members and zones that were worked out last, and what they follow from."""


def forget() -> None:
    """Forget these members."""
    _kept.clear()


def zones_shown(settings: bpy.types.PropertyGroup) -> list[PlacedZone | None]:
    """Return the blast zones of the panels in their members; None for each that does not lie in one with its holes.

    Panels that cannot be used raise ScenarioError or GeometryError.
    """
    group = settings.scenario
    if not len(group.blast_zones):
        return []
    zones = named(inner_of(group, _FIELDS[BlastZone.table]))
    members = _members(settings)
    if _kept.get("zones") != zones or _kept.get("placed_in") is not members:
        _kept["placed"] = [_placed(zone, members) for zone in zones]
        _kept["zones"], _kept["placed_in"] = zones, members
    return _kept["placed"]


def ends_of(placed: PlacedZone) -> Iterator[tuple[tuple[float, float, float], int, int]]:
    """Yield positions, m, axes, and directions along these, of a zone's middle (0), its begin (-1) and its end (1)."""
    axis = placed.zone.axes[0]
    for direction, along_m in zip((0, -1, 1), (placed.zone.middle_m, *placed.zone.ends_along_m), strict=True):
        position = placed.box_m.mean(axis=0)
        position[axis] = along_m
        x, y, z = position.tolist()
        yield (x, y, z), axis, direction


def drag_zone(settings: bpy.types.PropertyGroup, index: int, direction: int, along_m: float) -> None:
    """Move a zone along its member (0), or its begin (-1) or end (1), within its member and clear of other zones."""
    zones = zones_shown(settings)
    placed = zones[index] if index < len(zones) else None
    if placed is None:
        raise ScenarioError(f"there is no blast zone {index + 1} in a member here to be dragged")
    lowest_m, highest_m = _room(placed, [zone for zone in zones if zone is not None and zone is not placed])
    begin_m, end_m = placed.zone.ends_along_m
    least_m = _up(_least_height_m(placed.zone))
    if direction == 0:
        height_m = placed.zone.height_m
        begin_m = min(max(_nearest(along_m - height_m / 2.0), lowest_m), highest_m - height_m)
        end_m = begin_m + height_m
    elif direction < 0:
        begin_m = max(min(_nearest(along_m), end_m - least_m), lowest_m)
    else:
        end_m = min(max(_nearest(along_m), begin_m + least_m), highest_m)
    shown = settings.scenario.blast_zones[index]
    shown.middle_m, shown.height_m = round((begin_m + end_m) / 2.0, 6), round(end_m - begin_m, 6)
    setattr(settings.scenario, BlastZone.table + INDEX, index)


def _members(settings: bpy.types.PropertyGroup) -> tuple[Member, ...]:
    key = [inner_of(settings.scenario, _FIELDS[name]) for name in _OF_MEMBERS]
    if _kept.get("key") != key:
        _kept["members"] = prepared_members(scenario_of(settings)).members
        _kept["key"] = key
    return _kept["members"]


def _placed(zone: BlastZone, members: tuple[Member, ...]) -> PlacedZone | None:
    try:
        return placed_zone(zone, members)
    except (GeometryError, ScenarioError):  # building it says what is wrong
        return None


def _room(placed: PlacedZone, others: list[PlacedZone]) -> tuple[float, float]:
    """Return from where to where a zone may lie along its member, to whole centimetres inwards."""
    axis = placed.zone.axes[0]
    lowest_m, highest_m = placed.member.solid.bounds[:, axis].tolist()
    for other in others:
        if other.member.name != placed.member.name:
            continue
        begin_m, end_m = other.zone.ends_along_m
        if other.zone.middle_m < placed.zone.middle_m:
            lowest_m = max(lowest_m, end_m)
        else:
            highest_m = min(highest_m, begin_m)
    return _up(lowest_m), -_up(-highest_m)


def _least_height_m(zone: BlastZone) -> float:
    """Return the length of its rows."""
    return max((zone.holes_a_row - 1 + (0.5 if zone.rows > 1 else 0.0)) * zone.spacing_m, _STEP_M)


def _nearest(along_m: float) -> float:
    return round(along_m / _STEP_M) * _STEP_M


def _up(along_m: float) -> float:
    """Return the next whole centimetre; rounding of the last digits does not count."""
    return math.ceil(along_m / _STEP_M - 1e-6) * _STEP_M
