"""Buttons whose work takes some seconds: in steps in the window, with time left and Esc; in a script at once."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from time import monotonic
from typing import Any

import bpy

from ..errors import DemolitionError
from ..system.progress import Progress
from . import messages, task_progress
from .languages.words import translated
from .operators import GuardedOperator, refused


class _StoppedError(BaseException):
    """Ends the work from within; no `except Exception` keeps it going."""


class SteppedThread(Progress):
    """Work in a thread of its own, which waits after each of its parts until `step` is called.

    Blender waits during a step, as if it did the work itself, but reads mouse and keyboard in between.

    Parameters
    ----------
    work
        Reports its stages and parts to this progress, and returns its result.
    shortest_s
        Parts that end within this time are one step, s: Blender may take longer to draw how far the work is than the
        work takes for a part.

    Attributes
    ----------
    stage_text, done, total
        The stage that was reported last, and how many of its parts are done.
    is_finished
        Whether the work has ended, also by an error.
    """

    def __init__(self, work: Callable[[SteppedThread], Any], shortest_s: float = 0.0):
        self.done, self.total, self.stage_text = 0, 0, ""
        self.is_finished = False
        self._work = work
        self._outcome: Any = None
        self._error: Exception | None = None
        self._is_stopped = False
        self._shortest_s, self._begun_s = shortest_s, 0.0
        self._its_turn, self._our_turn = threading.Semaphore(0), threading.Semaphore(0)
        self._thread = threading.Thread(target=self._run, daemon=True)

    def step(self) -> None:
        """Let it work until its next part is done."""
        if self.is_finished:
            return
        self._begun_s = monotonic()
        if not self._thread.is_alive():
            self._thread.start()
        else:
            self._its_turn.release()
        self._our_turn.acquire()

    def stop(self) -> None:
        """End the work where it is; a file that is written whole or not at all stays so."""
        self._is_stopped = True
        if self._thread.is_alive():
            self.step()
        self.is_finished = True

    def outcome(self) -> Any:
        """Return the result of the work; raise what it raised."""
        if self._error:
            raise self._error
        return self._outcome

    def stage(self, text: str) -> None:
        """Note which stage begins; called by the work."""
        self.stage_text, self.done, self.total = text, 0, 0
        self._hand_over()

    def part(self, done: int, total: int, text: str = "") -> None:
        """Note how many parts of a stage are done; called by the work."""
        self.done, self.total = done, total
        if self._is_stopped or monotonic() - self._begun_s >= self._shortest_s:
            self._hand_over()

    def wait(self) -> None:
        """Let Blender go on while the work waits for another process; called by the work."""
        self._hand_over()

    def _hand_over(self) -> None:
        self._our_turn.release()
        self._its_turn.acquire()
        if self._is_stopped:
            raise _StoppedError

    def _run(self) -> None:
        try:
            self._outcome = self._work(self)
        except _StoppedError:
            pass
        except Exception as error:
            self._error = error
        finally:
            self.is_finished = True
            self._our_turn.release()


_LOOKING_ROUND = frozenset(
    {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "WINDOW_DEACTIVATE"}
)
"""Events that Blender still gets meanwhile; all others would change what the task works on."""

Work = Callable[[SteppedThread], str | None]
"""Does the work, which needs no Blender, and returns a sentence on its result."""


class SteppedTask(GuardedOperator):
    """Base of operators that work in steps, between which Blender draws and reads mouse and keyboard.

    Attributes
    ----------
    task, unit
        The task and its parts as the progress names them, such as ``Rendering`` and ``pictures``.
    tick_s
        Pause between two steps, s.
    passed_events
        Types of events that Blender still gets while the work goes on.
    """

    task: str
    unit: str
    tick_s = 0.005
    passed_events: frozenset[str] = _LOOKING_ROUND
    _timer: bpy.types.Timer | None = None
    _progress: task_progress.TaskProgress | None = None

    def begin(self, context: bpy.types.Context) -> int:
        """Prepare the work, and return how many parts it has."""
        raise NotImplementedError

    def step(self) -> bool:
        """Do a step, and return whether there is more to do."""
        raise NotImplementedError

    def show_progress(self, progress: task_progress.TaskProgress) -> None:
        """Say how far the work is."""
        raise NotImplementedError

    def finish(self, context: bpy.types.Context) -> set[str]:
        """Keep the result, and report it."""
        raise NotImplementedError

    def interrupt(self) -> None:
        """End the work where it is."""
        raise NotImplementedError

    def stopped(self, context: bpy.types.Context) -> set[str]:
        """Report that the user has stopped the work."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        messages.clear(self)
        try:
            self.begin(context)
            while self.step():
                pass
            return self.finish(context)
        except (DemolitionError, OSError) as error:  # a full disk, for one
            return refused(self, error)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        messages.clear(self)
        try:
            if progress := task_progress.going_on():
                raise DemolitionError(f"{progress.task} goes on: wait for it, or stop it with Esc")
            total = self.begin(context)
        except (DemolitionError, OSError) as error:
            return refused(self, error)
        self._progress = task_progress.begin(context, self.task, self.unit, total)
        task_progress.show(context)
        manager = context.window_manager
        self._timer = manager.event_timer_add(self.tick_s, window=context.window)
        manager.modal_handler_add(self)
        _at_work[:] = [self]
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self not in _at_work:  # the extension was switched off
            return {"CANCELLED"}
        if event.type == "ESC":
            self.cancel(context)
            return self.stopped(context)
        if event.type == "Q" and event.ctrl and event.value == "PRESS":
            self.report({"WARNING"}, translated("{} goes on: Esc stops it, then Blender can be left").format(self.task))
        if event.type != "TIMER":
            return {"PASS_THROUGH"} if event.type in self.passed_events else {"RUNNING_MODAL"}
        try:
            if self.step():
                self.show_progress(self._progress)
                task_progress.show(context)
                return {"RUNNING_MODAL"}
            self.cancel(context)
            return self.finish(context)
        except (DemolitionError, OSError) as error:
            self.cancel(context)
            return refused(self, error)

    def cancel(self, context: bpy.types.Context) -> None:
        """End the work and its progress; Blender calls this before it loads another file."""
        _at_work.clear()
        self.interrupt()
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        task_progress.end(context)


