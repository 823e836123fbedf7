"""The one owner of everything done in a scene while Blender runs."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

import bpy

from ..errors import DemolitionError, SimulationError
from ..model.results.arrays import Results
from ..scene.bodies import is_marked
from .crash_guards.safe_render import has_to_rest
from .crash_guards.world_guard import WorldGuard
from .display.contours import ContourDisplay
from .display.shown_results import ShownResults
from .kept_run import has_run, recall_run, results_of_run
from .recording.recorder import Recording


class RecordedScene:
    """Records a scene, keeps Blender from crashing over it, and colours its bodies.

    The methods named after Blender's events never raise. Their order of work matters: the guard comes before the
    recording, as it has to see removed objects while Bullet still has them, and contours come last, as they show the
    recorded frame. `recording` runs, or has ended early and was not stopped yet.
    """

    def __init__(self, scene: bpy.types.Scene):
        self.scene = scene
        self.recording: Recording | None = None
        self.results = ShownResults(scene)
        self.contours = ContourDisplay(self.results)
        self._guard = WorldGuard()
        self._is_alone = False
        self._is_rendered = False
        self._rests = False

    @property
    def stands_still(self) -> bool:
        """Whether the scene is not simulated until its start frame, as an object was taken out of its world."""
        return self._guard.stands_still

    @property
    def is_at_work(self) -> bool:
        """Whether the scene is recorded, coloured or stands still."""
        return self.recording is not None or self.contours.is_shown or self.stands_still

    def start(self, recording: Recording, *, alone: bool = False) -> None:
        """Record the scene from now on; alone means that it cannot be edited meanwhile."""
        self._is_alone = alone
        if not alone:
            self._guard.share(self.scene, recording.world)
        self._is_rendered = False
        self.recording = recording
        self.results.follow(recording)

    def stop(self) -> Recording | None:
        """End the recording, and return it."""
        recording, self.recording = self.recording, None
        self.results.is_live = False
        if recording and not recording.error:
            recording.close()
            self._guard.release()
            if not self._is_alone:
                self.look()
        elif recording:
            with suppress(ReferenceError):  # another file was opened
                self.results.hold()  # Blender may have lost what it played, as after undo
        return recording

    def show_results(self, results: Results) -> None:
        """Show kept results, until the next recording."""
        self.results.load(results)
        self.contours.refresh()

    def look(self) -> None:
        """Take over the world as it is now, to guard it from the next frame on."""
        for depsgraph in self._depsgraphs():
            if not self._is_recorded:
                self._guard.look(self.scene, depsgraph)

    def before_frame(self) -> None:
        """Guard the world, and prepare the frame."""
        self.before_update()
        if self._is_rendered:
            self._with_recording(_refuse_unplayed_frame)
        else:
            self.results.before_frame()
        self._with_recording(Recording.before_frame)
        self._guard.keep_standing_still(self.scene)

    def after_frame(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame, and colour it."""
        self._guard.hand_over(self.scene)
        self._with_recording(lambda recording: recording.after_frame(depsgraph))
        if not self._is_recorded:
            self._guard.look(self.scene, depsgraph)
        self.contours.paint(depsgraph)

    def before_update(self) -> None:
        """Guard the world."""
        changes = self._guard.check_objects(self.scene)
        if changes and self._is_recorded:
            self._fail(SimulationError(changes))

    def after_update(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Colour the bodies: an edited body was evaluated again, and has its own colour."""
        self.contours.paint(depsgraph)

    def before_undo_or_load(self, *, world_stays: bool = False) -> None:
        """End the recording and release the world before Blender frees them.

        With `world_stays` Blender keeps the world, but frees some of its objects: the world stands still.
        """
        with suppress(ReferenceError):  # the scene was deleted before
            self._guard.check_objects(self.scene)  # a scene that is not shown was not updated since a deletion
        if self._is_recorded:
            self._fail(SimulationError("undo, redo or loading a file took away what was recorded"))
        try:
            if world_stays:
                self._guard.stand_still(self.scene)
            else:
                self._guard.forget()
        except ReferenceError:  # undo may bring the scene back, with another world
            self._guard.forget()

    def after_load(self) -> None:
        """Go to the start frame, as positions are lost in any other, and show the results of the scene's run."""
        world = self.scene.rigidbody_world
        if self.scene.library or not (world and world.collection and any(map(is_marked, world.collection.all_objects))):
            return
        if not world.point_cache.is_baked:
            self.scene.frame_set(world.point_cache.frame_start)
        self._show_kept_run()

    def after_undo(self) -> None:
        """Show what was recorded of the building that undo or redo has brought: Blender has lost what it played."""
        if self.recording or self.scene.library:
            return
        recall_run(self.scene)
        if self.results.hold():
            self.contours.refresh()
        else:
            self._show_kept_run()

    def before_render(self) -> None:
        """Let the world rest if Blender would simulate it in the render."""
        self._is_rendered = True
        if has_to_rest(self.scene):
            self.scene.rigidbody_world.enabled = False
            self._rests = True

    def after_render(self) -> None:
        """Let the world go on."""
        self._is_rendered = False
        if self._rests:
            self._rests = False
            with suppress(ReferenceError):  # the scene was deleted meanwhile
                self.scene.rigidbody_world.enabled = True

    @property
    def _is_recorded(self) -> bool:
        return self.recording is not None and self.recording.error is None

    def _show_kept_run(self) -> None:
        if has_run(self.scene):
            try:
                self.show_results(results_of_run(self.scene))
            except DemolitionError as error:
                self.results.missing = str(error)

    def _with_recording(self, action: Callable[[Recording], None]) -> None:
        if self.recording is None or not self._is_recorded:
            return
        try:
            action(self.recording)
        except Exception as error:  # an exception in a handler would be lost in the console: the recording keeps it
            self._fail(error)

    def _fail(self, error: Exception) -> None:
        if self.recording is not None:
            self.recording.fail(error)
        self._guard.end_sharing(self._depsgraphs())

    def _depsgraphs(self) -> list[bpy.types.Depsgraph]:
        try:
            return [layer.depsgraph for layer in self.scene.view_layers if layer.depsgraph]
        except ReferenceError:  # the scene was deleted meanwhile
            return []


def _refuse_unplayed_frame(recording: Recording) -> None:
    """A render simulates in copies and a thread of its own; it only plays back frames that were played before."""
    scene, last = recording.scene, recording.last_frame
    if scene.frame_current > (scene.rigidbody_world.point_cache.frame_start if last is None else last):
        raise SimulationError("a render went beyond the frames that were recorded: play the timeline, then render it")
