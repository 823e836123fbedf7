# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's file browser, which opens in a window of its own."""

from pathlib import Path

import bpy
from person import Person, Place, Steps, region_of


def choose_file(person: Person, path: Path) -> Steps:
    """Give a folder and a name in the file browser that opens, and accept them."""
    manager = bpy.context.window_manager
    yield from person.wait_for("a file browser opens", lambda: len(manager.windows) > 1, 10.0)
    yield 1.0
    window = manager.windows[-1]
    area = next(each for each in window.screen.areas if each.type == "FILE_BROWSER")
    folder, name = (Place(window, area, region_of(area, kind)) for kind in ("UI", "EXECUTE"))
    person.take_to(window)
    yield from person.fill_in("directory", f"{path.parent}/", folder)
    yield 0.5
    try:
        yield from person.fill_in("filename", path.name, name)
    except LookupError:  # Blender 5 has the name edited at once, and shows no other button until that is done
        yield from person.replace_text(path.name)
        yield from person.press("RET")
    yield from person.picture(f"choosing_{path.stem}")
    yield from person.click("file.execute", name)
    yield from person.wait_for("the file browser closes", lambda: len(manager.windows) == 1, 10.0)
    person.take_to(None)
    yield 0.5
