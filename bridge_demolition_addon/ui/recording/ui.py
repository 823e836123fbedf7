"""The panels of runs and of recording by hand, and Run Beside: a run in a process of its own.

Blender stays free meanwhile. A few times a second it looks how far the run is. The run ends with Blender, and as the
extension is switched off.
"""

from __future__ import annotations

import atexit
from pathlib import Path

import bpy

from ...errors import DemolitionError, OutputError, SimulationError, text_of
from ...model.run_folder.folder import check_folder
from ...model.run_folder.summary import result_digest_in
from ...model.scenario import Scenario
from ...model.scenario.file import scenario_text
from ...scene.as_built import build_of, changed_bodies, manual_edits
from ...scene.run_setup import run_setup_of
from ...simulation.blender_events import recorded_scene, running_recording, shown_results
from ...simulation.kept_run import adopt_run
from ...simulation.recording.recorder import Recording
from ...studies.whole_run_process import WholeRun
from ...studies.whole_run_program import whole_run_program_command
from .. import messages
from ..contours import view as contour_view
from ..languages.words import translated
from ..operators import Action, absolute, baked, no_world
from ..results.shown_run import counts_line
from ..scenario.built import changed_in_blender, changes, scenario_to_run
from ..scenario.ui import draw_changes, draw_run
from ..sidebar import SidebarPanel, draw_sentence
from ..task_progress import time_left_text
from ..viewport import redraw_views
from . import session
from .operator import BUILD_ANEW, build_for_run
from .session import BDA_OT_set_debris_log, BDA_OT_set_force_log, new_folder

_LOOK_EVERY_S = 0.3
_BUTTON = "bda.run_beside"


class RunsBeside:
    """The run that goes on beside Blender, at most one.

    Attributes
    ----------
    run : WholeRun or None
        None while there is none.
    is_stopping : bool
        Whether it was asked to end with the frames that it has.
    """

    def __init__(self) -> None:
        self.run: WholeRun | None = None
        self.is_stopping = False
        self._scene_uid = 0
        self._build = ""

    def begin(self, scene: bpy.types.Scene, scenario: Scenario, folder: Path) -> None:
        """Begin the run of what is built in a scene; a program that cannot start raises SimulationError."""
        settings, self.is_stopping = scene.bda, False
        self.run = WholeRun(
            whole_run_program_command(bpy.app.binary_path, pictures=settings.pictures_of_run),
            scenario_text(scenario),
            folder,
            overwrite=settings.overwrite,
            pictures=settings.pictures_of_run,
        )
        self._scene_uid, self._build = scene.session_uid, build_of(scene)
        if not bpy.app.timers.is_registered(look_in):
            bpy.app.timers.register(look_in, first_interval=_LOOK_EVERY_S, persistent=True)

    def stop(self) -> None:
        """End the run, if there is one."""
        run, self.run = self.run, None
        if run:
            run.end()

    def look_in(self) -> None:
        """Take what the run has said, and show its results once they are there and nothing else is recorded."""
        run = self.run
        if run is None or running_recording():
            return
        try:
            is_new = run.look()
            if run.state.is_over:
                self.stop()
                self.show(run)
        except (DemolitionError, OSError) as error:
            self.stop()
            is_new = True
            messages.note(self._scene() or bpy.context.scene, _BUTTON, "ERROR", text_of(error))
        if is_new:
            redraw_views()

    def show(self, run: WholeRun) -> None:
        """Show the results of a run that has ended, where what it is of is still in view."""
        scene, folder = self._scene(), run.folder
        if scene is None or build_of(scene) != self._build:
            text = translated("Results are in {}; they are not shown, as another bridge is built here now")
            messages.note(scene or bpy.context.scene, _BUTTON, "WARNING", text.format(folder))
            return
        if last := session.last_recording():
            for other in bpy.data.scenes:
                if shown_results(other).recording is last.recording:
                    shown_results(other).forget()
            session.forget_recording(last.folder)
        recorded_scene(scene).show_results(adopt_run(scene, folder))
        contour_view.follow(scene)
        if self.is_stopping:
            text = translated("Stopped after {} of {} frames").format(run.state.frames, run.state.of_frames)
            messages.note(scene, _BUTTON, "WARNING", text)
        messages.note(scene, _BUTTON, "INFO", translated("Results are in {}").format(folder))

    def _scene(self) -> bpy.types.Scene | None:
        return next((scene for scene in bpy.data.scenes if scene.session_uid == self._scene_uid), None)


