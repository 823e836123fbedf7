# SPDX-License-Identifier: GPL-3.0-or-later
"""Drag the ball, a charge and a blast zone with Preview While Dragging, and see what falls; undo; switch it off."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
from dragging import handle_of, hold, look_at, on_screen
from habits import delete_all, load, undo
from person import Person, Steps
from traces import PRESETS, everything, module

BALL, CHARGES = PRESETS / "span_of_2019_ball.toml", PRESETS / "span_of_2019_explosives.toml"
ELASTIC, ZONES = PRESETS / "reinforced_span_ball.toml", PRESETS / "drilled_spans.toml"

MIDDLE_M, FROM_M = (9.0, 0.0, 1.0), 34.0
"""What the view looks at, left of the sidebar, and from how far."""
ZONES_M, ZONES_FROM_M = (13.0, 0.0, 2.0), 12.0
"""Near the zones, which are small."""

BEGIN_S, WAIT_S, LONG_S = 60.0, 60.0, 300.0
"""For the process to start, a rigid run and an elastic one, on a machine that has other work."""


RIGID, ELASTIC_SO_FAR = "ball of 2019, rigid", "reinforced span, elastic, so far"
RIGID_END, ELASTIC_END = f"{RIGID}, to its end", "reinforced span, elastic, to its end"
END_IN_RIGID = 5.0
"""How many times as long a preview with elastic connections may take: other programs take their part of the time."""

TOOK_S: dict[str, float] = {}
"""How long each took, by what was dragged."""

AFTER_DRAG_S = 0.2
"""That `hold` waits at its end."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    yield from delete_all(person)
    person.take_reports()
    with person.in_sidebar():
        bpy.ops.bda.load_preset(preset=BALL.stem)  # without a path, which a picture would show
    yield 0.5
    person.expect("it is off at first", person.scene.bda.preview_run, False)
    look_at(person, MIDDLE_M, FROM_M)
    before = everything()
    yield from person.click("preview_run")
    yield from person.wait_for("a first preview comes", is_over, BEGIN_S)
    person.expect("it says that it is no forecast", "no forecast" in sentences()[0])
    yield from person.picture("switched_on")
    yield from drag_ball(person)
    person.expect("nothing of it is in the file", everything(), before)
    yield from say_faults(person)
    yield from see_elastic(person)
    yield from drag_charge(person)
    yield from drag_zone(person)
    yield from switch_off(person)
    person.expect("all was drawn", module("ui.preview.run_beside").drawing.error, "")
    person.take_reports()


def drag_ball(person: Person) -> Steps:
    """It is dragged, and what falls is shown of the last position alone; Ctrl-Z shows the first one again, at once."""
    first, process = shown(), beside().process
    x, y, z = handle_of(person, "TARGET").position_m
    start, end = on_screen(person, (x, y, z)), on_screen(person, (x - 4.0, y - 1.5, z))
    yield from hold(person, start, end, still)
    began = time.monotonic()
    yield from time_of(person, RIGID, is_of_now, WAIT_S, began)
    yield from time_of(person, RIGID_END, is_over, WAIT_S, began)
    person.expect("another outcome is shown", shown() is not first)
    person.expect("by the same process", beside().process is process)
    person.expect("debris has an outline", len(shown().outcome.debris_lines_m) > 0)
    yield from person.illustrate("preview_run", person.view)
    yield from undo(person)
    yield from person.wait_for("Ctrl-Z shows the first one again", lambda: shown() is first, 5.0)
    person.expect("and ends the process", beside().process is None or beside().process is not process)


def say_faults(person: Person) -> Steps:
    """A ball that misses the bridge."""
    person.scene.bda.scenario.ball.target_m = (500.0, 0.0)
    yield from person.wait_for(
        "it is said why there is none", lambda: sentences()[0].startswith("No preview: "), WAIT_S
    )
    yield from person.picture("fault")
    person.note("a fault", "" if len(sentences()) == 1 else f"said was {sentences()}")


