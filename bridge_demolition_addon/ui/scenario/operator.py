"""Loading, saving, building and removing scenarios."""

import bpy
import numpy as np
from bpy.props import StringProperty

from ...display.camera_targets import points_to_see
from ...model.scenario import Scenario
from ...model.scenario.file import read_scenario, scenario_text
from ...model.sequence.checked_model import checked_model
from ...model.sequence.lifts import pick_warnings
from ...model.stages.stability import stability_of
from ...scene.as_built import keep_as_built, keep_stability
from ...scene.bodies import lacks_ground
from ...scene.demolition import build_demolition, check_replaceable
from ...scene.removal import remove_demolition, remove_loose_connections
from ...scene.rendering.surroundings import stage
from ...simulation.blender_events import shown_results
from ...simulation.kept_run import forget_run
from .. import messages
from ..operators import (
    Action,
    FileWriter,
    UndoableAction,
    absolute,
    baked,
    no_world,
    recording_runs,
    unset,
    write_file,
)
from ..preview.decorator import preview_lines
from ..stages import show_checked
from ..viewport import bridge_box, look_at_box, look_at_bridge, look_at_other_bridge
from .built import forget_built, is_emptied, keep_built, show_built
from .preset_menu import described_preset, name_own_model, preset_file
from .prop import default_scenario
from .values import scenario_of, show_scenario

_SUFFIX = ".toml"

_MOST_SHARDS_JUDGED = 1000
"""Whether a bridge stands is worked out as it is built, if that takes a few seconds: up to so many shards."""


class BDA_OT_load_scenario(UndoableAction, bpy.types.Operator):
    """Show the scenario file's values in the panels, and its charges in the scene; nothing is built yet"""

    bl_label = "Load Scenario"
    changes_objects = True
    blocked_by = (unset("scenario_path", "Choose a scenario file first"),)

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        scenario = read_scenario(absolute(settings.scenario_path))
        show_scenario(settings, scenario)
        settings.loaded_path = settings.scenario_path
        return f"Loaded {scenario.title}"


class BDA_OT_save_scenario(Action, FileWriter, bpy.types.Operator):
    """Save what the panels show, and the charges of the scene, as a scenario file"""

    bl_label = "Save Scenario"
    bl_options = {"REGISTER"}

    filename_ext = _SUFFIX
    filter_glob: StringProperty(default="*" + _SUFFIX, options={"HIDDEN"})

    def usual_path(self, context: bpy.types.Context) -> str:
        return context.scene.bda.scenario_path or "scenario" + _SUFFIX

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        text = scenario_text(scenario_of(settings))
        path = absolute(bpy.path.ensure_ext(self.filepath, _SUFFIX))
        write_file(path, text.encode())
        settings.scenario_path = settings.loaded_path = str(path)
        return f"Saved {path}"


class BDA_OT_new_scenario(UndoableAction, bpy.types.Operator):
    """Set all values in the panels to their defaults, and remove the charges"""

    bl_label = "New Scenario"
    changes_objects = True

    def act(self, context: bpy.types.Context) -> str | None:
        _show(context.scene.bda, default_scenario())


class BDA_OT_load_preset(UndoableAction, bpy.types.Operator):
    """Show the values of a preset."""

    bl_label = "Load Preset"
    bl_description = (
        "Show the values of this preset in the panels, and its charges in the scene. In its picture road, banks, "
        "figures, machines, dust and bars are for looks only"
    )
    changes_objects = True

    preset: StringProperty(name="Preset", description="Name of the preset")

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Return the tooltip of a preset's button; empty for Blender's own."""
        return described_preset(properties.preset) if properties.preset else ""

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Load it, and let the view show its outlines, if there are any."""
        done = self.execute(context)
        if "FINISHED" in done and len(lines_m := preview_lines(context.scene.bda)):
            look_at_box(context, np.array([lines_m.min(axis=0), lines_m.max(axis=0)]))
        return done

    def act(self, context: bpy.types.Context) -> str | None:
        _show(context.scene.bda, read_scenario(preset_file(self.preset)))


def _has_bodies(context: bpy.types.Context) -> str | None:
    if context.scene.rigidbody_world and not is_emptied(context.scene):
        return "This scene has bodies already: build again, or use a new scene"
    return None


