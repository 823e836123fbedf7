"""Points that can be dragged in the 3D view: the targets of the ball, and charges."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import bpy

from ...model.bridge import deck_top
from ...scene.blast.charges import charge_objects
from .decorator import sizes_shown

_DECIMALS = 2
"""Of a metre: the mouse is no finer, and the panels show all digits."""

_LEAST_DROP_M = 0.01


class HandleKind(StrEnum):
    """The point that is dragged: target or drop of the ball, or charge."""

    TARGET = "TARGET"
    DROP = "DROP"
    CHARGE = "CHARGE"


@dataclass(frozen=True, slots=True)
class Handle:
    """A point that can be dragged, up and down or level: of the drop of the ball, or the charge, with an index."""

    kind: HandleKind
    index: int
    is_upright: bool
    name: str
    position_m: tuple[float, float, float]


def handles(scene: bpy.types.Scene) -> list[Handle]:
    """Return all points of a scene that can be dragged; those of the ball only over a bridge of the panels.

    A size in the panels that cannot be used raises ScenarioError, which names the key.
    """
    return [*_of_ball(scene), *_of_charges(scene)]


def drag(scene: bpy.types.Scene, kind: HandleKind, index: int, position_m: Sequence[float]) -> None:
    """Move a charge, or set the target of a drop, or its height over the deck, m."""
    x, y, z = (round(coordinate, _DECIMALS) for coordinate in position_m)
    if kind == HandleKind.CHARGE:
        charge_objects(scene)[index].location = (x, y, z)
        return
    ball = scene.bda.scenario.ball
    drop = (ball, *ball.hits)[index]
    if kind == HandleKind.TARGET:
        drop.target_m = (x, y)
    else:
        height_m = position_m[2] - deck_top(sizes_shown(scene.bda)[0])
        drop.drop_height_m = max(round(height_m, _DECIMALS), _LEAST_DROP_M)


def _of_ball(scene: bpy.types.Scene) -> Iterator[Handle]:
    bridge, ball, is_all = sizes_shown(scene.bda)
    if not (bridge and ball and is_all):
        return
    top = deck_top(bridge)
    for index, drop in enumerate(ball.drops):
        number = f" of hit {index + 1}" if ball.hits else ""
        x, y = drop.target_m
        yield Handle(HandleKind.TARGET, index, False, f"Target{number}", (x, y, top))
        yield Handle(HandleKind.DROP, index, True, f"Drop height{number}", (x, y, top + drop.drop_height_m))


def _of_charges(scene: bpy.types.Scene) -> Iterator[Handle]:
    """Give those of charges that have no parent and no constraint, which would move them back."""
    for index, charge in enumerate(charge_objects(scene)):
        if not charge.parent and not len(charge.constraints) and not charge.library:
            for is_upright in (False, True):
                yield Handle(HandleKind.CHARGE, index, is_upright, charge.name, tuple(charge.location))
