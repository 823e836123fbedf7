# SPDX-License-Identifier: GPL-3.0-or-later
"""The summary of a recording against what happened in it."""

import json

import numpy as np
import pytest
from support.sample_results import GRAVITY, G, changed, hanging_chain, without_connections

from bridge_demolition_addon.model.results.records import HitOfRun, MomentOfRun
from bridge_demolition_addon.model.results.summary import first_hit_s, impact_step, summarise

BODY_SERIES = (
    "places_m",
    "rotations",
    "velocities_m_s",
    "asleep",
    "body_forces_n",
    "body_peaks_n",
    "body_sums_n",
    "body_peak_sums_n",
    "body_contact_impulses_ns",
    "body_signed_2019_n",
    "stresses_pa",
    "von_mises_pa",
)


def test_summary_of_the_chain():
    summary = summarise(hanging_chain(), GRAVITY)
    assert summary["frames"] == 5
    assert summary["simulated_s"] == pytest.approx(0.16)
    assert summary["mass_kg"] == {"shard": 500.0, "ball": 1000.0}
    assert summary["bodies"] == {"shard": 2, "ball": 1, "ground": 1}
    assert summary["reading"] == "every sub-step"
    assert summary["largest_throw"] == {"throw_m": 5.0, "body": "lower"}


def test_a_shard_that_was_removed_is_not_thrown():
    chain = hanging_chain()
    positions = chain.frames.positions_m.copy()
    positions[-1, chain.inventory.body_names.tolist().index("lower"), 2] -= 1000.0
    assert summarise(changed(chain, places_m=positions), GRAVITY)["largest_throw"]["body"] == "upper"


@pytest.mark.parametrize(
    "hits, hit_s",
    [([1.508, 2.188], 1.508), ([0.3, 1.508], 1.508), ([], 1.542), ([2.188], 1.542)],
)
def test_the_first_hit_is_told_to_a_sub_step(hits, hit_s):
    recorded = [HitOfRun("ball", time_s, 0.01, 5.0, 1e4, 1e6) for time_s in hits]
    assert first_hit_s(MomentOfRun(1.542, 39), recorded) == hit_s
    assert first_hit_s(None, recorded) is None


def test_breaking_over_time():
    connections = summarise(hanging_chain(), GRAVITY)["connections"]
    over_time = connections.pop("over_time")
    # Whether bars hold was not recorded.
    unknown = {"cracked": None, "yielded": None, "torn": None}
    assert connections == {"count": 2, "intact": 1, "broken": 1, **unknown}
    # The first frame and those in which the numbers change.
    assert over_time["intact"] == [2, 1]
    assert over_time["broken"] == [0, 1]
    assert over_time["time_s"] == pytest.approx([0.0, 0.16])


def test_largest_forces_with_their_body_and_moment():
    summary = summarise(hanging_chain(), GRAVITY)
    # Frame 5, in its second half: weight of 500 kg above, of 200 kg and 1 kN across below. Ball and ground, which the
    # hit in frame 6 loads with more, do not count.
    force_sum, resultant = summary["largest_force_sum"], summary["largest_resultant"]
    assert (force_sum["body"], force_sum["frame"]) == ("upper", 5)
    assert force_sum["time_s"] == pytest.approx(0.12)
    assert force_sum["force_N"] == pytest.approx(500 * G + np.hypot(200 * G, 1000))
    assert (resultant["body"], resultant["frame"]) == ("upper", 5)
    assert resultant["force_N"] == pytest.approx(np.hypot(300 * G, 1000))
    others = hanging_chain()
    assert others.frames.loads.body_peaks_n[4, [0, 3]].min() > force_sum["force_N"] > resultant["force_N"]


def test_the_ball_hits_in_the_frame_that_stops_it():
    assert summarise(hanging_chain(), GRAVITY)["impact"] == {"frame": 6, "time_s": pytest.approx(0.16)}


def test_the_hit_of_the_ball_by_hand():
    (hit,) = summarise(hanging_chain(), GRAVITY, contact_time_s=0.01)["hits_of_the_ball"]
    # It falls for 0.1 s, and 6 g for 0.02 s stop it: the momentum of 1000 kg at 0.1 g, and 0.02 s of its weight.
    assert hit.pop("ball") == "Wrecking ball"
    hertz = hit.pop("hertz_peak_force_N")
    assert hit == pytest.approx(
        {
            "time_s": 0.14,
            "lasted_s": 0.02,
            "impulse_Ns": 120 * G,
            "approach_m_s": 0.1 * G,
            "raw_peak_force_N": 6000 * G,
            "raw_step_s": 0.004,
            "contact_time_s": 0.01,
            # The area under half a sine is 2/π of its height times its length.
            "half_sine_peak_force_N": np.pi / 2 * 120 * G / 0.01,
        }
    )
    assert np.isfinite(hertz) and hertz > 0.0


