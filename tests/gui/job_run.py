# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a scenario of 200 shards in one go; Esc stops; then to the end, answering all the time; bake."""

import json

import bpy
import numpy as np
from habits import build, delete_all
from panels import Panels
from person import Person, Steps
from pulse import Pulse, judge
from traces import CHECKOUT, EXTENSION, handlers, recording_runs, rows, something_goes_on

SCENARIO = CHECKOUT / "examples" / "report_2019" / "i235_one_span.toml"
SHARDS = 200


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    yield from build(person, SCENARIO)
    yield from panels.show_only("Run")
    person.expect_reports("nothing but the building is reported", "Deleted 3 object", f"{SHARDS} shards")
    yield from stop_with_escape(person)
    yield from run_to_the_end(person)
    yield from bake(person, panels)
    yield from panels.show_only("Run")
    yield from switch_off_while_it_runs(person)


def run(person: Person, name: str) -> Steps:
    """Give a folder, and click Run."""
    yield from person.fill_in("output_directory", str(person.folder / name))
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 10.0)


def stop_with_escape(person: Person) -> Steps:
    yield from run(person, "stopped")
    yield from person.wait_for("it runs up to frame 20", lambda: person.scene.frame_current >= 20, 60.0)
    yield from person.picture("running")
    person.expect("Esc alone stops it", person.refusal("bda.unregister_handler"), "Run is at work: Esc stops it")
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("it stops", lambda: not recording_runs(), 10.0)
    yield 1.0
    stopped = person.scene.frame_current
    person.expect("it stops before the end", stopped < person.scene.frame_end)
    person.expect_reports(
        "that it stopped is reported", "Stopped after", "says nothing of the outcome", "Results are in"
    )
    summary = json.loads((person.folder / "stopped" / "summary.json").read_text(encoding="utf-8"))
    person.expect("the results say so", not summary["completed"])
    yield from person.picture("stopped")
    yield 0.5
    person.expect("it stays stopped", person.scene.frame_current, stopped)


def run_to_the_end(person: Person) -> Steps:
    folder = person.folder / "results"
    yield from run(person, "results")
    pulse = Pulse()
    undone = False
    while recording_runs():
        yield
        if person.scene.frame_current > 15 and not undone:
            yield from person.press("Z", ctrl=True)
            undone = True
    pulse.stop()
    yield from person.wait_for("its pictures are taken", lambda: not something_goes_on(), 60.0)
    yield 1.0
    yield from person.picture("run")
    person.expect("undo does nothing meanwhile", person.scene.frame_current, person.scene.frame_end)
    for what, waits in pulse.waits().items():
        judge(person, what, waits[:-1])  # the last one is that for the results and their chart
        person.note(f"writing the results kept {what} waiting for {waits[-1, 0]:.2f} s")
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    person.expect("the run is complete", summary["completed"])
    with np.load(folder / "results.npz") as arrays:
        person.expect("results have every frame", arrays["frames"].tolist(), list(range(2, person.scene.frame_end + 1)))
    person.expect("no recording runs", recording_runs(), False)
    person.expect_reports(
        "what moves, what creeps and the results are reported",
        "still move at the end",
        "creep at the end",
        "Results are in",
        "Pictures of the run are in",
    )


def bake(person: Person, panels: Panels) -> Steps:
    yield from panels.show_only("Record by Hand")
    yield from person.click("bda.bake")
    yield 0.5
    world = person.scene.rigidbody_world
    person.expect("it is baked", world.point_cache.is_baked)
    yield from person.picture("baked")
    person.scene.frame_set(person.scene.frame_end)
    yield 0.5
    last = {row["body"]: row for row in rows(person.folder / "results" / "debris_log.csv")}
    graph = person.window.view_layer.depsgraph
    apart = [
        np.linalg.norm(
            np.array(obj.evaluated_get(graph).matrix_world.translation)
            - [float(last[obj.name][f"{axis}_m"]) for axis in "xyz"]
        )
        for obj in world.collection.objects
    ]
    person.expect("the bake leaves bodies where the debris log says", max(apart) < 1e-3)
    yield from person.click("bda.delete_bake")
    yield 0.5
    person.expect("the bake is deleted", not world.point_cache.is_baked)
    person.expect_reports("nothing but the bake is reported", "Baked: ")


def switch_off_while_it_runs(person: Person) -> Steps:
    yield from run(person, "switched_off")
    yield from person.wait_for("it runs again", lambda: person.scene.frame_current >= 8)
    bpy.ops.preferences.addon_disable(module=EXTENSION)
    yield 1.0
    yield from person.picture("switched_off_while_running")
    person.expect("no handler is left after switching off", dict(handlers()), {})
