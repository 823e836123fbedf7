# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads of the design on a bridge with bars by rule, against sums and plastic theory by hand."""

import numpy as np
import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.reinforcement.design import bar_schedule
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.design_loads import carries_design_loads, design_loads, load_cases
from bridge_demolition_addon.model.stages.standing import StandingBridge

pytestmark = pytest.mark.slow

SPAN_M, WIDTH_M, DEPTH_M, DENSITY_KG_M3 = 8.0, 3.0, 0.5, 2500.0
SLAB = f"""
[scenario]
title = "Slab"
[time]
duration_s = 1.0
[bridge]
density_kg_m3 = {DENSITY_KG_M3}
span_lengths_m = [{SPAN_M}]
[bridge.deck]
width_m = {WIDTH_M}
thickness_m = {DEPTH_M}
[bridge.piers]
kind = "wall"
column_length_m = 0.6
column_width_m = {WIDTH_M}
height_m = 2.0
[bridge.bearings]
[bridge.reinforcement]
DESIGN
[[fracture.members]]
member = "pier"
shards = 2
[fracture]
shards = 40
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
"""
Q_N_M2 = 10e3


def standing(scenario):
    return StandingBridge(checked_model(scenario), scenario.joints)


def test_load_model_1_adds_up_to_what_en_1991_2_says():
    """One lane of 3 m with 9 kN/m², 2.5 kN/m² on the other 0.7 m, and two axles of 300 kN in the middle of the span."""
    scenario = read_scenario(EXAMPLES / "two_spans_13m_ball.toml")
    model = checked_model(scenario)
    cases = dict(load_cases(scenario, model))
    assert list(cases) == ["LM1 on span 1", "LM1 on span 2"]  # each span has a deck of its own
    traffic_n = 13.0 * (3.0 * 9e3 + 0.7 * 2.5e3) + 600e3
    for name, middle_m in (("LM1 on span 1", 6.5), ("LM1 on span 2", 19.5)):
        loads = cases[name]
        assert -loads[2].sum() == pytest.approx(1.5 / 1.35 * traffic_n, rel=1e-9)
        # Their resultant: forces at the centres of the shards, and what they turn these by.
        about_y = (loads[4] - model.centres_m[:, 0] * loads[2]).sum() / -loads[2].sum()
        assert about_y == pytest.approx(middle_m, abs=1e-9)
        about_x = (loads[3] + model.centres_m[:, 1] * loads[2]).sum()
        assert about_x == pytest.approx(0.0, abs=1e-3)


def test_loads_of_a_skewed_deck_stand_on_it():
    scenario = read_scenario(EXAMPLES / "three_span_box_girder.toml")
    cases = dict(load_cases(scenario, checked_model(scenario)))
    # Lanes of 3 m: 9 kN/m² and 2 × 2.5 kN/m²; axles of 600, 400 and 200 kN.
    whole = 1.5 / 1.35 * (16.0 * 3.0 * (9e3 + 2.5e3 + 2.5e3) + 1200e3)
    assert -cases["LM1 on span 2"][2].sum() == pytest.approx(whole, rel=1e-9)
    assert len(cases) == 5


@pytest.fixture(scope="module")
def slab():
    return scenario_from_text(SLAB.replace("DESIGN", f"traffic_kn_m2 = {Q_N_M2 / 1e3}"))


def test_the_load_factor_is_that_of_plastic_theory(slab):
    """M = A f_y (d - a / 2) of the bars of the schedule, over 1.35 g L² / 8 + 1.5 q L² / 8.

    Irregular shards carry up to 30 % more (docs/stages.md), and bars harden by 8 % until they rupture.
    """
    rows = bar_schedule(slab, prepared_members(slab).members).bars
    layer = next(
        row.layer for row in rows if row.kind == "deck" and (row.layer.side, row.layer.along) == ("bottom", "x")
    )
    force_n, compression_pa = layer.area_m2 * 500e6, 35e6  # B500B, and `concrete`
    depth_m = DEPTH_M - layer.depth_m
    resisted_nm = force_n * (depth_m - force_n / (WIDTH_M * compression_pa) / 2.0)
    own_n_m2 = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * DEPTH_M
    acting_nm = (1.35 * own_n_m2 + 1.5 * Q_N_M2) * WIDTH_M * SPAN_M**2 / 8.0
    (found,) = design_loads(slab, standing(slab))
    assert 0.97 < found.factor / (resisted_nm / acting_nm) < 1.3 * 1.08


def test_without_traffic_its_own_weight_counts_alone():
    scenario = scenario_from_text(SLAB.replace("DESIGN", 'designed_for = "own weight"'))
    bridge = standing(scenario)
    assert list(carries_design_loads(scenario, bridge)) == ["own weight alone"]
    assert all(np.all(loads == 0.0) for _, loads in load_cases(scenario, bridge.model))


def test_a_bridge_without_designed_bars_has_none(slab):
    scenario = scenario_from_text(SLAB.replace("DESIGN", 'designed_for = "none"'))
    assert design_loads(scenario, standing(scenario)) == []


@pytest.mark.long
def test_stages_say_it(tmp_path, capfd, slab):
    path = tmp_path / "slab.toml"
    path.write_text(SLAB.replace("DESIGN", f"traffic_kn_m2 = {Q_N_M2 / 1e3}"), encoding="utf-8")
    assert main(["stages", str(path), "--output", str(tmp_path / "out")]) == 0
    said = capfd.readouterr().out
    assert "under 1.35 G + 1.5 Q, 10 kN/m² on span 1: collapse load factor" in said and "it carries them" in said
