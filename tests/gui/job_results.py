# SPDX-License-Identifier: GPL-3.0-or-later
"""Results and the bridge that they are of, after a run that was stopped, and after one that ended.

Ctrl-Z and Ctrl-Shift-Z show what was recorded; another bridge has no results of the first, until Ctrl-Z brings that
back.
"""

from pathlib import Path

import bpy
import numpy as np
from dragging import out_of_sight
from habits import build, delete_all, undo
from panels import Panels
from person import Person, Steps
from timeline import drag_to_frame
from traces import module, recording_runs, something_goes_on

STOPPED_AT, ENDS_AT = 20, 16
BALL = "Wrecking ball"


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    person.scene.bda.pictures_of_run = False
    yield from build(person)
    for name, last in (("stopped", STOPPED_AT), ("ended", ENDS_AT)):
        folder = person.folder / name
        person.scene.bda.output_directory = str(folder)
        yield from run(person, last, stops=name == "stopped")
        yield from shows_the_run(person, f"{name}, as it was run", folder)
        hint = module("ui.scenario.hints").next_step(person.scene)
        person.expect(f"{name}: what is next is said", "Run again" in hint, name == "stopped")
        yield from select_and_undo(person, f"{name}, after Ctrl-Z", folder)
        yield from redo(person)
        yield from shows_the_run(person, f"{name}, after Ctrl-Shift-Z", folder)
    yield from another_bridge(person, folder)
    yield from stop_a_run_beside(person, panels)
    yield from nothing_built(person)
    person.take_reports()


def run(person: Person, last: int, *, stops: bool) -> Steps:
    """Run up to a frame, and press Esc there, or let it end."""
    person.scene.frame_end = person.scene.frame_end if stops else last
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 60.0)
    if stops:
        yield from person.wait_for("some frames are over", lambda: person.scene.frame_current >= last, 240.0)
        yield from person.move_to_view()
        yield from person.press("ESC")
    yield from person.wait_for("it is over", lambda: not something_goes_on(), 240.0)
    yield 0.5


def select_and_undo(person: Person, when: str, folder: Path) -> Steps:
    """Select twice, and take both back: the second time to before the run, which is no step of its own."""
    yield from person.move_to_view()
    yield from person.press("A", "a")
    yield 0.3
    yield from person.press("I", ctrl=True)  # select what is not
    yield 0.3
    for number in (1, 2):
        yield from undo(person)
        yield from person.picture(f"{folder.name}_undone_{number}")
        yield from shows_the_run(person, f"{when} {number}", folder)
    person.expect(f"{when} it can be reported", person.refusal("bda.make_report"), "")


def redo(person: Person) -> Steps:
    yield from person.move_to_view()
    yield from person.press("Z", ctrl=True, shift=True)
    yield 0.5


def shows_the_run(person: Person, when: str, folder: Path) -> Steps:
    """Drag through the timeline: bodies are where the file of results has them, and the ball is among them."""
    with np.load(folder / "results.npz") as arrays:
        numbers, positions_m, names = (arrays[name] for name in ("frames", "places_m", "body_names"))
    last = int(numbers[-1])
    apart = []
    for first, frame in ((last, 8), (8, last)):
        yield from drag_to_frame(person, first, frame)
        row = int(np.flatnonzero(numbers == person.scene.frame_current)[0])
        objects, graph = person.scene.rigidbody_world.collection.objects, person.window.view_layer.depsgraph
        shown = np.array([objects[name].evaluated_get(graph).matrix_world.translation for name in names])
        apart.append(np.abs(shown - positions_m[row]).max())
    fell_m = float(positions_m[0, names.tolist().index(BALL), 2] - positions_m[-1, names.tolist().index(BALL), 2])
    person.expect(f"{when}: the timeline is at the last frame", person.scene.frame_current, last)
    person.expect(f"{when}: bodies are where they were recorded", [round(float(gap), 3) for gap in apart], [0.0, 0.0])
    person.expect(f"{when}: the ball fell", fell_m > 0.1)
    shown_run = module("ui.results.shown_run").shown_run(person.scene)
    person.expect(f"{when}: the panel has this run", shown_run and shown_run.folder, folder)


def another_bridge(person: Person, folder: Path) -> Steps:
    """Build a thicker deck: no result of the first is shown beside it, and Ctrl-Z brings them back with it."""
    largest = module("ui.results.shown_run").shown_run(person.scene).peak_force
    person.scene.bda.scenario.bridge.deck.thickness_m += 0.1
    with person.in_sidebar():
        bpy.ops.bda.build_anew("INVOKE_DEFAULT")
    yield 1.0
    yield from person.picture("another_bridge")
    person.expect("there is a body of the same name", largest.body in person.scene.objects)
    for button in ("bda.go_to_body", "bda.open_results", "bda.draw_charts", "bda.export_run"):
        reason = person.refusal(button)
        person.expect(f"{button} says why it is greyed", "of another bridge than is built here" in reason)
    person.expect("there is nothing to report", bool(person.refusal("bda.render_run")))
    yield from undo(person)
    yield 0.5
    yield from shows_the_run(person, "after Ctrl-Z of Build Again", folder)
    yield from person.picture("the_first_again")
    person.expect("all of it is in view", out_of_sight(person, [(0.0, 0.0, 3.0), (8.0, 0.0, 3.0)]), [])


def stop_a_run_beside(person: Person, panels: Panels) -> Steps:
    """Change a value, and stop the run beside that is of it: what it has is shown as that of Run."""
    folder, runs = person.folder / "beside", module("ui.recording.ui").runs_beside
    person.scene.bda.output_directory = str(folder)
    person.scene.bda.scenario.bridge.deck.thickness_m += 0.1
    time = person.scene.bda.scenario.time
    time.duration_s, time.stop_at_rest = 60.0, False
    yield from panels.show_only("Run")
    yield from person.click("bda.run_beside")
    yield from person.wait_for("it runs", lambda: bool(runs.run and runs.run.state.frames), 240.0)
    yield from person.picture("run_beside")
    yield from person.click("bda.stop_run_beside")
    yield from person.wait_for("it is stopped", lambda: runs.run is None, 240.0)
    yield 0.5
    yield from person.picture("run_beside_stopped")
    yield from shows_the_run(person, "stopped beside", folder)
    yield from panels.show_only("Scenario")


def nothing_built(person: Person) -> Steps:
    """Press A and Delete: nothing stands and nothing runs."""
    yield from delete_all(person)
    person.expect("nothing stands", module("ui.scenario.hints").draws_verdict(person.scene), False)
    person.expect("Run says why it is greyed", "Nothing is left of what was built" in person.refusal("bda.run"))
    yield from person.picture("nothing_left")
