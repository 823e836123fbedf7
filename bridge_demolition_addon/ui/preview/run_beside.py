"""A coarse run of what the panels show, in a process of its own beside Blender, while something is moved.

A few times a second Blender looks whether the panels show another scenario, has it run in place of the one before, and
takes what is known of it by now. Nothing of it gets into the scene: the switch, too, is of this session alone.
"""

from __future__ import annotations

import atexit
from collections.abc import Iterator
from dataclasses import dataclass, field

import bpy
from bpy.app.handlers import persistent

from ...errors import DemolitionError, text_of
from ...model.scenario import Scenario
from ...model.scenario.file import scenario_text
from ...simulation.blender_events import running_recording
from ...studies.preview_process import Preview, PreviewProcess
from ...studies.preview_program import preview_program_command
from ..scenario.values import scenario_of
from ..viewport import redraw_views
from .decorator import is_wanted_in

LOOK_EVERY_S = 0.15
_MOST_KEPT = 20
"""Previews of scenarios that were shown before: undo brings these back at once."""


@dataclass(slots=True)
class RunBeside:
    """The preview of the scenario that the panels show.

    Attributes
    ----------
    process : PreviewProcess or None
        None while the switch is off, and until it is needed.
    shown : Preview or None
        What is known of the newest scenario, or of the one before as long as nothing is known of the newest.
    is_of_before : bool
        Whether what is shown is of the scenario before.
    """

    process: PreviewProcess | None = None
    shown: Preview | None = None
    is_of_before: bool = False
    _is_on: bool = False
    _asked: Scenario | None = None
    _text: str = ""
    _kept: dict[str, Preview] = field(default_factory=dict)

    @property
    def is_on(self) -> bool:
        """Whether previews are made."""
        return self._is_on

    @is_on.setter
    def is_on(self, wanted: bool) -> None:
        if wanted and not self._is_on and not bpy.app.timers.is_registered(look_in):
            bpy.app.timers.register(look_in, first_interval=LOOK_EVERY_S, persistent=True)
        if not wanted:
            self.forget()
        self._is_on = wanted

    def follow(self, settings: bpy.types.PropertyGroup) -> bool:
        """Have the scenario of the panels run if it is another one, and return whether something new is shown."""
        try:
            scenario = scenario_of(settings)
        except DemolitionError as error:
            is_new = self.shown is None or self.shown.reason != text_of(error)
            self._leave(Preview(None, True, reason=text_of(error)))
            return is_new
        if scenario == self._asked:
            return False
        text = scenario_text(scenario)
        self._asked, self._text = scenario, text
        if text in self._kept:
            self._leave(self._kept[text], scenario)
            return True
        try:
            self._ready_process().ask(text)
        except (DemolitionError, OSError) as error:
            self._leave(Preview(None, True, reason=text_of(error)), scenario)
            return True
        self.is_of_before = self.shown is not None
        return True

    def look(self) -> bool:
        """Take what is new of the run, and return whether it is."""
        if self.process is None:
            return False
        try:
            preview = self.process.look()
        except DemolitionError as error:
            preview = Preview(None, True, reason=text_of(error))
        if preview is None:
            return False
        self.shown, self.is_of_before = preview, False
        if preview.is_over and preview.outcome:
            self._kept[self._text] = preview
            if len(self._kept) > _MOST_KEPT:
                del self._kept[next(iter(self._kept))]
        return True

    @property
    def is_running(self) -> bool:
        """Whether a run goes on."""
        return self.process is not None and self.process.is_running

    def end(self) -> None:
        """End the process; the next look begins again where it is wanted."""
        process, self.process, self._asked = self.process, None, None
        if process:
            process.end()

    def fail(self, reason: str) -> None:
        """End the process for a reason, and begin again with another scenario only."""
        asked = self._asked
        self.end()
        self._asked, self.shown, self.is_of_before = asked, Preview(None, True, reason=reason), False

    def forget(self) -> None:
        """End the process, and forget all that it found."""
        self.end()
        self.shown, self.is_of_before = None, False
        self._kept.clear()

    def _leave(self, preview: Preview, scenario: Scenario | None = None) -> None:
        """Show something that needs no run."""
        self._asked, self.shown, self.is_of_before = scenario, preview, False
        if self.process:
            self.process.stop()

    def _ready_process(self) -> PreviewProcess:
        if self.process is None:
            self.process = PreviewProcess(preview_program_command(bpy.app.binary_path))
        return self.process


beside = RunBeside()
"""The only one: what is moved is moved in one window."""

atexit.register(beside.end)


def look_in() -> float | None:
    """Follow what the panels show, and return when Blender's timer calls again, s; None once it is off."""
    if not beside.is_on:
        return None
    try:
        is_new = beside.look()
        if not running_recording():
            for settings in _settings_shown():
                is_new |= beside.follow(settings)
        if is_new:
            redraw_views()
    except Exception as error:  # a timer that raises is heard in the console alone, and called no more
        beside.fail(f"{type(error).__name__}: {error}")
        redraw_views()
    return LOOK_EVERY_S


def _settings_shown() -> Iterator[bpy.types.PropertyGroup]:
    """Give the settings of the first window whose tab is open."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            if is_wanted_in(window.scene, window.screen):
                yield window.scene.bda
                return


@persistent
def _before_undo(*_: object) -> None:
    """End the run: its scenario may be gone. What was shown of the scenario that comes back is kept."""
    beside.end()


@persistent
def _before_load(*_: object) -> None:
    beside.is_on = False


_HANDLERS = {"undo_pre": _before_undo, "redo_pre": _before_undo, "load_pre": _before_load}


def register() -> None:
    """Follow undo, and files that are opened."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    """End the process, and forget everything."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
    if bpy.app.timers.is_registered(look_in):
        bpy.app.timers.unregister(look_in)
    beside.is_on = False
