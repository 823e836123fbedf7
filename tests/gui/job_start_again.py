# SPDX-License-Identifier: GPL-3.0-or-later
"""Start again: another bridge is in view, without old messages and contours; a run says what is not as it was built.

Shards are deleted, moved and doubled, the ball is deleted, the bridge lies as rubble before its first frame, and
nothing at all is left.
"""

from collections.abc import Callable

import bpy
from dragging import out_of_sight
from habits import build, delete_all, load, undo
from panels import Panels
from person import Person, Steps
from traces import PRESETS, SCENARIO, module, recording_runs, something_goes_on

LONGER = PRESETS / "drilled_spans.toml"
LONGER_CORNERS_M = [(x, y, z) for x in (-0.5, 26.5) for y in (-1.85, 1.85) for z in (0.0, 6.1)]
CORNERS_M = [(x, y, z) for x in (-0.5, 8.5) for y in (-2.0, 2.0) for z in (0.0, 3.4)]
"""Of both bridges, by hand."""
BALL_M = (4.0, 0.0, 4.7)
"""Top of the ball over the small bridge: on 3.4 m, 0.3 m above it, and 1 m wide."""

RUBBLE_FRAME = 36
SHARDS = 30


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from delete_all(person)
    yield from panels.widen(160)
    person.scene.bda.pictures_of_run = False
    yield from build(person)
    person.expect("bridge and ball are in view", out_of_sight(person, [*CORNERS_M, BALL_M]), [])
    yield from leave_early(person)
    yield from build_another(person)
    yield from build_the_first_again(person, panels)
    yield from without_its_ball(person)
    yield from build_again(person)
    yield from without_a_shard(person, panels)
    yield from build_again(person)
    yield from with_a_double(person)
    yield from build_again(person)
    yield from from_rubble(person)
    yield from with_nothing_left(person)
    person.take_reports()


def leave_early(person: Person) -> Steps:
    """Run with contours, be told that Blender cannot be left meanwhile, and press Esc."""
    person.scene.bda.contours = True
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 30.0)
    yield from person.wait_for("some frames are over", lambda: person.scene.frame_current > 5, 60.0)
    yield from person.move_to_view()
    yield from person.press("Q", ctrl=True)
    yield 0.3
    person.expect("Ctrl-Q is answered", any("Esc stops it" in report for report in person.take_reports()))
    person.expect("and it goes on", recording_runs())
    yield from stop(person)
    person.expect("that it stopped stays in the panel", any(text.startswith("Stopped after") for text in told(person)))


def build_another(person: Person) -> Steps:
    """Load another scenario, and click Build Again and Run: the view goes to it."""
    yield from load(person, LONGER)
    yield 0.5
    person.expect("the other bridge is not in view yet", bool(out_of_sight(person, LONGER_CORNERS_M)))
    yield from person.click("bda.run")
    yield from person.wait_for("the other one runs", recording_runs, 120.0)
    yield 0.5
    person.expect("all of it is in view", out_of_sight(person, LONGER_CORNERS_M), [])
    person.expect("no message is left of the first", [text for text in told(person) if "Stopped" in text], [])
    yield from person.picture("another_runs")
    yield from stop(person)


def build_the_first_again(person: Person, panels: Panels) -> Steps:
    """Build Again alone: no message, no contours, the bridge in view."""
    yield from load(person, SCENARIO)
    yield from panels.toggle_inner(0, "bda.import_ifc")  # Advanced
    yield from build_again(person)
    person.expect("bridge and ball are in view again", out_of_sight(person, [*CORNERS_M, BALL_M]), [])
    person.expect("no message is left of the other", told(person), [])
    person.expect("contours are off, as nothing was run", person.scene.bda.contours, False)
    person.expect("the view shows materials", person.view.spaces.active.shading.color_type, "MATERIAL")
    yield from person.picture("the_first_again")


def without_its_ball(person: Person) -> Steps:
    yield from delete(person, lambda body: module("scene.bodies").kind_of(body) == "ball")
    yield from begin(person)
    person.expect("that there is no ball is said as it begins", said(person, "the ball of the scenario is missing"))
    yield from person.picture("no_ball")
    yield from stop(person)


