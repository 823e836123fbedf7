# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole work of docs/walkthrough.md, by mouse and keyboard: from a preset, which stands, to the report of its run.

After every step, what is in the scene and on disk is checked. Its pictures are those of the page.
"""

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from dragging import handle_of, hold, on_screen, out_of_sight
from file_browser import choose_file
from habits import delete_all, save_file, undo, undo_and_redo
from panels import Panels
from person import Person, Steps
from timeline import drag_to_frame, timeline
from traces import (
    PRESETS,
    colours,
    module,
    opened,
    recording_runs,
    rows,
    scenario_in,
    scenario_shown,
    something_goes_on,
)

PRESET = PRESETS / "drilled_spans.toml"
PRESET_KEY = "D"
"""The letter that is underlined in its name."""
ABOVE_PX = 30
"""From Build Scenario to Presets."""

SHARDS, DENSITY_KG_M3 = 65, 2400.0
VOLUME_M3 = 2 * 13.48 * 3.7 * 0.6 + 3 * 1.2 * 3.7 * 0.6 + 6 * 0.7 * 0.7 * 4.9
"""Two decks with an overhang at one end and half a joint at the other, three caps and six columns, by hand."""
CORNERS = tuple(product((-0.5, 26.5), (-1.85, 1.85), (0.0, 6.1)))
"""Of the bridge, by hand."""

WIDER_PX = 60
"""By how much the sidebar is made wider, so that its sentences have less lines."""
TURN_PX, NOTCHES_BACK = 100, 2
"""By how much the view is turned, so that the bridge lies across it, and how far back it is taken then."""

ZONE_M, HIGHER_M, OFF_M = 1.5, 0.5, 0.2
"""The middle of the first zone as it is loaded, by how much it is dragged, and what few pixels of the screen are."""

SHOWN_FRAMES = (20, 30, 45)
"""In which contours are looked at while it runs: all zones have fired in the last but one."""
DOWN_M = 4.5
"""Above the centres of all shards at the end, of which those of the decks lie on what is left of the piers."""
RUN_S = 1200.0
"""That a run may take on a machine with other work."""
COLOUR_NOISE = 0.02
"""Between a colour and the end of the colour map."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from empty_scene(person, panels)
    yield from choose_preset(person)
    yield from save_and_compare(person)
    settings = person.scene.bda
    settings.scenario_path = settings.loaded_path = ""  # pictures would show the path
    yield from change_density(person, panels)
    yield from build_bridge(person, panels)
    yield from move_a_zone(person)
    yield from show_contours(person, panels)
    yield from run(person, panels)
    check_results(person)
    yield from scrub(person)
    yield from look_at_results(person, panels)
    yield from make_report(person, panels)
    yield from undo_and_redo(person, SHARDS + 1)
    yield from save_what_was_changed(person, panels)


def empty_scene(person: Person, panels: Panels) -> Steps:
    """What Blender starts with is of no use here: A and Delete."""
    yield from delete_all(person)
    person.expect("A and Delete empty the scene", [obj.name for obj in person.scene.objects], [])
    width = person.sidebar.width
    yield from panels.widen(WIDER_PX)
    person.expect("dragging its edge makes the sidebar wider", person.sidebar.width >= width + WIDER_PX // 2)
    yield from panels.show_only("Scenario")
    yield from person.illustrate("sidebar", person.view)


def choose_preset(person: Person) -> Steps:
    """Presets, and one from the menu that opens."""
    yield from person.hover("bda.build_scenario")
    x, y = person.mouse
    yield from person.move(x, y + ABOVE_PX)
    yield from person.press("LEFTMOUSE")
    yield 1.0
    yield from person.illustrate("presets", person.view)
    yield from person.press(PRESET_KEY, PRESET_KEY.lower())
    yield 0.5
    person.expect("the panels show the preset", scenario_shown(person.scene).title, scenario_in(PRESET).title)
    yield from person.illustrate("preset", person.sidebar)


def save_and_compare(person: Person) -> Steps:
    """Save Scenario, at once: nothing is lost."""
    file = person.folder / "as_loaded.toml"
    yield from person.click("bda.save_scenario")
    yield from choose_file(person, file)
    person.expect("what was loaded is saved to the last digit", scenario_in(file), scenario_in(PRESET))
    person.expect_reports("nothing but deleting and saving is reported", "Deleted 3 object", f"Saved {file}")


def change_density(person: Person, panels: Panels) -> Steps:
    """Type into a field of Sizes."""
    bridge = person.scene.bda.scenario.bridge
    yield from panels.show_only("Sizes")
    yield from person.fill_in("density_kg_m3", f"{DENSITY_KG_M3:g}")
    yield from person.illustrate("bridge", person.sidebar)
    person.expect("the density is as typed", bridge.density_kg_m3, DENSITY_KG_M3)
    person.expect("nothing is built yet", person.scene.rigidbody_world is None)


def build_bridge(person: Person, panels: Panels) -> Steps:
    """Build the bridge, read that it stands, and have its load factor worked out."""
    yield from panels.show_only("Scenario")
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None, 60.0)
    yield 1.0
    world = person.scene.rigidbody_world
    shards = list(world.collection.objects)
    person.expect("shards and ground are in the world", len(shards), SHARDS + 1)
    person.expect("there are connections", len(world.constraints.objects) > SHARDS)
    person.expect("the view shows all of the bridge beside the sidebar", out_of_sight(person, CORNERS), [])
    mass = sum(shard.rigid_body.mass for shard in shards if shard.rigid_body.type == "ACTIVE")
    person.expect(
        "they weigh what the bridge does by hand", math.isclose(mass, VOLUME_M3 * DENSITY_KG_M3, rel_tol=1e-4)
    )
    person.expect_reports("nothing but the building is reported", f"{SHARDS} shards")
    yield from turn_view(person)
    yield from person.illustrate("built", person.view)
    yield from person.click("bda.does_it_stand")
    yield 1.0
    person.expect_reports("it stands, and how much more it carries is reported", "load factor")
    yield from person.illustrate("stands", person.sidebar)
    kept = module("scene.as_built").kept_stability(person.scene)
    person.expect("its verdict is kept with the scene", kept["verdict"], "stands")


