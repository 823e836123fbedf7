# SPDX-License-Identifier: GPL-3.0-or-later
"""The example that takes a span down in steps: it begins as it is told, and all steps happen, in order."""

from dataclasses import replace

import pytest
from support.example_claims import assert_begins
from support.example_runs import begun, example, run_example

NAME = "i235_steps"


@pytest.mark.long
def test_it_stands_until_the_jackhammer_works(session_folder):
    assert_begins(NAME, begun(NAME, session_folder))


def in_quick_succession(scenario):
    """The same steps within two seconds: the ball hits 1.01 s after it is let go, and is not lifted again."""
    jackhammers = [replace(jackhammer, end_time_s=0.5) for jackhammer in scenario.jackhammers]
    return replace(
        scenario,
        jackhammers=jackhammers,
        ball=replace(scenario.ball, release_time_s=0.5, hits=()),
        weakenings=[replace(weakening, time_s=1.6) for weakening in scenario.weakenings],
        saw_cuts=[replace(cut, time_s=1.65) for cut in scenario.saw_cuts],
        removals=[replace(removal, time_s=1.7) for removal in scenario.removals],
        time=replace(scenario.time, duration_s=1.85),
    )


@pytest.mark.long
def test_all_steps_happen(tmp_path):
    scenario = example(NAME)
    run = run_example(in_quick_succession(scenario), tmp_path)
    events = run.summary["events"]
    assert [event["kind"] for event in events] == ["weakening", "saw cut", "removal"]
    assert [event["time_s"] for event in events] == pytest.approx([1.6, 1.65, 1.7], abs=1.0 / 240.0)
    removed = [run.results.inventory.body_names.tolist().index(name) for name in events[2]["shards"]]
    assert (run.results.frames.positions_m[-1, removed, 2] < -900.0).all()
    broken = (~run.results.frames.intact).sum(axis=1)
    hit_s = run.summary["impact"]["time_s"]
    assert 0 < broken[run.at(0.5)] < broken[run.at(hit_s + 0.05)] < broken[-1]
    assert hit_s == pytest.approx(1.51, abs=2.0 / 24.0)