class BDA_OT_build_scenario(UndoableAction, bpy.types.Operator):
    """Build the bridge that the panels show, its shards, connections, ground and ball in this scene"""

    bl_label = "Build Scenario"
    changes_objects = True
    blocked_by = (_has_bodies,)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Build it, and let the view show the bridge."""
        done = self.execute(context)
        if "FINISHED" in done:
            look_at_bridge(context)
        return done

    def act(self, context: bpy.types.Context) -> str:
        stop_playing(context)
        scene = context.scene
        is_emptied_scene = scene.rigidbody_world is not None
        if is_emptied_scene:
            scene.bda.contours = False  # of a run of what was here before
        return build(scene, again=is_emptied_scene)


def _nothing_built(context: bpy.types.Context) -> str | None:
    return "Nothing is built here yet: build the scenario" if no_world(context) else None


class BDA_OT_build_anew(UndoableAction, bpy.types.Operator):
    """Remove what was built here but the charges, with all changes by hand, and build what the panels show"""

    bl_label = "Build Again"
    changes_objects = True
    blocked_by = (_nothing_built, baked, recording_runs)

    def act(self, context: bpy.types.Context) -> str:
        stop_playing(context)
        context.scene.bda.contours = False  # of a run of what was here before
        return build_again(context)


class BDA_OT_show_built(UndoableAction, bpy.types.Operator):
    """Set values that have changed since the scene was built back to those that it was built with"""

    bl_label = "Show as Built"
    blocked_by = (unset("built_scenario", "Nothing is built here yet: build the scenario"),)

    def act(self, context: bpy.types.Context) -> None:
        show_built(context.scene.bda)


def _nothing_to_remove(context: bpy.types.Context) -> str | None:
    return "This scene has no rigid-body world: there is nothing to remove" if no_world(context) else None


class BDA_OT_remove_demolition(UndoableAction, bpy.types.Operator):
    """Remove all that was built here but the charges, so that the scenario can be built again"""

    bl_label = "Remove Demolition"
    changes_objects = True
    blocked_by = (_nothing_to_remove, recording_runs)

    def act(self, context: bpy.types.Context) -> str:
        scene = context.scene
        stop_playing(context)
        shown_results(scene).forget()
        forget_run(scene)
        removed = remove_demolition(scene)
        forget_built(scene.bda)
        scene.bda.total_mass = ""
        if scene.rigidbody_world:
            others = len(scene.rigidbody_world.collection.all_objects)
            self.report({"WARNING"}, f"The rigid-body world stays, as it has {others} bodies that were not built here")
        return f"{removed} bodies removed"


def _ground_is_gone(context: bpy.types.Context) -> str | None:
    if lacks_ground(context.scene):
        return "The ground is gone: undo what took it away, or build again; without it the bridge hangs in the air"
    return None


class BDA_OT_remove_loose_connections(UndoableAction, bpy.types.Operator):
    """Remove connections that lack a body, as those of deleted shards do: nothing can be recorded with them"""

    bl_label = "Remove Loose Connections"
    changes_objects = True
    blocked_by = (_nothing_to_remove, recording_runs, _ground_is_gone)

    def act(self, context: bpy.types.Context) -> str:
        return f"{remove_loose_connections(context.scene)} loose connections removed"


def build_again(context: bpy.types.Context) -> str:
    """Build what the panels show in place of what was built; the view follows to a bridge of another size."""
    before_m = bridge_box(context)
    built = build(context.scene, again=True)
    look_at_other_bridge(context, before_m)
    return built


def build(scene: bpy.types.Scene, *, again: bool = False) -> str:
    """Build the scenario that the panels show, or that is in a file which was not loaded yet, and say how large it is.

    `again` says that it replaces what was built before.
    """
    settings = scene.bda
    name_own_model(settings)
    is_new = settings.scenario_path not in ("", settings.loaded_path)
    scenario = read_scenario(absolute(settings.scenario_path)) if is_new else scenario_of(settings)
    built = build_and_show(scene, scenario, is_shown=not is_new, again=again)
    settings.loaded_path = settings.scenario_path
    return built


def build_and_show(scene: bpy.types.Scene, scenario: Scenario, *, is_shown: bool = False, again: bool = False) -> str:
    """Build a scenario, show it in the panels unless they show it already, and say how large it is.

    `again` says that it replaces what was built before.
    """
    settings, model = scene.bda, checked_model(scenario)
    if again:
        check_replaceable(scene, scenario, model)
        remove_demolition(scene)
    shown_results(scene).forget()
    forget_run(scene)
    shards = build_demolition(scene, scenario, model)
    stage(scene, shards, model, points_to_see(scenario, model.members), scenario.pictures)
    if not is_shown:
        show_scenario(settings, scenario)
    settings.total_mass = ""
    messages.clear_of(scene)
    for warning in pick_warnings(scenario.lifts, model):
        messages.note(scene, "bda.build_scenario", "WARNING", warning)
    keep_built(settings, scenario)
    show_checked(scene)
    keep_as_built(scene)
    if len(model.shards) <= _MOST_SHARDS_JUDGED:
        keep_stability(scene, stability_of(scenario, model, with_factor=False).to_json())
    return f"{len(model.shards)} shards, {len(model.connections)} connections"


def stop_playing(context: bpy.types.Context) -> None:
    """Stop the timeline, if it plays: bodies that are removed must not be simulated meanwhile."""
    if context.screen and context.screen.is_animation_playing:
        bpy.ops.screen.animation_cancel(restore_frame=False)


def _show(settings: bpy.types.PropertyGroup, scenario: Scenario) -> None:
    """Show a scenario that is not from a file of the user."""
    show_scenario(settings, scenario)
    settings.scenario_path = settings.loaded_path = ""
