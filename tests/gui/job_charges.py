# SPDX-License-Identifier: GPL-3.0-or-later
"""Charges in the open, with the report of 2019 in hand: placed, recorded while the timeline plays, in logs by name.

After every step, what is in the scene and on disk is checked. Its pictures are those of docs/sidebar.md.
"""

import json
import math
from dataclasses import replace
from itertools import product
from typing import Any

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from file_browser import choose_file
from habits import delete_all, load, play_or_pause, register, save_file, undo_and_redo
from panels import Panels
from person import Person, Steps, region_of
from traces import PRESETS, charges, colours, recording_runs, rows, scenario_in

PRESET = PRESETS / "span_of_2019_explosives.toml"

SHARDS, DENSITY_KG_M3, BREAKING_N = 60, 2500.0, 300000.0
VOLUME_M3 = 14.0 * 8.5 * 0.4 + 2 * 1.0 * 8.5 * 0.6 + 4 * 0.7 * 0.7 * 4.9
"""Deck with its overhangs, two caps and four columns of the preset, by hand."""
FACE_ACROSS_M = 8.5 / 4.0 - 0.7 / 2.0
"""From the middle of the road to the inner face of a column, each in the middle of its half of the width."""

WEST, EAST = "West pier", "East pier"
MASS_KG, EAST_M, DELAY_S, EXPLOSIVE = 60.0, (13.0, 0.0, 1.0), 0.05, "C-4"
MASS, DELAY = '["bda_mass_kg"]', '["bda_delay_s"]'
LAST_FRAME = 74
FRAMES = range(2, LAST_FRAME + 1)

