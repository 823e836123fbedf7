# SPDX-License-Identifier: GPL-3.0-or-later
"""Pull the rug from under a recording: a change, another file, the extension switched off, Blender quit."""

import bpy
from habits import build, go_to_start, play_or_pause, play_until, register
from panels import Panels
from person import Person, Steps
from traces import EXTENSION, handlers, recording_runs, rows


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from build(person)
    yield from panels.show_only("Record by Hand")
    yield from restart_while_recording(person)
    yield from load_while_recording(person)
    yield from switch_off_while_playing(person)
    yield from quit_while_recording(person)


def restart_while_recording(person: Person) -> Steps:
    """Go back to the start in the middle, make something heavier, and play again."""
    folder = person.folder / "restarted"
    yield from go_to_start(person)
    yield from register(person, folder)
    yield from play_until(person, 15)
    yield from play_or_pause(person)
    yield from go_to_start(person)
    ball = next(obj for obj in person.scene.rigidbody_world.collection.objects if obj.rigid_body.mass == 5000)
    ball.rigid_body.mass = 6000
    yield from play_until(person, 8)
    yield from play_or_pause(person)
    yield 0.2
    last = person.scene.frame_current
    frames = sorted({int(row["frame"]) for row in rows(folder / "force_log.csv")})
    person.expect("a changed simulation is recorded again", frames, list(range(2, last + 1)))
    yield from person.click("bda.unregister_handler")
    yield 2.0
    person.expect_reports("nothing but the recording is reported", "30 shards", "Recording to", "Results are in")


def load_while_recording(person: Person) -> Steps:
    file = person.folder / "before_loading.blend"
    yield from go_to_start(person)
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    yield from register(person, person.folder / "loaded")
    yield from play_until(person, 12)
    person.expect_reports("nothing but the registering is reported", "Recording to")
    with bpy.context.temp_override(window=person.window):
        bpy.ops.wm.open_mainfile(filepath=str(file))
    yield 1.0
    yield from person.open_sidebar()
    yield from person.picture("file_loaded_while_recording")
    yield from play_until(person, 10)
    if person.playing:
        yield from play_or_pause(person)
    person.expect("the log of the recording is whole", len(rows(person.folder / "loaded" / "force_log.csv")) % 32, 0)
    if not person.refusal("bda.unregister_handler"):
        yield from person.click("bda.unregister_handler")
        yield 2.0
        yield from person.picture("file_loaded_and_unregistered")
        person.expect_reports(
            "loading ends the recording with a warning", "loading a file", "still move at the end", "Results are in"
        )
    person.expect("no recording runs after loading", recording_runs(), False)


def switch_off_while_playing(person: Person) -> Steps:
    yield from go_to_start(person)
    yield from register(person, person.folder / "switched_off")
    yield from play_until(person, 12)
    bpy.ops.preferences.addon_disable(module=EXTENSION)
    yield 1.0
    yield from person.picture("switched_off_while_playing")
    person.expect("it plays on without the extension", person.playing)
    person.expect("no handler is left after switching off", dict(handlers()), {})
    person.expect("its log is whole", len(rows(person.folder / "switched_off" / "force_log.csv")) % 32, 0)
    person.expect_reports("nothing but the registering is reported before", "Recording to")
    yield from play_or_pause(person)
    bpy.ops.preferences.addon_enable(module=EXTENSION)
    yield 1.0


def quit_while_recording(person: Person) -> Steps:
    yield from person.open_sidebar()
    yield from go_to_start(person)
    yield from register(person, person.folder / "quit")
    yield from play_until(person, 12)
    yield from person.picture("about_to_quit")
    person.expect_reports("nothing but the registering is reported at last", "Recording to")