class ModalTask(SteppedTask):
    """Base of operators whose work needs no Blender.

    Attributes
    ----------
    shortest_step_s
        Parts of the work that end within this time are one step, s.
    """

    shortest_step_s = 0.0
    _thread: SteppedThread

    def work(self, context: bpy.types.Context) -> Work:
        """Look up in Blender all that the work needs, and return it."""
        raise NotImplementedError

    def share_of(self, thread: SteppedThread) -> float:
        """Return how much of the work is done."""
        return thread.done / thread.total if thread.total else 0.0

    def begin(self, context: bpy.types.Context) -> int:
        self._thread = SteppedThread(self.work(context), self.shortest_step_s)
        return 1

    def step(self) -> bool:
        self._thread.step()
        return not self._thread.is_finished

    def show_progress(self, progress: task_progress.TaskProgress) -> None:
        progress.total, progress.note = max(self._thread.total, 1), self._thread.stage_text
        progress.reach(self.share_of(self._thread))

    def finish(self, context: bpy.types.Context) -> set[str]:
        if done := self._thread.outcome():
            self.report({"INFO"}, done)
        return {"FINISHED"}

    def interrupt(self) -> None:
        self._thread.stop()

    def stopped(self, context: bpy.types.Context) -> set[str]:
        messages.tell(self, "WARNING", f"{self.bl_label}: stopped; files that were written whole are new")
        return {"CANCELLED"}


class RenderingTask(SteppedTask):
    """Base of operators that render pictures, one in a step."""

    task, unit = "Rendering", "pictures"
    passed_events = frozenset()
    _pictures: Iterator[Path]

    def step(self) -> bool:
        return next(self._pictures, None) is not None

    def show_progress(self, progress: task_progress.TaskProgress) -> None:
        progress.step()

    def interrupt(self) -> None:
        self._pictures.close()  # which leaves the scene as it was

    def stopped(self, context: bpy.types.Context) -> set[str]:
        done, total = round(self._progress.share * self._progress.total), self._progress.total
        messages.tell(self, "WARNING", f"Stopped after {done} of {total} pictures")
        return {"CANCELLED"}


_at_work: list[SteppedTask] = []
"""The one that goes on, if any does."""


def unregister() -> None:
    """Stop what goes on."""
    for task in list(_at_work):
        task.cancel(bpy.context)
