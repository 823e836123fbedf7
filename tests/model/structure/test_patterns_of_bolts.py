# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars on bolts by their pattern: what `bda check` says of them, and what their joints resist, by hand."""

import numpy as np
import pytest
from support.steelwork import bar, node, steel_scenario

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.steelwork import bending_to_axial_ratio_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.steel_bars import bar_uses, steel_facts

TWO = "2 M20 8.8 in 1 line, p1 70, e1 40, e2 50, gusset 12"
"""Bearing of the bar of 10 mm of S235, f_u = 360: 2.5 · 0.606 · 360 · 20 · 10 = 109.1 kN of the last bolt, less than
117.6 kN in shear; 146.0 kN of the other. 3.7: twice the least, 218.2 kN."""

SIX = "6 M20 8.8 in 2 lines, p1 70, p2 70, e1 40, e2 40, gusset 20"


def tie(load_kg, **keys):
    nodes = [node("top", 0.0, 9.0, support="fixed"), node("hook", 0.0, 4.0, mass_kg=load_kg)]
    return steel_scenario(nodes, [bar("tie", "top", "hook", "FLAT 150x10", **keys)], grade="S235", pieces=4)


def cantilever(load_kg, bolts, section="FLAT 200x20"):
    nodes = [node("wall", 0.0, 5.0, support="fixed"), node("tip", 2.0, 5.0, mass_kg=load_kg)]
    members = [bar("arm", "wall", "tip", section, end_bolts=[bolts, "welded"])]
    return steel_scenario(nodes, members, grade="S355", pieces=8)


def factor(scenario):
    bridge = StandingBridge(build_model(scenario), scenario.joints)
    whole = np.ones(len(bridge.model.connections))
    return bridge.collapse_factor(whole > 0.0, whole, np.zeros((6, len(bridge.model.shards))))


def first_joint(model):
    joints = model.steel.joints
    return int(model.steel.rows[: len(joints.numbers)][joints.numbers == 0][0])


def facts_of(scenario):
    model = build_model(scenario)
    return [text for _, text in steel_facts(scenario, model, model_at_rest(model, scenario.joints))]


def test_a_tie_comes_down_at_the_load_that_its_bolts_resist_in_bearing():
    scenario = tie(10_000.0, end_bolts=[TWO, "welded"])
    weight_n = float(build_model(scenario).masses_kg.sum()) * STANDARD_GRAVITY_M_S2
    assert factor(scenario) == pytest.approx(218.2e3 / weight_n, rel=0.015)  # found within 1 %


def test_bda_check_says_what_bolts_resist_and_which_is_used_most():
    scenario = tie(10_000.0, end_bolts=[TWO, "welded"])
    model = build_model(scenario)
    (use,) = bar_uses(scenario, model, model_at_rest(model, scenario.joints))
    weight_n = float(model.masses_kg.sum()) * STANDARD_GRAVITY_M_S2
    assert use.bolts_used == (pytest.approx(0.5 * weight_n / 109.09e3, rel=2e-3), None)
    # Block from an edge: 50 - 11 = 39 mm in tension, 77 mm in shear: 10 · (39 · 360 + 77 · 135.7) = 244.9 kN.
    # Across it is one row in single shear, 1.5 · 360 · 20 · 10 = 108.0 kN (3.6.1 (10)): twice that, and by 70 mm.
    assert facts_of(scenario)[-1] == (
        f"{TWO} at top: resist 218.2 kN in shear and bearing, the section between holes 414.7 kN, a block 244.9 kN, "
        "62% of the bar; across it 216.0 kN and 7.56 kN·m; the farthest bolt is used by 45%"
    )


@pytest.mark.long
@pytest.mark.slow
def test_a_cantilever_yields_at_the_moment_of_its_bolts():
    """Six bolts, I_p = 26 950 mm², farthest at 78.3 mm: 117.6 kN · 344.4 mm = 40.5 kN·m; the bar alone: 71.0 kN·m."""
    scenario = cantilever(1000.0, SIX)
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    moment_nm = float(np.abs(rest.loads[3:, first_joint(model)]).max())
    (use,) = bar_uses(scenario, model, rest)
    assert use.section_used == pytest.approx(moment_nm / 40.50e3, rel=0.01)  # with some shear
    assert factor(scenario) == pytest.approx(40.50e3 / moment_nm, rel=0.02)


def test_the_farthest_bolt_has_a_moment_and_a_shear_by_hand():
    scenario = cantilever(1000.0, SIX)
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    row = first_joint(model)
    shear_n, moment_nm = abs(rest.loads[2, row]), float(np.abs(rest.loads[3:, row]).max())
    force_n = np.hypot(moment_nm * 35e-3 / 26950e-6, shear_n / 6 + moment_nm * 70e-3 / 26950e-6)
    (use,) = bar_uses(scenario, model, rest)
    assert use.bolts_used[0] == pytest.approx(force_n / 117.6e3, rel=1e-3)


def test_out_of_the_plane_of_the_gusset_an_end_is_as_weak_as_along_the_bar():
    """A flat bar that lies has its pattern in the level plane."""
    upright, lying = (cantilever(1000.0, SIX, section).steelwork for section in ("FLAT 200x20", "FLAT 20x200"))
    of_upright, of_lying = (
        bending_to_axial_ratio_of(steelwork, steelwork.members[0], 0) for steelwork in (upright, lying)
    )
    share = upright.end_share(upright.members[0], 0)
    assert of_upright == (pytest.approx(40.50 / 71.0 / share, rel=1e-3), 1.0)
    assert of_lying == (1.0, pytest.approx(of_upright[0], rel=1e-9))
    assert bending_to_axial_ratio_of(upright, upright.members[0], 1) == (1.0, 1.0)


def test_overloaded_bolts_are_named():
    assert "arm: a bolt carries more than EN 1993-1-8, table 3.4 lets it resist" in facts_of(cantilever(2500.0, SIX))


@pytest.mark.parametrize(
    ("bolts", "message"),
    [
        (TWO.replace("e2 50", "e2 80"), "tie.*end_bolts.1: the pattern of bolts needs 160 mm"),
        (TWO.replace("e1 40", "e1 20"), "tie.*end_bolts.1: .*e1 is 20 mm: expected at least 26.4 mm"),
    ],
)
def test_a_pattern_that_does_not_fit_is_refused(bolts, message):
    with pytest.raises(ScenarioError, match=message):
        tie(10_000.0, end_bolts=[bolts, "welded"])
