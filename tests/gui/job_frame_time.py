# SPDX-License-Identifier: GPL-3.0-or-later
"""A frame of the drilled example takes as long in the window as it takes the command line in the same Blender."""

import json
import subprocess
import sys
from pathlib import Path

import bpy
from frame_times import FRAMES, FrameTimes
from habits import build, delete_all
from person import Person, Steps
from traces import CHECKOUT, module, recording_runs, something_goes_on

SCENARIO = CHECKOUT / "examples" / "drilled" / "two_spans.toml"
MOST = 1.1
"""Over that of the command line."""
PATIENCE_S = 1500.0


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    yield from delete_all(person)
    person.scene.bda.pictures_of_run = False
    person.scene.bda.output_directory = str(person.folder / "window")
    yield from build(person, SCENARIO)
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None, 120.0)
    times = FrameTimes(module("simulation.playback"))
    alone = without_window(person.folder / "alone")  # both at once, as other work slows both down
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 120.0)
    yield from person.wait_for("its frames are played", lambda: len(times.work_s) >= FRAMES, PATIENCE_S)
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("it is over", lambda: not something_goes_on(), 120.0)
    yield from person.wait_for("the other is over", lambda: alone.poll() is not None, PATIENCE_S)
    person.expect("it ended well", alone.returncode, 0)
    others_s = json.loads((person.folder / "alone" / "times.json").read_text(encoding="utf-8"))
    ratio = sum(times.counted_s) / sum(others_s)
    said = f"{len(others_s)} frames take {sum(times.counted_s):.2f} s in the window, {sum(others_s):.2f} s without"
    person.note(f"{said}: {ratio:.3f} times as long", "" if ratio < MOST else "too long")
    person.take_reports()


def without_window(folder: Path) -> subprocess.Popen[bytes]:
    """Run the scenario in another process of this Blender, with one thread, as runs without pictures have.

    Blender without preferences knows neither the extension nor its libraries, and gets the paths of both.
    """
    folder.mkdir()
    paths = [str(Path(module("errors").__file__).parents[1]), *sys.path]
    start = f"import sys; sys.path += {paths!r}; from frame_times import main; main({str(SCENARIO)!r}, {str(folder)!r})"
    alone = (bpy.app.binary_path, "--background", "--factory-startup", "--threads", "1", "--python-exit-code", "1")
    with (folder / "said.txt").open("wb") as said:
        return subprocess.Popen([*alone, "--python-expr", start], stdout=said, stderr=said)
