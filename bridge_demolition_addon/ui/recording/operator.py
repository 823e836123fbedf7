"""Operators that record: while the timeline plays, or a run in one go, with its pictures and as a bake."""

from collections.abc import Iterator
from pathlib import Path
from weakref import WeakKeyDictionary

import bpy
from bpy.props import BoolProperty

from ...errors import DemolitionError, OutputError, SimulationError
from ...model.results.moving import creep_text
from ...model.run_folder.files import PICTURES
from ...model.run_folder.folder import check_folder, keep_scenario, lock_in_place, prepare_folder, withdraw_folder
from ...model.run_folder.summary import RunSummary
from ...model.scenario import RecordingSettings, Scenario
from ...model.scenario.recording import PictureSettings
from ...model.sequence.ending import Rest, doubts_of_run
from ...scene.as_built import edits_beside_bodies, manual_edits
from ...scene.run_setup import run_setup_of
from ...scene.world import keep_played_frames, start_over
from ...simulation.blender_events import running_recording, shown_results, start_recording, stop_recording
from ...simulation.crash_guards.safe_render import frames_are_known
from ...simulation.display.pictures import rendered_pictures, show_blast_zones, show_charges
from ...simulation.kept_run import keep_recording
from ...simulation.playback import Playing, frames_to_play
from ...simulation.recording.logs import LogFiles, checked_log
from ...simulation.recording.recordable import check_recordable
from ...simulation.recording.recorder import Recording
from ...simulation.run_summary import RunContext, rest_watch, run_summary
from ...system.folder_lock import FolderLock
from .. import messages, task_progress, workspace
from ..blast import build_missing_fields, keep_shown_blast
from ..modal_task import RenderingTask, SteppedTask
from ..operators import Action, GuardedOperator, absolute, baked, no_world, other_mode, recording_runs, refused
from ..scenario.built import is_emptied, scenario_to_run
from ..scenario.operator import BDA_OT_build_anew, build_again, stop_playing
from ..scenario.values import table_of
from ..task_progress import TaskProgress
from . import session
from .session import new_folder

RUNNING = "Running"
"""What the progress of Run says."""

_contexts: WeakKeyDictionary[Recording, RunContext] = WeakKeyDictionary()
"""Scenario and scene of each recording."""

_locks: WeakKeyDictionary[Recording, FolderLock] = WeakKeyDictionary()
"""Locks of the folders of recordings that go on."""


def recording_disabled_reason(context: bpy.types.Context) -> str | None:
    """Return why a scene cannot be recorded now, in a sentence, or None where it can."""
    return no_world(context) or recording_runs(context) or baked(context) or _emptied(context)


def _emptied(context: bpy.types.Context) -> str | None:
    return "Nothing is left of what was built: build the scenario again" if is_emptied(context.scene) else None


class BDA_OT_register_handler(Action, bpy.types.Operator):
    """Go to the start frame, and record forces and debris while the timeline plays; called Register Handler in 2019"""

    bl_label = "Start Recording"
    blocked_by = (recording_disabled_reason,)

    def act(self, context: bpy.types.Context) -> str:
        recording = new_recording(context.scene)
        warn_of_changed_bodies(self, recording)
        start_recording(recording)
        start_over(context.scene)
        session.redraw_while_recording()
        return f"Recording to {recording.folder}: play the timeline"


class BDA_OT_unregister_handler(GuardedOperator, bpy.types.Operator):
    """End the recording and write its results; called Unregister Handler in 2019"""

    bl_label = "Stop Recording"
    changes_scene = False

    @classmethod
    def disabled_reason(cls, _context: bpy.types.Context) -> str | None:
        if not running_recording():
            return "No recording runs"
        return "Run is at work: Esc stops it" if task_progress.going_on(RUNNING) else None

    def execute(self, context: bpy.types.Context) -> set[str]:
        return end_with_results(self, stop_recording())


def new_recording(scene: bpy.types.Scene) -> Recording:
    """Return a recording of a scene as the sidebar asks for it, into a folder that is made or cleared for it."""
    settings = scene.bda
    check_recordable(scene)
    table = table_of(settings.scenario.recording, RecordingSettings)
    scenario, by_hand = _scenario_with_edits(scene)
    keep_shown_blast(scene)
    build_missing_fields(scene)
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
    session.forget_recording(folder)  # Windows removes no file that is in use
    shown_results(scene).forget()
    lock = prepare_folder(folder, overwrite=settings.overwrite)  # only now, as it clears away what an earlier run left
    _locks[recording] = lock
    if scenario:
        keep_scenario(folder, scenario, by_hand)
        show_charges(scene, scenario)
        show_blast_zones(scene, scenario)
    _contexts[recording] = RunContext.of(scene, title, scenario, by_hand)
    return recording


