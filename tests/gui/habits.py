# SPDX-License-Identifier: GPL-3.0-or-later
"""What a person does in every job."""

from pathlib import Path

import bpy
from person import Person, Steps
from traces import SCENARIO, recording_runs


def delete_all(person: Person) -> Steps:
    """Press A and Delete over the 3D view, for Blender starts with things that are of no use here."""
    yield from person.move_to_view()
    yield from person.press("A", "a")
    yield from person.press("DEL")
    yield 0.5


def load(person: Person, scenario: Path = SCENARIO) -> Steps:
    """Choose a scenario and load it."""
    yield from person.fill_in("scenario_path", str(scenario))
    yield from person.click("bda.load_scenario")


def build(person: Person, scenario: Path = SCENARIO) -> Steps:
    """Choose a scenario and build it, without loading it first."""
    yield from person.fill_in("scenario_path", str(scenario))
    yield from person.click("bda.build_scenario")
    yield 1.0


def save_file(person: Person) -> None:
    """Save what is open, so that paths beside it are short in pictures."""
    bpy.ops.wm.save_as_mainfile(filepath=str(person.folder / "bridge.blend"))


def register(person: Person, results: Path | str) -> Steps:
    """Choose a folder and register the handler."""
    yield from person.fill_in("output_directory", str(results))
    yield from person.click("bda.register_handler")
    yield from person.wait_for("the handler is registered", recording_runs, 5.0)


def go_to_start(person: Person) -> Steps:
    """Go to the first frame by its shortcut."""
    yield from person.move_to_view()
    yield from person.press("LEFT_ARROW", shift=True)


def play_or_pause(person: Person) -> Steps:
    """Press the space bar over the 3D view."""
    yield from person.move_to_view()
    yield from person.press("SPACE", " ")


def play_until(person: Person, frame: int) -> Steps:
    """Play until a frame is reached, and leave it playing."""
    yield from play_or_pause(person)
    yield from person.wait_for(f"the timeline plays up to frame {frame}", lambda: person.scene.frame_current >= frame)


def undo(person: Person) -> Steps:
    """Press Ctrl-Z over the 3D view."""
    yield from person.move_to_view()
    yield from person.press("Z", ctrl=True)
    yield 0.5


def undo_and_redo(person: Person, bodies: int) -> Steps:
    """Press Ctrl-Z and Ctrl-Shift-Z after a run: contours and so many bodies are there."""
    yield from undo(person)
    yield 0.5
    yield from person.picture("undone")
    person.expect("contours are still shown after Ctrl-Z", person.scene.bda.contours)
    yield from person.press("Z", ctrl=True, shift=True)
    yield 1.0
    person.expect("and after Ctrl-Shift-Z", person.scene.bda.contours)
    person.expect("the bridge is there", len(person.scene.rigidbody_world.collection.objects), bodies)
    person.expect_reports("nothing is reported of it")


def render_still(person: Person, path: Path) -> Steps:
    """Press F12 with the renderer that is chosen, and keep a small picture of what comes of it."""
    scene = person.scene
    bpy.context.preferences.view.render_display_type = "NONE"
    scene.render.resolution_x, scene.render.resolution_y, scene.eevee.taa_render_samples = 320, 180, 4
    yield from person.move_to_view()
    yield from person.press("F12")
    yield 1.0
    yield from person.wait_for("the render ends", lambda: not bpy.app.is_job_running("RENDER"), 600.0)
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
