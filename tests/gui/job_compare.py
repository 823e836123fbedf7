# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a bridge twice; show what came of it over the view, the first run beside the second, a section; undo, scrub."""

import bpy
import numpy as np
from habits import build, delete_all, undo
from panels import Panels
from person import Person, Steps
from traces import module, pixels_of, something_goes_on

WEAK_KGF, WEAKER_KGF = 2000.0, 300.0
SAME_M = 1e-3
LEAST_CHANGED = 0.01
"""Share of the window that another run beside this one changes at least."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    first, second = person.folder / "first", person.folder / "second"
    yield from build(person)
    person.scene.bda.scenario.connections.breaking_force_kgf = WEAK_KGF
    yield from run(person, first)
    person.scene.bda.scenario.connections.breaking_force_kgf = WEAKER_KGF
    yield from run(person, second)
    person.take_reports()
    person.scene.frame_set(person.scene.frame_end)
    yield from figures(person, panels)
    yield from compare(person, panels, first)
    yield from section(person, panels, second)


def run(person: Person, folder) -> Steps:
    """Build the scenario again and run it into a folder."""
    bpy.ops.bda.build_anew()
    person.scene.bda.output_directory, person.scene.bda.pictures_of_run = str(folder), False
    with person.in_sidebar():
        bpy.ops.bda.run("INVOKE_DEFAULT")
    yield 1.0
    yield from person.wait_for("the run is over", lambda: not something_goes_on(), 300.0)
    yield 0.5
    person.expect(f"{folder.name} has results", (folder / "results.npz").exists())


def figures(person: Person, panels: Panels) -> Steps:
    """Draw key figures over the view, go to another frame, select a shard, and take them away."""
    scene = person.scene
    scene.bda.scenario.use_exclusion, scene.bda.scenario.exclusion.buffer_m = True, 5.0
    yield from panels.show_only("Results")
    yield 0.5
    yield from person.picture("no_figures")
    scene.bda.figures_in_view = True
    yield 1.0
    yield from person.picture("figures")
    changed = share_changed(person, "no_figures", "figures")
    person.note(f"key figures change {changed:.1%} of the window", "" if changed > LEAST_CHANGED else "they are hidden")
    shown = module("ui.key_figures")
    at_end = shown.in_view(bpy.context)
    scene.frame_set(scene.frame_start + 10)
    shard = next(body for body in scene.rigidbody_world.collection.objects if body.name.startswith("Shard"))
    shard.select_set(True)
    bpy.context.view_layer.objects.active = shard
    yield 1.0
    yield from person.picture("figures_of_a_shard")
    then = shown.in_view(bpy.context)
    person.expect("they follow the timeline", then.lines != at_end.lines)
    person.expect("the force is that on the selected shard", then.force_text.startswith(f"{shard.name}: "))
    person.expect("nothing fails to be drawn", module("ui.key_figures").drawing.error, "")
    shard.select_set(False)
    scene.bda.figures_in_view, scene.bda.scenario.use_exclusion = False, False
    scene.frame_set(scene.frame_end)
    yield 0.5


def compare(person: Person, panels: Panels, first) -> Steps:
    """Show the first run beside the second, lay it over, undo, scrub and remove it."""
    bodies = len(person.scene.rigidbody_world.collection.all_objects)
    settings = person.scene.bda
    yield from panels.show_only("Compare")
    yield from person.picture("alone")
    person.expect("there is nothing to compare with yet", "Choose the folder" in person.refusal("bda.compare_run"))
    yield from person.fill_in("compared_directory", str(first))
    yield from person.click("bda.compare_run")
    yield 1.0
    person.expect_reports("the other run is reported", "m beside this run")
    yield from person.picture("beside")
    changed = share_changed(person, "alone", "beside")
    person.note(
        f"another run changes {changed:.1%} of the window", "" if changed > LEAST_CHANGED else "it is not to be seen"
    )
    person.expect("nothing fails to be drawn", module("ui.comparison.shown").drawing.error, "")
    shown = module("ui.comparison.shown")
    here = shown.drawn_run(person.scene)
    person.expect("it stands beside this run", settings.compared_shift_m > 4.0 and not here.is_over)
    person.scene.frame_set(person.scene.frame_start + 1)
    yield 0.5
    yield from person.picture("beside_at_the_start")
    moved = np.abs(shown.drawn_run(person.scene).triangles - here.triangles).max()
    person.expect("it follows the timeline", bool(moved > 1.0))
    person.scene.frame_set(person.scene.frame_end)
    settings.contours = True
    yield 1.0
    yield from person.picture("beside_with_contours")
    colours = len(np.unique(shown.drawn_run(person.scene).colours.round(3), axis=0))
    person.expect("it has the colours of contours", colours > 20)
    settings.contours = False
    yield 0.5
    yield from person.picture("beside_without_contours")
    yield from person.click("bda.lay_over")
    yield 0.5
    person.expect("the pile lies where it was recorded", farthest_from_record(person) < SAME_M)
    person.expect("it lies over this run", settings.compared_shift_m, 0.0)
    yield from person.picture("over")
    yield from undo(person)
    person.expect("Ctrl-Z takes it beside again", person.scene.bda.compared_shift_m > 4.0)
    yield from undo(person)
    yield from undo(person)
    person.expect("Ctrl-Z takes it away", person.scene.bda.compared_folder, "")
    yield from person.press("Z", ctrl=True, shift=True)
    yield 0.5
    yield from person.press("Z", ctrl=True, shift=True)
    yield 1.0
    person.expect("and Ctrl-Shift-Z brings it back", person.scene.bda.compared_folder, str(first.resolve()))
    yield from person.picture("redone")
    person.expect("the bridge has its bodies", len(person.scene.rigidbody_world.collection.all_objects), bodies)
    person.expect("it is drawn", module("ui.comparison.shown").drawn_run(person.scene) is not None)
    yield from person.click("bda.forget_compared")
    yield 0.5
    person.expect("it is gone by its button", module("ui.comparison.shown").drawn_run(person.scene), None)
    person.take_reports()


def section(person: Person, panels: Panels, second) -> Steps:
    """Put the plane at the cursor, look at it, and write it."""
    person.scene.frame_set(person.scene.frame_end)
    yield from panels.show_only("Section")
    yield from person.picture("no_section")
    person.scene.cursor.location = (4.0, 0.0, 0.0)
    yield from person.click("bda.section_at_cursor")
    yield 0.5
    settings = person.scene.bda
    person.expect("the plane is at the cursor", round(settings.section_place_m, 3), 4.0)
    yield from person.picture("section")
    changed = share_changed(person, "no_section", "section")
    person.note(f"the section changes {changed:.2%} of the window", "" if changed > 0.001 else "it is not to be seen")
    cut = module("ui.sections").section_of(person.scene)
    person.expect("the pile lies where it is cut", farthest_from_record(person) < SAME_M)
    person.expect("debris is cut", cut.debris_area_m2 > 0.1 and cut.debris_height_m > 0.1)
    yield from person.click("bda.look_at_section")
    yield 1.5
    yield from person.picture("section_from_before")
    person.expect("nothing fails to be drawn", module("ui.sections").drawing.error, "")
    yield from person.click("bda.write_section")
    yield 1.0
    person.expect_reports("the files are reported", "section_across_4m.svg")
    written = sorted(path.name for path in second.glob("section_*"))
    person.expect("a picture and a drawing are written", written, ["section_across_4m.dxf", "section_across_4m.svg"])


def share_changed(person: Person, before: str, after: str) -> float:
    """Share of the window whose colour is another one."""
    first, second = (pixels_of(next(person.folder.glob(f"??_{name}.png"))) for name in (before, after))
    return float((np.abs(first - second).max(axis=1) > 0.05).mean())


def farthest_from_record(person: Person) -> float:
    """How far any shard is shown from where it was recorded in the last frame, m."""
    graph, series = bpy.context.evaluated_depsgraph_get(), module("simulation.blender_events")
    series = series.shown_results(person.scene).series
    recorded = dict(zip(series.body_names, series.frame(len(series) - 1).positions_m, strict=True))
    bodies = [body for body in person.scene.rigidbody_world.collection.objects if body.name.startswith("Shard")]
    shown = np.array([body.evaluated_get(graph).matrix_world.translation for body in bodies])
    return float(np.abs(shown - np.array([recorded[body.name] for body in bodies])).max())