def test_a_ball_that_rests_hits_nothing():
    results = hanging_chain()
    resting = changed(results, ball_impulses_ns=results.balls.impulses_ns / 6.0)  # its weight
    assert summarise(resting, GRAVITY)["hits_of_the_ball"] == []


def test_a_ball_that_is_hit_from_behind_has_no_estimates():
    results = hanging_chain()
    (hit,) = summarise(changed(results, ball_impulses_ns=-results.balls.impulses_ns), GRAVITY)["hits_of_the_ball"]
    assert hit["approach_m_s"] == pytest.approx(-0.1 * G)
    assert not {"contact_time_s", "half_sine_peak_force_N", "hertz_peak_force_N"} & set(hit)


def with_ball(velocities):
    results = hanging_chain()
    all_velocities = results.frames.velocities_m_s.copy()
    all_velocities[:, 3] = np.asarray(velocities)[:, None] * 0.04 * GRAVITY
    return changed(results, velocities_m_s=all_velocities)


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
    results = changed(
        results, body_kinds=np.where(results.inventory.body_kinds == "ball", "shard", results.inventory.body_kinds)
    )
    assert summarise(results, GRAVITY)["impact"] is None


def with_unknown(results, frames):
    """The recording, had the loads of some frames not been known."""
    unknown = {}
    for name in ("body_peaks_n", "body_peak_sums_n"):
        unknown[name] = results.arrays()[name].copy()
        unknown[name][frames] = np.nan
    return changed(results, **unknown)


def test_frames_of_unknown_forces_are_passed_over():
    results = hanging_chain()
    summary = summarise(with_unknown(results, [0, 3]), GRAVITY)
    assert summary["largest_force_sum"]["force_N"] == pytest.approx(700 * G)
    # Frame 3 is the first with loads; frame 4 has the same, number for number.
    assert summary["largest_force_sum"]["frame"] == 3
    nothing_known = summarise(with_unknown(results, slice(None)), GRAVITY)
    assert nothing_known["largest_force_sum"] is nothing_known["largest_resultant"] is None


def test_frames_in_which_only_some_forces_are_known_are_passed_over():
    results = hanging_chain()
    peaks = results.frames.loads.body_peak_sums_n.copy()
    peaks[3, 0] = np.nan
    summary = summarise(changed(results, body_peak_sums_n=peaks), GRAVITY)
    assert summary["largest_force_sum"]["force_N"] == pytest.approx(700 * G)


def test_a_reading_of_last_sub_steps_says_so():
    results = changed(hanging_chain(), reading=np.array("last sub-step of each frame"))
    assert summarise(results, GRAVITY)["reading"] == "last sub-step of each frame"


def only(results, body):
    """The recording of a single body."""
    kept = without_connections(results)
    assert set(BODY_SERIES) < set(kept.arrays())
    balls = slice(None) if body in kept.balls.bodies else slice(0)
    return changed(
        kept,
        balls=np.zeros_like(kept.balls.bodies[balls]),
        ball_impulses_ns=kept.balls.impulses_ns[:, balls],
        ball_velocities_m_s=kept.balls.velocities_m_s[:, balls],
        **{name: kept.arrays()[name][[body]] for name in ("body_names", "body_kinds", "masses_kg", "volumes_m3")},
        **{name: kept.arrays()[name][:, [body]] for name in BODY_SERIES},
    )


@pytest.mark.parametrize(
    "body, force, throw",
    [(0, None, None), (1, 0.0, 0.0), (2, 0.0, 5.0), (3, None, None)],
    ids=["ground", "upper", "lower", "ball"],
)
def test_a_single_body_without_connections(body, force, throw):
    summary = summarise(only(hanging_chain(), body), GRAVITY)
    for largest in (summary["largest_resultant"], summary["largest_force_sum"]):
        assert (largest and largest["force_N"]) == force
    assert (summary["largest_throw"] and summary["largest_throw"]["throw_m"]) == throw
    assert summary["connections"]["count"] == summary["connections"]["broken"] == 0
    assert len(summary["hits_of_the_ball"]) == (body == 3)


@pytest.mark.parametrize("results", [hanging_chain(), only(hanging_chain(), 0)], ids=["chain", "ground"])
def test_summary_is_strict_json(results):
    summary = summarise(results, GRAVITY)
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary
