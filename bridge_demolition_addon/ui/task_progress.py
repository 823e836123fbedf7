"""What goes on and takes long: how far it is, the time left, and how to stop it; in the status bar and the sidebar."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import bpy

from ..engineering.timing.time_left import Pace, in_words
from .sidebar import draw_sentence, redraw_sidebars


@dataclass(slots=True)
class TaskProgress:
    """How far some work is.

    Attributes
    ----------
    what
        What is done: ``Running``.
    unit
        What its steps are: ``frames``.
    total
        How many there are.
    note
        What else there is to say of it now.
    left_s
        Time left on the clock; None while nothing can be said of it.
    share
        Part of the work that is done.
    """

    what: str
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
        """What it says, each in a few words."""
        done = f"{round(self.share * self.total)} of {self.total} {self.unit}"
        left = [] if self.left_s is None else [in_words(self.left_s)]
        return [f"{self.what}: {done}", *left, *filter(None, [self.note]), "Esc: stop"]

    def step(self) -> None:
        """Note that one more step is done, of those that take alike long."""
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
"""One at most: whoever begins another has ended the one before."""


def begin(context: bpy.types.Context, what: str, unit: str, total: int) -> TaskProgress:
    """Show from now on how far some work is."""
    end(context)
    _going_on[:] = [TaskProgress(what, unit, total)]
    context.window_manager.progress_begin(0, 1000)
    return _going_on[0]


def show(context: bpy.types.Context) -> None:
    """Show how far it is now."""
    progress = going_on()
    context.window_manager.progress_update(round(1000 * progress.share))
    if context.workspace:
        context.workspace.status_text_set(" | ".join(progress.lines))
    redraw_sidebars(context)


def end(context: bpy.types.Context) -> None:
    """Show nothing of it any more."""
    if not _going_on:
        return
    _going_on.clear()
    context.window_manager.progress_end()
    if context.workspace:
        context.workspace.status_text_set(None)
    redraw_sidebars(context)


def going_on() -> TaskProgress | None:
    """Return the work that goes on, None where none does."""
    return _going_on[0] if _going_on else None


def draw_task_progress(layout: bpy.types.UILayout, context: bpy.types.Context, progress: TaskProgress) -> None:
    """Draw how far some work is."""
    first, *others = progress.lines
    layout.progress(factor=min(progress.share, 1.0), text=first)
    for line in others:
        draw_sentence(layout, context, line, icon="NONE")
