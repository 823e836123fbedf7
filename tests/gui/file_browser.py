# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's file browser, which opens in a window of its own."""

from pathlib import Path

import bpy
from person import Person, Place, Steps, region_of

NAME, ACCEPT = 0.3, 0.9
"""Where they are across the lowest line of the window."""


def choose_file(person: Person, path: Path) -> Steps:
    """Give a folder and a name in the file browser that opens, and accept them."""
    manager = bpy.context.window_manager
    yield from person.wait_for("a file browser opens", lambda: len(manager.windows) > 1, 10.0)
    yield 1.0
    window = manager.windows[-1]
    area = next(shown for shown in window.screen.areas if shown.type == "FILE_BROWSER")
    folder, foot = (Place(window, area, region_of(area, kind)) for kind in ("UI", "EXECUTE"))
    person.take_to(window)
    yield from person.fill_in("directory", f"{path.parent}/", folder)
    yield 0.5
    yield from click_foot(person, foot, NAME)
    yield from person.replace_text(path.name)
    yield from person.picture(f"choosing_{path.stem}")
    yield from click_foot(person, foot, ACCEPT)
    yield from person.wait_for("the file browser closes", lambda: len(manager.windows) == 1, 10.0)
    person.take_to(None)
    yield 0.5


def click_foot(person: Person, foot: Place, share: float) -> Steps:
    """Click in the lowest line, and again if the window is still there: the first click may end what is being typed."""
    region = foot.region
    x, y = region.x + int(share * region.width), region.y + region.height // 2
    for _ in range(2):
        yield from person.move(x, y)
        yield from person.move(x + 1, y)
        yield from person.press("LEFTMOUSE")
        yield 0.5
        if len(bpy.context.window_manager.windows) == 1:
            return
