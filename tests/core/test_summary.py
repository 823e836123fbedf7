"""The summary of a recording against what happened in it."""

import json
from dataclasses import replace

import numpy as np
import pytest
from sample_results import GRAVITY, hanging_chain, without_connections

from bridge_demolition_addon.core.summary import impact_step, summarise

G = 9.80665


def test_summary_of_the_chain():
    summary = summarise(hanging_chain(), GRAVITY)
    assert summary["frames"] == 5
    assert summary["simulated_s"] == pytest.approx(0.16)
    assert summary["mass_kg"] == {"shard": 500.0, "ball": 1000.0}
    assert summary["bodies"] == {"shard": 2, "ball": 1, "ground": 1}
    assert summary["largest_throw"] == {"throw_m": 5.0, "body": "lower"}


def test_breaking_over_time():
    connections = summarise(hanging_chain(), GRAVITY)["connections"]
    over_time = connections.pop("over_time")
    assert connections == {"count": 2, "intact": 1, "broken": 1}
    assert over_time["intact"] == [2, 2, 2, 2, 1]
    assert over_time["broken"] == [0, 0, 0, 0, 1]
    assert over_time["time_s"] == pytest.approx([0.0, 0.04, 0.08, 0.12, 0.16])


def test_largest_forces_with_their_body_and_moment():
    summary = summarise(hanging_chain(), GRAVITY)
    # Frame 5: weight 500 kg above, 200 kg and 1 kN across below. The ground, which takes more, does not count.
    force_sum, resultant = summary["largest_force_sum"], summary["largest_resultant"]
    assert (force_sum["body"], force_sum["frame"]) == ("upper", 5)
    assert force_sum["time_s"] == pytest.approx(0.12)
    assert force_sum["force_N"] == pytest.approx(500 * G + np.hypot(200 * G, 1000))
    assert (resultant["body"], resultant["frame"]) == ("upper", 5)
    assert resultant["force_N"] == pytest.approx(np.hypot(300 * G, 1000))


def test_the_ball_hits_in_the_frame_that_stops_it():
    assert summarise(hanging_chain(), GRAVITY)["impact"] == {"frame": 6, "time_s": pytest.approx(0.16)}


def with_ball(velocities):
    results = hanging_chain()
    all_velocities = results.velocities_m_s.copy()
    all_velocities[:, 3] = np.asarray(velocities)[:, None] * 0.04 * GRAVITY
    return replace(results, velocities_m_s=all_velocities)


@pytest.mark.parametrize(
    "velocities, step",
    [
        ([0, 0, 0, 0, 0], None),  # still held
        ([0, 0, 1, 2, 3], None),  # still falling
        ([0, 1, 2, 1, 0], 3),
        ([0, 0, 0.2, 0.1, 0.1], 2),  # hits in the frame that it is let go in
        ([1, 2, 0, 0, 0], 2),  # recorded only after its release
    ],
)
def test_step_of_the_impact(velocities, step):
    assert impact_step(with_ball(velocities), GRAVITY) == step


def test_no_ball_no_impact():
    results = hanging_chain()
    results = replace(results, body_kinds=np.where(results.body_kinds == "ball", "shard", results.body_kinds))
    assert summarise(results, GRAVITY)["impact"] is None


def test_frames_of_unknown_forces_are_passed_over():
    results = hanging_chain()
    forces = results.connection_forces_n.copy()
    forces[3] = np.nan
    summary = summarise(replace(results, connection_forces_n=forces), GRAVITY)
    assert summary["largest_force_sum"]["force_N"] == pytest.approx(700 * G)
    assert summary["largest_force_sum"]["frame"] == 2
    nothing_known = summarise(replace(results, connection_forces_n=np.full_like(forces, np.nan)), GRAVITY)
    assert nothing_known["largest_force_sum"] is nothing_known["largest_resultant"] is None


def only(results, body):
    """The recording of a single body."""
    kept = without_connections(results)
    return replace(
        kept,
        **{name: getattr(kept, name)[[body]] for name in ("body_names", "body_kinds", "masses_kg")},
        **{name: getattr(kept, name)[:, [body]] for name in ("places_m", "rotations", "velocities_m_s")},
    )


@pytest.mark.parametrize(
    "body, force, throw",
    [(0, None, None), (1, 0.0, 0.0), (2, 0.0, 5.0), (3, 0.0, None)],
    ids=["ground", "upper", "lower", "ball"],
)
def test_a_single_body_without_connections(body, force, throw):
    summary = summarise(only(hanging_chain(), body), GRAVITY)
    largest = summary["largest_resultant"]
    assert (largest and largest["force_N"]) == force
    assert (summary["largest_throw"] and summary["largest_throw"]["throw_m"]) == throw
    assert summary["connections"]["count"] == summary["connections"]["broken"] == 0


@pytest.mark.parametrize("results", [hanging_chain(), only(hanging_chain(), 0)], ids=["chain", "ground"])
def test_summary_is_strict_json(results):
    summary = summarise(results, GRAVITY)
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary
