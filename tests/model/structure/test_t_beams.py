# SPDX-License-Identifier: GPL-3.0-or-later
"""Girders that are cast with their slab are T-beams: effective widths, moments and load factors by hand."""

from functools import cache

import numpy as np
import pytest

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.materials import ReinforcedSection
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.stages.standing import RESISTANCE, StandingBridge, most_used_of
from bridge_demolition_addon.model.structure.facts import connection_facts
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.section_use import SectionsWithBars
from bridge_demolition_addon.model.structure.t_beams import t_beams

TEXT = """
[scenario]
title = "T-beams"
seed = {seed}
[time]
duration_s = 1.0
[bridge]
density_kg_m3 = 2500
span_lengths_m = {spans}
[bridge.deck]
width_m = 6.0
thickness_m = 0.25
overhang_m = 0.4
[bridge.girders]
number = 2
width_m = 0.5
depth_m = 0.9
spacing_m = 3.0
[bridge.abutments]
length_m = 0.8
width_m = 6.0
{height}
[bridge.bearings]
friction = 0.05
{bars}
[fracture]
shards = {shards}
[[fracture.members]]
member = "abutment"
shards = 1
[[supports]]
member = "abutment"
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
[shards]
start_deactivated = false
"""
PIERS = "[bridge.piers]\ncolumns = 2\ncolumn_length_m = 0.8\ncolumn_width_m = 0.8\nheight_m = 4.0"
BARS = """
[[reinforcement]]
members = ["girder"]
depth_m = 0.1
area_mm2 = 8000
diameter_mm = 32
[[reinforcement]]
members = ["girder"]
along = "z"
spread_mm2_m2 = {links}
[[reinforcement]]
members = ["deck"]
side = "top"
depth_m = 0.06
area_mm2 = 15000
[[reinforcement]]
members = ["deck"]
along = "y"
side = "top"
depth_m = 0.08
area_mm2 = 20000
[[reinforcement]]
members = ["deck"]
along = "y"
depth_m = 0.05
area_mm2 = 20000
"""
COMPRESSION_PA, YIELD_PA = 35e6, 500e6
LOAD_N_M = 2500.0 * STANDARD_GRAVITY_M_S2 * (3.0 * 0.25 + 0.5 * 0.9)


@cache
def planned(spans="[16.0]", links=8000, seed=3, shards=82):
    height = "height_m = 4.0" if spans.count(",") == 0 else PIERS
    return scenario_from_text(
        TEXT.format(spans=spans, seed=seed, height=height, bars=BARS.format(links=links), shards=shards)
    )


@cache
def standing(**keys):
    plan = planned(**keys)
    model = build_model(plan)
    bridge, count = StandingBridge(model, plan.joints), len(model.connections)
    nothing = np.ones(count, bool), np.ones(count), np.zeros((6, len(model.shards)))
    return plan, bridge, nothing


def sagging_nm():
    """All bars of the girder at yield, the block in a flange of 3 m; bars at the top of the slab are within it."""
    pull_n = 8000e-6 * YIELD_PA
    return pull_n * (1.15 - 0.1 - 0.5 * pull_n / (3.0 * COMPRESSION_PA))


def hogging_nm(flange_m):
    """Bars of the slab within the flange at yield, the block in the web."""
    pull_n = 15000e-6 * flange_m / 6.0 * YIELD_PA
    return pull_n * (1.15 - 0.06 - 0.5 * pull_n / (0.5 * COMPRESSION_PA))


def test_a_t_section_is_the_rectangle_that_its_block_lies_in():
    whole = ReinforcedSection(1.15, 3.0, COMPRESSION_PA, [1.05], [8000e-6], [YIELD_PA])
    beam = ReinforcedSection(1.15, 0.5, COMPRESSION_PA, [1.05], [8000e-6], [YIELD_PA], (3.0, 0.25))
    assert beam.moments_nm()[0] == pytest.approx(whole.moments_nm()[0], rel=1e-9)
    assert beam.moments_nm()[0] == pytest.approx(sagging_nm(), rel=1e-9)


def test_a_block_deeper_than_the_flange_goes_on_in_the_web():
    """By hand: 10 MN are 35 N/mm² on 0.8 m × 0.25 m and on 0.5 m × 0.1714 m of web below."""
    beam = ReinforcedSection(1.15, 0.5, COMPRESSION_PA, [1.05], [20000e-6], [YIELD_PA], (0.8, 0.25))
    in_web = (10e6 - 7e6) / (0.5 * COMPRESSION_PA)
    by_hand = 7e6 * (1.05 - 0.125) + 3e6 * (1.05 - 0.25 - 0.5 * in_web)
    assert beam.moments_nm()[0] == pytest.approx(by_hand, rel=1e-9)
    # The same at its other edge presses the web alone: 1 MN are 57 mm of it.
    upside_down = ReinforcedSection(1.15, 0.5, COMPRESSION_PA, [0.1], [2000e-6], [YIELD_PA], (0.8, 0.25))
    assert upside_down.moments_nm()[1] == pytest.approx(1e6 * (1.05 - 0.5 * 1e6 / (0.5 * COMPRESSION_PA)), rel=1e-9)