def turn_view(person: Person) -> Steps:
    """With the middle button and the wheel."""
    x, y = person.view.x + 300, person.view.y + 150
    yield from person.drag((x, y), (x + TURN_PX, y), button="MIDDLEMOUSE")
    for _ in range(NOTCHES_BACK):
        yield from person.press("WHEELDOWNMOUSE")
    yield 0.5


def move_a_zone(person: Person) -> Steps:
    """Drag a zone up by its ring, and take that back."""
    before = handle_of(person, "ZONE").position_m
    end = on_screen(person, (*before[:2], before[2] + HIGHER_M))
    yield from hold(person, on_screen(person, before), end, partial(person.picture, "zone_dragged"))
    yield 0.5
    risen = person.scene.bda.scenario.blast_zones[0].middle_m - ZONE_M
    person.note("its ring lifts a zone", "" if abs(risen - HIGHER_M) < OFF_M else f"it rose by {risen} m")
    yield from undo(person)
    person.expect("Ctrl-Z puts it back", round(person.scene.bda.scenario.blast_zones[0].middle_m, 6), ZONE_M)
    person.expect("so that the panels show what is built", module("ui.scenario.built").changes(person.scene.bda), [])
    person.take_reports()


def show_contours(person: Person, panels: Panels) -> Steps:
    yield from panels.show_only("Contours")
    yield from person.click("contours")
    yield 0.5
    person.expect("Contours is ticked", person.scene.bda.contours)
    person.expect("Logarithmic is ticked from the start", person.scene.bda.contour_logarithmic)
    yield from person.illustrate("post_processing", person.sidebar)
    person.expect_reports("nothing is reported")


def run(person: Person, panels: Panels) -> Steps:
    """Choose a folder and click Run; contours and progress meanwhile; pictures at its end."""
    yield from panels.show_only("Run")
    save_file(person)
    yield from person.fill_in("output_directory", "//results")
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    shown = []
    for frame in SHOWN_FRAMES:
        yield from person.wait_for(f"frame {frame} is reached", lambda: person.scene.frame_current >= frame, 300.0)  # noqa: B023
        shown.append(colours(person, shown=True))
        if frame == SHOWN_FRAMES[0]:
            yield from person.illustrate("running", person.view, person.status_bar)
        if frame == SHOWN_FRAMES[-1]:
            yield from person.illustrate("playing", person.view)
    person.expect("contours change meanwhile", bool((shown[0] != shown[-1]).any()))
    yield from person.wait_for("it ends and takes its pictures", lambda: not something_goes_on(), RUN_S)
    yield 1.0
    yield from person.illustrate("at_rest", person.view)
    reports = person.take_reports()
    ends = ("Results are in", "Pictures of the run are in")
    person.expect(
        "results and pictures are reported", [any(end in line for line in reports) for end in ends], [True] * 2
    )
    person.expect("nothing says that it falls by itself", [line for line in reports if "by itself" in line], [])


def check_results(person: Person) -> None:
    folder = person.folder / "results"
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    person.expect("the run is complete", summary["completed"])
    person.expect("it stands before", (summary["stability"]["verdict"], summary["fell_by_itself"]), ("stands", None))
    person.expect("and comes to rest", summary["came_to_rest_s"] is not None)
    person.note(f"it rests from {summary['came_to_rest_s']} s on, and ends after {summary['simulated_s']} s")
    debris = rows(folder / "debris_log.csv")
    last = max(int(row["frame"]) for row in debris)
    heights = [float(row["z_m"]) for row in debris if int(row["frame"]) == last and row["body"].startswith("Shard")]
    trouble = "" if max(heights) < DOWN_M else f"one is {max(heights)} m high"
    person.note(f"all shards are down, the highest at {max(heights):.2f} m", trouble)
    breaking = rows(folder / "breaking_log.csv")
    names = {obj.name for obj in person.scene.rigidbody_world.constraints.objects}
    person.expect("connections break", len(breaking) > 0)
    broken = {row["connection"] for row in breaking} & names
    person.expect("each once, and those of the scene", len(broken), len(breaking))
    person.expect("as many as the summary says", summary["connections"]["broken"], len(breaking))
    pictures = sorted(path.name for path in (folder / "frames").glob("*.png"))
    person.expect("there are three pictures", pictures, ["after.png", "before.png", "impact.png"])


