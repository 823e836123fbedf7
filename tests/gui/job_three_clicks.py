# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender as it starts to a demolition that runs: a preset, Build Scenario, Run; no folder or file is chosen."""

from pathlib import Path

from person import Person, Steps
from traces import PRESETS, recording_runs, scenario_in, scenario_shown

PRESET = "reinforced_span_ball"
FRAMES = 12
ABOVE_PX = 30
"""From Build Scenario to Presets."""
SECOND_PRESET_PX = (695, 464)
"""Where the menu has its second name, in a window of 1280 x 800."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    yield from person.picture("first_look")
    yield from choose(person)
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None)
    yield from person.picture("built")
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    yield from person.wait_for("it plays", lambda: person.scene.frame_current >= FRAMES, 120.0)
    yield from person.picture("runs")
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("it stops", lambda: not recording_runs(), 20.0)
    yield 0.5
    yield from person.picture("results")
    kept = list((Path.home() / "Bridge Demolition").iterdir())
    person.expect("its results are in a folder named after it", [folder.name[-2:] for folder in kept], ["_1"])
    person.expect("with results in it", (kept[0] / "results.npz").is_file())
    person.take_reports()


def choose(person: Person) -> Steps:
    """Open the menu, which is above Build Scenario, and click the second of its presets."""
    yield from person.hover("bda.build_scenario")
    x, y = person.mouse
    yield from person.move(x, y + ABOVE_PX)
    yield from person.press("LEFTMOUSE")
    yield 1.0
    yield from person.picture("presets")
    yield from person.move(*SECOND_PRESET_PX)
    yield 0.3
    yield from person.press("LEFTMOUSE")
    yield 0.5
    shown, wanted = scenario_shown(person.scene), scenario_in(PRESETS / f"{PRESET}.toml")
    person.expect("the panels show the preset", shown.title, wanted.title)
