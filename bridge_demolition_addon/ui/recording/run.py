"""Operators that simulate a scene in one go, keep it as a bake, and delete the bake."""

import bpy
from bpy.props import BoolProperty

from ...errors import DemolitionError, SimulationError
from ...scene.world import keep_played_frames
from ...simulation.crash_guards.safe_render import frames_are_known
from ...simulation.playback import Playing, frames_to_play
from .. import messages, task_progress
from ..modal_task import LOOKING_ROUND
from ..operators import Action, GuardedOperator, no_world, other_mode, recording_runs, refused
from ..scenario.operator import BDA_OT_build_anew, build
from . import session
from .operator import (
    check_output,
    end_with_results,
    new_recording,
    recording_disabled_reason,
    rest_to_stop_at,
    warn_of_changed_bodies,
    withdraw_recording,
)

_TICK_S = 0.001
"""Between two frames, for Blender to draw and to read mouse and keyboard."""

_SLOW_FRAME_S = 0.5


class BDA_OT_run(GuardedOperator, bpy.types.Operator):
    """Simulate and record from the start frame to the last one, and write the results; Esc stops"""

    bl_idname = "bda.run"
    bl_label = "Run"

    build_anew: BoolProperty(
        name="Build Again",
        description="Build what the panels show first, in place of what was built before",
        options={"SKIP_SAVE"},
    )

    pictures: BoolProperty(
        name="Pictures", description="Render the run's pictures when it has ended", options={"SKIP_SAVE"}
    )

    _progress: task_progress.TaskProgress | None = None

    disabled_reason = staticmethod(recording_disabled_reason)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """The whole run in one call, for scripts."""
        if not self._begin(context):
            return {"CANCELLED"}
        try:
            while not self._playing.finished:
                self._playing.step()
        except DemolitionError:
            pass  # the recording knows why, and is reported with what it has
        return self._end()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if context.screen.is_animation_playing:
            bpy.ops.screen.animation_cancel(restore_frame=False)
        if not self._begin(context):
            return {"CANCELLED"}
        self._progress = session.begin_run(context, _TICK_S, self._playing.total)
        context.window_manager.modal_handler_add(self)
        session.redraw_while_recording()
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC":
            return self._leave(context)
        if event.type != "TIMER":
            return {"PASS_THROUGH"} if event.type in LOOKING_ROUND else {"RUNNING_MODAL"}
        try:
            self._playing.step()
        except (DemolitionError, ReferenceError):
            return self._leave(context)
        if self._playing.finished:
            return self._leave(context)
        self._show(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender where it ends the run itself, as it does before another file is loaded."""
        self._playing.end()
        session.end_run(context)

    def _begin(self, context: bpy.types.Context) -> bool:
        recording = None
        messages.clear(self)
        try:
            if self.build_anew:
                self._build(context)
            frames_to_play(context.scene)  # a recording changes the scene before it is played
            recording = new_recording(context.scene)
            warn_of_changed_bodies(self, recording)
            self._playing = Playing(recording, stop_at=rest_to_stop_at(recording))
        except (DemolitionError, OSError) as error:
            if recording is not None:
                withdraw_recording(recording)
            refused(self, error)
            return False
        return True

    def _build(self, context: bpy.types.Context) -> None:
        if reason := other_mode(context):
            raise SimulationError(reason)
        check_output(context.scene.bda)
        self.report({"INFO"}, build(context.scene, again=True))
        bpy.ops.ed.undo_push(message=BDA_OT_build_anew.bl_label)  # a run itself is nothing to undo

    def _show(self, context: bpy.types.Context) -> None:
        self._progress.share = self._playing.done / self._playing.total
        self._progress.left_s = self._playing.left_s
        self._progress.note = note_of(self._playing, pictures=self.pictures)
        task_progress.show(context)

    def _leave(self, context: bpy.types.Context) -> set[str]:
        session.end_run(context)
        return self._end()

    def _end(self) -> set[str]:
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


class BDA_OT_bake(Action, bpy.types.Operator):
    """Keep the frames simulated so far as a bake: saved with the file, and played back instead of simulated"""

    bl_idname = "bda.bake"
    bl_label = "Bake"

    @classmethod
    def disabled_reason(cls, context: bpy.types.Context) -> str | None:
        if reason := no_world(context) or recording_runs(context):
            return reason
        if context.scene.rigidbody_world.point_cache.is_baked:
            return "The simulation is baked already"
        if not frames_are_known(context.scene):
            return "Nothing has been simulated since the last change: run or play it first"
        return None

    def act(self, context: bpy.types.Context) -> str:
        keep_played_frames(context.scene)
        return f"Baked: {context.scene.rigidbody_world.point_cache.info}"


class BDA_OT_delete_bake(Action, bpy.types.Operator):
    """Delete the bake, so that the scene is simulated again"""

    bl_idname = "bda.delete_bake"
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


CLASSES = (BDA_OT_run, BDA_OT_bake, BDA_OT_delete_bake)


def note_of(playing: Playing, *, pictures: bool = False) -> str:
    """Return what there is to say of a run besides how far it is; its pictures are no part of its time left."""
    said = [f"{playing.recording.broken} connections broken"]
    if playing.longest_frame_s > _SLOW_FRAME_S:
        said.append(f"one frame takes Blender up to {playing.longest_frame_s:.1f} s: it answers in between")
    if pictures:
        said.append("pictures follow")
    return " | ".join(said)
