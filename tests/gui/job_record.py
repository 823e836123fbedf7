# SPDX-License-Identifier: GPL-3.0-or-later
"""Build a scenario, record it while the timeline plays, read the results; then once more."""

import json
import math

import numpy as np
from habits import build, go_to_start, play_or_pause, register
from panels import Panels
from person import Person, Steps
from traces import handlers, recording_runs, rows

FILES = ("summary.json", "force_log.csv", "debris_log.csv", "results.npz", "force_over_time.png")


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    yield from person.picture("sidebar")
    panels = Panels(person)
    yield from build(person)
    yield from panels.show_only("Record by Hand")
    yield from person.picture("built")
    check_scene(person)

    results = person.folder / "results"
    yield from register(person, results)
    yield from person.picture("registered")
    check_registered(person)

    yield from play_once_around(person, results / "force_log.csv")
    yield from person.picture("played")
    recorded = rows(results / "force_log.csv")
    check_recorded(person, recorded)

    yield from person.click("bda.unregister_handler")
    yield 2.0
    yield from person.picture("unregistered")
    check_results(person, results)

    yield from go_to_start(person)
    again = person.folder / "again"
    yield from register(person, again)
    person.take_reports()
    yield from play_once_around(person, again / "force_log.csv")
    yield from person.click("bda.unregister_handler")
    yield 2.0
    yield from person.picture("recorded_again")
    person.expect("a second recording gives the same log", rows(again / "force_log.csv") == recorded)
    check_results(person, again)


def play_once_around(person: Person, log) -> Steps:
    """Play from the first frame past the last one, and look at the log at every turn."""
    sizes, frames = [], [person.scene.frame_current]
    yield from play_or_pause(person)
    person.expect("the space bar plays", person.playing)
    while frames[-1] >= frames[-2 if len(frames) > 1 else -1] and len(sizes) < 1000:
        if log.exists():
            sizes.append(len(rows(log)))
        frames.append(person.scene.frame_current)
        if len(frames) == 20:
            yield from person.picture("playing")
        yield
    yield 0.5
    yield from play_or_pause(person)
    person.expect("the space bar pauses", not person.playing)
    person.expect("the log grows while playing, by whole lines", len(set(sizes)) > 5 and sizes == sorted(sizes))


def check_scene(person: Person) -> None:
    world = person.scene.rigidbody_world
    person.expect("there is a rigid-body world", world is not None)
    person.expect("30 shards, ball and ground are in it", len(world.collection.objects), 32)
    person.expect("connections are in it", len(world.constraints.objects) > 30)
    person.expect("the timeline is as long as the scenario", person.scene.frame_end, 38)
    person.expect_reports("nothing but the building is reported", "30 shards")


def check_registered(person: Person) -> None:
    person.expect("every handler is registered once", set(handlers().values()), {1})
    person.expect_reports("nothing but the registering is reported", "Recording to")


def check_recorded(person: Person, log: list[dict[str, str]]) -> None:
    frames = [int(row["frame"]) for row in log]
    times = dict(zip(frames, (float(row["time_s"]) for row in log), strict=True))
    person.expect("every frame after the first is in the log", sorted(set(frames)), list(range(2, 39)))
    person.expect("every frame has a line for every body", len(frames), 37 * 32)
    person.expect("no time has passed in the frame that makes the world", times[2], 0.0)
    person.expect("the time of the last frame is the scenario's", math.isclose(times[38], 1.5, rel_tol=1e-6))
    forces = np.array([[float(row[name]) for name in row if "force" in name] for row in log])
    person.expect("all forces are numbers", bool(np.isfinite(forces).all()))
    person.expect("there are forces", bool(forces.any()))


def check_results(person: Person, folder) -> None:
    person.expect("no recording runs", recording_runs(), False)
    person.expect("all files are there", [name for name in FILES if not (folder / name).exists()], [])
    person.expect_reports("what creeps and the results are reported", "creeps at the end", f"Results are in {folder}")
    if not (folder / "results.npz").exists():
        return
    with np.load(folder / "results.npz") as arrays:
        person.expect("results have every frame", arrays["frames"].tolist(), list(range(2, 39)))
        person.expect("results have no unknown force", bool(np.isfinite(arrays["connection_forces_n"]).all()))
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    person.expect("the summary has the scenario's title", summary["title"], "Small bridge, wrecking ball")
    person.expect("connections break", summary["connections"]["broken"] > 0)
