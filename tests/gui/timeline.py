# SPDX-License-Identifier: GPL-3.0-or-later
"""The timeline below the 3D view, and the mouse on it."""

import bpy
from person import Person, Steps, region_of


def timeline(person: Person) -> bpy.types.Area:
    """The area of the timeline."""
    return next(area for area in person.window.screen.areas if area.type == "DOPESHEET_EDITOR")


def drag_to_frame(person: Person, first: int, last: int) -> Steps:
    """Press the mouse on a frame of the timeline's ruler, and let it go on another."""
    region = region_of(timeline(person), "WINDOW")
    start, end = (region.x + round(region.view2d.view_to_region(frame, 0, clip=False)[0]) for frame in (first, last))
    y = region.y + region.height - 10
    yield from person.drag((start, y), (end, y))
    yield 0.5
