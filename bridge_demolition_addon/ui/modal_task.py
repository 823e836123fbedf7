"""Buttons whose work takes some seconds, beside Blender or as pictures that it renders: time left, and Esc to stop."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import bpy

from ..errors import DemolitionError
from . import messages, task_progress
from .operators import Action, GuardedOperator, refused
from .stepped_thread import SteppedThread

_TICK_S = 0.005
LOOKING_ROUND = {
    "MOUSEMOVE",
    "INBETWEEN_MOUSEMOVE",
    "MIDDLEMOUSE",
    "WHEELUPMOUSE",
    "WHEELDOWNMOUSE",
    "WINDOW_DEACTIVATE",
}
"""Events that Blender still gets while something goes on; all others would change what it works on."""

Work = Callable[[SteppedThread], str | None]
"""Does the work, which needs no Blender, and returns a sentence on what was done."""


class ModalTask(Action):
    """Base of operators that go on beside the window; from a script they work in one go.

    Attributes
    ----------
    what, unit
        What is done, and what its parts are, as its progress says it.
    """

    what: str
    unit: str
    _thread: SteppedThread
    _timer: bpy.types.Timer | None = None

    def work(self, context: bpy.types.Context) -> Work:
        """Look up in Blender all that the work needs, and return it."""
        raise NotImplementedError

    def share_of(self, thread: SteppedThread) -> float:
        """Return how much of the work is done."""
        return thread.done / thread.total if thread.total else 0.0

    def act(self, context: bpy.types.Context) -> str | None:
        thread = SteppedThread(self.work(context))
        while not thread.is_finished:
            thread.step()
        return thread.outcome()

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        messages.clear(self)
        if reason := _what_goes_on():
            return refused(self, DemolitionError(reason))
        try:
            self._thread = SteppedThread(self.work(context))
        except (DemolitionError, OSError) as error:
            return refused(self, error)
        manager = context.window_manager
        self._timer = manager.event_timer_add(_TICK_S, window=context.window)
        manager.modal_handler_add(self)
        task_progress.begin(context, self.what, self.unit, 1)
        _at_work[:] = [self]
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self not in _at_work:  # the extension was switched off
            return {"CANCELLED"}
        if event.type == "ESC":
            self.stop(context)
            messages.tell(self, "WARNING", f"{self.bl_label}: stopped; files that were written whole are new")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"} if event.type in LOOKING_ROUND else {"RUNNING_MODAL"}
        self._thread.step()
        if self._thread.is_finished:
            return self._finish(context)
        self._show(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender where it ends the work itself, as it does before another file is loaded."""
        self.stop(context)

    def stop(self, context: bpy.types.Context) -> None:
        """End the work where it is."""
        self._thread.stop()
        self._take_back(context)

    def _finish(self, context: bpy.types.Context) -> set[str]:
        self._take_back(context)
        try:
            if done := self._thread.outcome():
                self.report({"INFO"}, done)
        except (DemolitionError, OSError) as error:
            return refused(self, error)
        return {"FINISHED"}

    def _show(self, context: bpy.types.Context) -> None:
        going_on, thread = task_progress.going_on(), self._thread
        going_on.total, going_on.note = max(thread.total, 1), thread.stage_text
        going_on.reach(self.share_of(thread))
        task_progress.show(context)

    def _take_back(self, context: bpy.types.Context) -> None:
        _at_work.clear()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        task_progress.end(context)


class RenderingTask(GuardedOperator):
    """Base of operators that render pictures, between which Blender draws its window; from a script in one go."""

    _pictures: Iterator[Path]
    _timer: bpy.types.Timer | None = None
    _total = 0

    def begin(self, context: bpy.types.Context) -> tuple[Iterator[Path], int]:
        """Return the pictures, each rendered when it is asked for, and how many there are."""
        raise NotImplementedError

    def finish(self) -> set[str]:
        """Keep what was rendered, and say so."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            pictures, _ = self.begin(context)
            for _ in pictures:
                pass
            return self.finish()
        except (DemolitionError, OSError) as error:  # a full disk, for one
            return refused(self, error)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if reason := _what_goes_on():
            return refused(self, DemolitionError(reason))
        try:
            self._pictures, self._total = self.begin(context)
        except (DemolitionError, OSError) as error:
            return refused(self, error)
        manager = context.window_manager
        self._progress = task_progress.begin(context, "Rendering", "pictures", self._total)
        task_progress.show(context)
        self._timer = manager.event_timer_add(_TICK_S, window=context.window)
        manager.modal_handler_add(self)
        _at_work[:] = [self]
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self not in _at_work:  # the extension was switched off
            return {"CANCELLED"}
        if event.type == "ESC":
            self.stop(context)
            done = round(self._progress.share * self._total)
            messages.tell(self, "WARNING", f"Stopped after {done} of {self._total} pictures")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            if next(self._pictures, None) is not None:
                self._progress.step()
                task_progress.show(context)
                return {"RUNNING_MODAL"}
            self.stop(context)
            return self.finish()
        except (DemolitionError, OSError) as error:
            self.stop(context)
            return refused(self, error)

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender where it ends the work itself, as it does before another file is loaded."""
        self.stop(context)

    def stop(self, context: bpy.types.Context) -> None:
        """End the rendering where it is, and leave the scene as it was."""
        _at_work.clear()
        self._pictures.close()
        context.window_manager.event_timer_remove(self._timer)
        task_progress.end(context)


def _what_goes_on() -> str:
    """Return in a sentence what else goes on and has to end first; empty where nothing does."""
    going_on = task_progress.going_on()
    return f"{going_on.what} goes on: wait for it, or stop it with Esc" if going_on else ""


_at_work: list[ModalTask | RenderingTask] = []
"""The one that goes on, if any does."""


def unregister() -> None:
    """Stop what goes on."""
    for each in list(_at_work):
        each.stop(bpy.context)
