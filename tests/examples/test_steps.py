"""The example that takes a span down in steps: all of them happen, in order, and the run ends at rest."""

import pytest
from example_claims import assert_claims
from example_runs import example, run_example

NAME = "i235_steps"


def test_span_is_taken_down_in_steps(tmp_path):
    run = run_example(example(NAME), tmp_path)
    events = run.summary["events"]
    assert [each["kind"] for each in events] == ["weakening", "saw cut", "removal"]
    assert [each["time_s"] for each in events] == pytest.approx([7.5, 8.0, 8.5], abs=1.0 / 240.0)
    removed = [run.results.inventory.body_names.tolist().index(name) for name in events[2]["shards"]]
    assert (run.results.frames.positions_m[-1, removed, 2] < -900.0).all()
    assert run.summary["simulated_s"] < run.scenario.time.duration_s
    assert_claims(NAME, run)
