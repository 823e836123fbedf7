"""Operators that simulate a scene in one go, render its pictures, keep it as a bake, and delete the bake."""

from collections.abc import Iterator
from pathlib import Path

import bpy
from bpy.props import BoolProperty

from ...errors import DemolitionError, SimulationError
from ...model.run_folder.files import PICTURES
from ...scene.world import keep_played_frames
from ...simulation.crash_guards.safe_render import frames_are_known
from ...simulation.display.pictures import rendered_pictures
from ...simulation.playback import Playing, frames_to_play
from .. import messages
from ..modal_task import RenderingTask, SteppedTask
from ..operators import Action, no_world, other_mode, recording_runs
from ..scenario.operator import BDA_OT_build_anew, build_again, stop_playing
from ..task_progress import TaskProgress
from . import session
from .operator import (
    RUNNING,
    check_output,
    end_with_results,
    new_recording,
    recording_disabled_reason,
    rest_to_stop_at,
    view_of,
    warn_of_changed_bodies,
    withdraw_recording,
)

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
        key_frame, last_frame = last.summary.key_frame, last.recording.last_frame
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