def scrub(person: Person) -> Steps:
    """Drag along the timeline: positions and colours are those of each frame."""
    log = rows(person.folder / "results" / "debris_log.csv")
    end = max(int(row["frame"]) for row in log)
    yield from drag_to_frame(person, 5, end)
    person.note(f"dragging in the timeline goes to frame {person.scene.frame_current} of {end}")
    yield from person.picture("scrubbed_to_the_end")
    late = colours(person, shown=True)
    person.scene.frame_set(end)
    yield 0.5
    graph = person.window.view_layer.depsgraph
    positions = {
        obj.name: np.array(obj.evaluated_get(graph).matrix_world.translation)
        for obj in person.scene.rigidbody_world.collection.objects
    }
    last = {row["body"]: row for row in log if int(row["frame"]) == end}
    apart = [
        np.linalg.norm(positions[name] - [float(row[f"{axis}_m"]) for axis in "xyz"]) for name, row in last.items()
    ]
    person.expect("bodies lie where the debris log says", max(apart, default=math.inf) < 1e-3)
    yield from drag_to_frame(person, end, SHOWN_FRAMES[0])
    off = abs(person.scene.frame_current - SHOWN_FRAMES[0])
    person.note("and back", "" if off <= 1 else f"to frame {person.scene.frame_current}")
    yield from person.illustrate("scrubbed", person.view, timeline(person))
    person.expect("colours follow", bool((colours(person, shown=True) != late).any()))


def look_at_results(person: Person, panels: Panels) -> Steps:
    """The largest force, and the button that leads there; charts; the folder."""
    yield from panels.show_only("Results")
    yield from person.click("bda.go_to_body")
    yield 0.5
    log = rows(person.folder / "results" / "force_log.csv")
    shards = [row for row in log if row["body"].startswith("Shard")]
    largest = max(shards, key=lambda row: float(row["peak_force_N"]))
    active = person.window.view_layer.objects.active
    person.expect(
        "the button leads to the body that has the largest peak force in the log", active.name, largest["body"]
    )
    person.expect("and to its frame", person.scene.frame_current, int(largest["frame"]))
    yield from person.illustrate("results", person.view)
    person.scene.bda.contour_peak = True
    yield 0.5
    bodies = list(person.scene.rigidbody_world.collection.all_objects)
    shown, scale = colours(person, shown=True)[bodies.index(active)], module("display.colour_scale")
    end = scale.linear(scale.colours(scale.ColourMap.VIRIDIS, np.ones(1)))[0]
    is_at_end = bool(abs(shown[:3] - end).max() < COLOUR_NOISE)
    person.expect("among the peaks so far that body is at the upper end of the scale", is_at_end)
    person.scene.bda.contour_peak = False
    yield from person.click("bda.draw_charts")
    yield from person.wait_for("there are charts", lambda: len(list(charts(person))) > 1, 300.0)
    yield from person.wait_for("all are drawn", lambda: module("ui.task_progress").going_on() is None, 300.0)
    yield 1.0
    person.expect_reports("nothing but the charts is reported", f"charts are in {person.folder / 'results' / 'charts'}")
    yield from person.click("bda.open_results")
    yield 0.5
    person.expect("the folder opens in the file manager", opened(), [str(person.folder / "results")])
    person.take_reports()


def charts(person: Person) -> Iterator[Path]:
    return (person.folder / "results" / "charts").glob("*.png")


def make_report(person: Person, panels: Panels) -> Steps:
    yield from panels.show_only("Report")
    yield from person.click("bda.make_report")
    folder = person.folder / "results"
    yield from person.wait_for("there is a report", lambda: (folder / "report.pdf").exists(), 400.0)
    yield 2.0
    person.expect(
        "both as a page and as PDF",
        [(folder / name).exists() for name in ("report.html", "report.pdf")],
        [True] * 2,
    )
    person.expect_reports("nothing but the report is reported", "Report: ")
    yield from person.picture("report")


def save_what_was_changed(person: Person, panels: Panels) -> Steps:
    """Save Scenario once more, with a name of its own; load it again."""
    yield from panels.show_only("Scenario")
    file = person.folder / "my_bridge.toml"
    yield from person.click("bda.save_scenario")
    yield from choose_file(person, file)
    found = scenario_in(file)
    person.expect("everything else is saved as it was loaded", found, as_typed(scenario_in(PRESET)))
    yield from person.click("bda.load_scenario")
    yield 0.5
    person.expect("loading it again changes nothing", scenario_shown(person.scene), found)
    person.expect_reports("nothing but saving and loading is reported", "Saved", "Loaded")


def as_typed(scenario: Any) -> Any:
    """A scenario with what was typed into the panels."""
    return replace(scenario, bridge=replace(scenario.bridge, density_kg_m3=DENSITY_KG_M3))
