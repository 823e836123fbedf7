# SPDX-License-Identifier: GPL-3.0-or-later
"""Check stages, colour the bridge by them, undo that, and find the smallest drop in the panel Search."""

from pathlib import Path

from habits import build, delete_all
from panels import Panels
from person import Person, Steps
from pulse import Pulse, judge
from traces import module, rows

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "stages" / "excavator_on_the_deck.toml"
STAGES_S = 600.0
"""The example's stages take about a minute on one core; a machine may be busy."""
SEARCH_S = 300.0
LOWEST_M, HIGHEST_M = 0.05, 0.1
"""Drops that never bring a bridge down, so that the search ends after its opening trials."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    yield from build(person, EXAMPLE)
    person.expect_reports("nothing but the building is reported", "Deleted 3 object", "200 shards")
    yield from panels.show_only("Stages")
    yield from check_stages(person)
    yield from show_utilisation(person)
    yield from build_anew(person, panels)
    yield from search(person, panels)


def check_stages(person: Person) -> Steps:
    """Check Stages goes on beside the window, and tells of four stages."""
    tables = person.folder / "tables"
    refusal = person.refusal("bda.show_utilisation")
    person.expect("nothing to show yet", "Check the stages first" in refusal, True)
    yield from person.fill_in("stages_directory", str(tables))
    yield from person.click("bda.check_stages")
    pulse = Pulse()
    yield 0.5
    yield from person.picture("checking")
    found = module("ui.stages")
    yield from person.wait_for("the stages are there", lambda: found.checked_in(person.scene) is not None, STAGES_S)
    pulse.stop()
    for what, waits in pulse.waits().items():
        if len(waits):  # no timeline is played
            judge(person, what, waits)
    yield 0.5
    yield from person.picture("checked")
    told = rows(tables / "stages.csv")
    person.expect("four stages are in the table", [row["stage"] for row in told], ["1", "2", "3", "4"])
    factors = [float(row["collapse_factor"]) for row in told]
    person.expect("each is weaker than the one before", factors == sorted(factors, reverse=True))
    person.expect_reports("the tables are reported", "4 stages, with tables in")


def show_utilisation(person: Person) -> Steps:
    """Show Utilisation colours the shards before anything is run; another stage, other colours; undo takes it back."""
    view = module("ui.contours.view")
    person.scene.frame_set(20)
    yield from person.click("bda.show_utilisation")
    yield from person.move_to_view()
    yield 0.5
    yield from person.picture("stage_1")
    person.expect("contours are shown", person.scene.bda.contours, True)
    person.expect("of the bridge as it was built", person.scene.frame_current, person.scene.frame_start)
    scale = module("simulation.blender_events").contours_of(person.scene).shown_frame()[0].scale
    person.expect(
        "their range is linear from 0 to 100 % at least",
        (scale.logarithmic, scale.low, scale.high >= 1.0),
        (False, 0.0, True),
    )
    colours = shown_colours(person)
    person.expect("shards have several colours", len(colours) > 20, True)
    person.expect("nothing is in the way", view.refusal(person.scene), "")
    yield from person.fill_in("stage_shown", "3")
    yield from person.move_to_view()
    yield from person.picture("stage_3")
    person.expect("another stage has other colours", shown_colours(person) != colours, True)
    person.expect("the third stage is shown", module("simulation.blender_events").contours_of(person.scene).stage, 3)
    for _ in range(2):
        yield from person.press("Z", "z", ctrl=True)
        yield 0.5
    yield from person.picture("undone")
    person.expect("undo takes the contours back", person.scene.bda.contours, False)
    person.expect_reports("nothing is reported")


def shown_colours(person: Person) -> set[tuple[float, ...]]:
    """Colours that the shards have in the view."""
    graph = person.scene.view_layers[0].depsgraph
    shards = [body for body in person.scene.objects if body.name.startswith("Shard")]
    return {tuple(round(channel, 4) for channel in body.evaluated_get(graph).color) for body in shards}


def build_anew(person: Person, panels: Panels) -> Steps:
    yield from panels.show_only("Scenario")
    yield from person.fill_in("scenario_path", str(Path(__file__).with_name("small.toml")))
    yield from person.click("bda.load_scenario")
    yield 0.5
    person.take_reports()


def search(person: Person, panels: Panels) -> Steps:
    """Find Smallest Charge, along the drop of the ball, beside the window."""
    work = module("ui.ensemble.search").WORK
    yield from panels.show_only("Search")
    folder = person.folder / "search"
    yield from person.fill_in("search_directory", str(folder))
    yield from person.click("search_quantity")
    yield 0.3
    yield from person.picture("quantities")
    yield from person.press("D", "d")  # the letter that is underlined
    yield 0.3
    person.expect("the drop is chosen", person.scene.bda.search_quantity, "DROP_HEIGHT")
    for name, value in (("lowest", LOWEST_M), ("highest", HIGHEST_M)):
        yield from person.fill_in(name, f"{value:g}")
    yield from person.click("bda.start_search")
    person.expect_reports("the start is reported", f"The search runs in {folder}")
    yield from person.wait_for("a run ends", lambda: work.session.planner.done >= 1, SEARCH_S)
    yield from person.picture("at_work")
    yield from person.wait_for("the search ends", lambda: work.session is None, SEARCH_S)
    yield 1.0
    yield from person.picture("found")
    person.expect("nothing went wrong", work.why_ended, "")
    said = work.result.sentences[0]
    person.expect("it says what was seen", said.startswith("0 of 8 runs met all criteria"), True)
    person.expect("all runs are in the table", len(rows(folder / "trials.csv")), 8)
