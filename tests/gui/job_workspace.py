# SPDX-License-Identifier: GPL-3.0-or-later
"""The first help, the workspace BDA by one click, and a chart in it."""

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


def tab(person: Person) -> str:
    """The tab of the sidebar of the workspace; none before it is shown."""
    return person.sidebar.active_panel_category if person.window.workspace.name == "BDA" else ""
