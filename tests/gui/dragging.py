# SPDX-License-Identifier: GPL-3.0-or-later
"""Dragging handles in the 3D view, and where they are on the screen."""

from collections.abc import Callable, Iterable
from typing import Any

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from person import Person, Steps, region_of
from traces import module

Pixels = tuple[int, int]


def hold(person: Person, start: Pixels, end: Pixels, show: Callable[[], Steps], leave_with: str = "") -> Steps:
    """Drag from one place on the screen to another; a picture shows it while the mouse is still down."""
    yield from person.move(start[0] - 2, start[1])
    yield from person.move(*start)
    yield 0.2
    person.hand.event_simulate(type="LEFTMOUSE", value="PRESS", x=start[0], y=start[1])
    yield 0.1
    for share in np.linspace(0.1, 1.0, 10):
        yield from person.move(*(round(a + share * (b - a)) for a, b in zip(start, end, strict=True)))
    yield from show()
    if leave_with:
        yield from person.press(leave_with)
    person.hand.event_simulate(type="LEFTMOUSE", value="RELEASE", x=end[0], y=end[1])
    yield 0.2


def handle_of(person: Person, kind: str, index: int = 0, is_upright: bool = False) -> Any:
    """The handle of that kind, and what is dragged by it."""
    found = module("ui.preview.handles").handles(person.scene)
    wanted = (kind, index, is_upright)
    return next(handle for handle in found if (handle.kind, handle.index, handle.is_upright) == wanted)


def on_screen(person: Person, position_m: tuple[float, float, float]) -> Pixels:
    """Where something is in the window."""
    region = region_of(person.view, "WINDOW")
    where = location_3d_to_region_2d(region, person.view.spaces.active.region_3d, position_m)
    return round(region.x + where.x), round(region.y + where.y)


def out_of_sight(person: Person, points_m: Iterable[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    """Which of some points are not in the view, or behind the sidebar."""
    region, view = region_of(person.view, "WINDOW"), person.view.spaces.active.region_3d
    right = person.sidebar.x - region.x
    seen = {point: location_3d_to_region_2d(region, view, point) for point in points_m}
    return [
        point for point, at in seen.items() if at is None or not (0.0 < at.x < right and 0.0 < at.y < region.height)
    ]


def look_at(person: Person, position_m: tuple[float, float, float], distance_m: float) -> None:
    """Look at a point from beside it and above."""
    space = person.view.spaces.active.region_3d
    space.view_perspective = "PERSP"
    space.view_rotation = (0.8001, 0.4619, 0.1913, 0.3314)
    space.view_location, space.view_distance = position_m, distance_m
    space.update()
    bpy.context.view_layer.update()
