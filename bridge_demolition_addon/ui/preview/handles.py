"""Places that can be dragged in the 3D view: the targets of the ball, and charges."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import bpy

from ...model.bridge import deck_top
from ...scene.blast.charges import charge_objects
from .decorator import sizes_shown

_DECIMALS = 2
"""Of a metre: nobody drags to the millimetre, and the panels show what was dragged to in full."""


_LEAST_DROP_M = 0.01


class HandleKind(StrEnum):
    """What is dragged."""

    TARGET = "TARGET"
    DROP = "DROP"
    CHARGE = "CHARGE"


@dataclass(frozen=True, slots=True)
class Handle:
    """A place that can be dragged.

    Attributes
    ----------
    kind, index
        Which one: target or height of a drop of the ball, or a charge, each in their order.
    is_upright
        Whether it goes up and down, or level.
    name
        What it is, in words.
    place_m
        Where it is, m.
    """

    kind: HandleKind
    index: int
    is_upright: bool
    name: str
    place_m: tuple[float, float, float]


def handles(scene: bpy.types.Scene) -> list[Handle]:
    """Return all places of a scene that can be dragged; without those of the ball where its drop cannot be told.

    Raises
    ------
    ScenarioError
        A size in the panels cannot be used; the text names the key.
    """
    return [*_of_ball(scene), *_of_charges(scene)]


def drag(scene: bpy.types.Scene, kind: HandleKind, index: int, place_m: Sequence[float]) -> None:
    """Set what the panels show of a place, where they have it: of a drop its target, or its height over the deck."""
    x, y, z = (round(each, _DECIMALS) for each in place_m)
    if kind == HandleKind.CHARGE:
        charge_objects(scene)[index].location = (x, y, z)
        return
    ball = scene.bda.scenario.ball
    drop = (ball, *ball.hits)[index]
    if kind == HandleKind.TARGET:
        drop.target_m = (x, y)
    else:
        height_m = place_m[2] - deck_top(sizes_shown(scene.bda)[0])
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
    """Give those of charges that hang on nothing: others are where what they hang on leads them."""
    for index, each in enumerate(charge_objects(scene)):
        if not each.parent and not len(each.constraints) and not each.library:
            for is_upright in (False, True):
                yield Handle(HandleKind.CHARGE, index, is_upright, each.name, tuple(each.location))
