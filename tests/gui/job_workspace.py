# SPDX-License-Identifier: GPL-3.0-or-later
"""The first help, the workspace BDA by one click, charts in it, and from a peak in a chart to its frame and shard."""

from pathlib import Path

import bpy
from habits import build
from panels import Panels
from person import Person, Steps
from traces import module, opened, recording_runs, something_goes_on


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from person.picture("first_help")
    yield from person.click("bda.open_walkthrough")
    yield 0.5
    person.expect(
        "the walkthrough is opened", [address.rpartition("/")[2] for address in opened()], ["walkthrough.html"]
    )
    yield from build(person)
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    yield from person.wait_for("it is over", lambda: not something_goes_on(), 120.0)
    yield 0.5
    person.expect("the run's own chart is there", chart(person).parent.name != "charts")
    with person.in_sidebar():
        bpy.ops.bda.draw_charts("INVOKE_DEFAULT")
    yield from person.wait_for("the chart is drawn", lambda: module("ui.task_progress").going_on() is None, 60.0)
    yield from panels.show_only("Scenario")
    yield from panels.toggle_inner(0, "bda.import_ifc")  # Advanced
    yield from person.click("bda.make_workspace")
    yield from person.wait_for("the workspace opens at the tab BDA", lambda: tab(person) == "BDA", 20.0)
    person.expect("the workspace is shown", person.window.workspace.name, "BDA")
    kinds = {area.ui_type for area in person.window.screen.areas}
    person.expect("with bridge, charts and timeline", {"VIEW_3D", "IMAGE_EDITOR", "TIMELINE"} <= kinds)
    yield from person.picture("workspace")
    person.take_reports()
    person.expect("the chart of forces is shown", shown_picture(person), "force_over_time.png")
    view = next(area for area in person.window.screen.areas if area.type == "VIEW_3D").spaces.active
    person.expect("sidebar and no tools", (view.show_region_ui, view.show_region_toolbar), (True, False))
    yield from other_picture(person)
    yield from to_the_peak(person)
    yield from run_again(person)


def other_picture(person: Person) -> Steps:
    """Show the plan of the debris, then the chart again."""
    for name in ("debris_plan.png", "force_over_time.png"):
        path = next(path for path in module("ui.chart_pictures").pictures_of(person.scene) if path.name == name)
        with person.in_sidebar():
            bpy.ops.bda.show_picture(picture=str(path))
        yield 0.5
        person.expect(f"{name} is shown", shown_picture(person), name)
        yield from person.picture(name.partition(".")[0])


def to_the_peak(person: Person) -> Steps:
    """Click where the chart is highest: the frame and the shard of the peak force of Results."""
    largest = module("ui.results.shown_run").shown_run(person.scene).peak_force
    person.scene.frame_set(person.scene.frame_start)
    with person.in_sidebar():
        bpy.ops.bda.go_to_peak("INVOKE_DEFAULT")
    yield 0.5
    results = module("ui.results.shown_run").shown_run(person.scene).results()
    axis = module("charts.histories").TimeAxis.read(chart(person))
    time_s = float(results.frames.time_s[list(results.frames.number).index(largest.frame)])
    share = axis.left + (time_s - axis.begin_s) / (axis.end_s - axis.begin_s) * (axis.right - axis.left)
    area = next(area for area in person.window.screen.areas if area.type == "IMAGE_EDITOR")
    region = next(region for region in area.regions if region.type == "WINDOW")
    x, y = region.view2d.view_to_region(share, 0.5, clip=False)
    yield from person.move(region.x + x, region.y + y)
    yield from person.press("LEFTMOUSE")
    yield 1.0
    person.expect("the frame of the peak is shown", person.scene.frame_current, largest.frame)
    person.expect("its shard is chosen", person.window.view_layer.objects.active.name, largest.body)
    person.expect_reports("the peak is reported", f"kN on {largest.body}")
    yield from person.picture("at_the_peak")


def run_again(person: Person) -> Steps:
    """Run once more in the workspace: it shows the chart of that run."""
    before = chart(person)
    person.scene.bda.pictures_of_run = False
    with person.in_sidebar():
        bpy.ops.bda.run("INVOKE_DEFAULT")
    yield from person.wait_for("it runs again", recording_runs, 20.0)
    yield from person.wait_for("it is over again", lambda: not something_goes_on(), 120.0)
    yield 0.5
    area = next(area for area in person.window.screen.areas if area.type == "IMAGE_EDITOR")
    shown = Path(area.spaces.active.image.filepath)
    person.expect("the chart of the run that has just ended is shown", shown, chart(person))
    person.expect("which is another one", shown != before)
    yield from person.picture("run_again")
    person.take_reports()


def chart(person: Person) -> Path:
    """The chart of forces of the run."""
    return module("ui.chart_pictures").chart_of(person.scene)


def shown_picture(person: Person) -> str:
    """Name of the file that the image editor shows; none where it is empty."""
    area = next(area for area in person.window.screen.areas if area.type == "IMAGE_EDITOR")
    image = area.spaces.active.image
    return Path(image.filepath).name if image else ""


def tab(person: Person) -> str:
    """The tab of the sidebar of the workspace; none before it is shown."""
    return person.sidebar.active_panel_category if person.window.workspace.name == "BDA" else ""
