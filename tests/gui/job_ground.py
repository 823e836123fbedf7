# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw a zone with the mouse; look at zones, distances, debris, exclusion zone, the ball's way and a chosen shard."""

import bpy
from habits import build, render_still
from panels import Panels
from person import Person, Steps
from traces import module, pixels_of

ALL = {"EXCLUSION", "ZONES", "DEBRIS", "RINGS", "NEIGHBOURS", "WAY", "FLASHES", "NAMES"}


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from build(person)
    person.expect_reports("nothing but the building is reported", "30 shards")
    look_down(person)
    settings = person.scene.bda
    settings.overlays, settings.scenario.use_exclusion = ALL, True
    settings.scenario.exclusion.buffer_m = 6.0
    yield 0.5
    yield from person.picture("planned")
    yield from draw_zone(person)
    settings.output_directory = str(person.folder / "run")
    bpy.ops.bda.run()
    yield 1.0
    person.take_reports()
    person.scene.frame_set(person.scene.frame_end)
    shard = next(body for body in person.scene.rigidbody_world.collection.objects if body.name.startswith("Shard"))
    shard.select_set(True)
    person.window.view_layer.objects.active = shard
    yield 1.0
    drawn = module("ui.ground.decorator").drawn
    texts = [label.text for label in drawn(person.scene, person.window.view_layer)]
    person.expect("the chosen shard has its name", shard.name in texts)
    person.expect("the exclusion zone is that of the run", "Exclusion zone of the last run" in texts)
    person.expect("all was drawn", module("ui.ground.decorator").drawing.error, "")
    yield from person.picture("after_the_run")
    yield from dust(person)
    yield from panels.show_only("Ground and Air")
    yield from person.scroll(30)
    yield from person.picture("panel")


def dust(person: Person) -> Steps:
    """Render the end of the run by F12 without dust and with it."""
    clear, dusty = person.folder / "clear.png", person.folder / "dusty.png"
    yield from render_still(person, clear)
    bpy.ops.bda.raise_dust()
    person.scene.frame_set(person.scene.frame_end)
    yield 0.5
    yield from render_still(person, dusty)
    changed = abs(pixels_of(dusty) - pixels_of(clear)).max(axis=1) > 0.02
    trouble = "" if changed.mean() > 0.005 else f"it changes {changed.mean():.2%} of the picture"
    person.note(f"{person.scene.render.engine} renders dust: {changed.mean():.1%} of the picture is other", trouble)
    bpy.ops.bda.settle_dust()
    person.take_reports()


def draw_zone(person: Person) -> Steps:
    view = person.view
    with person.in_sidebar():
        bpy.ops.bda.draw_zone("INVOKE_DEFAULT")
    yield 0.3
    for x, y in ((0.20, 0.25), (0.35, 0.25), (0.35, 0.40), (0.20, 0.40)):
        yield from person.move(view.x + int(x * view.width), view.y + int(y * view.height))
        yield from person.press("LEFTMOUSE")
        yield 0.2
    yield from person.picture("zone_being_drawn")
    yield from person.press("RET")
    yield 0.5
    zones = person.scene.bda.scenario.zones
    person.expect("a zone is added", [zone.name for zone in zones], ["Zone 1"])
    person.expect_reports("and reported", "Zone 1: 4 corners")
    yield from person.picture("zone_drawn")


def look_down(person: Person) -> None:
    space = person.view.spaces.active.region_3d
    space.view_location, space.view_distance = (6.0, 0.0, 0.0), 60.0
    bpy.context.view_layer.update()
