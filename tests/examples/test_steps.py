# SPDX-License-Identifier: GPL-3.0-or-later
"""The example that takes a span down in steps: all of them happen, in order, and the run ends once all rests."""

import pytest
from support.example_claims import assert_claims
from support.example_runs import example, run_example

NAME = "i235_steps"


def test_span_is_taken_down_in_steps(tmp_path):
    run = run_example(example(NAME), tmp_path)
    events = run.summary["events"]
    assert [event["kind"] for event in events] == ["weakening", "saw cut", "removal"]
    assert [event["time_s"] for event in events] == pytest.approx([7.5, 8.0, 8.5], abs=1.0 / 240.0)
    removed = [run.results.inventory.body_names.tolist().index(name) for name in events[2]["shards"]]
    assert (run.results.frames.positions_m[-1, removed, 2] < -900.0).all()
    # With 9 of 20 seeds all rests before the run is over, and then it ends a second later.
    rest_s, duration_s = run.summary["came_to_rest_s"], run.scenario.time.duration_s
    end_s = duration_s if rest_s is None else min(duration_s, rest_s + 1.0)
    assert run.summary["simulated_s"] == pytest.approx(end_s, abs=run.scenario.time.step.frame_s)
    assert_claims(NAME, run)
