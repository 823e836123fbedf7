# SPDX-License-Identifier: GPL-3.0-or-later
"""Drag blast zones and their ends by the mouse, before the bridge is built and after it; see them fire one by one."""

from functools import partial
from typing import Any

import bpy
from dragging import handle_of, hold, look_at, on_screen
from habits import delete_all, go_to_start, undo
from panels import Panels
from person import Person, Steps
from traces import PRESETS, module, pixels_of, recording_runs

SCENARIO = PRESETS / "drilled_spans.toml"
NEAR_M, CLOSE_M = (13.0, 0.0, 2.0), 9.0
"""The foot of the middle pier, and from how far its zones are large enough to be dragged."""
ALL_M, FAR_M = (16.0, 0.0, 1.0), 38.0
"""All of the bridge, left of the sidebar."""

HIGHER_M, OFF_M = 0.5, 0.12
"""By how much zones are dragged, and how much of that Blender may take for a click before it drags."""
ARROW_PX = 30
"""From an end of a zone to the middle of its arrow."""
LEAST_SEEN = 0.0005
"""Least part of the screen that a drawing changes."""

MIDDLE_M, HEIGHT_M = 1.5, 1.5
"""Of all zones as they are loaded."""

BETWEEN_FRAME, BETWEEN = 23, {"P3.1: 600 ms", "P3.2: 600 ms"}
"""A frame between the zones of the first pier, at 0.8 s, and those of the third, at 1.1 s; what is left then."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    person.take_reports()
    with person.in_sidebar():
        # Without a path, which a picture would show, and with a step to undo to.
        bpy.ops.bda.load_preset("EXEC_DEFAULT", True, preset=SCENARIO.stem)
    yield 0.5
    person.expect("nothing is built", len(person.scene.objects), 0)
    yield from see_zones(person)
    look_at(person, NEAR_M, CLOSE_M)
    yield 0.5
    yield from drag_middle(person)
    yield from drag_ends(person)
    person.take_reports()
    yield from build(person)
    yield from change_after_building(person)
    yield from see_them_fire(person, panels)
    for drawing in (module("ui.preview.decorator").drawing, module("ui.ground.decorator").drawing):
        person.expect("all was drawn", drawing.error, "")


def see_zones(person: Person) -> Steps:
    """Boxes, holes and delays, in colours from the first to the last."""
    look_at(person, ALL_M, FAR_M)
    yield from person.picture("loaded")
    with_them = screen(person)
    person.scene.bda.overlays -= {"BLAST_ZONES"}
    yield from person.picture("without_zones")
    person.expect("zones are seen", (with_them != screen(person)).any(axis=1).mean() > LEAST_SEEN)
    person.scene.bda.overlays |= {"BLAST_ZONES"}
    texts = {part.text for part in drawn(person) if part.text}
    expected = {f"P{pier}.{column}: {delay} ms" for pier, delay in ((1, 300), (2, 0), (3, 600)) for column in (1, 2)}
    person.expect("each has its name and delay", texts, expected)
    colours = {tuple(part.colour[:3]) for part in drawn(person)}
    person.expect("and one colour for each of three delays", len(colours), 3)


def drag_middle(person: Person) -> Steps:
    """By the ring: up, and back by Ctrl-Z; again, and back by Esc."""
    before = handle_of(person, "ZONE").position_m
    end = on_screen(person, (*before[:2], before[2] + HIGHER_M))
    yield from hold(person, on_screen(person, before), end, partial(person.illustrate, "zone", person.view))
    yield 0.3
    expect_zone(person, "its ring moves a zone", MIDDLE_M + HIGHER_M, HEIGHT_M)
    person.expect("the list has chosen it", person.scene.bda.scenario.blast_zones_index, 0)
    yield from undo(person)
    expect_zone(person, "Ctrl-Z moves it back", MIDDLE_M, HEIGHT_M, off_m=1e-6)
    yield from hold(person, on_screen(person, before), end, partial(person.picture, "left"), leave_with="ESC")
    yield 0.3
    expect_zone(person, "Esc puts it back", MIDDLE_M, HEIGHT_M, off_m=1e-6)


def drag_ends(person: Person) -> Steps:
    """By the arrows: its end up, and its begin to below the ground, where the column ends."""
    yield from drag_end(person, "ZONE_END", HIGHER_M, 1)
    expect_zone(person, "the arrow at its end makes it higher", MIDDLE_M + HIGHER_M / 2.0, HEIGHT_M + HIGHER_M)
    yield from undo(person)
    expect_zone(person, "Ctrl-Z makes it as high as before", MIDDLE_M, HEIGHT_M, off_m=1e-6)
    yield from drag_end(person, "ZONE_BEGIN", -2.0, -1)
    expect_zone(person, "its begin stops at the foot of the column", 2.25 / 2.0, 2.25, off_m=1e-3)
    yield from undo(person)
    expect_zone(person, "Ctrl-Z lifts it again", MIDDLE_M, HEIGHT_M, off_m=1e-6)


def drag_end(person: Person, kind: str, by_m: float, way: int) -> Steps:
    x, y, z = handle_of(person, kind).position_m
    start, end = (on_screen(person, (x, y, height)) for height in (z, z + by_m))
    start, end = ((pixels[0], pixels[1] + way * ARROW_PX) for pixels in (start, end))
    yield from hold(person, start, end, partial(person.picture, kind.lower()))
    yield 0.3


def expect_zone(person: Person, what: str, middle_m: float, height_m: float, off_m: float = OFF_M) -> None:
    zone = person.scene.bda.scenario.blast_zones[0]
    found = f"its middle is {zone.middle_m:.3f} m, its height {zone.height_m:.3f} m"
    is_so = abs(zone.middle_m - middle_m) <= off_m and abs(zone.height_m - height_m) <= off_m
    person.note(what, "" if is_so else f"{found}, expected {middle_m} m and {height_m} m")


def build(person: Person) -> Steps:
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None)
    yield 1.0
    person.expect_reports("nothing but the building is reported", "65 shards")
    look_at(person, ALL_M, FAR_M)
    yield from person.picture("built")


def change_after_building(person: Person) -> Steps:
    """The handles are still there, and the panels say what is no longer as it was built."""
    look_at(person, NEAR_M, CLOSE_M)
    yield 0.5
    before = handle_of(person, "ZONE").position_m
    end = on_screen(person, (*before[:2], before[2] + HIGHER_M))
    yield from hold(person, on_screen(person, before), end, partial(person.picture, "dragged_when_built"))
    yield 0.5
    changed = [change.key for change in module("ui.scenario.built").changes(person.scene.bda)]
    person.expect("the panels say what has changed", changed, ["blast_zones.middle_m (number 1)"])
    yield from undo(person)
    expect_zone(person, "Ctrl-Z makes it as it was built", MIDDLE_M, HEIGHT_M, off_m=1e-6)
    person.expect("nothing has changed then", module("ui.scenario.built").changes(person.scene.bda), [])


def see_them_fire(person: Person, panels: Panels) -> Steps:
    """Run past the last zone, stop, and look at each frame again."""
    yield from panels.show_only("Run")
    yield from person.fill_in("output_directory", str(person.folder / "run"))
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    yield from person.wait_for("all zones fire", lambda: person.scene.frame_current >= 32, 300.0)
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("it stops", lambda: not recording_runs(), 30.0)
    yield 1.0
    look_at(person, ALL_M, FAR_M)
    person.expect("none is drawn any more", {part.text for part in drawn(person) if part.text}, set())
    person.scene.frame_set(BETWEEN_FRAME)
    yield from person.illustrate("firing", person.view)
    found = module("ui.preview.handles").handles(person.scene)
    person.expect("nothing is left to be dragged in them", [handle.name for handle in found], [])
    person.expect("those that fire last are left", {part.text for part in drawn(person) if part.text}, BETWEEN)
    yield from go_to_start(person)
    yield 0.5
    person.expect("at the start all are there again", len([part for part in drawn(person) if part.text]), 6)
    person.take_reports()


def drawn(person: Person) -> list[Any]:
    """What is drawn of the zones and of all else on the ground and in the air."""
    return list(module("ui.ground.decorator").drawn(person.scene, person.window.view_layer))


def screen(person: Person) -> Any:
    """The pixels (n, 3) of the last screenshot."""
    return pixels_of(sorted(person.folder.glob("*.png"))[-1])
