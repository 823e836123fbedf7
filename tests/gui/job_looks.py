# SPDX-License-Identifier: GPL-3.0-or-later
"""Build from Blender as it starts, and look at the bridge: Solid, Material Preview, Rendered, and by F12."""

import bpy
from habits import build, render_still
from panels import Panels
from person import Person, Steps
from traces import pixels_of

STARTUP = ("Cube", "Light", "Camera")
SECONDS_OF_SHADERS = 15.0
"""That a renderer takes at first, drawn without a graphics card."""


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from panels.show_only("Scenario")
    yield from build(person)
    person.expect_reports("nothing but the building is reported", "30 shards")
    objects = person.scene.objects
    person.expect("the start-up objects are there", [name in objects for name in STARTUP], [True] * 3)
    person.expect("and hidden", [seen(person, name) for name in STARTUP], [False] * 3)
    person.expect("the scene has a camera before the bridge", person.scene.camera.name, "Bridge camera")
    yield from through_the_camera(person)
    yield from looks(person)
    empties = [obj for obj in objects if obj.rigid_body_constraint]
    person.expect("connections are hidden", any(seen(person, empty.name) for empty in empties), False)
    yield from person.click("bda.toggle_symbols")
    yield 0.5
    person.expect("the eye shows them", all(seen(person, empty.name) for empty in empties))
    yield from person.click("bda.toggle_symbols")
    yield from by_f12(person)
    yield from panels.toggle_inner(0, "bda.import_ifc")  # Advanced
    yield from remove(person)
    person.expect("the start-up objects are seen again", [seen(person, name) for name in STARTUP], [True] * 3)
    person.expect("the scene has its own camera again", person.scene.camera.name, "Camera")


def looks(person: Person) -> Steps:
    shading = person.view.spaces.active.shading
    for kind in ("SOLID", "MATERIAL", "RENDERED"):
        shading.type = kind
        person.view.tag_redraw()
        yield 1.0 if kind == "SOLID" else SECONDS_OF_SHADERS
        yield from person.picture(kind.lower())
    shading.type = "SOLID"
    yield 0.5


def by_f12(person: Person) -> Steps:
    """Press F12 with the renderer that Blender starts with, and look at what comes of it."""
    path = person.folder / "by_f12.png"
    yield from render_still(person, path)
    empty = "" if pixels_of(path).std() > 0.05 else "the picture is empty"
    person.note(f"{person.scene.render.engine} renders the built scene", empty)


def through_the_camera(person: Person) -> Steps:
    yield from person.move_to_view()
    person.view.spaces.active.region_3d.view_perspective = "CAMERA"
    yield 0.5


def remove(person: Person) -> Steps:
    yield from person.click("bda.remove_demolition")
    yield 0.5
    person.expect("nothing of ours is left", [world.name for world in bpy.data.worlds], ["World"])
    person.expect_reports("nothing but the removal is reported", "bodies removed")


def seen(person: Person, name: str) -> bool:
    return person.scene.objects[name].visible_get(view_layer=person.window.view_layer)
