# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose a preset by its picture, and undo it; add a charge, which is put at a pier; and run beside Blender."""

from habits import build, undo
from panels import Panels
from person import Person, Steps
from traces import PRESETS, module, scenario_in, scenario_shown

FOURTH = PRESETS / "span_of_2019_ball.toml"
FOURTH_PX = (587, 460)
"""Where the fourth picture is in a window of 1280 x 800."""
ABOVE_PX = 100
"""From Build Scenario to the picture in the panel."""
PATIENCE_S = 300.0


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from choose_by_picture(person)
    yield from build(person)
    yield from run_beside(person, panels)
    yield from add_a_charge(person, panels)


def choose_by_picture(person: Person) -> Steps:
    """Click the picture in the panel, and one of those that open: it loads its preset, in one step of undo."""
    before = scenario_shown(person.scene)
    yield from person.hover("bda.build_scenario")
    x, y = person.mouse
    yield from person.move(x, y + ABOVE_PX)  # Blender does not say what is under the mouse there
    yield 1.0
    yield from person.picture("tooltip")
    yield from person.press("LEFTMOUSE")
    yield 2.0
    yield from person.picture("pictures")
    yield from person.move(*FOURTH_PX)
    yield 2.0
    yield from person.picture("tooltip_of_a_preset")
    yield from person.press("LEFTMOUSE")
    yield 1.0
    yield from person.picture("chosen")
    person.expect("the panels show the preset", scenario_shown(person.scene).title, scenario_in(FOURTH).title)
    yield from undo(person)
    yield 0.5
    person.expect("one undo takes it back", scenario_shown(person.scene).title, before.title)
    person.take_reports()


def run_beside(person: Person, panels: Panels) -> Steps:
    """Run Beside, and work on meanwhile: results are shown when it is over."""
    beside = module("ui.recording.ui").runs_beside
    yield from panels.show_only("Run")
    yield from person.fill_in("output_directory", str(person.folder / "beside"))
    yield from person.click("pictures_of_run")
    yield from person.click("bda.run_beside")
    yield from person.wait_for("it runs beside", lambda: beside.run is not None and beside.run.state.frames > 3, 120.0)
    yield from person.picture("beside")
    yield from person.wait_for("it ends", lambda: beside.run is None, PATIENCE_S)
    yield 1.0
    shown = module("simulation.blender_events").shown_results(person.scene)
    person.expect("its results are shown", shown.are_loaded)
    told = [message.text for message in module("ui.messages").messages_of(person.scene)]
    person.expect("where they are is said", told, [f"Results are in {person.folder / 'beside'}"])
    person.scene.frame_set(person.scene.frame_end)
    yield 1.0
    yield from person.picture("shown")
    person.take_reports()


def add_a_charge(person: Person, panels: Panels) -> Steps:
    """Add Charge: it is at a face of a pier, 1 m up, and not at the 3D cursor in the origin."""
    yield from panels.show_only("Charges in the Open")
    yield from person.click("bda.add_source_point")
    (charge,) = module("scene.blast.charges").charges_of(person.scene)
    person.expect("it is 1 m up", abs(charge.position_m[2] - 1.0) < 1e-5)
    person.expect("and near the ground", charge.burst, "surface")
    yield from person.picture("charge")
    person.take_reports()
