# SPDX-License-Identifier: GPL-3.0-or-later
"""Type a size and see the bridge before it is built; drag the ball's target, its height and a charge; undo."""

from functools import partial

import bpy
import numpy as np
from dragging import handle_of, hold, look_at, on_screen
from habits import delete_all, load, undo
from panels import Panels
from person import Person, Steps
from traces import module, pixels_of

FEW_PX = 6
"""That the mouse may be off what it has dragged: places are rounded to cm, and Blender starts to drag late."""

ARROW_PX = 40
"""From a place to the middle of the arrow above it."""

MIDDLE_M, FROM_M = (7.0, 0.0, 2.0), 24.0
"""What the view looks at, left of the sidebar, and from how far."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    person.take_reports()
    yield from load(person)
    yield 0.5
    look_at(person, MIDDLE_M, FROM_M)
    settings = person.scene.bda
    person.expect("nothing is built", len(person.scene.objects), 0)
    yield from person.picture("loaded")
    with_it = screen(person)
    settings.show_preview = False
    yield from person.picture("without_preview")
    without = screen(person)
    person.expect("the preview is seen", (with_it != without).any(axis=1).mean() > 0.002)
    settings.show_preview = True
    yield from panels.show_only("Sizes")
    width = settings.scenario.bridge.deck.width_m
    lines = preview(person)
    yield from person.picture("bridge_panel")
    settings.scenario.bridge.deck.width_m = 2.0 * width
    yield 0.3
    yield from person.picture("deck_twice_as_wide")
    person.expect("it is as wide as the deck", float(np.ptp(preview(person)[:, 1])) > float(np.ptp(lines[:, 1])))
    settings.scenario.bridge.deck.width_m = width
    person.take_reports()
    yield from drag_target(person)
    yield from drag_height(person)
    yield from drag_charge(person)
    yield from panels.show_only("Scenario")
    yield from after_building(person)
    drawing = module("ui.preview.decorator").drawing
    person.expect("all was drawn", drawing.error, "")


def drag_target(person: Person) -> Steps:
    ball = person.scene.bda.scenario.ball
    before, goal = tuple(ball.target_m), (ball.target_m[0] - 3.0, ball.target_m[1] - 0.8)
    start = handle_of(person, "TARGET", is_upright=False).position_m
    end = on_screen(person, (*goal, start[2]))
    yield from hold(person, on_screen(person, start), end, partial(person.picture, "target_dragged"))
    yield 0.5
    dropped = on_screen(person, handle_of(person, "TARGET", is_upright=False).position_m)
    person.expect("the target is under the mouse", np.abs(np.subtract(dropped, end)).max() <= FEW_PX)
    person.expect("the panel shows it", np.abs(np.subtract(ball.target_m, goal)).max() < 0.3)
    yield from undo(person)
    ball = person.scene.bda.scenario.ball
    person.expect("undo puts the target back", np.allclose(ball.target_m, before))
    yield from hold(
        person, on_screen(person, start), end, partial(person.picture, "target_dragged_and_left"), leave_with="ESC"
    )
    yield 0.3
    person.expect("Esc puts the target back", np.allclose(person.scene.bda.scenario.ball.target_m, before, atol=0.01))


def drag_height(person: Person) -> Steps:
    before = person.scene.bda.scenario.ball.drop_height_m
    x, y, z = handle_of(person, "DROP", is_upright=True).position_m
    start, end = (on_screen(person, (x, y, height)) for height in (z, z + 1.0))
    start, end = ((position[0], position[1] + ARROW_PX) for position in (start, end))
    yield from hold(person, start, end, partial(person.picture, "height_dragged"))
    yield 0.3
    risen = person.scene.bda.scenario.ball.drop_height_m - before
    person.note("the ball hangs 1 m higher", "" if 0.8 < risen < 1.2 else f"it hangs {risen} m higher")
    yield from undo(person)
    person.expect("undo lowers it again", abs(person.scene.bda.scenario.ball.drop_height_m - before) < 1e-3)


def drag_charge(person: Person) -> Steps:
    person.scene.cursor.location = (1.0, -1.0, 1.0)
    with person.in_sidebar():
        bpy.ops.bda.add_source_point()  # at the cursor, where a script does it
        bpy.ops.ed.undo_push(message="Charge added")  # which Blender leaves out where a script does it
    yield 0.5
    charge = bpy.data.objects["Charge 1"]
    charge.select_set(False)
    start, goal = (1.0, -1.0, 1.0), (3.0, -1.5, 1.0)
    yield from hold(
        person, on_screen(person, start), on_screen(person, goal), partial(person.picture, "charge_dragged")
    )
    yield 0.3
    position = tuple(bpy.data.objects["Charge 1"].location)
    person.note(
        "the charge is where it was dragged to", "" if np.allclose(position, goal, atol=0.3) else f"it is {position}"
    )
    yield from undo(person)
    position = tuple(bpy.data.objects["Charge 1"].location)
    person.expect("undo puts the charge back", np.allclose(position, start))
    person.take_reports()


def after_building(person: Person) -> Steps:
    yield from person.click("bda.build_scenario")
    yield 1.0
    person.expect_reports("nothing but the building is reported", "30 shards")
    person.expect("the preview has gone", len(preview(person)), 0)
    look_at(person, MIDDLE_M, FROM_M)
    yield from person.picture("built")
    x, y, z = handle_of(person, "TARGET", is_upright=False).position_m
    yield from hold(
        person,
        on_screen(person, (x, y, z)),
        on_screen(person, (x - 2.0, y, z)),
        partial(person.picture, "dragged_when_built"),
    )
    yield 0.5
    changed = module("ui.scenario.built").changes(person.scene.bda)
    person.expect("the panels say what was built", [change.key for change in changed], ["ball.target_m"])
    person.expect("the preview shows what would be built now", len(preview(person)) > 0)
    yield from person.picture("changed_since")


def preview(person: Person) -> np.ndarray:
    return module("ui.preview.decorator").preview_lines(person.scene.bda)


def screen(person: Person) -> np.ndarray:
    """The pixels (n, 3) of the last screenshot."""
    return pixels_of(sorted(person.folder.glob("*.png"))[-1])
