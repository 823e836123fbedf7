# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples by explosives: they stand without their charges, which push away what is near."""

import json
from dataclasses import replace

import numpy as np
import pytest
from support.example_claims import assert_begins
from support.example_runs import begun, example, run_example
from support.long_cases import long_but

from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.study.outcome import evaluate

NAMES = ("single_span_explosives", "two_spans_20m_delays")
SAG_M = {"single_span_explosives": 0.03, "two_spans_20m_delays": 0.03}
"""Elastic with slivers that settle, 4 to 5 mm over 20 seeds; and of Bullet, with 50 iterations, not of concrete."""


def quiet(scenario):
    """The scenario without its explosion."""
    return replace(scenario, blast=replace(scenario.blast, explosion=False))


@pytest.fixture(params=long_but(["two_spans_20m_delays"], NAMES))
def loud(request, session_folder):
    return begun(request.param, session_folder)


@pytest.mark.long
@pytest.mark.parametrize("name", NAMES)
def test_bridge_stands_without_its_explosion(blender, tmp_path, name):
    run = run_example(quiet(example(name, 0.7)), tmp_path)
    connections = run.summary["connections"]
    # Slivers between members, and parts of the feet of columns. When the charges would go off, 0 to 0.9 % are broken
    # over 20 seeds, and shards have moved by 4 to 20 mm.
    assert connections["broken"] <= 0.05 * connections["count"]
    assert run.fallen_m(run.shards).max() < SAG_M[name]
    assert run.summary["charges"] is run.summary["blast"] is None


@pytest.mark.long
def test_bridge_stands_until_its_charges_go_off(loud):
    before = loud.results.frames.time_s < loud.scenario.blast.start_s
    assert (~loud.results.frames.intact[before]).sum(axis=1).max() <= 0.05 * loud.summary["connections"]["count"]


@pytest.mark.long
@pytest.mark.parametrize("loud", NAMES, indirect=True)
def test_charges_push_away_what_is_near(request, loud):
    assert_begins(request.node.callspec.params["loud"], loud)


def test_blast_pushes_away_from_the_charges(loud):
    # Every charge is below the deck: each shard of it gets its blast upwards.
    impulses = loud.results.frames.blast_impulses_ns.sum(axis=0)[loud.of_members("deck")]
    assert (impulses[:, 2] > 0.0).all()
    charges = loud.scenario.charges
    assert loud.summary["charges"]["mass_kg"] == sum(charge.mass_kg for charge in charges)


def test_a_study_keeps_little_of_such_a_run(loud, tmp_path):
    outcome = evaluate(loud.results, RunSummary.of(loud.summary), loud.scenario)
    np.savez_compressed(tmp_path / "outlines.npz", **outcome.outlines.arrays())
    assert len(loud.shards) >= 200
    assert (tmp_path / "outlines.npz").stat().st_size + len(json.dumps(outcome.outputs)) < 200_000


@pytest.mark.long
def test_fields_and_direct_loads_agree_where_nothing_breaks(blender, tmp_path):
    scenario = example("two_spans_20m_delays", 0.6, shards=60)
    scenario = replace(scenario, connections=replace(scenario.connections, breaking_force_n=1e12))
    totals = []
    for apply in ("fields", "direct"):
        run = run_example(replace(scenario, blast=replace(scenario.blast, apply=apply)), tmp_path / apply)
        totals.append(run.results.frames.blast_impulses_ns.sum(axis=0))
    sizes = np.linalg.norm(totals[0], axis=1)
    # The bridge moves by millimetres before the second charges go off, a little differently either way.
    np.testing.assert_array_less(np.linalg.norm(totals[0] - totals[1], axis=1), 0.002 * sizes.max())


def test_delays_load_one_after_the_other(blender, tmp_path):
    spans = []
    for name, times, largest_kg in (
        ("two_spans_20m_delays", [0.425, 0.4, 0.425], 2000.0),
        ("two_spans_20m_at_once", [0.4, 0.4, 0.4], 3000.0),
    ):
        scenario = example(name, 0.6, shards=60)
        summary = run_example(replace(scenario, blast=replace(scenario.blast, apply="direct")), tmp_path / name).summary
        assert [charge["detonation_s"] for charge in summary["charges"]["charges"]] == pytest.approx(times)
        assert [charge["mass_kg"] for charge in summary["charges"]["charges"]] == [1000.0] * 3
        assert summary["charges"]["largest_mass_at_once_kg"] == largest_kg
        spans.append(summary["blast"]["last_load"]["time_s"] - summary["blast"]["first_load"]["time_s"])
    assert spans[0] >= spans[1]


def test_the_two_differ_in_nothing_but_delays():
    delays, at_once = example("two_spans_20m_delays"), example("two_spans_20m_at_once")
    together = tuple(replace(charge, delay_ms=0.0) for charge in delays.charges)
    assert replace(delays, charges=together, title=at_once.title) == at_once
    assert delays.bridge.span_lengths_m == (20.0, 20.0)  # of the report
