"""A coarse run of what the panels show, in a process of its own outside Blender, and its drawing in the 3D view.

A few times a second Blender looks whether the panels show another scenario, has it run in place of the one before, and
takes what is known of it by now. Nothing of it gets into the scene: the switch, too, is of this session alone.
"""

import atexit
from collections.abc import Iterator
from dataclasses import dataclass, field

import bpy
import gpu
from bpy.app.handlers import persistent
from bpy.props import BoolProperty

from ...display.preview_outcome import PreviewOutcome
from ...errors import DemolitionError, text_of
from ...model.scenario import Scenario
from ...model.scenario.file import scenario_text
from ...model.study.preview_scenario import ALIKE_PERCENT, LEAST_THROW, MOST_THROW
from ...simulation.blender_events import running_recording
from ...studies.preview_process import Preview, PreviewProcess
from ...studies.preview_program import preview_program_command
from ..languages.words import translated
from ..scenario.values import scenario_of
from ..scene_units import area_text, length_text, mass_text
from ..task_progress import time_left_text
from ..view_drawing import ViewDrawing, draw_lines, write_at_foot
from ..viewport import redraw_views
from .decorator import is_wanted, is_wanted_in

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


_DEBRIS, _FALLEN, _STANDING = (1.0, 0.3, 0.9, 1.0), (1.0, 0.3, 0.9, 0.45), (0.45, 1.0, 0.5, 0.55)
_DEBRIS_PX, _SHARD_PX = 3.0, 1.0
_OF_BEFORE = 0.3
"""How much of its opacity is left of a preview of other values than the panels show now."""


def sentences() -> list[str]:
    """Return what is said of the preview; nothing while it is off."""
    if not beside.is_on:
        return []
    shown = beside.shown
    if shown is None or (shown.outcome is None and beside.is_of_before):
        return [translated("Preview: one coarse run begins")] if beside.is_running else []
    if shown.outcome is None:
        return [translated("No preview: {}").format(shown.reason)]
    lines = _of_outcome(shown.outcome, shown.is_over)
    if beside.is_of_before:
        return [*lines, translated("These are the values before; a new run goes on")]
    return [*lines, _progress(shown, shown.outcome)]


def _of_outcome(outcome: PreviewOutcome, is_over: bool) -> list[str]:
    heading = [translated("Preview in {} shards: one coarse run, no forecast").format(outcome.shards)]
    if not outcome.fallen and not is_over:
        return [*heading, translated("All shards stand so far")]  # which may be before anything is done to them
    if outcome.is_elastic:
        heading.append(_trust())
    if not outcome.fallen:
        return [*heading, translated("All shards stand")]
    fallen = translated("{} shards ({}) fall, {} stand").format(
        outcome.fallen, mass_text(outcome.fallen_kg), outcome.standing
    )
    lies = translated("Debris covers {}, up to {} from the bridge").format(
        area_text(outcome.area_m2, ".0f"), length_text(outcome.farthest_m, ".1f")
    )
    if not outcome.falling:
        return [*heading, fallen, lies]
    flying = translated("{} still fall: shown where they would land in free flight").format(outcome.falling)
    return [*heading, fallen, flying, lies]


def _trust() -> str:
    """Return what is known of previews that take longer steps than the run."""
    tested = translated(
        "Longer steps than in the run: {} % of spans fell or stood alike, debris got {} to {} times as far"
    )
    return tested.format(ALIKE_PERCENT, f"{LEAST_THROW:.1f}", f"{MOST_THROW:.1f}")


def _progress(shown: Preview, outcome: PreviewOutcome) -> str:
    if shown.is_over:
        return translated("The run ended after {} s").format(f"{outcome.time_s:.1f}")
    times = (f"{outcome.time_s:.1f}", f"{outcome.duration_s:.1f}")
    so_far = translated("Only so far: {} s of {} s, the run goes on").format(*times)
    return so_far if shown.left_s is None else f"{so_far}, {time_left_text(shown.left_s)}"


def _draw_in_space(context: bpy.types.Context) -> None:
    outcome = beside.shown.outcome if beside.is_on and beside.shown else None
    if outcome is None or not is_wanted(context):
        return
    share = _OF_BEFORE if beside.is_of_before else 1.0
    gpu.state.blend_set("ALPHA")
    for lines, colour, width_px in (
        (outcome.standing_lines_m, _STANDING, _SHARD_PX),
        (outcome.fallen_lines_m, _FALLEN, _SHARD_PX),
        (outcome.debris_lines_m, _DEBRIS, _DEBRIS_PX),
    ):
        draw_lines(context, lines, (*colour[:3], share * colour[3]), width_px)
    gpu.state.blend_set("NONE")


def _draw_on_screen(context: bpy.types.Context) -> None:
    if is_wanted(context):
        write_at_foot(context, sentences())


drawing = ViewDrawing(_draw_in_space, _draw_on_screen)


def _switch(_settings: bpy.types.PropertyGroup, wanted: bool) -> None:
    beside.is_on = wanted
    redraw_views()


class PreviewRunProperties:
    """Part of the settings of a scene."""

    preview_run: BoolProperty(
        name="Preview While Dragging",
        description="While you drag the ball, a charge or a blast zone, or change a value, run the scenario of the "
        "panels in some 50 to 80 shards in a process of its own, and show the outline of its debris, what falls and "
        "what stands. It is one coarse run and no forecast, takes a processor and about 0.5 GB of memory, and changes "
        "nothing in the file. Off again with the next file",
        get=lambda _settings: beside.is_on,
        set=_switch,
        options={"SKIP_SAVE"},
    )