def see_elastic(person: Person) -> Steps:
    """Reinforced concrete: what is known so far is shown while the run goes on."""
    yield from load_other(person, ELASTIC)
    look_at(person, MIDDLE_M, FROM_M)
    yield from person.wait_for("a first preview comes", lambda: shown() is not None, BEGIN_S)
    x, y, z = handle_of(person, "TARGET").position_m
    start, end = on_screen(person, (x, y, z)), on_screen(person, (x - 3.0, y - 1.0, z))
    yield from hold(person, start, end, still)
    began = time.monotonic()
    yield from time_of(person, ELASTIC_SO_FAR, is_of_now, WAIT_S, began)
    yield from person.picture("elastic_so_far")
    yield from time_of(person, ELASTIC_END, is_over, LONG_S, began)
    person.expect("some of an elastic one is known before a rigid one ends", TOOK_S[ELASTIC_SO_FAR] < TOOK_S[RIGID_END])
    person.expect("it takes five times as long at most", TOOK_S[ELASTIC_END] < END_IN_RIGID * TOOK_S[RIGID_END])
    person.expect("it says what it is worth", "fell or stood alike" in sentences()[1])
    yield from person.picture("elastic_at_end")


def drag_charge(person: Person) -> Steps:
    yield from load_other(person, CHARGES)
    look_at(person, MIDDLE_M, FROM_M)
    yield from person.wait_for("a first preview comes", is_over, BEGIN_S)
    x, y, z = handle_of(person, "CHARGE").position_m
    start, end = on_screen(person, (x, y, z)), on_screen(person, (x + 2.0, y, z))
    yield from hold(person, start, end, still)
    began = time.monotonic()
    yield from time_of(person, "charges of 2019, rigid", is_of_now, WAIT_S, began)
    yield from time_of(person, "charges of 2019, rigid, to its end", is_over, WAIT_S, began)
    yield from person.picture("charge_outcome")


def drag_zone(person: Person) -> Steps:
    yield from load_other(person, ZONES)
    look_at(person, ZONES_M, ZONES_FROM_M)
    yield from person.wait_for("a first preview comes", lambda: shown() is not None, BEGIN_S)
    x, y, z = handle_of(person, "ZONE").position_m
    start, end = on_screen(person, (x, y, z)), on_screen(person, (x, y, z + 0.5))
    yield from hold(person, start, end, still)
    yield from time_of(person, "drilled spans, elastic, so far", is_of_now, WAIT_S, time.monotonic())
    look_at(person, (13.0, 0.0, 1.0), 44.0)
    yield from person.wait_for("something falls", lambda: shown().outcome.fallen > 0, LONG_S)
    yield from person.picture("zone_so_far")


def switch_off(person: Person) -> Steps:
    process = beside().process
    person.expect("a run goes on", process is not None and process.is_running)
    yield from person.click("preview_run")
    yield 0.5
    person.expect("it is off", person.scene.bda.preview_run, False)
    person.expect("no process is left", beside().process is None and not process.is_running)
    person.expect("nothing is said of it", sentences(), [])
    yield from person.picture("switched_off")


def load_other(person: Person, scenario: Path) -> Steps:
    """Load another scenario in the same file."""
    yield from load(person, scenario)
    yield 0.5
    person.take_reports()


def still() -> Steps:
    """Take no time before the mouse is let go."""
    yield 0.05


def time_of(person: Person, what: str, happens: Callable[[], bool], seconds: float, began_s: float) -> Steps:
    """Wait for a preview of what was dragged, and keep how long that took since the mouse was let go."""
    yield 2.0 * module("ui.preview.run_beside").LOOK_EVERY_S
    yield from person.wait_for(what, happens, seconds)
    took_s = time.monotonic() - began_s + AFTER_DRAG_S
    TOOK_S[what] = took_s
    with (person.folder / "times.txt").open("a", encoding="utf-8") as file:
        file.write(f"{what}: {took_s:.1f} s\n")


def beside() -> Any:
    return module("ui.preview.run_beside").beside


def shown() -> Any:
    """The preview that is shown."""
    return beside().shown


def is_of_now() -> bool:
    """Whether a preview is shown of what the panels show now, at its end or so far."""
    return shown() is not None and not beside().is_of_before


def is_over() -> bool:
    return is_of_now() and shown().is_over and not beside().is_running


def sentences() -> list[str]:
    return list(module("ui.preview.run_beside").sentences())
