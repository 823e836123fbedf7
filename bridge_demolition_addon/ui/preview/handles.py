"""Points that can be dragged in the 3D view: the targets of the ball, charges, and blast zones with their ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import bpy

from ...errors import GeometryError
from ...model.bridge import deck_top
from ...scene.blast.charges import charge_objects
from ...scene.time_scale import simulated_time_s
from ...scene.world import FIRST_STEP_FRAME
from .decorator import sizes_shown
from .zone_handles import drag_zone, ends_of, zones_shown

_DECIMALS = 2
"""Of a metre: the mouse is no finer, and the panels show all digits."""

_LEAST_DROP_M = 0.01

_UP = (0.0, 0.0, 1.0)
_ENDS = {0: "", -1: ", begin", 1: ", end"}


class HandleKind(StrEnum):
    """The point that is dragged: target or drop of the ball, charge, or blast zone or one of its ends."""

    TARGET = "TARGET"
    DROP = "DROP"
    CHARGE = "CHARGE"
    ZONE = "ZONE"
    ZONE_BEGIN = "ZONE_BEGIN"
    ZONE_END = "ZONE_END"


_OF_ZONE = {HandleKind.ZONE: 0, HandleKind.ZONE_BEGIN: -1, HandleKind.ZONE_END: 1}
"""Which way an end of a zone lies from its middle."""


@dataclass(frozen=True, slots=True)
class Handle:
    """A point that can be dragged, up and down or level: of the drop of the ball, charge or zone with an index.

    A zone and its ends go along an axis, 0 to 2. `points_to` is the direction of its arrow; None for a ring.
    """

    kind: HandleKind
    index: int
    is_upright: bool
    name: str
    position_m: tuple[float, float, float]
    axis: int | None = None
    points_to: tuple[float, float, float] | None = None


def handles(scene: bpy.types.Scene) -> list[Handle]:
    """Return all points of a scene that can be dragged; those of the ball only over a bridge of the panels.

    A size in the panels that cannot be used raises ScenarioError, which names the key.
    """
    return [*_of_ball(scene), *_of_charges(scene), *_of_zones(scene)]


def dragged_values(scene: bpy.types.Scene, kind: HandleKind, index: int) -> list[tuple[Any, str, Any]]:
    """Return owners, names and values of the properties that dragging sets, so that they can be put back."""
    if kind == HandleKind.CHARGE:
        charge = charge_objects(scene)[index]
        return [(charge, "location", tuple(charge.location))]
    if kind in _OF_ZONE:
        zone = scene.bda.scenario.blast_zones[index]
        return [(zone, name, getattr(zone, name)) for name in ("middle_m", "height_m")]
    drop = _drops(scene)[index]
    return [(drop, "target_m", tuple(drop.target_m)), (drop, "drop_height_m", drop.drop_height_m)]


def drag(scene: bpy.types.Scene, kind: HandleKind, index: int, position_m: Sequence[float]) -> None:
    """Move a charge, a zone or its end, or set the target of a drop, or its height over the deck, m."""
    if kind in _OF_ZONE:
        axis = next(handle.axis for handle in _of_zones(scene) if (handle.kind, handle.index) == (kind, index))
        drag_zone(scene.bda, index, _OF_ZONE[kind], position_m[axis or 0])
        return
    x, y, z = (round(coordinate, _DECIMALS) for coordinate in position_m)
    if kind == HandleKind.CHARGE:
        charge_objects(scene)[index].location = (x, y, z)
        return
    drop = _drops(scene)[index]
    if kind == HandleKind.TARGET:
        drop.target_m = (x, y)
    else:
        height_m = position_m[2] - deck_top(sizes_shown(scene.bda)[0])
        drop.drop_height_m = max(round(height_m, _DECIMALS), _LEAST_DROP_M)


def _drops(scene: bpy.types.Scene) -> tuple[bpy.types.PropertyGroup, ...]:
    ball = scene.bda.scenario.ball
    return ball, *ball.hits


def _of_ball(scene: bpy.types.Scene) -> Iterator[Handle]:
    bridge, ball, own = sizes_shown(scene.bda)
    if not (bridge and ball) or own:
        return
    top = deck_top(bridge)
    for index, drop in enumerate(ball.drops):
        number = f" of hit {index + 1}" if ball.hits else ""
        x, y = drop.target_m
        yield Handle(HandleKind.TARGET, index, False, f"Target{number}", (x, y, top))
        yield Handle(
            HandleKind.DROP, index, True, f"Drop height{number}", (x, y, top + drop.drop_height_m), points_to=_UP
        )


def _of_charges(scene: bpy.types.Scene) -> Iterator[Handle]:
    """Give those of charges that have no parent and no constraint, which would move them back."""
    for index, charge in enumerate(charge_objects(scene)):
        if not charge.parent and not len(charge.constraints) and not charge.library:
            for is_upright in (False, True):
                arrow = _UP if is_upright else None
                position = tuple(charge.location)
                yield Handle(HandleKind.CHARGE, index, is_upright, charge.name, position, points_to=arrow)


def _of_zones(scene: bpy.types.Scene) -> Iterator[Handle]:
    """Give those of zones of the panels that lie in their members, until time begins: then these move away."""
    if scene.rigidbody_world and simulated_time_s(scene, FIRST_STEP_FRAME) > 0.0:
        return
    try:
        zones = zones_shown(scene.bda)
    except GeometryError:  # building says what is wrong
        return
    kinds = {direction: kind for kind, direction in _OF_ZONE.items()}
    for index, placed in enumerate(zones):
        for position, axis, direction in ends_of(placed) if placed else ():
            x, y, z = (float(direction * (axis == number)) for number in range(3))
            name = f"{placed.zone.name}{_ENDS[direction]}"
            arrow = (x, y, z) if direction else None
            yield Handle(kinds[direction], index, False, name, position, axis, arrow)
