# SPDX-License-Identifier: GPL-3.0-or-later
"""The bridge of 2019 that does not start deactivated breaks under its own weight; one that does stands."""

from dataclasses import replace

import pytest
from support.example_claims import assert_begins
from support.example_runs import begun, example, run_example


@pytest.fixture(scope="module")
def awake(session_folder):
    return begun("single_span_awake", session_folder)


def test_nothing_happens_to_it_but_its_own_weight(awake):
    scenario = awake.scenario
    assert scenario.ball is None and not scenario.charges and not scenario.changes and not scenario.jackhammers
    assert scenario.connections.breaking_force_kgf == 10_000  # of the report, Table 2
    assert awake.results.inventory.masses_kg[awake.shards].sum() == pytest.approx(107_000.0, rel=1e-6)


def test_awake_it_breaks_under_its_own_weight(awake):
    assert_begins("single_span_awake", awake)


@pytest.mark.long
def test_deactivated_it_stands(blender, tmp_path):
    scenario = example("single_span_awake", 0.5)
    shards = replace(scenario.shards, use_deactivation=True, start_deactivated=True)
    asleep = run_example(replace(scenario, shards=shards), tmp_path)
    assert asleep.summary["connections"]["broken"] == 0
    # Nothing is solved, so nothing moves at all: what is left is the rounding of places as float32.
    assert asleep.moved_m(asleep.shards).max() < 1e-5
