"""Parts that operators share: greyed buttons with a reason, errors as messages, and paths from the sidebar."""

from collections.abc import Callable
from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper

from ..errors import DemolitionError, OutputError
from ..simulation.blender_events import running_recording
from ..system.disk import writing
from . import messages
from .languages.words import translated
from .sidebar import path_property

Obstacle = Callable[[bpy.types.Context], str | None]
"""Returns in a sentence why a button cannot work now, or None where it can."""


class GuardedOperator:
    """Base of buttons that are greyed, with a reason in their tooltip, as long as they cannot work.

    Each has the id that its class name says: `BDA_OT_run` is ``bda.run``.

    Attributes
    ----------
    changes_scene
        Whether the button changes the scene, which it then cannot do to one that is linked from another file.
    changes_objects
        Whether it makes or removes objects, for which Blender has to be in object mode.
    blocked_by
        Other obstacles, in the order in which they are asked.
    """

    changes_scene = True
    changes_objects = False
    blocked_by: tuple[Obstacle, ...] = ()

    def __init_subclass__(cls, **keywords: object) -> None:
        super().__init_subclass__(**keywords)
        cls.bl_idname = cls.__name__.replace("BDA_OT_", "bda.")

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        """Return why the button cannot work in this scene now, or None where it can."""
        return next(filter(None, (obstacle(context) for obstacle in cls.blocked_by)), None)

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        reason = (
            (cls.changes_scene and _linked(context))
            or (cls.changes_objects and other_mode(context))
            or cls.disabled_reason(context)
        )
        if reason:
            cls.poll_message_set(translated(reason))
        return not reason


class Action(GuardedOperator):
    """Base of operators that act in one go."""

    def act(self, context: bpy.types.Context) -> str | None:
        """Do the work, and return a sentence on its result, if there is one to report."""

    def execute(self, context: bpy.types.Context) -> set[str]:
        messages.clear(self)
        try:
            done = self.act(context)
        except (DemolitionError, OSError) as error:
            return refused(self, error)
        if done:
            self.report({"INFO"}, translated(done))
        return {"FINISHED"}


class UndoableAction(Action):
    """Base of those that Blender can undo."""

    bl_options = {"REGISTER", "UNDO"}


class FileWriter(ExportHelper):
    """Base of operators that ask for a file to write; each has the suffix as `filename_ext`, and a `filter_glob`."""

    filepath: path_property("File", "File to write")

    def usual_path(self, context: bpy.types.Context) -> str:
        """Return the path that is proposed; empty for one named after the saved file."""
        return ""

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.filepath = self.usual_path(context)
        return super().invoke(context, event)


def unset(name: str, reason: str) -> Obstacle:
    """Return what blocks a button as long as a setting of the scene is empty."""
    return lambda context: None if getattr(context.scene.bda, name) else reason


def no_world(context: bpy.types.Context) -> str | None:
    """Say that the scene has no rigid-body world."""
    world = context.scene.rigidbody_world
    return None if world and world.collection else "This scene has no rigid-body world: build a scenario first"


def recording_runs(_context: bpy.types.Context) -> str | None:
    """Say that a recording runs."""
    return "A recording runs: stop it first" if running_recording() else None


def baked(context: bpy.types.Context) -> str | None:
    """Say that the simulation is baked."""
    is_baked = context.scene.rigidbody_world.point_cache.is_baked
    return "The simulation is baked and only played back: delete the bake first" if is_baked else None


def other_mode(context: bpy.types.Context) -> str | None:
    """Say that Blender is in another mode than object mode."""
    return None if context.mode == "OBJECT" else "Go to object mode first"


def _linked(context: bpy.types.Context) -> str | None:
    library = context.scene.library
    sentence = translated("This scene is linked from {}: open that file to change it")
    return library and sentence.format(Path(library.filepath).name)


def refused(operator: bpy.types.Operator, error: Exception) -> set[str]:
    """Cancel an operator with an error's message."""
    messages.tell(operator, "ERROR", str(error))
    return {"CANCELLED"}


def absolute(path: str) -> Path:
    """Return the path that the user wrote, where ``//`` is the folder of the saved file."""
    if path.startswith("//") and not bpy.data.filepath:
        raise OutputError(f"{path}: is relative to this file, which is not saved yet; save it or give a full path")
    return Path(bpy.path.abspath(path))


def write_file(path: Path, content: bytes, *, new_folder: bool = False) -> None:
    """Write a file, and make its folder where there is none if that is wanted."""
    with writing(path):
        if new_folder:
            path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
