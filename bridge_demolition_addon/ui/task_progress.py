"""Progress of a long task in the status bar and the sidebar: how far it is, the time left, and how to stop it."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import bpy

from ..engineering.timing.time_left import Pace, clock
from .languages.words import translated
from .sidebar import draw_sentence, redraw_sidebars


@dataclass(slots=True)
class TaskProgress:
    """How far a task is.

    Attributes
    ----------
    task, unit
        The task as a text, such as ``Running``, and its steps, such as ``frames``.
    note
        Another text of the lines.
    left_s
        Time left on the clock; None while it is not known.
    share
        Part of the work that is done.
    """

    task: str
    unit: str
    total: int
    note: str = ""
    left_s: float | None = None
    share: float = 0.0
    _began_s: float = field(default_factory=time.perf_counter)
    _stepped_s: float = field(default_factory=time.perf_counter)
    _pace: Pace = field(default_factory=Pace)

    @property
    def lines(self) -> list[str]:
        """The progress in short lines."""
        done = translated("{} of {}").format(round(self.share * self.total), self.total)
        left = [] if self.left_s is None else [time_left_text(self.left_s)]
        notes = [translated(self.note)] if self.note else []
        return [f"{translated(self.task)}: {done} {translated(self.unit)}", *left, *notes, translated("Esc: stop")]

    def step(self) -> None:
        """Note that one more step is done, of steps that take equally long."""
        now = time.perf_counter()
        self._pace.note(now - self._stepped_s)
        self._stepped_s = now
        self.share = len(self._pace.took_s) / self.total
        self.left_s = self._pace.left_s(self.total - len(self._pace.took_s))

    def reach(self, share: float) -> None:
        """Note how much is done of work whose steps take unequally long."""
        self.share = share
        if share > 0.0:
            self.left_s = (time.perf_counter() - self._began_s) * (1.0 - share) / share


_going_on: list[TaskProgress] = []
"""At most one: a task that begins ends the one before."""


def time_left_text(seconds: float) -> str:
    """Return a time left as text."""
    return translated("about {} min left").format(clock(seconds))


def begin(context: bpy.types.Context, task: str, unit: str, total: int) -> TaskProgress:
    """Show the progress of a task from now on."""
    end(context)
    _going_on[:] = [TaskProgress(task, unit, total)]
    context.window_manager.progress_begin(0, 1000)
    return _going_on[0]


def show(context: bpy.types.Context) -> None:
    """Show how far the task is now."""
    progress = going_on()
    context.window_manager.progress_update(round(1000 * progress.share))
    if context.workspace:
        context.workspace.status_text_set(" | ".join(progress.lines))
    redraw_sidebars(context)


def end(context: bpy.types.Context) -> None:
    """Show the progress no longer."""
    if not _going_on:
        return
    _going_on.clear()
    context.window_manager.progress_end()
    if context.workspace:
        context.workspace.status_text_set(None)
    redraw_sidebars(context)


def going_on(task: str | None = None) -> TaskProgress | None:
    """Return the progress of the task that goes on, if it is the one that is asked for; None where there is none."""
    return next((progress for progress in _going_on if task in (None, progress.task)), None)


def draw_task_progress(layout: bpy.types.UILayout, context: bpy.types.Context, progress: TaskProgress) -> None:
    """Draw a progress bar with its lines."""
    first, *others = progress.lines
    layout.progress(factor=min(progress.share, 1.0), text=first)
    for line in others:
        draw_sentence(layout, context, line, icon="NONE")