def warn_of_changed_bodies(operator: bpy.types.Operator, recording: Recording) -> None:
    """Name the bodies that are not as they were built, before anything is simulated."""
    if text := _changed_bodies_text(recording):
        messages.tell(operator, "WARNING", text)


def _changed_bodies_text(recording: Recording) -> str:
    return f"Not as it was built: {'; '.join(recording.changed_bodies)}" if recording.changed_bodies else ""


def check_output(settings: bpy.types.PropertyGroup) -> None:
    """See that the folder and the files of logs that are chosen can be used, without changing anything."""
    for path in (settings.force_log_path, settings.debris_log_path):
        _log_file(path, settings.overwrite)
    if settings.output_directory:
        check_folder(absolute(settings.output_directory), overwrite=settings.overwrite)


def _scenario_with_edits(scene: bpy.types.Scene) -> tuple[Scenario | None, list[str]]:
    """Return what a scene will run, None where it was not built from a scenario, and edits that no scenario can say."""
    to_run = scenario_to_run(scene.bda)
    if to_run is None:
        return None, []
    setup = run_setup_of(scene)
    scenario, others = setup.effective_scenario(to_run)
    return scenario, [*others, *manual_edits(scene, setup)]


def end_with_results(operator: bpy.types.Operator, recording: Recording, *, stopped: str = "") -> set[str]:
    """Write the results of a recording that has ended, keep it for the panel Results, and report how it ended.

    Where nothing was recorded, its folder is removed if nothing else is in it. `stopped` says that the user has
    stopped the recording before its time; it is empty otherwise.
    """
    messages.clear(operator)
    moved = not _locks[recording].in_place
    try:
        folder = _keep_recording(recording, completed=not (recording.error or stopped))
    except (DemolitionError, OSError) as error:  # a full disk, for one
        return refused(operator, recording.error or error)
    summary = session.last_recording().summary
    warnings = [
        f"The recording ended early: {recording.error}" if recording.error else stopped,
        *doubts_of_run(summary),
        creep_text(summary.creeping),
        _changed_bodies_text(recording),
    ]
    if by_hand := edits_beside_bodies(_contexts[recording].made_by_hand, recording.changed_bodies):
        warnings.append(f"Changed in Blender, and not in the scenario of the run: {'; '.join(by_hand)}")
    if moved:
        warnings.append(f"{recording.folder} was moved or deleted, and the logs with it")
    if recording.rigid_because:
        warnings.append(f"Connections were rigid, not elastic: {recording.rigid_because}")
    for warning in filter(None, warnings):
        messages.tell(operator, "WARNING", warning)
    messages.tell(operator, "INFO", f"Results are in {folder}")
    workspace.show_new_chart()
    return {"FINISHED"}


def withdraw_recording(recording: Recording) -> None:
    """Remove the folder of a recording that has no results."""
    withdraw_folder(_locks.pop(recording))


def _keep_recording(recording: Recording, *, completed: bool) -> Path:
    """Write the results, and return their folder: another one where the recording's was moved."""
    try:
        results = recording.results()
    except SimulationError:
        withdraw_recording(recording)
        raise
    context = _contexts[recording]
    summary = run_summary(recording, results, context, completed=completed)
    with lock_in_place(_locks.pop(recording)) as lock:
        keep_recording(lock.folder, recording, summary, context)
    session.keep_recording(lock.folder, recording, RunSummary.of(summary))
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


_SLOW_FRAME_S = 0.5


BUILD_ANEW = BoolProperty(
    name="Build Again",
    description="Build what the panels show first, in place of what was built before",
    options={"SKIP_SAVE"},
)


def build_for_run(operator: bpy.types.Operator, context: bpy.types.Context) -> None:
    """Build what the panels show in place of what was built before, as a button that runs it."""
    if reason := other_mode(context):
        raise SimulationError(reason)
    check_output(context.scene.bda)
    stop_playing(context)
    operator.report({"INFO"}, build_again(context))
    bpy.ops.ed.undo_push(message=BDA_OT_build_anew.bl_label)  # a run itself is nothing to undo


