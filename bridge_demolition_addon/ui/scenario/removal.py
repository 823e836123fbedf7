"""The buttons that take a demolition out of the scene again, and connections that hold nothing."""

import bpy

from ...scene.removal import remove_demolition, remove_loose_connections
from ...simulation.display import contours
from ...simulation.recording import handlers
from ..operators import Refusing, no_world


class _Removal(Refusing):
    """Base of the two."""

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        if no_world(context):
            return "This scene has no rigid-body world: there is nothing to remove"
        return "A recording runs: unregister its handler first" if handlers.current() else None


class BDA_OT_remove_demolition(_Removal, bpy.types.Operator):
    """Remove all that was built here but the charges, so that the scenario can be built anew"""

    bl_idname = "bda.remove_demolition"
    bl_label = "Remove Demolition"

    def execute(self, context: bpy.types.Context) -> set[str]:
        scene = context.scene
        if context.screen and context.screen.is_animation_playing:
            bpy.ops.screen.animation_cancel(restore_frame=False)
        contours.forget(scene)
        removed = remove_demolition(scene)
        scene.bda.built_scenario = scene.bda.title = scene.bda.total_mass = ""
        self.report({"INFO"}, f"{removed} bodies removed")
        if scene.rigidbody_world:
            others = len(scene.rigidbody_world.collection.all_objects)
            self.report({"WARNING"}, f"The rigid-body world stays, as it has {others} bodies that were not built here")
        return {"FINISHED"}


class BDA_OT_remove_loose_connections(_Removal, bpy.types.Operator):
    """Remove connections that lack a body, as those of deleted shards do: nothing can be recorded with them"""

    bl_idname = "bda.remove_loose_connections"
    bl_label = "Remove Loose Connections"

    def execute(self, context: bpy.types.Context) -> set[str]:
        removed = remove_loose_connections(context.scene)
        self.report({"INFO"}, f"{removed} loose connections removed")
        return {"FINISHED"}


CLASSES = (BDA_OT_remove_demolition, BDA_OT_remove_loose_connections)
