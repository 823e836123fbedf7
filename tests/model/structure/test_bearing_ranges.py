# SPDX-License-Identifier: GPL-3.0-or-later
"""What single bearings carry in several cuts of one bridge, against symmetry and the theorem of three moments."""

import numpy as np
import pytest
from support.bearing_decks import WEIGHT_N_M, deck_text

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.bearing_ranges import bearing_axes, bearing_facts, bearing_ranges
from bridge_demolition_addon.model.structure.equilibrium import loads_of, model_at_rest
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

SPAN_M, OVERHANG_M = 12.0, 0.4
GIRDERS = """
[scenario]
title = "three girders, symmetric"
seed = {seed}
[time]
duration_s = 1.0
[bridge]
density_kg_m3 = 2500
span_lengths_m = [12.0, 12.0]
skew_deg = {skew}
[bridge.deck]
width_m = 6.0
thickness_m = 0.3
overhang_m = 0.4
[bridge.girders]
number = 3
width_m = 0.5
depth_m = 0.9
spacing_m = 2.0
[bridge.piers]
columns = 3
column_length_m = 0.8
column_width_m = 0.8
height_m = 4.0
[bridge.abutments]
length_m = 0.8
width_m = 6.0
[bridge.bearings]
pinned_at = 2
[[supports]]
member = "abutment"
[[supports]]
member = "pier"
[fracture]
shards = {shards}
[[fracture.members]]
member = "abutment"
shards = 1
[[fracture.members]]
member = "pier"
shards = 1
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
strength_factor = 50.0
[shards]
start_deactivated = false
"""


def girders(seed=3, shards=90, skew=0.0):
    return scenario_from_text(GIRDERS.format(seed=seed, shards=shards, skew=skew))


def ranges_of(scenario, count):
    return bearing_ranges(scenario, build_model(scenario), count)


@pytest.mark.parametrize(("seed", "shards"), [pytest.param(3, 90, marks=pytest.mark.long), (40, 70)])
def test_ranges_over_cuts_hold_what_girders_carry_by_symmetry(seed, shards):
    found = ranges_of(girders(seed, shards), 5)
    # Three moments with equal spans L and overhangs a: M2 = -w (L² - 2 a²) / 8, M1 = -w a² / 2.
    load_n_m = 2500.0 * STANDARD_GRAVITY_M_S2 * (6.0 * 0.3 + 3 * 0.5 * 0.9)
    over_pier = load_n_m * (SPAN_M**2 - 2.0 * OVERHANG_M**2) / 8.0
    at_end = load_n_m * OVERHANG_M**2 / 2.0
    outer_n = load_n_m * (SPAN_M / 2.0 + OVERHANG_M) - (over_pier - at_end) / SPAN_M
    inner_n = 2.0 * (load_n_m * (SPAN_M + OVERHANG_M) - outer_n)
    expected = {"on abutment 1": outer_n, "on pier 1 column": inner_n, "on abutment 2": outer_n}
    assert [axis.name for axis in found.axes] == list(expected)
    for axis in found.axes:
        sums_n = found.upwards_n[:, list(axis.bearings)].sum(axis=1)
        np.testing.assert_allclose(sums_n, expected[axis.name], rtol=0.1)
        assert sums_n.mean() == pytest.approx(expected[axis.name], rel=0.04)  # few shards make a stiff pier of it
    truth = np.repeat([outer_n, inner_n, outer_n], 3) / 3.0
    np.testing.assert_allclose(found.upwards_n, np.tile(truth, (len(found.upwards_n), 1)), rtol=0.08)


def test_what_is_printed_of_cuts(tmp_path, capsys):
    path = tmp_path / "girders.toml"
    path.write_text(GIRDERS.format(seed=3, shards=60, skew=0.0))
    main(["check", "--cuts", "2", str(path)])
    said = capsys.readouterr().out
    assert "Bearings in 2 cuts, seeds 3 to 4" in said
    assert said.count(" kN up in another cut") == 9 and "by seed 4: single bearings differ by up to " in said
    assert "chance of 67%" in said  # 2 of 3: each of three cuts is as likely to be the least or the largest
    section = said[said.index("Bearings in 2 cuts") :]
    assert section.count(" kN in the mean") == 12 and section.count("in all") == 3
    for wrong in ("1", "101", "2.5", "many"):
        assert main(["check", "--cuts", wrong, str(path)]) != 0
        assert f"'{wrong}' is wrong: expected a whole number from 2 to 100" in capsys.readouterr().err


