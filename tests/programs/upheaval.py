# SPDX-License-Identifier: GPL-3.0-or-later
"""Record a pair of blocks, do something that Blender itself may not survive, and check what becomes of the recording.

Usage: upheaval.py FOLDER UPHEAVAL, a method of `Upheaval`. It says "ended well" where Blender survived it.
"""

import os
import sys
from pathlib import Path

import bpy
from support.falling_pair import FRAMES, FallingPair, assert_ended, play

from bridge_demolition_addon.simulation.blender_events import stop_recording


class Upheaval:
    """A pair of blocks whose recording is ended by what happens to it."""

    def __init__(self, folder: Path):
        self.folder, self.pair = folder, FallingPair()
        self.recording = self.pair.record(folder)

    def ended(self, *words: str) -> None:
        assert_ended(bpy, self.recording, self.folder, *words)

    def delete_body_and_connection(self) -> None:
        for obj in bpy.data.objects:
            obj.select_set(obj in (self.pair.far, self.pair.between))
        bpy.ops.object.delete()
        self.ended("'Block 2', 'Connection 1' removed", "start frame")

    def exchange_connection(self) -> None:
        """The number of connections stays."""
        bpy.data.objects.remove(self.pair.between)
        self.pair.blocks.connect("POINT", (0.5, 0, 1.5), self.pair.near, self.pair.far)
        bpy.context.view_layer.update()
        self.ended("'Connection 1' removed", "added", "start frame")

    def remove_world(self) -> None:
        with bpy.context.temp_override(scene=self.pair.scene):
            bpy.ops.rigidbody.world_remove()
        play(self.pair.scene, FRAMES + 2, FRAMES + 20)
        self.ended("world was removed")

    def remove_world_and_make_another(self) -> None:
        with bpy.context.temp_override(scene=self.pair.scene):
            bpy.ops.rigidbody.world_remove()
            bpy.ops.rigidbody.world_add()
        play(self.pair.scene, FRAMES + 2, FRAMES + 20)
        self.ended("world was removed")

    def undo(self) -> None:
        self._colour_and_undo()
        self.ended("undo")

    def redo(self) -> None:
        stop_recording()
        self._colour_and_undo()
        self.pair.scene = bpy.context.scene
        self.recording = self.pair.record(self.folder)
        assert bpy.ops.ed.redo() == {"FINISHED"}
        self.ended("redo")

    def _colour_and_undo(self) -> None:
        bpy.ops.ed.undo_push(message="before")
        bpy.data.objects["Block 1"].color = (1.0, 0.0, 0.0, 1.0)
        bpy.ops.ed.undo_push(message="after")
        assert bpy.ops.ed.undo() == {"FINISHED"}


def main(folder: str, upheaval: str) -> None:
    """Do one upheaval in an empty scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    getattr(Upheaval(Path(folder)), upheaval)()
    print("ended well", flush=True)
    os._exit(0)


main(*sys.argv[1:])