class BDA_OT_run(SteppedTask, bpy.types.Operator):
    """Simulate and record from the start frame to the last one, and write the results; Esc stops"""

    bl_label = "Run"
    task, unit = RUNNING, "frames"
    tick_s = 0.001
    blocked_by = (recording_disabled_reason,)

    build_anew: BUILD_ANEW

    pictures: BoolProperty(
        name="Pictures", description="Render the run's pictures when it has ended", options={"SKIP_SAVE"}
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        stop_playing(context)
        begun = super().invoke(context, event)
        session.redraw_while_recording()
        return begun

    def begin(self, context: bpy.types.Context) -> int:
        if self.build_anew:
            build_for_run(self, context)
        frames_to_play(context.scene)  # a recording changes the scene before it is played
        recording = new_recording(context.scene)
        warn_of_changed_bodies(self, recording)
        try:
            self._playing = Playing(recording, stop_at=rest_to_stop_at(recording))
        except (DemolitionError, OSError):
            withdraw_recording(recording)
            raise
        return self._playing.total

    def step(self) -> bool:
        try:
            self._playing.step()
        except (DemolitionError, ReferenceError):  # the recording knows why, and is reported with what it has
            return False
        return not self._playing.finished

    def show_progress(self, progress: TaskProgress) -> None:
        progress.share = self._playing.done / self._playing.total
        progress.left_s = self._playing.left_s
        progress.note = note_of(self._playing, pictures=self.pictures)

    def interrupt(self) -> None:
        self._playing.end()

    def stopped(self, context: bpy.types.Context) -> set[str]:
        return self.finish(context)

    def finish(self, context: bpy.types.Context) -> set[str]:
        playing = self._playing
        playing.end()
        stopped = "" if playing.finished else f"Stopped after {playing.done} of {playing.total} frames"
        ended = end_with_results(self, playing.recording, stopped=stopped)
        if self.pictures and ended == {"FINISHED"} and playing.finished and not playing.recording.error:
            self._take_pictures()
        return ended

    def _take_pictures(self) -> None:
        """Render pictures as their own button does, in the window picture by picture."""
        try:
            bpy.ops.bda.render_run("INVOKE_DEFAULT" if self._progress else "EXEC_DEFAULT")
        except RuntimeError as error:  # so a script learns of a refusal, which the panel has kept by now
            self.report({"WARNING"}, f"No pictures of the run: {error}")


def _no_known_run(context: bpy.types.Context) -> str | None:
    if session.last_recording_of(context.scene) is None:
        return "What is built in this scene was not run since Blender started: run it first"
    return None if frames_are_known(context.scene) else "Something has changed since the run: run it again first"


class BDA_OT_render_run(RenderingTask, bpy.types.Operator):
    """Render the bridge before, at the frame of the largest force and after the last run, into its folder; Esc stops"""

    bl_label = "Pictures of the Run"
    blocked_by = (no_world, recording_runs, _no_known_run)

    _folder: Path

    def begin(self, context: bpy.types.Context) -> int:
        last = session.last_recording()
        self._folder = last.folder
        key_frame, last_frame = last.summary.key_frame.frame, last.recording.last_frame
        view = view_of(last.recording)
        self._pictures: Iterator[Path] = rendered_pictures(context.scene, last.folder, view, key_frame, last_frame)
        return len(PICTURES)

    def finish(self, context: bpy.types.Context) -> set[str]:
        messages.tell(self, "INFO", f"Pictures of the run are in {self._folder}")
        return {"FINISHED"}


def _nothing_to_bake(context: bpy.types.Context) -> str | None:
    if context.scene.rigidbody_world.point_cache.is_baked:
        return "The simulation is baked already"
    if not frames_are_known(context.scene):
        return "Nothing has been simulated since the last change: run or play it first"
    return None


class BDA_OT_bake(Action, bpy.types.Operator):
    """Keep the frames simulated so far as a bake: saved with the file, and played back instead of simulated"""

    bl_label = "Bake"
    blocked_by = (no_world, recording_runs, _nothing_to_bake)

    def act(self, context: bpy.types.Context) -> str:
        keep_played_frames(context.scene)
        return f"Baked: {context.scene.rigidbody_world.point_cache.info}"


class BDA_OT_delete_bake(Action, bpy.types.Operator):
    """Delete the bake, so that the scene is simulated again"""

    bl_label = "Delete Bake"

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        world = context.scene.rigidbody_world
        return None if world and world.point_cache.is_baked else "There is no bake"

    def act(self, context: bpy.types.Context) -> None:
        cache = context.scene.rigidbody_world.point_cache
        with bpy.context.temp_override(scene=context.scene, point_cache=cache):
            bpy.ops.ptcache.free_bake()
        context.scene.frame_set(cache.frame_start)


def note_of(playing: Playing, *, pictures: bool = False) -> str:
    """Return what else the progress of a run says; its pictures are not part of its time left."""
    notes = [playing.recording.counts.text]
    if playing.longest_frame_s > _SLOW_FRAME_S:
        notes.append(f"one frame takes Blender up to {playing.longest_frame_s:.1f} s: it answers in between")
    if pictures:
        notes.append("pictures follow")
    return " | ".join(notes)
