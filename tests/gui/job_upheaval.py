# SPDX-License-Identifier: GPL-3.0-or-later
"""One thing after which Blender alone crashes, or may crash, when it plays on.

To be repeated: what crashes does not crash every time. The scene is built and the handler registered by calls, as the
buttons have jobs of their own; playing, editing, undoing and deleting are done by keys.
"""

from pathlib import Path

import bpy
from habits import go_to_start, play_or_pause, play_until
from person import Person, Steps
from traces import EXTENSION, SCENARIO, handlers
from upheavals import ALONE, RECORDED

FRAME = 21
"""When it happens: the ball is falling, and nothing is in Blender's cache from here on."""

TIMES = 5
"""In one Blender, one after the other."""


def steps(person: Person, upheaval: str, company: str) -> Steps:
    yield 0.5
    for number in range(TIMES):
        preferences = preferences_of_undo()
        prepare(person, company, number)
        yield 0.3
        yield from play_until(person, FRAME)
        yield from globals()[upheaval](person)
        yield from play_on(person)
        person.expect("preferences are as before", preferences_of_undo(), preferences)
        person.expect("no handler is registered twice", max(handlers().values(), default=1), 1)
        if upheaval not in ("new_file", "open_file"):
            yield from play_again(person)
        person.note(f"survived {number + 1}")


def prepare(person: Person, company: str, number: int) -> None:
    """Build a demolition where there is none, go to the start, and have the extension do what it is to do."""
    with bpy.context.temp_override(window=person.window):
        if not person.scene.rigidbody_world:
            bpy.ops.preferences.addon_enable(module=EXTENSION)
            person.scene.bda.scenario_path = str(SCENARIO)
            bpy.ops.bda.build_scenario()
            bpy.ops.bda.toggle_symbols()  # what is hidden cannot be chosen
            bpy.ops.ed.undo_push(message="built")
            bpy.ops.wm.save_as_mainfile(filepath=str(person.folder / "built.blend"))
        person.scene.frame_set(1)
        for link in list(person.scene.rigidbody_world.constraints.objects):
            if None in (link.rigid_body_constraint.object1, link.rigid_body_constraint.object2):
                bpy.data.objects.remove(link)  # left over by a deleted shard, and not simulated
        if company == RECORDED:
            if bpy.ops.bda.unregister_handler.poll():
                bpy.ops.bda.unregister_handler()
            person.scene.bda.output_directory = str(person.folder / f"results {number}")
            bpy.ops.bda.register_handler()
        if company == ALONE:
            bpy.ops.preferences.addon_disable(module=EXTENSION)


def preferences_of_undo() -> tuple[bool, bool, bool]:
    preferences = bpy.context.preferences
    return preferences.experimental.use_undo_legacy, preferences.view.show_developer_ui, preferences.is_dirty


def play_on(person: Person) -> Steps:
    """Have it played for a second longer, whether it was paused or not."""
    if not person.playing:
        yield from play_or_pause(person)
    yield 0.5
    person.expect("it plays on", person.playing)
    yield from play_or_pause(person)


def play_again(person: Person) -> Steps:
    """From the start it is simulated again."""
    yield from go_to_start(person)
    heights = []
    yield from play_or_pause(person)
    for _ in range(10):
        yield 0.05
        heights.append(ball_height(person))
    yield from play_or_pause(person)
    person.expect("the ball falls again", max(heights) - min(heights) > 0.1)


def ball_height(person: Person) -> float:
    ball = next(obj for obj in person.scene.rigidbody_world.collection.objects if obj.rigid_body.mass == 5000)
    return ball.evaluated_get(person.window.view_layer.depsgraph).matrix_world.translation.z


# What is done


def undo(person: Person) -> Steps:
    """Move two shards, and take one of the moves back."""
    yield from play_or_pause(person)
    for number in (3, 4):
        yield from move_shard(person, number)
    yield from person.press("Z", ctrl=True)
    yield 0.3


def redo(person: Person) -> Steps:
    """Take both moves back, play, and bring them back again."""
    yield from undo(person)
    yield from person.press("Z", ctrl=True)
    yield 0.3
    yield from play_until(person, FRAME)
    yield from play_or_pause(person)
    yield from person.press("Z", ctrl=True, shift=True)
    yield 0.3


def delete_shard(person: Person) -> Steps:
    """Delete a shard while it plays, and leave its connections."""
    select(person, shard(person, 5))
    yield from delete_selected(person)


def delete_shard_and_connections(person: Person) -> Steps:
    """Delete a shard while it plays, with all that holds it."""
    body = shard(person, 5)
    links = [
        obj
        for obj in person.scene.rigidbody_world.constraints.objects
        if body in (obj.rigid_body_constraint.object1, obj.rigid_body_constraint.object2)
    ]
    select(person, body, *links)
    yield from delete_selected(person)


def delete_connection(person: Person) -> Steps:
    """Delete a connection while it plays."""
    select(person, person.scene.rigidbody_world.constraints.objects[7])
    yield from delete_selected(person)


def remove_shard_by_script(person: Person) -> Steps:
    """Remove a shard as scripts do, while it plays."""
    bpy.data.objects.remove(shard(person, 5))
    yield 0.3


def new_file(person: Person) -> Steps:
    """Start a new file while it plays."""
    with bpy.context.temp_override(window=person.window):
        bpy.ops.wm.read_homefile()
    yield 1.0


def open_file(person: Person) -> Steps:
    """Open the same demolition again while it plays."""
    with bpy.context.temp_override(window=person.window):
        bpy.ops.wm.open_mainfile(filepath=str(Path(person.folder) / "built.blend"))
    yield 1.0


def switch_off(person: Person) -> Steps:
    """Switch the extension off while it plays, and on again."""
    if hasattr(person.scene, "bda"):
        bpy.ops.preferences.addon_disable(module=EXTENSION)
    person.expect("no handler is left", dict(handlers()), {})
    yield 0.5
    bpy.ops.preferences.addon_enable(module=EXTENSION)
    yield 0.3


def shard(person: Person, number: int) -> bpy.types.Object:
    return person.scene.rigidbody_world.collection.objects[number]


def select(person: Person, *objects: bpy.types.Object) -> None:
    for obj in person.scene.objects:
        obj.select_set(obj in objects)
    person.window.view_layer.objects.active = objects[0]


def delete_selected(person: Person) -> Steps:
    before = len(person.scene.objects)
    yield from person.move_to_view()
    yield from person.press("DEL")
    yield 0.3
    person.expect("something is deleted", len(person.scene.objects) < before)


def move_shard(person: Person, number: int) -> Steps:
    select(person, shard(person, number))
    yield from person.move_to_view()
    yield from person.press("G")
    yield from person.press("ONE", "1")
    yield from person.press("RET")
    yield 0.2