def test_bearings_of_a_skewed_bridge_have_their_axes():
    scenario = girders(skew=30.0, shards=60)
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    forces = model.bearings.forces(loads_of(model, rest))
    facts = dict(bearing_facts(scenario, model, rest, forces))
    assert [name for name in facts if name.startswith("on ")] == ["on abutment 1", "on pier 1 column", "on abutment 2"]
    weight_kn = sum(bearing.force_n[2] for bearing in forces) / 1000.0
    sums = [float(text.split()[0]) for name, text in facts.items() if name.startswith("on ")]
    assert sum(sums) == pytest.approx(weight_kn, abs=0.2)


def test_a_deck_in_lines_has_no_axis_of_several_bearings():
    scenario = scenario_from_text(deck_text())
    model = build_model(scenario)
    assert bearing_axes(model, model.bearings.forces(loads_of(model, model_at_rest(model, scenario.joints)))) == ()


def test_no_other_cut_is_made_for_what_decks_that_meet_over_a_pier_lay_on_it():
    """Each is a beam from -0.5 to 11.95 m on walls of 0.6 m, so on lines at 0 and 11.825 m, however it is cut."""
    per_span = "[bridge.deck]\nper_span = true\njoint_gap_m = 0.1"
    scenario = scenario_from_text(deck_text(spans=(12.0, 12.0)).replace("[bridge.deck]", per_span))
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    forces = model.bearings.forces(loads_of(model, rest))
    facts = dict(bearing_facts(scenario, model, rest, forces))
    assert len(bearing_axes(model, forces)) == len([name for name in facts if name.startswith("on pier")]) > 0
    assert not any("another cut" in words for fact in facts.items() for words in fact)
    weight_n = 12.45 * WEIGHT_N_M
    at_end_n = weight_n * (11.825 - 5.725) / 11.825
    expected_n = [at_end_n, weight_n - at_end_n, weight_n - at_end_n, at_end_n]
    assert [force.force_n[2] for force in forces] == pytest.approx(expected_n, rel=0.01)


def test_another_cut_says_how_far_bearings_differ():
    """What is printed, added to what this cut carries, is what the bridge carries by the next seed."""
    scenario = girders(shards=60)
    other = scenario_from_text(GIRDERS.format(seed=4, shards=60, skew=0.0))
    carried = []
    for one in (scenario, other):
        model = build_model(one)
        rest = model_at_rest(model, one.joints)
        forces = model.bearings.forces(loads_of(model, rest))
        carried.append(
            (np.array([force.force_n[2] for force in forces]), list(bearing_facts(one, model, rest, forces)))
        )
    more = [float(text.split("; ")[1].split()[0]) for _, text in carried[0][1] if "another cut" in text]
    np.testing.assert_allclose(more, 1e-3 * (carried[1][0] - carried[0][0]), atol=0.06)


def test_cuts_that_cannot_be_compared_are_refused():
    one_each = girders(shards=9)  # deck, 3 girders, 3 columns and 2 abutments
    with pytest.raises(ScenarioError, match=r"scenario\.seed 4 cuts the bridge as 3 does"):
        ranges_of(one_each, 2)
    scenario = scenario_from_text(deck_text(bearings=()))
    with pytest.raises(ScenarioError, match=r"no \[\[bearings\]\]"):
        ranges_of(scenario, 2)


@pytest.mark.parametrize(("skew", "said"), [(0.0, "5% of each"), (25.0, "11% of each"), (40.0, "not measured")])
def test_cuts_that_are_alike_are_said_to_leave_the_same_out(skew, said):
    """The figures are what `test_girders_on_bearings` and `test_slabs_on_columns` hold single bearings within."""
    scenario = girders(skew=skew)
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    facts = dict(bearing_facts(scenario, model, rest, model.bearings.forces(loads_of(model, rest))))
    assert facts["known to within"].startswith(said)
