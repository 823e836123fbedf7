# SPDX-License-Identifier: GPL-3.0-or-later
"""A model of one's own: its meshes become members, are seen as outlines in their place, and are built."""

from pathlib import Path

import bpy
import numpy as np
from habits import delete_all
from panels import Panels
from person import Person, Steps
from traces import module, pixels_of

PARTS = {
    "deck": ((10.0, 4.0, 0.5), (5.0, 0.0, 4.25)),
    "west wall": ((0.5, 4.0, 4.0), (0.5, 0.0, 2.0)),
    "east wall": ((0.5, 4.0, 4.0), (9.5, 0.0, 2.0)),
}
"""Sizes and middles of boxes, m."""
SIZE_M = (10.0, 4.0, 4.5)
LEAST_CHANGED = 0.002
"""Share of the window that outlines change at least."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    model(person)
    person.scene.bda.scenario.use_ball = False
    yield from panels.show_only("Own Model")
    yield from person.picture("modelled")
    yield from person.click("bda.add_selected_members")
    yield 0.5
    person.expect("nothing asks for a folder", len(bpy.context.window_manager.windows), 1)
    tables = person.scene.bda.scenario.geometry
    person.expect("all meshes of what was selected are members", {table.name for table in tables}, set(PARTS))
    person.expect(
        "their files are in a folder of their own", {Path(table.file).parent.name for table in tables}, {"members_1"}
    )
    lines = module("ui.preview.decorator").preview_lines(person.scene.bda)
    person.expect("outlines stand for the meshes", np.ptp(lines, axis=0).round(3).tolist(), list(SIZE_M))
    person.scene.bda.show_preview = True
    yield from person.picture("outlines")
    person.scene.bda.show_preview = False
    yield from person.picture("without_outlines")
    changed = np.abs(screen(person, "outlines") - screen(person, "without_outlines")).max(axis=1) > 0.05
    person.note(
        f"they change {changed.mean():.2%} of the window", "" if changed.mean() > LEAST_CHANGED else "too little"
    )
    person.scene.bda.show_preview = True
    person.take_reports()
    yield from panels.show_only("Scenario")
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None, 60.0)
    yield 1.0
    yield from person.picture("built")
    person.expect("outlines have gone", len(module("ui.preview.decorator").preview_lines(person.scene.bda)), 0)
    person.take_reports()


def model(person: Person) -> None:
    """Three boxes and a light, selected."""
    with bpy.context.temp_override(window=person.window, area=person.view):
        for name, (size_m, middle_m) in PARTS.items():
            bpy.ops.mesh.primitive_cube_add(size=1.0, location=middle_m, scale=size_m)
            bpy.context.active_object.name = name
        bpy.ops.object.light_add()
        bpy.ops.object.select_all(action="SELECT")


def screen(person: Person, name: str) -> np.ndarray:
    """The pixels (n, 3) of a screenshot."""
    return pixels_of(next(person.folder.glob(f"??_{name}.png")))
