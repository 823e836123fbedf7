# SPDX-License-Identifier: GPL-3.0-or-later
"""Render stills and animations by keys: before anything is played, after that, and while a recording runs.

Blender alone crashes where a render simulates what has not been played.
"""

import bpy
from habits import build, go_to_start, play_or_pause, play_until, register
from panels import Panels
from person import Person, Steps
from traces import recording_runs

LAST_FRAME = 20


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from build(person)
    yield from panels.show_only("Record by Hand")
    person.take_reports()
    set_up(person)
    world = person.scene.rigidbody_world
    person.expect("a render locks the window", person.scene.render.use_lock_interface)

    yield from render(person, "F12")
    yield from render(person, "F12", ctrl=True)
    person.expect("pictures of all frames are rendered", len(pictures(person)), LAST_FRAME)
    person.expect("the world goes on after a render", world.enabled)
    yield from play(person)

    yield from render(person, "F12")
    person.scene.bda.overwrite = True  # Blender forgets what it played with any change to a setting of the scene
    yield from render(person, "F12")
    yield from render(person, "F12", ctrl=True)
    person.expect("the world goes on after a render of what was forgotten", world.enabled)
    yield from play(person)

    yield from register(person, person.folder / "recorded")
    yield from play_until(person, 10)
    yield from play_or_pause(person)
    yield from render(person, "F12")
    yield from play(person)
    yield from person.click("bda.unregister_handler")
    yield 1.0
    person.expect_reports("a still does not end the recording", "Recording to", "Results are in")
    person.expect("what was recorded is kept", (person.folder / "recorded" / "summary.json").exists())

    yield from register(person, person.folder / "rendered")
    yield from render(person, "F12", ctrl=True)
    yield from play(person)
    yield from person.click("bda.unregister_handler")
    yield 1.0
    yield from person.picture("rendered_while_recording")
    person.expect_reports("a render of what was not played is not recorded", "Recording to", "a render went beyond")
    person.expect("no recording runs", recording_runs(), False)


def set_up(person: Person) -> None:
    """Small pictures of few frames, in no window of their own."""
    scene = person.scene
    bpy.context.preferences.view.render_display_type = "NONE"
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
    scene.render.resolution_x, scene.render.resolution_y = 64, 48
    scene.render.filepath = str(person.folder / "rendered_")
    scene.frame_end = LAST_FRAME
    scene.camera = scene.camera or bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    if scene.camera.name not in scene.objects:
        scene.collection.objects.link(scene.camera)


def render(person: Person, key: str, **modifiers: bool) -> Steps:
    """Press the key, and wait until the picture is, or the pictures are, rendered."""
    yield from person.move_to_view()
    yield from person.press(key, **modifiers)
    yield 0.5
    yield from person.wait_for("the render ends", lambda: not bpy.app.is_job_running("RENDER"), 60.0)
    yield 0.2


def play(person: Person) -> Steps:
    """From the start to the end, in which the ball falls."""
    yield from go_to_start(person)
    yield from play_until(person, LAST_FRAME - 1)
    yield from play_or_pause(person)


def pictures(person: Person) -> list:
    return list(person.folder.glob("rendered_*.png"))
