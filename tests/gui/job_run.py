# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a scenario in one go; stop another run with Esc; bake; keep answering meanwhile."""

import json
import time

import bpy
import numpy as np
from person import Person, Steps
from traces import EXTENSION, SCENARIO, handlers

ANSWER_S = 0.5
"""Blender answers at least so often while it runs."""


def steps(person: Person) -> Steps:
    yield 0.5
    start(person, "build_scenario")
    yield 0.5
    yield from run_to_the_end(person)
    yield from stop_with_escape(person)
    yield from bake(person)
    yield from switch_off_while_it_runs(person)


def run_to_the_end(person: Person) -> Steps:
    folder = person.folder / "results"
    start(person, "run", folder)
    longest, last = 0.0, time.perf_counter()
    undone = False
    while handlers():
        yield
        now = time.perf_counter()
        if not handlers():  # it has just written the results, and drawn their chart
            break
        longest, last = max(longest, now - last), now
        if person.scene.frame_current > 15 and not undone:
            yield from person.picture("running")
            yield from person.press("Z", ctrl=True)
            undone, last = True, time.perf_counter()
    yield 0.5
    yield from person.picture("run")
    person.expect("undo does nothing meanwhile", person.scene.frame_current, person.scene.frame_end)
    person.note(f"the longest wait for an answer was {longest:.2f} s", "" if longest < ANSWER_S else "too long")
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    person.expect("the run is complete", summary["completed"])
    with np.load(folder / "results.npz") as arrays:
        person.expect("results have every frame", arrays["frames"].tolist(), list(range(2, 39)))
    person.expect("no handler is left", dict(handlers()), {})


def stop_with_escape(person: Person) -> Steps:
    folder = person.folder / "stopped"
    start(person, "run", folder)
    yield from person.wait_for("it runs", lambda: person.scene.frame_current >= 8)
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield 1.0
    stopped = person.scene.frame_current
    person.expect("it stops", stopped < person.scene.frame_end and not handlers())
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    person.expect("the results say so", not summary["completed"])
    yield 0.5
    person.expect("it stays stopped", person.scene.frame_current, stopped)


def bake(person: Person) -> Steps:
    start(person, "bake")
    yield 0.5
    person.expect("it is baked", person.scene.rigidbody_world.point_cache.is_baked)
    start(person, "delete_bake")
    yield 0.5
    person.expect("the bake is deleted", not person.scene.rigidbody_world.point_cache.is_baked)


def switch_off_while_it_runs(person: Person) -> Steps:
    start(person, "run", person.folder / "switched_off")
    yield from person.wait_for("it runs", lambda: person.scene.frame_current >= 8)
    bpy.ops.preferences.addon_disable(module=EXTENSION)
    yield 1.0
    yield from person.picture("switched_off_while_running")
    person.expect("no handler is left after switching off", dict(handlers("")), {})


def start(person: Person, operator: str, folder=None) -> None:
    """As its button does."""
    with bpy.context.temp_override(window=person.window, area=person.view, region=person.sidebar):
        person.scene.bda.scenario_path = str(SCENARIO)
        person.scene.bda.output_directory = str(folder or person.folder)
        getattr(bpy.ops.bda, operator)("INVOKE_DEFAULT")