def test_a_t_section_that_is_pressed_as_a_whole_is_so_about_its_own_middle():
    beam = ReinforcedSection(1.0, 0.5, COMPRESSION_PA, [0.1, 0.9], [1e-4] * 2, [YIELD_PA] * 2, (1.5, 0.2))
    of_concrete_n, above_middle_m = 0.7 * COMPRESSION_PA, 1.0 * 0.2 * 0.4 / 0.7
    pressed = np.array([[-of_concrete_n - 2e-4 * YIELD_PA, of_concrete_n * above_middle_m]])
    for part in (0.5, 0.99):
        assert beam.utilisations(*(part * pressed.T)) == pytest.approx(part, rel=1e-3)
    assert beam.utilisations(pressed[:, 0], -pressed[:, 1])[0] > 1.1  # as much beyond the middle on its other side


@pytest.mark.parametrize(
    ("spans", "at_m", "flange_m"),
    [
        # EN 1992-1-1, 5.3.2.1: each side 0.2 b + 0.1 l0, at most b = 1.25 m, with l0 = 16 m
        ("[16.0]", 8.0, 3.0),
        # l0 = 0.85 × 10 = 8.5 m: 0.5 + 2 × (0.25 + 0.85)
        ("[10.0, 14.0]", 5.0, 2.7),
        # l0 = 0.15 × 24 = 3.6 m: 0.5 + 2 × (0.25 + 0.36)
        ("[10.0, 14.0]", 10.2, 1.72),
        # l0 = 0.7 × 10 = 7 m in a span between two piers: 0.5 + 2 × (0.25 + 0.7)
        ("[10.0, 10.0, 10.0]", 15.0, 2.4),
    ],
)
def test_flanges_are_as_wide_as_is_effective(spans, at_m, flange_m):
    plan = planned(spans)
    model = build_model(plan)
    beams = list(t_beams(plan, model.layers, model.members))
    assert [beam.flange_m(at_m) for beam in beams] == pytest.approx([flange_m] * 2)


def test_what_is_printed_is_of_the_whole_section():
    plan = planned("[16.0, 16.0]", shards=60)
    (line,) = [text for _, text in connection_facts(plan, build_model(plan)) if "of slab" in text]
    printed = [float(part.split(" kN·m")[0].split()[-1]) for part in line.split(";")]
    # 0.5 + 2 × (0.25 + 0.15 × 32 × 0.1) over the pier
    assert 1000.0 * np.array(printed) == pytest.approx([sagging_nm(), hogging_nm(1.96)], rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "shards"), [(3, 82), (11, 122)])
def test_a_span_uses_what_it_does_by_hand(seed, shards):
    plan, bridge, nothing = standing(seed=seed, shards=shards)
    most = most_used_of(bridge, SectionsWithBars(plan, bridge.model), bridge.rest(*nothing))
    by_hand = LOAD_N_M * (16.0**2 / 8.0 - 0.4**2 / 2.0) / sagging_nm()
    assert most.governed_by == RESISTANCE and most.between[0].startswith("girder")
    assert most.used == pytest.approx(by_hand, rel=0.12)


@pytest.mark.slow
def test_a_span_carries_as_many_times_its_weight_as_by_hand():
    _, bridge, nothing = standing()
    by_hand = sagging_nm() / LOAD_N_M / (16.0**2 / 8.0 - 0.4**2 / 2.0)
    # Bars harden by 8 %, and a crack lies between middles of shards.
    assert 0.95 < bridge.collapse_factor(*nothing) / by_hand < 1.3


@pytest.mark.slow
def test_few_links_are_used_as_shear_flows_along_the_slab():
    """Shear flow V S / I of the whole section, which has not cracked, over a quarter of the span beside a support."""
    plan, bridge, nothing = standing(links=2000)
    model = bridge.model
    loads = bridge.unbroken(nothing[0]).loads
    most = SectionsWithBars(plan, model).most_used(loads, np.full(len(model.connections), np.nan))
    web_m2, slab_m2, apart_m = 0.5 * 0.9, 3.0 * 0.25, 0.575
    both = web_m2 * slab_m2 / (web_m2 + slab_m2) * apart_m
    inertia_m4 = 0.5 * 0.9**3 / 12.0 + 3.0 * 0.25**3 / 12.0 + both * apart_m
    flow_n_m = LOAD_N_M * (8.0 - 0.5 * 4.0) * both / inertia_m4
    assert most.along_slab
    assert most.used == pytest.approx(flow_n_m / (0.9 * 2000e-6 * 0.5 * YIELD_PA), rel=0.2)