WIDER_PX = 250
"""By how much the sidebar is made wider to show all columns of the list of charges."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    yield from panels.show_only("Scenario")
    yield from load(person, PRESET)
    yield from save_and_compare(person)
    yield from change_values(person, panels)
    yield from build_bridge(person, panels)
    yield from place_charges(person, panels)
    yield from turn_view(person)
    yield from choose_logs(person, panels)
    yield from hide_and_undo(person, panels)
    yield from record(person, panels)
    check_logs(person)
    yield from undo_and_redo(person, SHARDS + 1)
    yield from save_what_was_changed(person, panels)


def save_and_compare(person: Person) -> Steps:
    """Save Scenario, at once: nothing is lost."""
    file = person.folder / "as_loaded.toml"
    yield from person.click("bda.save_scenario")
    yield from choose_file(person, file)
    person.expect("what was loaded is saved to the last digit", scenario_in(file), scenario_in(PRESET))
    person.expect_reports(
        "nothing but deleting, loading and saving is reported", "Deleted 3 object", "Loaded", f"Saved {file}"
    )


def change_values(person: Person, panels: Panels) -> Steps:
    """Type into fields of Sizes, Fracture and Connections."""
    scenario = person.scene.bda.scenario
    yield from panels.show_only("Sizes")
    yield from person.fill_in("density_kg_m3", f"{DENSITY_KG_M3:g}")
    yield from person.picture("bridge")
    person.expect("the density is as typed", scenario.bridge.density_kg_m3, DENSITY_KG_M3)
    yield from panels.show_only("Fracture")
    yield from person.fill_in("shards", str(SHARDS))
    yield from person.picture("fracture")
    person.expect("the number of shards is as typed", scenario.fracture.shards, SHARDS)
    yield from panels.show_only("Connections")
    yield from person.fill_in("breaking_force_n", f"{BREAKING_N:g}")
    yield from person.picture("connections")
    person.expect("the force is as typed", scenario.connections.breaking_force_n, BREAKING_N)
    person.expect("nothing is built yet", person.scene.rigidbody_world is None)


def build_bridge(person: Person, panels: Panels) -> Steps:
    """Delete the charges of the preset, and build the bridge."""
    yield from panels.show_only("Charges in the Open")
    for _ in range(3):
        yield from person.click("bda.delete_source_point")
    person.expect("Delete deletes the charges", charges(person.scene), ())
    person.expect("Delete is greyed then", "Choose a charge" in person.refusal("bda.delete_source_point"))
    yield from panels.show_only("Scenario")
    yield from person.click("bda.build_scenario")
    yield 1.0
    yield from person.picture("built")
    world = person.scene.rigidbody_world
    shards = list(world.collection.objects)
    person.expect("shards and ground are in the world", len(shards), SHARDS + 1)
    person.expect("there are connections", len(world.constraints.objects) > SHARDS)
    person.expect("the timeline is as long as the scenario", person.scene.frame_end, LAST_FRAME)
    person.expect("the view shows all of the bridge beside the sidebar", out_of_sight(person), [])
    mass = sum(shard.rigid_body.mass for shard in shards if shard.rigid_body.type == "ACTIVE")
    expected = VOLUME_M3 * DENSITY_KG_M3
    person.expect("they weigh what the bridge does by hand", math.isclose(mass, expected, rel_tol=1e-5))
    person.expect_reports("nothing but the building is reported", f"{SHARDS} shards")


def out_of_sight(person: Person) -> list[tuple[float, ...]]:
    """Corners of the bridge, by hand, that are not in the view, or behind the sidebar."""
    region = region_of(person.view, "WINDOW")
    corners = product((-0.5, 13.5), (-4.25, 4.25), (0.0, 5.9))
    seen = {corner: location_3d_to_region_2d(region, person.view.spaces.active.region_3d, corner) for corner in corners}
    right = person.sidebar.x - region.x
    return [
        label for label, at in seen.items() if at is None or not (0.0 < at.x < right and 0.0 < at.y < region.height)
    ]


def place_charges(person: Person, panels: Panels) -> Steps:
    """Add Charge, which is put at a pier; edit its row; drag it; a second by the cursor; and a third, to be deleted."""
    scene = person.scene
    yield from panels.show_only("Charges in the Open")
    yield from person.click("bda.add_source_point")
    x, y, z = charges(scene)[0].position_m
    at_face = math.isclose(abs(y), FACE_ACROSS_M, abs_tol=1e-5)
    person.expect("a charge is at a face of a column of the first pier, 1 m up", (x, at_face, z), (0.0, True, 1.0))
    scene.objects["Charge 1"].location = (0.0, 0.0, 0.0)
    yield from rename(person, "Charge 1", WEST)
    yield from person.fill_in(MASS, f"{MASS_KG:g}", of=WEST)
    yield from person.picture("row_edited")
    yield from person.move_to_view()
    yield from person.press("G", "g")
    yield from person.press("Z", "z")
    yield from person.write("1")
    yield from person.press("RET")
    yield 0.3
    found = charges(scene)[0]
    person.expect("it has the name and mass of the row", (found.name, found.mass_kg), (WEST, MASS_KG))
    person.expect("G Z 1 moves it up by a metre", found.position_m, (0.0, 0.0, 1.0))

    yield from cursor_to_the_deck(person)
    yield from person.click("bda.add_source_point")
    person.expect("the second is where the mouse was", charges(scene)[1].position_m, tuple(scene.cursor.location))
    yield from rename(person, "Charge 2", EAST)
    yield from person.fill_in(MASS, f"{MASS_KG:g}", of=EAST)
    yield from person.fill_in(DELAY, f"{DELAY_S:g}", of=EAST)
    yield from choose_explosive(person)
    yield from type_place(person)
    found = charges(scene)[1]
    expected = (EAST, MASS_KG, EXPLOSIVE, EAST_M)
    person.expect("its place is as typed", (found.name, found.mass_kg, found.explosive, found.position_m), expected)
    person.expect("its delay is as typed", math.isclose(found.delay_s, DELAY_S, rel_tol=1e-6))

    yield from person.click("bda.add_source_point")
    yield from person.picture("third")
    person.expect("there is a third", len(charges(scene)), 3)
    yield from person.click("bda.delete_source_point")
    person.expect("Delete deletes just that", [charge.name for charge in charges(scene)], [WEST, EAST])
    yield from person.click("bda.add_source_point")
    yield from person.move_to_view()
    yield from person.press("Z", ctrl=True)
    yield 0.5
    person.expect("Ctrl-Z takes one back", [charge.name for charge in charges(person.scene)], [WEST, EAST])

    yield from panels.widen(WIDER_PX)
    yield from person.picture("wide_list")
    yield from panels.widen(-WIDER_PX)

    yield from person.click("bda.build_force_objects")
    person.expect_reports("every shard gets a force field", f"{SHARDS} force fields made, 0 kept")
    yield from person.click("bda.show_total_mass")
    mass = f"{VOLUME_M3 * DENSITY_KG_M3:,.0f}".replace(",", " ")
    person.expect_reports("the total mass is that by hand", f"Total mass: {mass} kg")
    if not person.scene.bda.scenario.blast.explosion:
        yield from person.click("explosion")
    person.expect("Explosion is ticked", person.scene.bda.scenario.blast.explosion)
    yield from person.illustrate("charges", person.view)


def rename(person: Person, old: str, new: str) -> Steps:
    """Ctrl and a click on the name in the row, which is left of the mass."""
    yield from person.hover(MASS, of=old)
    yield from person.move(person.sidebar.x + person.sidebar.width // 8, person.mouse[1])
    yield 0.2
    yield from person.press("LEFTMOUSE", ctrl=True)
    yield from person.replace_text(new)
    yield from person.press("RET")
    yield 0.2


def cursor_to_the_deck(person: Person) -> Steps:
    """Shift and the right button of the mouse put the 3D cursor on what is under it."""
    region = region_of(person.view, "WINDOW")
    where = location_3d_to_region_2d(region, person.view.spaces.active.region_3d, (3.0, 1.0, 5.9))
    yield from person.move(region.x + round(where.x), region.y + round(where.y))
    yield from person.press("RIGHTMOUSE", shift=True)
    yield 0.3
    near = np.linalg.norm(np.array(person.scene.cursor.location) - (3.0, 1.0, 5.9)) < 0.3
    person.expect("Shift and a right click put the 3D cursor on the deck", bool(near))


def choose_explosive(person: Person) -> Steps:
    yield from person.click("charge_explosive")
    yield 0.3
    yield from person.picture("explosives")
    yield from person.press("C", "c")  # the letter that is underlined
    yield 0.3


def type_place(person: Person) -> Steps:
    """X, Y and Z, with the tabulator from one to the next."""
    yield from person.click("location")
    for number, key in zip(EAST_M, ("TAB", "TAB", "RET"), strict=True):
        yield from person.replace_text(f"{number:g}")
        yield from person.press(key)
    yield from person.move_to_view()
    yield 0.3
    yield from person.picture("typed")


def choose_logs(person: Person, panels: Panels) -> Steps:
    """Choose Debris Log and Choose Force Log, in the file browser."""
    yield from panels.show_only("Log Files")
    for name in ("debris", "force"):
        file = person.folder / f"my_{name}_log.csv"
        yield from person.click(f"bda.set_{name}_log")
        yield from choose_file(person, file)
        person.expect(f"the {name} log's file is as chosen", getattr(person.scene.bda, f"{name}_log_path"), str(file))
    yield from person.picture("log_files")
    yield from panels.show_only("Contours")
    yield from person.click("contours")
    yield 0.5
    person.expect("Contours is ticked", person.scene.bda.contours)
    person.expect("Logarithmic is ticked from the start", person.scene.bda.contour_logarithmic)
    yield from person.picture("contours")
    person.expect_reports("nothing is reported")


def record(person: Person, panels: Panels) -> Steps:
    """Start Recording, and play; contours and colour bar meanwhile."""
    yield from panels.show_only("Record by Hand")
    save_file(person)
    for name in ("debris", "force"):  # those that were chosen, as a picture shows them
        setattr(person.scene.bda, f"{name}_log_path", f"//my_{name}_log.csv")
    person.take_reports()
    yield from register(person, "//results")
    person.expect_reports("nothing but the registering is reported", "Recording to")
    yield 1.0  # Blender moves the panels below slowly
    yield from person.illustrate("registered", person.sidebar)
    log = person.folder / "my_force_log.csv"
    yield from play_or_pause(person)
    shown = []
    for frame in (20, 30, 45):
        yield from person.wait_for(f"frame {frame} is played", lambda: person.scene.frame_current >= frame, 90.0)  # noqa: B023
        shown.append(colours(person, shown=True))
        if frame == 30:
            yield from person.picture("playing")
    person.expect("contours change during play", bool((shown[0] != shown[-1]).any()))
    yield from person.wait_for("it plays to its end", lambda: person.scene.frame_current < 45, 90.0)
    yield from play_or_pause(person)
    person.expect("the space bar pauses", not person.playing)
    person.expect("the log grew while it played", len(rows(log)), len(FRAMES) * (SHARDS + 1))
    yield from person.click("bda.unregister_handler")
    yield 2.0
    yield from person.picture("unregistered")
    person.expect("no recording runs", recording_runs(), False)
    person.expect_reports(
        "the results are reported, that so coarse a bridge falls by itself, and that it still moves and creeps",
        "still move at the end",
        "The bridge does not stand by itself",
        "creep at the end",
        f"Results are in {person.folder / 'results'}",
    )


def check_logs(person: Person) -> None:
    folder = person.folder / "results"
    forces, debris = (rows(person.folder / f"my_{name}_log.csv") for name in ("force", "debris"))
    person.expect("every frame is in the force log", sorted({int(row["frame"]) for row in forces}), list(FRAMES))
    person.expect("those logs are not in the folder as well", list(folder.glob("*force_log.csv")), [])
    person.expect("all forces are numbers", all(math.isfinite(float(row["force_sum_N"])) for row in forces))
    bodies = {obj.name for obj in person.scene.rigidbody_world.collection.objects}
    person.expect("every body is in the debris log", {row["body"] for row in debris}, bodies)

    breaking = rows(folder / "breaking_log.csv")
    world = person.scene.rigidbody_world
    names = {obj.name for obj in world.constraints.objects}
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    person.expect("connections break", len(breaking) > 0)
    person.expect(
        "each once, and those of the scene", len({row["connection"] for row in breaking} & names), len(breaking)
    )
    person.expect("as many as the summary says", summary["connections"]["broken"], len(breaking))

    explosion = rows(folder / "explosion_log.csv")
    person.expect("both charges are in the explosion log", {row["charge"] for row in explosion}, {WEST, EAST})
    first = {name: min(float(row["time_s"]) for row in explosion if row["charge"] == name) for name in (WEST, EAST)}
    start, frame = person.scene.bda.scenario.blast.start_s, 1 / person.scene.render.fps
    person.expect("the first goes off at its start", start <= first[WEST] <= start + 2 * frame)
    person.expect("the second after its delay", start + DELAY_S <= first[EAST] <= start + DELAY_S + 2 * frame)


def turn_view(person: Person) -> Steps:
    """One notch of the wheel away from the bridge, and a bit to the right, where the colour bar does not hide it."""
    yield from person.move_to_view()
    yield from person.press("WHEELDOWNMOUSE")
    x, y = person.view.x + 200, person.view.y + 150
    yield from person.drag((x, y), (x + 60, y), button="MIDDLEMOUSE", shift=True)
    yield 0.3


def hide_and_undo(person: Person, panels: Panels) -> Steps:
    """Show Connections and Forces; undo that; show them again, and hide them."""
    yield from panels.show_only("Vectors and Charges")
    every = hidden_symbols(person)
    person.expect("connections and force fields are hidden at first", len(every) > SHARDS)
    person.expect("charges are seen", all(bpy.data.objects[name].visible_get() for name in (WEST, EAST)))
    yield from person.click("bda.toggle_symbols")
    yield 0.5
    person.expect("then all of them are seen", hidden_symbols(person), set())
    yield from person.move_to_view()
    yield from person.press("Z", ctrl=True)
    yield 1.0
    person.expect("Ctrl-Z hides them", hidden_symbols(person), every)
    yield from person.click("bda.toggle_symbols")
    yield 0.5
    person.expect("they are seen again", hidden_symbols(person), set())
    yield from person.illustrate("shown", person.view)
    yield from person.click("bda.toggle_symbols")
    yield 0.5
    person.expect("they are hidden again", hidden_symbols(person), every)
    person.expect_reports("nothing is reported")


def hidden_symbols(person: Person) -> set[str]:
    """Names of the connections and force fields that are not seen."""
    empties = [obj for obj in person.scene.objects if obj.type == "EMPTY" and obj.name not in (WEST, EAST)]
    return {empty.name for empty in empties if not empty.visible_get(view_layer=person.window.view_layer)}


def save_what_was_changed(person: Person, panels: Panels) -> Steps:
    """Save Scenario once more, with a name of its own."""
    yield from panels.show_only("Scenario")
    file = person.folder / "my_bridge.toml"
    yield from person.click("bda.save_scenario")
    yield from choose_file(person, file)
    found = scenario_in(file)
    person.expect(
        "everything else is saved as it was loaded", replace(found, charges=()), as_typed(scenario_in(PRESET))
    )
    for saved, placed in zip(found.charges, charges(person.scene), strict=True):
        person.expect(f"{placed.name} is saved", replace(saved, delay_ms=placed.delay_ms), placed)
        person.expect("with its delay", math.isclose(saved.delay_s, placed.delay_s, abs_tol=1e-9))
    person.expect_reports("nothing but saving is reported", "Saved")


def as_typed(scenario: Any) -> Any:
    """A scenario with what was typed into the panels, and no charges."""
    return replace(
        scenario,
        bridge=replace(scenario.bridge, density_kg_m3=DENSITY_KG_M3),
        fracture=replace(scenario.fracture, shards=SHARDS),
        connections=replace(scenario.connections, breaking_force_n=BREAKING_N),
        charges=(),
    )
