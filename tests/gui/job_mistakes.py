# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the wrong thing: every time a sentence says so, and nothing else happens."""

import math

from habits import build, play_or_pause, play_until
from panels import Panels
from person import Person, Steps
from traces import SCENARIO, everything, recording_runs, rows


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from press_greyed_buttons(person, panels)
    yield from build_what_is_not_there(person)
    yield from build_and_undo(person)
    yield from panels.show_only("Record by Hand")
    yield from record_into_a_folder_in_use(person)
    yield from record_after_playing_alone(person)


def press_greyed_buttons(person: Person, panels: Panels) -> Steps:
    before = everything()
    reasons = {
        "bda.load_scenario": "Choose a scenario file first",
        "bda.import_ifc": "IFC is read by IfcOpenShell",  # which the extension does not bring
        "bda.register_handler": "build a scenario first",
        "bda.unregister_handler": "No recording runs",
    }
    for button, reason in reasons.items():
        yield from panels.show_only("Record by Hand" if button.endswith("_handler") else "Scenario")
        person.expect(f"{button} is greyed with a reason", reason in person.refusal(button))
        yield from person.hover(button)
        yield 1.5
        yield from person.picture(f"greyed_{button.partition('.')[2]}")
        yield from person.press("LEFTMOUSE")
    yield from panels.show_only("Scenario")
    person.expect("greyed buttons do nothing", (everything(), recording_runs()), (before, False))


def build_what_is_not_there(person: Person) -> Steps:
    before = everything()
    yield from build(person, SCENARIO.with_name("nowhere.toml"))
    yield from person.picture("no_such_scenario")
    person.expect_reports("a scenario that is not there is an error", "nowhere.toml")
    person.expect("it changes nothing", everything(), before)
    person.expect("it makes no rigid-body world", person.scene.rigidbody_world is None)


def build_and_undo(person: Person) -> Steps:
    before = everything()
    yield from build(person)
    person.expect("a world is greyed with a reason", "already" in person.refusal("bda.build_scenario"))
    yield from person.hover("bda.build_scenario")
    yield 1.5
    yield from person.picture("greyed_after_building")
    yield from person.move_to_view()
    yield from person.press("Z", ctrl=True)
    yield from person.picture("undone")
    person.expect("Ctrl-Z takes all of it back", everything(), before)
    person.expect("Ctrl-Z takes the world back", person.scene.rigidbody_world is None)
    yield from person.click("bda.build_scenario")
    yield 1.0
    person.expect("it can be built again", len(person.scene.rigidbody_world.collection.objects), 32)
    person.expect_reports("nothing but two buildings is reported", "30 shards", "30 shards")


def record_into_a_folder_in_use(person: Person) -> Steps:
    used = person.folder / "used"
    used.mkdir()
    (used / "notes.txt").write_text("mine", encoding="utf-8")
    yield from person.fill_in("output_directory", str(used))
    yield from person.click("bda.register_handler")
    yield from person.picture("folder_in_use")
    person.expect_reports("a folder that is there is an error", "overwriting")
    person.expect("it registers nothing", recording_runs(), False)
    yield from person.click("overwrite")
    yield from person.click("bda.register_handler")
    person.expect("it is used once overwriting is allowed", recording_runs(), True)
    person.expect_reports("nothing but the registering is reported", "Recording to")
    yield from person.click("bda.unregister_handler")
    yield from person.picture("nothing_recorded")
    person.expect_reports("nothing recorded without playing", "play the timeline")


def record_after_playing_alone(person: Person) -> Steps:
    """What Blender has simulated before is in its cache, and not simulated again."""
    yield from play_until(person, 20)
    yield from play_or_pause(person)
    yield from person.click("bda.register_handler")
    person.expect("registering goes to the start frame", person.scene.frame_current, 1)
    yield from play_until(person, 25)
    yield from play_or_pause(person)
    yield from person.picture("recorded_after_playing_alone")
    yield from person.click("bda.unregister_handler")
    yield 2.0
    yield from person.picture("recorded_after_playing_alone_ended")
    person.expect_reports(
        "frames played before are recorded", "Recording to", "not to be used for distances", "Results are in"
    )
    log = rows(person.folder / "used" / "force_log.csv")
    frames = [int(row["frame"]) for row in log]
    person.expect("they are recorded from the first to the last", sorted(set(frames)), list(range(2, frames[-1] + 1)))
    person.expect("their forces are known", all(math.isfinite(float(row["force_sum_N"])) for row in log))
