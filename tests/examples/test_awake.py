"""The bridge of 2019 that does not start deactivated falls under its own weight; one that does stands."""

from dataclasses import replace

import numpy as np
import pytest
from example_runs import example, run_example


@pytest.fixture(scope="module")
def awake(tmp_path_factory):
    return run_example(example("single_span_awake", 2.0), tmp_path_factory.mktemp("awake"))


def test_nothing_happens_to_it_but_its_own_weight(awake):
    scenario = awake.scenario
    assert scenario.ball is None and not scenario.charges and not scenario.changes and not scenario.jackhammers
    assert scenario.connections.breaking_force_kgf == 10_000  # of the report, Table 2
    assert awake.results.inventory.masses_kg[awake.shards].sum() == pytest.approx(107_000.0, rel=1e-6)


def test_awake_it_falls(awake):
    deck = awake.of_members("deck")
    # From 5.4 m to the ground within 1.5 s: free fall alone takes 1.05 s.
    assert np.median(awake.fallen_m(deck, awake.at(1.5))) > 3.0
    assert np.median(awake.fallen_m(deck)) > 4.0
    assert awake.summary["connections"]["broken"] > 0.3 * awake.summary["connections"]["count"]
    assert awake.throws_m(awake.shards).max() < 8.0


def test_deactivated_it_stands(awake, tmp_path):
    scenario = example("single_span_awake", 0.5)
    shards = replace(scenario.shards, use_deactivation=True, start_deactivated=True)
    asleep = run_example(replace(scenario, shards=shards), tmp_path)
    assert asleep.summary["connections"]["broken"] == 0
    # Nothing is solved, so nothing moves at all: what is left is the rounding of places as float32.
    assert asleep.moved_m(asleep.shards).max() < 1e-5
    # The one that is awake has begun to break and to fall by then.
    step = awake.at(0.5)
    assert not awake.results.frames.intact[step].all()
    assert awake.fallen_m(awake.of_members("deck"), step).max() > 0.1
