# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender as it starts to a demolition in 4 actions, and to a study that states a distance in 7.

N and the tab are two of them. Then Build Scenario and Run; or a preset by its picture, the panel Study in its group,
and Start. No folder or file is chosen.
"""

import math
from pathlib import Path

from panels import Panels, way_to
from person import Person, Steps
from traces import PRESETS, module, recording_runs, scenario_in, scenario_shown

PRESET = "reinforced_span_ball"
FRAMES = 12
ABOVE_PX = 100
"""From Build Scenario to the picture of the preset."""
SECOND_PRESET_PX = (400, 460)
"""Where the second of the pictures that it opens is, in a window of 1280 x 800."""


SIDEBAR_ACTIONS = 2
"""N, and the tab BDA."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from person.picture("first_look")
    yield from begin_a_study(person, panels)
    yield from panels.show_only("Scenario")
    yield from demolish(person)
    person.take_reports()


def demolish(person: Person) -> Steps:
    """Build Scenario and Run, which need no preset."""
    before = person.clicks
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None)
    yield from person.picture("built")
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    person.expect("so many actions to the first demolition", SIDEBAR_ACTIONS + person.clicks - before, 4)
    yield from person.wait_for("it plays", lambda: person.scene.frame_current >= FRAMES, 120.0)
    yield from person.picture("runs")
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("it stops", lambda: not recording_runs(), 20.0)
    yield 0.5
    yield from person.picture("results")
    study = Path(person.scene.bda.study_directory)
    kept = [folder for folder in study.parent.iterdir() if folder != study]
    person.expect("its results are in a folder named after it", [folder.name[-2:] for folder in kept], ["_1"])
    person.expect("with results in it", (kept[0] / "results.npz").is_file())


def begin_a_study(person: Person, panels: Panels) -> Steps:
    """A preset, and the study of it: the panel states the distance by itself once its runs are there (job study)."""
    before = person.clicks
    yield from choose(person)
    to_choose = person.clicks - before
    yield from panels.show_only("Study")  # a person clicks two headers: the group's, and the panel's in it
    before = person.clicks
    yield from person.click("bda.start_study")
    work = module("ui.ensemble.study").WORK
    yield from person.wait_for("the study begins", lambda: work.session is not None, 20.0)
    actions = SIDEBAR_ACTIONS + to_choose + len(way_to("Study")) + person.clicks - before
    person.expect("so many actions to a distance with its confidence", actions, 7)
    study, session = person.scene.bda.study, work.session
    person.expect("of which there will be one", session.planner.total >= least_runs(study.quantile, study.confidence))
    person.expect("in a folder of its own", Path(person.scene.bda.study_directory), session.folder.path)
    yield from person.picture("study")
    yield from person.click("bda.stop_study")
    yield from person.wait_for("Stop ends it", lambda: work.session is None, 20.0)


def least_runs(quantile: float, confidence: float) -> int:
    """How many runs set a limit by their largest value, by S. S. Wilks (1941): 1 - q^n is at least the confidence."""
    return math.ceil(math.log(1.0 - confidence) / math.log(quantile))


def choose(person: Person) -> Steps:
    """Click the picture, which is above Build Scenario, and the second of those that it opens."""
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