runs_beside = RunsBeside()
"""The only ones: processes outlive a file that is closed."""

atexit.register(runs_beside.stop)


def look_in() -> float | None:
    """Look how far the run is, and return when Blender's timer calls again, s; None once there is none."""
    runs_beside.look_in()
    return _LOOK_EVERY_S if runs_beside.run else None


def _goes_on(_context: bpy.types.Context) -> str | None:
    return "A run goes on beside Blender: wait for it, or stop it" if runs_beside.run else None


def _none_goes_on(_context: bpy.types.Context) -> str | None:
    return None if runs_beside.run else "No run goes on beside Blender"


class BDA_OT_run_beside(Action, bpy.types.Operator):
    """Run what is built in a process of its own: Blender stays free meanwhile, and shows the results at the end"""

    bl_label = "Run Beside"
    blocked_by = (no_world, _goes_on, baked)

    build_anew: BUILD_ANEW

    def act(self, context: bpy.types.Context) -> None:
        scene = context.scene
        if self.build_anew:
            build_for_run(self, context)
        scenario = scenario_of_run_beside(scene)
        chosen = scene.bda.output_directory
        folder = absolute(chosen) if chosen else new_folder(scenario.title)
        if scene.bda.force_log_path or scene.bda.debris_log_path:
            raise OutputError(
                "Run Beside writes its logs into the folder of the results: empty the fields in Log Files"
            )
        check_folder(folder, overwrite=scene.bda.overwrite)
        runs_beside.begin(scene, scenario, folder)


class BDA_OT_stop_run_beside(Action, bpy.types.Operator):
    """End the run that goes on beside Blender; what it has simulated by now is kept and shown"""

    bl_label = "Stop Run Beside"
    changes_scene = False
    blocked_by = (_none_goes_on,)

    def act(self, context: bpy.types.Context) -> None:
        run = runs_beside.run
        if not runs_beside.is_stopping and run.stop():
            runs_beside.is_stopping = True
            return
        runs_beside.stop()
        messages.clear_button(_BUTTON)
        if result_digest_in(run.folder):  # only its pictures were not all taken
            runs_beside.show(run)
            return
        text = translated("Stopped; what was written by then is in {}").format(run.folder)
        messages.note(context.scene, _BUTTON, "WARNING", text)


def scenario_of_run_beside(scene: bpy.types.Scene) -> Scenario:
    """Return the scenario that a scene runs; what no scenario can say raises SimulationError."""
    to_run = scenario_to_run(scene.bda)
    if to_run is None:
        raise SimulationError("this scene was not built from a scenario: Run simulates it here")
    setup = run_setup_of(scene)
    scenario, others = setup.effective_scenario(to_run)
    if by_hand := [*others, *(changed_bodies(scene) or manual_edits(scene, setup))]:
        raise SimulationError(
            f"changed in Blender, of which a run beside knows nothing: {'; '.join(by_hand)}; use Run, or build again"
        )
    return scenario


