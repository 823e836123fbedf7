# SPDX-License-Identifier: GPL-3.0-or-later
"""Let rows of connected blocks fall, and do to each, one after another, what a line of the input names.

A line is a list in JSON: FOLDER, STEP…, each step a method of `FallingRow`. The program says "ended well" after each
row where nothing went wrong, and ends where something did.
"""

import json
import os
import sys
from pathlib import Path

import bpy
from support.blocks import Blocks

from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
from bridge_demolition_addon.scene.removal import remove_demolition
from bridge_demolition_addon.scene.world import start_over
from bridge_demolition_addon.simulation import blender_events
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.crash_guards import safe_undo
from bridge_demolition_addon.simulation.recording.recorder import Recording


class FallingRow:
    """Eight blocks with connections between them, and a ground below."""

    def __init__(self, folder: Path):
        self.folder, self.blocks = folder, Blocks()
        self.ground = self.blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
        self.row = [self.blocks.block((1.02 * number, 0, 4.5), 100.0) for number in range(8)]
        pairs = zip(self.row, self.row[1:], strict=False)
        self.links = [
            self.blocks.connect("FIXED", (1.02 * number + 0.5, 0, 4.5), *pair) for number, pair in enumerate(pairs)
        ]
        self.doomed, self.held_by = self.row[3], self.links[2:4]
        self.recording: Recording | None = None

    @property
    def scene(self) -> bpy.types.Scene:
        """The scene, which is another object after an undo."""
        return bpy.context.scene

    def play(self, first: int, last: int) -> None:
        for frame in range(first, last + 1):
            self.scene.frame_set(frame)

    def height(self) -> float:
        evaluated = bpy.data.objects["Block 1"].evaluated_get(self.scene.view_layers[0].depsgraph)
        return evaluated.matrix_world.translation.z

    # What the row goes through first.

    def own_constraints_as_blenders_buttons_do(self) -> None:
        for link in self.links:
            self.scene.collection.objects.link(link)
        self.scene.collection.children.unlink(self.blocks.world.constraints)

    def record(self) -> None:
        self.recording = Recording(self.scene, self.folder)
        start_recording(self.recording)
        self.play(1, 11)
        assert self.recording.error is None

    def record_shards(self) -> None:
        for body in self.row:
            body["bda_kind"] = "shard"
        self.record()

    def begin_to_record(self) -> None:
        self.recording = Recording(self.scene, self.folder)
        start_recording(self.recording)

    def watch(self) -> None:
        for body in self.row:
            body["bda_kind"] = "shard"
        blender_events.register()
        self.play(1, 11)

    def stop(self) -> None:
        for body in self.row:
            body["bda_kind"] = "shard"
        blender_events.register()
        stop_recording()

    def play_unwatched(self) -> None:
        for body in self.row:
            body["bda_kind"] = "shard"
        self.play(1, 11)

    def switch_on(self) -> None:
        import addon_utils  # there is none before bpy is imported

        assert addon_utils.enable("bridge_demolition_addon", handle_error=_raise)

    def switch_off(self) -> None:
        import addon_utils

        addon_utils.disable("bridge_demolition_addon", handle_error=_raise)

    def bake(self) -> None:
        self.scene.frame_end = self.scene.rigidbody_world.point_cache.frame_end = 20
        bpy.ops.ptcache.bake_all(bake=True)
        assert self.scene.rigidbody_world.point_cache.is_baked

    def fail_to_open_a_file(self) -> None:
        try:
            bpy.ops.wm.open_mainfile(filepath=str(self.folder / "missing.blend"))
        except RuntimeError as error:
            assert "No such file" in str(error)

    def open_another_file(self) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)

    def use_freed_memory(self) -> None:
        for number in range(130):
            values = {"__annotations__": dict.fromkeys("abcde", bpy.props.FloatProperty())}
            bpy.utils.register_class(type(f"Settings{number}", (bpy.types.PropertyGroup,), values))

    def add_another_block(self) -> None:
        self.blocks.block((0, 5, 3), 10.0)

    # What is edited.

    def give_connection_one_body(self) -> None:
        self.links[3].rigid_body_constraint.object1 = None

    def edit_threshold(self) -> None:
        self.links[3].rigid_body_constraint.breaking_threshold = 5.0

    def edit_limits(self) -> None:
        self.links[3].rigid_body_constraint.use_limit_lin_x = True

    def edit_type(self) -> None:
        self.links[3].rigid_body_constraint.type = "HINGE"

    def switch_connection_off(self) -> None:
        self.links[3].rigid_body_constraint.enabled = False

    def rename_connection(self) -> None:
        self.links[3].name = "Renamed"

    def turn_connection(self) -> None:
        self.links[3].rotation_euler.x = 1.0

    def hide_connections(self) -> None:
        self.blocks.world.constraints.hide_viewport = True

    def exclude_connections(self) -> None:
        layer = bpy.context.view_layer.layer_collection
        layer.children[self.blocks.world.constraints.name].exclude = True

    def take_connections_out_of_the_scene(self) -> None:
        self.scene.collection.children.unlink(self.blocks.world.constraints)

    def edit_others_after_going_back(self) -> None:
        """In place of the first, Blender makes another constraint once it goes beyond the frames that it has played."""
        self.scene.frame_set(6)
        self.play(7, 14)
        self.edit_others()

    def edit_others(self) -> None:
        for link in self.links[:3] + self.links[4:]:
            link.rigid_body_constraint.type = "POINT"
            self.update()

    def play_on_with_nothing_left_behind(self) -> None:
        self.play(12, 12)
        blender_events.unregister()
        world = BulletWorld(self.scene, [*self.row, self.ground], self.links)
        assert world.bind(self.scene.view_layers[0].depsgraph, to_read=False) is WorldState.NEW
        assert not world.has_grown(), "Bullet has more connections than Blender"
        world.release()
        self.play(13, 20)

    def go_on_falling(self) -> None:
        before = self.height()
        self.play(12, 40)
        assert self.height() < before and not blender_events.recorded_scene(self.scene).stands_still
        self.fall_from_the_start()
        assert self.height() < 4.0, "it falls again"

    def recording_has_ended(self) -> None:
        assert str(self.recording.error).startswith(f"connection {self.links[3].name!r} was edited"), (
            self.recording.error
        )
        assert len(stop_recording().frames) == 10

    def play_another_row_in_another_scene(self) -> None:
        self.choose_another_scene()
        another = FallingRow(self.folder)
        for body in another.row:
            body["bda_kind"] = "shard"
        self.play(1, 11)

    def choose_another_scene(self) -> None:
        bpy.context.window.scene = bpy.data.scenes.new("Another")

    # What is deleted.

    def remove_body(self) -> None:
        bpy.data.objects.remove(self.doomed)

    def remove_three_bodies(self) -> None:
        for body in self.row[2:5]:
            bpy.data.objects.remove(body)

    def delete_body(self) -> None:
        self._delete(self.doomed)

    def remove_connection(self) -> None:
        bpy.data.objects.remove(self.held_by[0])

    def delete_body_and_connections(self) -> None:
        self._delete(self.doomed, *self.held_by)

    def remove_connections_then_body(self) -> None:
        bpy.data.batch_remove([*self.held_by, self.doomed])

    def remove_everything(self) -> None:
        for item in (*self.row[1:], *self.links, self.ground):
            bpy.data.objects.remove(item)

    def remove_world(self) -> None:
        bpy.ops.rigidbody.world_remove()

    def empty_world(self) -> None:
        self.kept, self.scene.rigidbody_world.collection = self.scene.rigidbody_world.collection, None

    def fill_world_again(self) -> None:
        self.scene.rigidbody_world.collection = self.kept

    def take_body_out_of_world(self) -> None:
        self.blocks.world.collection.objects.unlink(self.doomed)

    def remove_body_and_after_a_second_start_another(self) -> None:
        bpy.data.objects.remove(self.doomed)
        self.play(12, 20)
        self.scene.frame_set(1)
        self.play(2, 11)
        bpy.data.objects.remove(self.row[5])

    def _delete(self, *objects: bpy.types.Object) -> None:
        for obj in bpy.data.objects:
            obj.select_set(obj in objects)
        bpy.ops.object.delete()

    def remove_demolitions(self) -> None:
        for scene in bpy.data.scenes:
            bpy.context.window.scene = scene
            assert remove_demolition(scene) == len(self.row)
            self.play_all_scenes()

    # What becomes of it.

    def update(self) -> None:
        bpy.context.view_layer.update()

    def go_to_start(self) -> None:
        self.scene.frame_set(1)

    def stand_still_until_the_start(self) -> None:
        rest = self.height()
        self.play(12, 40)
        assert self.height() == rest, "nothing moves until the start frame"
        assert blender_events.recorded_scene(self.scene).stands_still
        self.fall_from_the_start()
        assert self.height() < 4.0, "it falls again"

    def fall_from_the_start(self) -> None:
        self.play(1, 20)
        assert not blender_events.recorded_scene(self.scene).stands_still

    def play_the_bake_and_simulate_again(self) -> None:
        self.play(1, 20)
        bpy.ops.ptcache.free_bake_all()
        self.play(1, 20)

    def record_again(self) -> None:
        assert "removed: go to the start frame" in str(self.recording.error), self.recording.error
        stop_recording()
        for link in list(self.scene.rigidbody_world.constraints.objects):
            if None in (link.rigid_body_constraint.object1, link.rigid_body_constraint.object2):
                bpy.data.objects.remove(link)  # left over by a body, and no recording takes it
        again = self.folder / "again"
        again.mkdir()
        self.recording = Recording(self.scene, again)
        start_recording(self.recording)
        start_over(self.scene)
        self.play(1, 20)
        self._assert_recorded(19)

    def record_from_now(self) -> None:
        self.play(1, 11)
        self.recording = Recording(self.scene, self.folder)
        start_recording(self.recording)
        self.play(12, 30)
        self._assert_recorded(19)

    def _assert_recorded(self, frames: int) -> None:
        assert self.recording.error is None and self.recording.layout_error is None, (
            self.recording.error,
            self.recording.layout_error,
        )
        assert self.recording.recorded_frames == frames
        stop_recording()

    def add_block(self) -> None:
        self.blocks.block((0, 5, 3), 10.0)
        before = self.height()
        self.play(12, 16)
        assert self.height() < before and not blender_events.recorded_scene(self.scene).stands_still

    # Undo.

    def undo_and_redo(self) -> None:
        blender_events.register()
        preferences = bpy.context.preferences

        def looks() -> tuple[bool, ...]:
            shown = preferences.view.show_developer_ui
            return preferences.experimental.use_undo_legacy, shown, preferences.is_dirty

        preferences.is_dirty = False
        before = looks()
        bpy.ops.ed.undo_push(message="built")
        self.play(1, 21)
        red = (1.0, 0.0, 0.0, 1.0)
        for name in ("Block 2", "Block 3"):
            bpy.data.objects[name].color = red
            bpy.ops.ed.undo_push(message=name)
        assert bpy.ops.ed.undo() == {"FINISHED"}
        assert looks() == before
        assert tuple(bpy.data.objects["Block 3"].color) != red
        assert tuple(bpy.data.objects["Block 2"].color) == red
        assert self.scene.frame_current == 1, "it ends at the start frame"
        self.play(2, 30)
        assert self.height() < 4.0, "it falls again"
        assert bpy.ops.ed.redo() == {"FINISHED"}
        assert looks() == before and self.scene.frame_current == 1
        assert tuple(bpy.data.objects["Block 3"].color) == red
        self.play(1, 30)
        assert self.height() < 4.0
        blender_events.unregister()

    def watch_from_an_undo_step_on(self) -> None:
        for body in self.row:
            body["bda_kind"] = "shard"
        blender_events.register()
        bpy.ops.ed.undo_push(message="built")
        self.play(2, 11)

    def undo(self) -> None:
        bpy.ops.ed.undo_push(message="edited")
        assert bpy.ops.ed.undo() == {"FINISHED"}
        assert self.scene.frame_current == 1
        self.row, self.links = (
            [bpy.data.objects[f"{kind} {number}"] for number in numbers]
            for kind, numbers in (("Block", range(1, 9)), ("Connection", range(7)))
        )
        self.doomed, self.held_by = self.row[3], self.links[2:4]

    def show_a_linked_scene(self) -> None:
        path = self.folder / "linked.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
        with bpy.data.libraries.load(str(path), link=True) as (stored, wanted):
            wanted.scenes = stored.scenes[:1]
        bpy.context.window.scene = wanted.scenes[0]
        self.play(1, 5)

    def delete_scene_and_undo(self) -> None:
        name = self.scene.name
        self.choose_another_scene()
        bpy.ops.ed.undo_push(message="another")
        bpy.data.scenes.remove(bpy.data.scenes[name])
        bpy.ops.ed.undo_push(message="deleted")
        assert bpy.ops.ed.undo() == {"FINISHED"}
        bpy.context.window.scene = bpy.data.scenes[name]

    def undo_and_play_all_scenes(self) -> None:
        bpy.ops.ed.undo_push(message="edited")
        assert bpy.ops.ed.undo() == {"FINISHED"}
        self.play_all_scenes()

    def play_all_scenes(self) -> None:
        for scene in bpy.data.scenes:
            for frame in (12, 13, 1, 2, 3):
                scene.frame_set(frame)

    def add_view_layer(self) -> None:
        bpy.context.window.view_layer = self.scene.view_layers.new("Layer")

    def play_on_from_the_start(self) -> None:
        self.play(2, 11)

    def undo_without_a_world(self) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        blender_events.register()
        seen = []
        experimental = bpy.context.preferences.experimental
        bpy.app.handlers.undo_pre.append(lambda *_: seen.append(experimental.use_undo_legacy))
        bpy.ops.ed.undo_push(message="one")
        bpy.context.scene.frame_end = 77
        bpy.ops.ed.undo_push(message="two")
        assert bpy.ops.ed.undo() == {"FINISHED"}
        assert seen == [False], seen
        blender_events.unregister()

    def end_in_mid_undo(self) -> None:
        blender_events.register()
        preferences = bpy.context.preferences
        assert not preferences.experimental.use_undo_legacy
        safe_undo.before_undo()
        assert preferences.experimental.use_undo_legacy
        blender_events.unregister()
        assert not preferences.experimental.use_undo_legacy and not preferences.view.show_developer_ui


def _raise(error: Exception) -> None:
    raise error


def play(folder: str, *steps: str) -> None:
    """Do the steps, then begin another file and play it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    row = FallingRow(Path(folder))
    for step in steps:
        getattr(row, step)()
    blender_events.unregister()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for frame in range(1, 5):
        bpy.context.scene.frame_set(frame)
    print("ended well", flush=True)


def main() -> None:
    """Play one row after the other, as each line of the input says."""
    for line in sys.stdin:
        play(*json.loads(line))
    os._exit(0)


main()
