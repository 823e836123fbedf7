# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a run, a report, charts and a film say that they still take, against how long they take; and Esc in each."""

import time

from habits import build
from person import Person, Steps
from traces import CHECKOUT, module, recording_runs

SCENARIO = CHECKOUT / "examples" / "report_2019" / "two_spans_13m_explosives.toml"
FACTOR, SHARE = 1.5, 0.8
"""How right it is, and in how many looks: others on the machine may take or leave half of it at any time."""
LEAST_LEFT_S = 2.0
"""Below which nobody minds."""
FROM_SHARE, TO_SHARE = 0.2, 0.9


def steps(person: Person) -> Steps:
    yield from person.open_sidebar()
    yield from build(person, SCENARIO)
    yield from person.click("bda.run")
    yield from person.wait_for("it runs", recording_runs, 20.0)
    yield from follow(person, "the run", 15)
    yield from follow(person, "the pictures of the run", 1)
    yield from person.picture("run_is_over")
    kept = [message.text for message in module("ui.messages").messages_of(person.scene)]
    person.expect("where its results are stays in the panel", any("Results are in" in text for text in kept))
    yield from stop(person, "bda.make_report", "the report")
    person.expect("there is no report to open yet", "make one first" in person.refusal("bda.open_report"))
    yield from begin(person, "bda.make_report")
    yield from follow(person, "the report", 4)
    yield 0.5
    report = module("ui.results.operator").report_of(person.scene)
    person.expect("the panel names the report", report is not None and report.is_file())
    person.expect("and it can be opened", person.refusal("bda.open_report"), "")
    yield from stop(person, "bda.draw_charts", "the charts")
    yield from begin(person, "bda.draw_charts")
    yield from follow(person, "the charts", 2)
    yield from film(person)
    person.take_reports()


def film(person: Person) -> Steps:
    settings = person.scene.bda
    settings.film_directory, settings.film_kind = str(person.folder / "film"), "PICTURES"
    settings.film_width, settings.film_height = 320, 180
    yield from begin(person, "bda.render_contours")
    yield from follow(person, "the film", 5)


def begin(person: Person, button: str) -> Steps:
    yield from call(person, button)
    yield from person.wait_for(f"{button} begins", lambda: going_on() is not None, 20.0)


def stop(person: Person, button: str, what: str) -> Steps:
    yield from begin(person, button)
    yield from person.move_to_view()
    yield from person.press("ESC")
    yield from person.wait_for(f"Esc stops {what}", lambda: going_on() is None, 10.0)
    kept = [message.text for message in module("ui.messages").messages_of(person.scene)]
    person.expect(f"and it is said in the panel of {what}", any("stopped" in text for text in kept))


def call(person: Person, button: str) -> Steps:
    """Call a button as a click does."""
    import bpy

    group, name = button.split(".")
    with person.in_sidebar():
        getattr(getattr(bpy.ops, group), name)("INVOKE_DEFAULT")
    yield


def going_on() -> object | None:
    return module("ui.task_progress").going_on()


def follow(person: Person, what: str, pictured_at: int) -> Steps:
    """Note what is said as it goes on, and compare when it is over."""
    said, pictured, turns, first = [], False, 0, going_on()
    while (progress := going_on()) is first:
        if progress.left_s is not None and FROM_SHARE <= progress.share <= TO_SHARE:
            said.append((time.perf_counter(), progress.left_s))
        turns += 1
        if turns == pictured_at and not pictured:
            pictured = True
            yield from person.picture(what.replace(" ", "_"))
        yield
    ended = time.perf_counter()
    factors = [max(left / (ended - when), (ended - when) / left) for when, left in said if ended - when > LEAST_LEFT_S]
    if not factors:
        person.note(f"{what} takes too short a time to judge")
        return
    share = sum(factor <= FACTOR for factor in factors) / len(factors)
    trouble = "" if share >= SHARE else f"only {share:.0%} of {len(factors)} times; at worst {max(factors):.2f}"
    person.note(f"time left of {what} is right within a factor of {FACTOR} in {SHARE:.0%} of looks", trouble)
    person.note(f"{what}: {len(factors)} looks, {share:.0%} within {FACTOR}, at worst {max(factors):.2f}")
