# SPDX-License-Identifier: GPL-3.0-or-later
"""Open every panel, scroll through all of them, and see how long they take with many shards and charges."""

import time
from collections.abc import Callable
from statistics import median

import bpy
from habits import load
from person import Person, Steps
from traces import module

SHARDS = 1000
CHARGES = 100
SCROLLS = 20
NOTCHES = 9
"""Of the mouse wheel; together they move the sidebar by less than it is high."""


def steps(person: Person) -> Steps:
    seconds: dict[str, list[float]] = {}
    open_at_first = open_panels(seconds)
    yield from person.open_sidebar()
    yield from person.picture("top")
    yield from load(person)
    yield 0.5
    person.expect("loading fills the panels", person.scene.bda.scenario.fracture.shards, 30)
    person.expect("loading builds nothing", person.scene.rigidbody_world is None)
    yield from person.picture("loaded")
    yield from make_many(person)
    for number in range(SCROLLS):
        yield from person.picture(f"scrolled_{number}")
        yield from scroll(person)
    yield from measure(person, seconds, open_at_first)
    person.take_reports()


def open_panels(seconds: dict[str, list[float]]) -> set[str]:
    """Have all panels open from the beginning, and take their times; return those that are open without this."""
    found = [cls for cls in module("ui.registration").classes() if issubclass(cls, bpy.types.Panel)]
    closed = {panel.__name__ for panel in found if "DEFAULT_CLOSED" in getattr(panel, "bl_options", ())}
    inside = {panel.__name__ for panel in found if getattr(panel, "bl_parent_id", "") in closed}
    for panel in reversed(found):
        bpy.utils.unregister_class(panel)
    for panel in found:
        panel.bl_options = set()
        panel.draw = timed(panel.draw, seconds.setdefault(panel.__name__, []))
        bpy.utils.register_class(panel)
    return {panel.__name__ for panel in found} - closed - inside


def timed(draw: Callable, seconds: list[float]) -> Callable:
    def timed_draw(self, context) -> None:
        began = time.thread_time()  # without what others on the machine do meanwhile
        draw(self, context)
        seconds.append(time.thread_time() - began)

    return timed_draw


def make_many(person: Person) -> Steps:
    settings = person.scene.bda
    settings.scenario.fracture.shards = SHARDS
    settings.scenario.connections.method = "face"
    settings.scenario.connections.use_search_radius_m = False
    yield from person.click("bda.build_scenario")
    yield from person.wait_for("it is built", lambda: person.scene.rigidbody_world is not None)
    charge = module("model.blast.charges").Charge
    create = module("scene.blast.charges").create_charges
    positions = [(0.08 * number, 0.0, 2.0) for number in range(CHARGES)]
    create(
        person.scene,
        [charge(name=f"Charge {n}", position_m=position, mass_kg=1.0) for n, position in enumerate(positions, 1)],
    )
    settings.charge_index = 5
    yield 0.5


def scroll(person: Person) -> Steps:
    yield from person.move(person.sidebar.x + person.sidebar.width // 2, person.sidebar.y + 300)
    for _ in range(NOTCHES):
        yield from person.press("WHEELDOWNMOUSE")


def measure(person: Person, seconds: dict[str, list[float]], open_at_first: set[str]) -> Steps:
    for times in seconds.values():
        times.clear()
    for _ in range(20):
        person.sidebar.tag_redraw()
        yield 0.05
    # The median of one and the same Blender differed by a factor of 1.8 from one minute to the next, on a machine with
    # nothing else to do: a processor that is shared with other machines is not always as fast.
    usual, fastest = ({name: 1e3 * of(times) for name, times in seconds.items() if times} for of in (median, min))
    slowest = max(fastest, key=fastest.get)
    person.note(
        f"all panels together are drawn in {sum(fastest.values()):.2f} ms at their fastest, {slowest} in "
        f"{fastest[slowest]:.2f} ms; usually in {sum(usual.values()):.2f} ms; those that are open at first in "
        f"{sum(fastest.get(panel, 0.0) for panel in open_at_first):.2f} ms at their fastest, usually in "
        f"{sum(usual.get(panel, 0.0) for panel in open_at_first):.2f} ms"
    )
