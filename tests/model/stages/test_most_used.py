# SPDX-License-Identifier: GPL-3.0-or-later
"""Utilisation of spans with bars, against w L² / 8 by the moment of resistance, worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.stages.stability import stability_of
from bridge_demolition_addon.model.stages.standing import RESISTANCE, StandingBridge, most_used_of
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.section_use import SectionsWithBars

pytestmark = pytest.mark.slow

WIDTH_M, DEPTH_M, OVERHANG_M, TO_BARS_M = 5.0, 0.8, 0.3, 0.06
SPAN = """
[scenario]
title = "span with bars"
seed = {seed}
[time]
duration_s = 1.0
[bridge]
density_kg_m3 = 2500
span_lengths_m = [{span_m}]
skew_deg = {skew}
[bridge.deck]
width_m = 5.0
thickness_m = 0.8
overhang_m = 0.3
[bridge.abutments]
length_m = 0.6
width_m = 5.0
height_m = 3.0
[bridge.bearings]
pinned_at = 1
[[supports]]
member = "abutment"
{bars}
[fracture]
shards = 32
[[fracture.members]]
member = "abutment"
shards = 1
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
{ductility}
[shards]
start_deactivated = false
"""
LAYER = '[[reinforcement]]\nmembers = ["deck"]\nalong = "x"\nside = "{}"\ndepth_m = 0.06\narea_mm2 = {}\n'


def span(span_m, area_mm2=12500, seed=1, skew=0.0):
    bars = LAYER.format("bottom", area_mm2) + LAYER.format("top", 4000)
    return scenario_from_text(
        SPAN.format(span_m=span_m, seed=seed, skew=skew, bars=bars, ductility="ductile_elongation_m = 0.01")
    )


def most_used(scenario):
    model = build_model(scenario)
    bridge, count = StandingBridge(model, scenario.joints), len(model.connections)
    standing = bridge.rest(np.ones(count, bool), np.ones(count), np.zeros((6, len(model.shards))))
    return most_used_of(bridge, SectionsWithBars(scenario, model), standing), standing


def by_hand(span_m, area_mm2, scenario):
    """Moment at mid-span over A f_y (d - a / 2) with a = A f_y / (b f_c); the bars near the pressed edge do little."""
    load_n_m = 2500.0 * STANDARD_GRAVITY_M_S2 * WIDTH_M * DEPTH_M
    pull_n = 1e-6 * area_mm2 * 500e6
    block_m = pull_n / (WIDTH_M * scenario.joints[0].strength.compression_pa)
    resisted_nm = pull_n * (DEPTH_M - TO_BARS_M - 0.5 * block_m)
    return load_n_m * (span_m**2 / 8.0 - OVERHANG_M**2 / 2.0) / resisted_nm


def test_spans_of_one_design_use_what_they_do_by_hand():
    uses, cracked = [], []
    for span_m in (9.0, 11.0, 13.0, 15.0, 17.0, 20.0):
        scenario = span(span_m)
        most, standing = most_used(scenario)
        assert (most.governed_by, most.between) == (RESISTANCE, ("deck",))
        # What stands by hardening alone uses all that its bars resist as they yield.
        assert most.used == pytest.approx(min(by_hand(span_m, 12500, scenario), 1.0), rel=0.05)
        assert abs(most.at_m[0] - span_m / 2.0) < 1.5
        uses.append(most.used)
        cracked.append(standing.cracked.any())
    assert uses == sorted(uses) and uses[0] < 0.3 and uses[-1] == 1.0
    assert not cracked[0] and all(cracked[2:])  # it makes no difference whether the concrete still holds


@pytest.mark.parametrize("seed", [5, 23])
def test_more_bars_are_used_less(seed):
    uses = []
    for area_mm2 in (9000, 12000, 18000):
        scenario = span(15.0, area_mm2, seed=seed)
        uses.append(most_used(scenario)[0].used)
        assert uses[-1] == pytest.approx(by_hand(15.0, area_mm2, scenario), rel=0.05)
    assert uses[0] > uses[1] > uses[2]


def test_a_skewed_span_counts_along_its_bars():
    scenario = span(12.0, skew=20.0)
    along = by_hand(12.0, 12500, scenario)
    # A slab with a skew spans by what is between its span along the road and the one square to its supports.
    assert 0.95 * along * np.cos(np.radians(20.0)) ** 2 < most_used(scenario)[0].used < 1.05 * along


@pytest.mark.parametrize("seed", [1, 7])
def test_load_factors_fall_with_longer_spans_too(seed):
    """Where what a deck carries is what its section resists, that by its weight goes with 1 / L²."""
    spans_m = (9.0, 12.0, 15.0, 18.0)
    found = [stability_of(span(span_m, seed=seed)) for span_m in spans_m]
    factors, uses = ([getattr(each, name) for each in found] for name in ("load_factor", "utilisation"))
    assert all(np.diff(factors) < 0.0) and all(np.diff(uses) > 0.0)
    by_span = [factor * (span_m**2 - 4.0 * OVERHANG_M**2) for factor, span_m in zip(factors, spans_m, strict=True)]
    assert max(by_span) < 1.1 * min(by_span)
    for stability in found:  # bars harden by 8 %, and a crack lies between middles of shards
        assert 0.95 < stability.load_factor * stability.utilisation < 1.3
        assert "of the resistance in bending (deck)" in stability.sentence


def test_spans_with_bars_by_rule_have_a_reserve():
    rule = '[bridge.reinforcement]\ndesigned_for = "LM1"\n'
    uses = []
    for span_m in (9.0, 12.0, 15.0):
        text = SPAN.format(span_m=span_m, seed=1, skew=0.0, bars=rule, ductility="")
        most, _ = most_used(scenario_from_text(text))
        uses.append(most.used)
    # Bars for 1.35 times own weight and traffic, f_y / 1.15: own weight alone uses less than 1 / 1.35 / 1.15 of them.
    assert uses == sorted(uses) and uses[-1] < 0.645


def test_without_bars_faces_are_judged_by_their_strength():
    scenario = span(5.0)
    plain = replace(scenario, reinforcement=(), connections=replace(scenario.connections, ductile_elongation_m=None))
    most, standing = most_used(plain)
    assert most.governed_by != RESISTANCE and most.words == "of the strength of a face"
    assert most.used == np.nanmax(standing.used)
