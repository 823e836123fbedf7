# SPDX-License-Identifier: GPL-3.0-or-later
"""The validation: its page has every case, and what it says of a case is what the case says."""

import math

import pytest
import validate
from case import GROUPS, Comparison
from support.checkout import ROOT


@pytest.mark.parametrize("name", validate.CASES)
def test_the_page_has_the_case_as_it_is_now(name):
    case = validate.case_named(name)
    assert case.name == name and case.group in GROUPS
    assert f"scripts/validate {name} " in validate.DOCUMENT.read_text(encoding="utf-8")
    assert (ROOT / "docs" / "pictures" / "validation" / f"{name}.png").is_file()


def test_the_page_is_what_was_kept():
    """`scripts/validate --page` writes it."""
    assert validate.DOCUMENT.read_text(encoding="utf-8") == validate.page(
        [validate.kept(case) for case in validate.CASES]
    )


def test_all_cases_together_take_half_an_hour_at_most():
    assert sum(validate.kept(case).seconds for case in validate.CASES) <= 1800.0


def test_a_quantity_is_held_against_its_tolerance():
    assert Comparison("way", "m", 2.0, 2.03, 0.02).is_met
    assert not Comparison("way", "m", 2.0, 1.95, 0.02).is_met
    assert Comparison("place", "", (0.3, 0.4), 0.3).is_met
    assert not Comparison("place", "", (0.3, 0.4), 0.41).is_met


def test_one_case_runs_and_is_met(blender, tmp_path):
    """The cheapest: friction stops a block where Coulomb says."""
    import sliding_block

    times, way = sliding_block.course(tmp_path, 0.6)
    expected = sliding_block.SPEED_M_S**2 / (2.0 * 0.6 * sliding_block.G)
    assert way[-1] == pytest.approx(expected, rel=0.02)
    assert times[-1] == pytest.approx(2.5, abs=0.05)


def test_a_weight_on_a_reinforced_beam_goes_as_far_as_plastic_theory_says(blender, tmp_path):
    import drop_weight

    largest, _ = drop_weight.found_m(tmp_path, 300.0, 4.0, substeps=20)
    assert largest == pytest.approx(drop_weight.expected_m(300.0, 4.0), rel=0.1)


def test_a_strip_rises_by_the_impulse_of_a_blast(blender, tmp_path):
    import blasted_strip

    _, risen = blasted_strip.risen_m(tmp_path, 25.0)
    assert risen.max() == pytest.approx(blasted_strip.expected_m(25.0), rel=0.05)
    assert blasted_strip.by_impulse_m(blasted_strip.impulse_ns(25.0)) > risen.max()


def test_cubes_that_were_tossed_go_as_far_as_was_measured(blender, tmp_path):
    """57 of the tosses of Pfrommer, Halm and Posa (CoRL 2020), with friction and restitution as they give them."""
    import tossed_cubes

    tosses = tossed_cubes.measured()
    travels, rests = tossed_cubes.tossed(tmp_path, tosses)
    assert travels.mean() == pytest.approx(tosses.travels_m.mean(), rel=0.03)
    assert travels.std() == pytest.approx(tosses.travels_m.std(), rel=0.25)
    assert rests.mean() == pytest.approx(tosses.rest_s.mean(), rel=0.1)


@pytest.mark.parametrize(("share", "holds"), [(0.85, False), (1.15, True)])
def test_a_beam_that_loses_a_support_needs_the_moments_of_limit_analysis(blender, tmp_path, share, holds):
    import lost_support

    _, sunk = lost_support.sunk_m(tmp_path, share, duration_s=0.8)
    assert (sunk[-1] < 0.15) == holds


def test_a_beam_that_loses_a_support_goes_further_than_it_rests_by_its_damping(blender, tmp_path):
    import sudden_loss

    _, sunk = sudden_loss.sunk_m(tmp_path, 0.05)
    assert sunk.max() == pytest.approx((1.0 + math.exp(-0.05 * math.pi)) * sudden_loss.at_rest_m(), rel=0.03)