def without_a_shard(person: Person, panels: Panels) -> Steps:
    yield from delete(person, lambda body: body.name.startswith("Shard"))
    yield from person.click("bda.run")
    yield 0.5
    person.expect("loose connections are named", said(person, "remove loose connections first"))
    yield from person.click("bda.remove_loose_connections")
    yield from begin(person)
    person.expect("that a shard is missing is said as it begins", said(person, "1 shard is missing"))
    yield from stop(person)


def with_a_double(person: Person) -> Steps:
    """A charge pushes shards by force fields: the shard that is doubled gets one in the run."""
    person.scene.bda.scenario.blast.explosion, person.scene.cursor.location = True, (1.0, 0.0, 1.0)
    with person.in_sidebar():
        bpy.ops.bda.add_source_point()
        bpy.ops.bda.build_force_objects()
    choose(person, next(filter(lambda body: body.name.startswith("Shard"), bodies(person))))
    yield from person.move_to_view()
    yield from person.press("D", "d", shift=True)
    yield 0.3
    yield from person.press("Z", "z")
    yield from person.write("5")
    yield from person.press("RET")
    yield 0.5
    person.expect("there is one shard more", shards(person), SHARDS + 1)
    yield from begin(person)
    person.expect("that it was added is said as it begins", said(person, "1 body is added"))
    yield from stop(person)
    yield from delete(person, module("scene.blast.charges").is_charge, among=list(person.scene.objects))


def from_rubble(person: Person) -> Steps:
    """The places of a pile are applied to its shards: refused, with what to do."""
    yield from begin(person)
    yield from person.wait_for("it lies", lambda: person.scene.frame_current >= RUBBLE_FRAME, 120.0)
    yield from stop(person)
    with bpy.context.temp_override(window=person.window, area=person.view):
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.visual_transform_apply()
    person.scene.frame_set(person.scene.frame_start)
    yield from person.click("bda.run")
    yield 1.0
    person.expect("nothing runs from rubble", recording_runs(), False)
    person.expect("and it is said why", said(person, "begins with rubble") and said(person, "build the scenario again"))
    yield from person.picture("rubble")


def with_nothing_left(person: Person) -> Steps:
    """A and Delete: Build Scenario can be clicked, and builds."""
    yield from delete_all(person)
    hint = module("ui.scenario.hints").next_step(person.scene)
    person.expect("what is next is said", "nothing is left of what was built" in hint)
    person.expect("Build Scenario can be clicked", person.refusal("bda.build_scenario"), "")
    person.take_reports()
    yield from person.click("bda.build_scenario")
    yield 1.0
    person.expect_reports("nothing but the building is reported", f"{SHARDS} shards")
    person.expect("all shards are there", shards(person), SHARDS)
    yield from undo(person)
    person.expect("Ctrl-Z takes that back", shards(person), 0)


def begin(person: Person) -> Steps:
    """Click Run, and wait for its first frames."""
    person.take_reports()
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 60.0)


def stop(person: Person) -> Steps:
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for("Esc stops it", lambda: not something_goes_on(), 30.0)
    yield 0.5


def build_again(person: Person) -> Steps:
    yield from person.click("bda.build_anew")
    yield from person.wait_for("it is built again", lambda: shards(person) == SHARDS, 60.0)
    yield 1.0
    person.take_reports()


def delete(person: Person, is_wanted: Callable[[bpy.types.Object], bool], among: list | None = None) -> Steps:
    """Choose the first that is wanted, and press Delete over the 3D view."""
    choose(person, next(filter(is_wanted, among or bodies(person))))
    yield from person.move_to_view()
    yield from person.press("DEL")
    yield 0.5
    person.take_reports()


def choose(person: Person, wanted: bpy.types.Object) -> None:
    for chosen in person.window.view_layer.objects:
        chosen.select_set(chosen == wanted)
    person.window.view_layer.objects.active = wanted


def bodies(person: Person) -> list[bpy.types.Object]:
    return list(person.scene.rigidbody_world.collection.objects)


def shards(person: Person) -> int:
    return sum(body.name.startswith("Shard") for body in bodies(person))


def told(person: Person) -> list[str]:
    """Messages that stay in the sidebar."""
    return [message.text for message in module("ui.messages").messages_of(person.scene)]


def said(person: Person, part: str) -> bool:
    """Whether a message has a text in it."""
    return any(part in text for text in told(person))
