# SPDX-License-Identifier: GPL-3.0-or-later
"""Composite spans in runs in Blender: at rest as by statics, with studs that hold, yield, or are not there."""

from dataclasses import replace

import numpy as np
import pytest
from support.composite import composite_scenario, deflection_of, shards_of

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.structure.equilibrium import loads_of, model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.simulation.run import run_scenario

SPAN_M = 12.0
AWAKE = "[shards]\nstart_deactivated = false\n"
DECK_N = 2500.0 * 4.0 * 0.2 * SPAN_M * STANDARD_GRAVITY_M_S2


def run_of(folder, studs, tables="", **time):
    """Scenario, model, summary and results of a run of a short span."""
    scenario = composite_scenario((SPAN_M,), fields=2, pieces=2, shards=20, studs=studs, tables=AWAKE + tables)
    scenario = replace(scenario, time=replace(scenario.time, **time))
    summary = run_scenario(scenario, folder / "run", overwrite=False, pictures=False, progress=Silence())
    return scenario, build_model(scenario), summary, load_results(folder / "run" / "results.npz")


def goes_down_m(results, name):
    """How far a node is below where it was built, in each frame (k,)."""
    (body,) = np.flatnonzero(results.inventory.body_members == name)
    heights = results.frames.positions_m[:, body, 2]
    return heights[0] - heights


def test_it_rests_as_by_statics_until_a_girder_is_taken_away(tmp_path):
    """Deflection and shear of studs within 1 %; then the other girder and the deck carry its part of the load.

    Ten passes of the solver: with more of them a shard of the deck presses on a piece that no stud joins it to, which
    statics have not, and studs carry up to 4 % of the largest force more or less.
    """
    removal = '[[removals]]\ntime_s = 0.5\nmembers = ["span G1 0-1"]\n'
    scenario, model, _, results = run_of(
        tmp_path, "studs_per_m = 6\nstud_diameter_mm = 19", removal, solver_iterations=10
    )
    rest = model_at_rest(model, scenario.joints)
    before = (results.frames.time_s > 0.1) & (results.frames.time_s < 0.49)
    assert goes_down_m(results, "span G1 1")[before] == pytest.approx(deflection_of(model, rest, "span G1 1"), rel=0.01)
    forces = loads_of(model, rest).forces_n[model.decks.rows]
    frame = int(np.flatnonzero(before)[-1])
    carried = results.frames.loads.connection_forces_n[frame, model.decks.rows]
    largest = abs(forces[:, 0]).max()
    np.testing.assert_allclose(carried[:, 0], forces[:, 0], atol=0.01 * largest)
    assert goes_down_m(results, "span G1 1")[-1] > 2.0 * goes_down_m(results, "span G1 1")[frame]


@pytest.mark.long
def test_studs_that_are_overloaded_yield_and_hold_on(tmp_path):
    """Studs of 3 kN, where 12 would be needed: they yield, none fails, and the span stands between both stiffnesses."""
    weak = "studs_per_m = 6\nstud_strength_n = 3e3\nstud_uplift_n = 3e3\nstud_slip_mm = 30"
    scenario, model, summary, results = run_of(tmp_path, weak)
    kinds = {kind["kind"]: kind for kind in summary["reinforcement"]["by_kind"]}
    of_studs = kinds["deck and girder"]
    assert of_studs["yielded"] > 0 and of_studs["ruptured"] == 0
    whole = deflection_of(model, model_at_rest(model, scenario.joints), "span G1 1")
    loose = composite_scenario((SPAN_M,), fields=2, pieces=2, shards=20, studs="studs_per_m = 0\ndeck_friction = 0.01")
    apart_model = build_model(loose)
    apart = deflection_of(apart_model, model_at_rest(apart_model, loose.joints), "span G1 1")
    ends = goes_down_m(results, "span G1 1")[-5:].mean()
    assert 1.03 * whole < ends < apart


@pytest.mark.long
def test_a_deck_without_studs_presses_on_its_girders_by_its_weight(tmp_path):
    _, model, summary, results = run_of(tmp_path, "studs_per_m = 0")
    on_girders = [row for row in summary["bearings"] if row["name"].startswith("span deck on")]
    assert [row["name"] for row in on_girders] == ["span deck on span G1", "span deck on span G2"]
    assert sum(row["at_rest_up_N"] for row in on_girders) == pytest.approx(DECK_N, rel=0.02)
    deck = np.flatnonzero(results.inventory.body_members == "span deck")
    assert len(deck) == len(shards_of(model, "span deck"))
    moved = results.frames.positions_m[-1, deck] - results.frames.positions_m[0, deck]
    assert abs(moved).max() < 0.02