def draw_run_beside(layout: bpy.types.UILayout, context: bpy.types.Context, *, has_changed: bool) -> None:
    """Draw the button, which builds again first as Run does, and while a run goes on how far it is and what stops it.

    What comes and goes is below the button that stops it, which so stays under the mouse.
    """
    if runs_beside.run is None:
        text = "Build Again and Run Beside" if has_changed else "Run Beside"
        layout.operator(BDA_OT_run_beside.bl_idname, text=text, icon="WINDOW").build_anew = has_changed
        for message in messages.messages_of(context.scene):
            if message.button == _BUTTON:  # the panel that has all messages may be closed
                draw_sentence(layout, context, message.text, icon="INFO")
        return
    text = "Stop Now, without Results" if runs_beside.is_stopping else "Stop Run Beside"
    layout.operator(BDA_OT_stop_run_beside.bl_idname, text=text, icon="X")
    state = runs_beside.run.state
    done = translated("{} of {} frames").format(state.frames, state.of_frames)
    layout.progress(factor=state.frames / max(state.of_frames, 1), text=done if state.of_frames else "")
    if state.of_frames:
        draw_sentence(layout, context, counts_line(state.connections), icon="NONE")
    if state.stage:
        draw_sentence(layout, context, state.stage, icon="NONE")
    if state.left_s:
        draw_sentence(layout, context, time_left_text(state.left_s), icon="NONE")


def unregister() -> None:
    """End the run, if there is one."""
    if bpy.app.timers.is_registered(look_in):
        bpy.app.timers.unregister(look_in)
    runs_beside.stop()


class BDA_PT_run(SidebarPanel, bpy.types.Panel):
    """Run the demolition, and choose the folder of its results."""

    bl_label = "Run"
    bl_options = set()

    def draw(self, context: bpy.types.Context) -> None:
        settings, recording = context.scene.bda, running_recording()
        changed = [] if recording else changes(settings)
        draw_run(self.layout.column(align=True), settings, has_changed=bool(changed))
        draw_run_beside(self.layout.column(align=True), context, has_changed=bool(changed))
        column = _draw_folder(self.layout, settings)
        column.prop(settings, "pictures_of_run")
        if recording:
            _draw_state(self.layout, context, recording)
        if changed:
            draw_changes(self.layout, context, changed)
        for change in changed_in_blender(context.scene):
            text = f"{change.key} is {change.shown} in Blender, and runs so; built {change.built}"
            draw_sentence(self.layout, context, text, icon="INFO")


class BDA_PT_handler(SidebarPanel, bpy.types.Panel):
    """Recording while the timeline plays; called Frame Change Event Handler in 2019."""

    bl_label = "Record by Hand"

    def draw(self, context: bpy.types.Context) -> None:
        _draw_folder(self.layout, context.scene.bda)
        column = self.layout.column(align=True)
        column.operator("bda.register_handler")
        column.operator("bda.unregister_handler")
        row = self.layout.row(align=True)
        row.operator("bda.bake")
        row.operator("bda.delete_bake")


class BDA_PT_post_processing(SidebarPanel, bpy.types.Panel):
    """Other files for the logs of debris and forces; called Post Processing in 2019."""

    bl_label = "Log Files"

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.scene.bda
        for operator in (BDA_OT_set_debris_log, BDA_OT_set_force_log):
            column = self.layout.column(align=True)
            column.enabled = running_recording() is None
            column.operator(operator.bl_idname)
            column.prop(settings, operator.setting, text="", placeholder=translated("In the folder of the results"))


def _draw_folder(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> bpy.types.UILayout:
    """Draw where results go, greyed while something is recorded, and return the column of it."""
    column = layout.column()
    column.enabled = running_recording() is None
    column.prop(settings, "output_directory", text="", placeholder=translated("A new folder for each run"))
    column.prop(settings, "overwrite")
    return column


def _draw_state(layout: bpy.types.UILayout, context: bpy.types.Context, recording: Recording) -> None:
    if recording.error:
        draw_sentence(layout, context, translated("Recording ended early: {}").format(recording.error))
        return
    layout.label(text=translated("{} frames").format(recording.recorded_frames), translate=False)
    draw_sentence(layout, context, counts_line(recording.counts), icon="NONE")
    if recording.layout_error:
        text = translated("Forces are estimated from motion: {}").format(recording.layout_error)
        draw_sentence(layout, context, text)
    elif recording.rigid_because:
        text = translated("Connections are rigid, not elastic: {}").format(recording.rigid_because)
        draw_sentence(layout, context, text)
