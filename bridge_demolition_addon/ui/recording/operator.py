"""Operators that start and end a recording, which goes on while the timeline plays."""

from __future__ import annotations

from pathlib import Path
from weakref import WeakKeyDictionary

import bpy

from ...errors import DemolitionError, OutputError, SimulationError
from ...model.run_folder.folder import (
    check_folder,
    keep_scenario,
    lock_in_place,
    prepare_folder,
    withdraw_folder,
)
from ...model.run_folder.summary import RunSummary
from ...model.scenario import RecordingSettings, Scenario
from ...model.scenario.recording import PictureSettings
from ...model.sequence.rest import Rest
from ...model.sequence.undisturbed import self_collapse_text
from ...scene.as_built import manual_edits
from ...scene.effective_scenario import effective_scenario
from ...scene.run_setup import run_setup_of
from ...scene.world import start_over
from ...simulation.blender_events import running_recording, shown_results, start_recording, stop_recording
from ...simulation.display.pictures import show_charges
from ...simulation.kept_run import keep_recording
from ...simulation.recording.logs import LogFiles, checked_log
from ...simulation.recording.recordable import check_recordable
from ...simulation.recording.recorder import Recording
from ...simulation.run_summary import RunContext, rest_watch, run_summary
from ...system.folder_lock import FolderLock
from .. import messages
from ..blast.operator import keep_shown_blast
from ..operators import Action, GuardedOperator, absolute, no_world, recording_runs, refused
from ..scenario.built import scenario_to_run
from ..scenario.values import table_of
from . import session
from .new_folder import new_folder

_contexts: WeakKeyDictionary[Recording, RunContext] = WeakKeyDictionary()
"""What each recording is of."""

_locks: WeakKeyDictionary[Recording, FolderLock] = WeakKeyDictionary()
"""What keeps others out of each recording's folder, as long as it goes on."""


def recording_disabled_reason(context: bpy.types.Context) -> str | None:
    """Return why a scene cannot be recorded now, in a sentence, or None where it can."""
    if reason := no_world(context) or recording_runs(context):
        return reason
    if context.scene.rigidbody_world.point_cache.is_baked:
        return "The simulation is baked and only played back: delete the bake first"
    return None


class BDA_OT_register_handler(Action, bpy.types.Operator):
    """Go to the start frame, and record forces and debris while the timeline plays; called Register Handler in 2019"""

    bl_idname = "bda.register_handler"
    bl_label = "Start Recording"

    disabled_reason = staticmethod(recording_disabled_reason)

    def act(self, context: bpy.types.Context) -> str:
        recording = new_recording(context.scene)
        warn_of_changed_bodies(self, recording)
        start_recording(recording)
        start_over(context.scene)
        session.redraw_while_recording()
        return f"Recording to {recording.folder}: play the timeline"


class BDA_OT_unregister_handler(GuardedOperator, bpy.types.Operator):
    """End the recording and write its results; called Unregister Handler in 2019"""

    bl_idname = "bda.unregister_handler"
    bl_label = "Stop Recording"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        if not running_recording():
            return "No recording runs"
        return "Run is at work: Esc stops it" if session.run_goes_on() else None

    def execute(self, context: bpy.types.Context) -> set[str]:
        return end_with_results(self, stop_recording())


CLASSES = (BDA_OT_register_handler, BDA_OT_unregister_handler)


def new_recording(scene: bpy.types.Scene) -> Recording:
    """Return a recording of a scene as the sidebar asks for it, into a folder that is made or cleared for it.

    Raises
    ------
    DemolitionError, OSError
        A value, the folder or a file for a log cannot be used, or the scene cannot be recorded.
    """
    settings = scene.bda
    check_recordable(scene)
    table = table_of(settings.scenario.recording, RecordingSettings)
    scenario, by_hand = _as_run(scene)
    keep_shown_blast(scene)
    forces, debris = (
        _log_file(path, settings.overwrite) for path in (settings.force_log_path, settings.debris_log_path)
    )
    if forces is not None and forces == debris:
        raise OutputError(f"{forces}: is the file of both logs; choose another for one of them")
    title = scenario.title if scenario else scene.name
    folder = absolute(settings.output_directory) if settings.output_directory else new_folder(title)
    if taken := {forces, debris} & {folder, *folder.parents}:
        raise OutputError(f"{taken.pop()}: expected a file for the log, found the folder of the results")
    recording = Recording(
        scene,
        folder,
        every_substep=table.every_substep,
        log_files=LogFiles(forces, debris),
        contacts=table.contacts,
    )
    check_folder(folder, overwrite=settings.overwrite)
    _let_go_of(folder, scene)
    lock = prepare_folder(folder, overwrite=settings.overwrite)  # only now, as it clears away what an earlier run left
    _locks[recording] = lock
    if scenario:
        keep_scenario(folder, scenario, by_hand)
        show_charges(scene, scenario)
    _contexts[recording] = RunContext.of(scene, title, scenario, by_hand)
    return recording


