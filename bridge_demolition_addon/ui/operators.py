"""How the buttons refuse, and what they say of paths."""

from pathlib import Path

import bpy

from ..core.errors import OutputError


class Refusing:
    """Base of buttons that are greyed, with a reason in their tooltip, as long as they cannot work."""

    @classmethod
    def why_not(cls, context: bpy.types.Context) -> str | None:
        """Why the button cannot work now, in a sentence; None where it can, as it does unless it says otherwise."""
        return None

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if reason := cls.why_not(context):
            cls.poll_message_set(reason)
        return not reason


def no_world(context: bpy.types.Context) -> str | None:
    """That the scene has no rigid-body world, in a sentence; None where it has."""
    world = context.scene.rigidbody_world
    if world and world.collection:
        return None
    return "This scene has no rigid-body world: build a scenario first"


def refused(operator: bpy.types.Operator, error: Exception) -> set[str]:
    """End an operator with a message."""
    operator.report({"ERROR"}, str(error))
    return {"CANCELLED"}


def absolute(path: str) -> Path:
    """A path as the user gave it, where ``//`` is the folder of the saved file.

    Raises
    ------
    OutputError
        The path is relative to a file that has not been saved yet.
    """
    if path.startswith("//") and not bpy.data.filepath:
        raise OutputError(f"{path}: is relative to this file, which has no place yet; save it or give a full path")
    return Path(bpy.path.abspath(path))
