"""The example that takes a span down in steps: all of them happen, in order, and the run ends at rest."""

import numpy as np
import pytest
from example_runs import EXAMPLES

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.core.results.arrays import load_results
from bridge_demolition_addon.core.scenario.file import read_scenario

STEPS = read_scenario(EXAMPLES / "i235_steps.toml")


def test_span_is_taken_down_in_steps(tmp_path):
    from bridge_demolition_addon.simulation.run import run_scenario

    summary = run_scenario(STEPS, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run" / "results.npz")
    assert [each["kind"] for each in summary["events"]] == ["weakening", "saw cut", "removal"]
    assert [each["time_s"] for each in summary["events"]] == pytest.approx([7.5, 8.0, 8.5], abs=1.0 / 240.0)
    removed = [results.inventory.body_names.tolist().index(name) for name in summary["events"][2]["shards"]]
    assert (results.frames.positions_m[-1, removed, 2] < -900.0).all()
    # Nobody else falls through the ground, and the deck over the removed pier comes down.
    others = np.setdiff1d(results.inventory.of_kind("shard"), removed)
    assert results.frames.positions_m[-1, others, 2].min() > 0.0
    broken = (~results.frames.intact).sum(axis=1)
    by_hammer, by_ball = (broken[np.searchsorted(results.frames.time_s, time_s)] for time_s in (1.9, 4.0))
    assert 0 < by_hammer < by_ball < broken[-1]
    hits = [hit["time_s"] for hit in summary["hits_of_the_ball"]]
    assert any(3.0 < time_s < 3.6 for time_s in hits)
    assert any(6.7 < time_s < 7.3 for time_s in hits)
    # Animation lifts the ball in between: nothing hits it.
    assert not any(4.0 < time_s < 5.7 for time_s in hits)
    assert 8.5 < summary["came_to_rest_s"] < STEPS.time.duration_s - 1.0
    assert summary["simulated_s"] < STEPS.time.duration_s
