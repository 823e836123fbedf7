# SPDX-License-Identifier: GPL-3.0-or-later
"""Show contours while a recording plays and when scrubbing afterwards, with vectors and colour bar; then a film."""

import bpy
from habits import build, go_to_start, play_or_pause, register
from panels import Panels
from person import Person, Steps
from traces import colours, module, recording_runs


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from build(person)
    person.expect_reports("nothing but the building is reported", "30 shards")
    look(person)
    bpy.data.objects["Cube"].hide_set(True)  # of Blender's start-up file, it stands in the bridge
    yield from person.picture("built")
    own = colours(person)
    yield from panels.show_only("Contours")
    yield from person.click("contours")
    yield 0.5
    person.expect("the box is ticked", person.scene.bda.contours)
    results = person.folder / "results"
    yield from panels.show_only("Record by Hand")
    yield from register(person, results)
    person.expect_reports("nothing but the registering is reported", "Recording to")
    yield from play_or_pause(person)
    yield from person.wait_for("the timeline plays", lambda: person.scene.frame_current >= 20)
    yield from person.picture("playing")
    yield from person.wait_for("it plays to its end", lambda: person.scene.frame_current < 20)
    yield from play_or_pause(person)
    yield from person.click("bda.unregister_handler")
    yield 1.0
    person.expect_reports("what creeps and the results are reported", "creeps at the end", f"Results are in {results}")
    yield from panels.show_only("Contours")
    yield from go_to_start(person)
    yield from person.picture("start")
    shown = {}
    for frame in (8, 14, 30):
        person.scene.frame_set(frame)
        yield 0.5
        yield from person.picture(f"frame_{frame}")
        shown[frame] = colours(person, shown=True)
    person.expect("frames differ in their colours", bool((shown[8] != shown[14]).any()))
    person.expect("the bodies' own colours are not touched", bool((colours(person) == own).all()))
    person.scene.frame_set(8)
    yield 0.5
    person.expect("a frame has the same colours again", bool((colours(person, shown=True) == shown[8]).all()))
    settings = person.scene.bda
    settings.contour_quantity, settings.contour_map, settings.contour_logarithmic = "VON_MISES", "VIRIDIS", True
    settings.contour_peak, settings.show_vectors = True, True
    settings.vectors = {"BODIES", "CONNECTIONS", "CONTACTS"}
    person.scene.frame_set(21)
    yield 0.5
    yield from person.picture("vectors")
    settings.show_vectors = False
    add_charge(person)
    settings.show_charges = settings.show_rings = True
    settings.ring_damage = "8"
    yield 0.5
    yield from person.picture("charges")
    settings.show_charges = settings.show_rings = False
    yield from inner_panels(person, panels)
    bpy.ops.bda.toggle_symbols()
    yield 0.5
    yield from person.picture("symbols_hidden")
    yield from person.click("contours")
    yield 0.5
    yield from person.picture("contours_off")
    person.expect("no recording runs", recording_runs(), False)
    person.expect("the bodies show their own colours", bool((colours(person, shown=True) == own).all()))
    person.expect("the view is as before", person.view.spaces.active.shading.color_type, "MATERIAL")
    yield from film(person)
    yield from load_in_the_middle_of_a_film(person)
    yield from open_with_contours(person)


def inner_panels(person: Person, panels: Panels) -> Steps:
    """Open each of the other panels, and look at it."""
    for name in ("Film", "Vectors and Charges", "Earlier Run"):
        yield from panels.show_only(name)
        yield from person.picture("panel_" + name.replace(" ", "_"))
    yield from panels.show_only("Contours")


def film(person: Person) -> Steps:
    person.scene.bda.film_directory = str(person.folder / "film")
    person.scene.bda.film_width, person.scene.bda.film_height = 640, 360
    with person.in_sidebar():
        bpy.ops.bda.render_contours("INVOKE_DEFAULT")
    file = person.folder / "film" / "contours.mp4"
    yield 5.0
    yield from person.picture("film_in_the_making")
    yield from person.wait_for("there is a film", file.exists, 120.0)
    yield 1.0
    person.expect_reports("nothing but the film is reported", "37 pictures rendered")
    yield from person.picture("film_done")


def load_in_the_middle_of_a_film(person: Person) -> Steps:
    file = person.folder / "before_the_film.blend"
    person.scene.bda.film_directory = str(person.folder / "cut_short")
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    with person.in_sidebar():
        bpy.ops.bda.render_contours("INVOKE_DEFAULT")
    rendered = (person.folder / "cut_short").glob
    yield from person.wait_for("there are pictures", lambda: len(list(rendered("*.png"))) > 3, 60.0)
    with bpy.context.temp_override(window=person.window):
        bpy.ops.wm.open_mainfile(filepath=str(file))
    yield 1.0
    stopped_at = len(list(rendered("*.png")))
    yield 3.0
    person.expect("no more pictures are rendered", len(list(rendered("*.png"))), stopped_at)
    person.expect("pictures are as large as they were", person.scene.render.resolution_x, 1920)
    person.expect("no recording runs of the film", recording_runs(), False)
    yield from person.picture("loaded_in_the_middle_of_a_film")


def open_with_contours(person: Person) -> Steps:
    """Save a file that shows contours, and open it: they are shown again."""
    file = person.folder / "with_contours.blend"
    person.scene.bda.contours = True
    person.scene.frame_set(14)
    yield 0.5
    before = colours(person, shown=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    with bpy.context.temp_override(window=person.window):
        bpy.ops.wm.open_mainfile(filepath=str(file))
    yield 2.0
    yield from person.picture("opened_with_contours")
    person.expect("contours are shown in the file that is opened", person.scene.bda.contours)
    person.scene.frame_set(14)  # a file with a run opens at its start
    yield 0.5
    person.expect("in the colours of before", bool((colours(person, shown=True) == before).all()))
    person.expect("bodies have others of their own", bool((colours(person) != before).any()))
    person.expect("the view shows them", person.view.spaces.active.shading.color_type, "OBJECT")


def look(person: Person) -> None:
    """Look at the bridge from beside it."""
    space = person.view.spaces.active.region_3d
    space.view_location, space.view_distance = (4.0, 0.0, 2.0), 16.0


def add_charge(person: Person) -> None:
    charge = module("model.blast.charges").Charge
    create = module("scene.blast.charges").create_charges
    positions = {"Charge A": (1.0, 0.0, 1.0), "Charge B": (7.0, 0.0, 1.0)}
    create(person.scene, [charge(name=name, position_m=position, mass_kg=0.4) for name, position in positions.items()])
