# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo while a recording runs.

Blender alone, without any add-on, crashes when it plays on after an undo in the middle of a simulation (job upheaval):
this job looks at what becomes of the recording.
"""

from habits import build, play_or_pause, play_until, register
from panels import Panels
from person import Person, Steps
from traces import recording_runs


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    panels = Panels(person)
    yield from build(person)
    yield from panels.show_only("Record by Hand")
    yield from register(person, person.folder / "undone")
    yield from play_until(person, 10)
    yield from play_or_pause(person)
    yield from person.press("Z", ctrl=True)
    yield from person.picture("undone_while_recording")
    yield from play_or_pause(person)
    yield 1.0
    yield from play_or_pause(person)
    yield from person.click("bda.unregister_handler")
    yield 2.0
    yield from person.picture("undone_and_unregistered")
    reports = (
        "30 shards",
        "Recording to",
        "undo, redo",
        "what follows is no outcome",
        "still move at the end",
        "Results are in",
    )
    person.expect_reports("undo ends the recording with a warning", *reports)
    person.expect("what was recorded is kept", (person.folder / "undone" / "summary.json").exists())
    person.expect("no recording runs after undo", recording_runs(), False)