def test_a_slab_in_40_irregular_shards_comes_down_about_when_plastic_theory_says(blender, tmp_path):
    """25 %, as cracks go along inclined faces: the page has what single seeds came to."""
    import reinforced_slab

    assert reinforced_slab.load_at(*reinforced_slab.course(tmp_path, 40, 1)) == pytest.approx(1.0, abs=0.25)


def test_a_weight_on_a_strip_in_irregular_shards_goes_about_as_far_as_in_opensees(blender, tmp_path):
    """25 %, as seeds scatter; without damping, OpenSees has 87 mm."""
    import drop_on_shards as case

    expected = case.by_opensees_mm("800 kg", "as in the run", "stays")
    stays = 1e3 * case.stays_m(*case.course(tmp_path, case.DROPS["800 kg"], 2))
    assert stays == pytest.approx(expected, rel=0.25)


def test_opensees_was_asked_about_the_drops_of_the_case():
    import drop_on_shards as case

    for name in case.DROPS:
        undamped, damped = (case.by_opensees_mm(name, damping, "stays") for damping in ("none", "as in the run"))
        assert 0.0 < damped < undamped < case.by_opensees_mm(name, "none", "largest")


def test_formulas_of_loaded_beams_are_those_of_a_hand_calculation():
    """V_Rd,c of 0.2 × 0.36 m with 2 % in C38: 0.18 · 1.745 · (2 · 38)^⅓ = 1.331 N/mm², 95.8 kN, less 1.88 · 1.14 kN.

    M of 0.3 × 0.35 m with 900 mm²: 450 kN · (0.35 - 0.0395 / 2) = 148.6 kN·m, less 5.65 kN·m of its own weight.
    """
    import bent_beam
    import sheared_beam

    assert sheared_beam.BEAM.shears_at_n == pytest.approx(2.0 * (95.8e3 - 1.88e3 * 1.14), rel=2e-3)
    assert bent_beam.BEAM.bends_at_n == pytest.approx(148.6e3 - 5.65e3, rel=2e-3)


def test_a_reinforced_beam_comes_down_about_when_its_section_yields(blender, tmp_path):
    import bent_beam
    from loaded_beams import comes_down_at_n, course

    load = comes_down_at_n(*course(tmp_path, bent_beam.BEAM, 1, bent_beam.MOST_N))
    assert load == pytest.approx(bent_beam.BEAM.bends_at_n, rel=0.15)


@pytest.mark.parametrize(("share", "topples"), [(0.9, False), (1.1, True)])
def test_a_pier_topples_by_the_impulse_of_a_charge(blender, tmp_path, share, topples):
    import toppling_charge

    _, angles = toppling_charge.leans(tmp_path, share, duration_s=1.7, substeps=20)
    assert (angles[-1] > toppling_charge.SLENDERNESS) == topples


def test_a_row_topples_as_fast_as_published():
    """J. van Leeuwen, as worked out for tiles of 48 mm by a program of its own: 1.24 m/s, and by √(g h) for others."""
    import toppling_row

    assert toppling_row.theory_m_s(0.3, 1.0, steps=100) == pytest.approx(9.82, rel=2e-3)
    scale = (toppling_row.HEIGHT_M / 0.048) ** 0.5
    tiles = toppling_row.theory_m_s(7.5 / 48 * toppling_row.HEIGHT_M, 16 / 48 * toppling_row.HEIGHT_M, steps=100)
    assert tiles / scale == pytest.approx(1.24, rel=3e-3)


def test_airblast_far_away_is_that_of_another_rule():
    import airblast_far_away

    for distance, tolerance in airblast_far_away.SCALED_DISTANCES:
        found = airblast_far_away.found_kpa(distance)
        assert found == pytest.approx(airblast_far_away.rule_kpa(distance), rel=tolerance)