def warn_of_changed_bodies(operator: bpy.types.Operator, recording: Recording) -> None:
    """Name the bodies that are not as they were built, before anything is simulated."""
    if recording.changed_bodies:
        messages.tell(operator, "WARNING", f"Not as it was built: {'; '.join(recording.changed_bodies)}")


def check_output(settings: bpy.types.PropertyGroup) -> None:
    """See that the folder and the files of logs that are chosen can be used, without changing anything."""
    for path in (settings.force_log_path, settings.debris_log_path):
        _log_file(path, settings.overwrite)
    if settings.output_directory:
        check_folder(absolute(settings.output_directory), overwrite=settings.overwrite)


def _as_run(scene: bpy.types.Scene) -> tuple[Scenario | None, list[str]]:
    """Return what a scene will run, and what of it no scenario can say; None where it was not built from one."""
    to_run = scenario_to_run(scene.bda)
    if to_run is None:
        return None, []
    setup = run_setup_of(scene)
    scenario, unsaid = effective_scenario(setup, to_run)
    return scenario, [*unsaid, *manual_edits(scene, setup)]


def _let_go_of(folder: Path, scene: bpy.types.Scene) -> None:
    """Let go of what was recorded into a folder that is to be cleared: Windows removes no file that is in use."""
    session.forget_recording(folder)
    shown_results(scene).forget()


def end_with_results(operator: bpy.types.Operator, recording: Recording, *, stopped: str = "") -> set[str]:
    """Write what a recording that has ended has, keep it for the panel of results, and report how it ended.

    Where nothing was recorded the folder is gone as well, if nothing else is in it: the next try finds it free.

    Parameters
    ----------
    operator
        What ended it, which this is the result of.
    recording
        The recording.
    stopped
        In a sentence, that the user has stopped it before its time; empty where that is not so.
    """
    messages.clear(operator)
    moved = not _locks[recording].in_place
    try:
        folder = _keep_recording(recording, completed=not (recording.error or stopped))
    except (DemolitionError, OSError) as error:  # a full disk, for one
        return refused(operator, recording.error or error)
    if recording.error:
        messages.tell(operator, "WARNING", f"The recording ended early: {recording.error}")
    elif stopped:
        messages.tell(operator, "WARNING", stopped)
    if fall := self_collapse_text(session.last_recording().summary.values):
        messages.tell(operator, "WARNING", fall)
    warn_of_changed_bodies(operator, recording)
    if by_hand := _contexts[recording].made_by_hand:
        messages.tell(
            operator, "WARNING", f"Changed in Blender, and not in the scenario of the run: {'; '.join(by_hand)}"
        )
    if moved:
        messages.tell(operator, "WARNING", f"{recording.folder} was moved or deleted, and the logs with it")
    if recording.layout_error:
        messages.tell(operator, "WARNING", f"Forces are estimated from motion: {recording.layout_error}")
    elif recording.rigid_because:
        messages.tell(operator, "WARNING", f"Connections were rigid, not elastic: {recording.rigid_because}")
    messages.tell(operator, "INFO", f"Results are in {folder}")
    return {"FINISHED"}


def withdraw_recording(recording: Recording) -> None:
    """Take back the folder of a recording that came to nothing."""
    withdraw_folder(_locks.pop(recording))


def _keep_recording(recording: Recording, *, completed: bool) -> Path:
    """Write what was recorded, and return the folder that it is in: another one where the recording's was moved."""
    try:
        results = recording.results()
    except SimulationError:
        withdraw_recording(recording)
        raise
    context = _contexts[recording]
    summary = run_summary(recording, results, context, completed=completed)
    with lock_in_place(_locks.pop(recording)) as lock:
        keep_recording(lock.folder, recording, summary, context)
    session.keep_recording(lock.folder, recording, RunSummary(summary))
    return lock.folder


def view_of(recording: Recording) -> PictureSettings:
    """Return how the pictures of a recording are taken: as its scenario says, or else as the panels show."""
    if scenario := _contexts[recording].scenario:
        return scenario.pictures
    return table_of(recording.scene.bda.scenario.pictures, PictureSettings)


def rest_to_stop_at(recording: Recording) -> Rest | None:
    """Return the rest at which a recording is to end before its time, if it is; to be asked for before it runs."""
    context = _contexts[recording]
    scenario = context.scenario
    return rest_watch(scenario, context.ground_motion) if scenario and scenario.time.stop_at_rest else None


def _log_file(path: str, overwrite: bool) -> Path | None:
    return checked_log(absolute(path), overwrite=overwrite) if path else None
