# SPDX-License-Identifier: GPL-3.0-or-later
"""The validation: its page has every case, and what it says of a case is what the case says."""

import math

import numpy as np
import pytest
import validate
from case import GROUPS, VALIDATION, Against, Comparison
from scipy.spatial.transform import Rotation
from support.checkout import ROOT

from bridge_demolition_addon.report.wording.checks import TABLE, measured_cases


@pytest.mark.parametrize("name", validate.CASES)
def test_the_page_has_the_case_as_it_is_now(name):
    case = validate.case_named(name)
    assert case.name == name and case.group in GROUPS
    document = validate.DOCUMENT if case.group == VALIDATION else validate.VERIFICATION
    assert f"scripts/validate {name} " in document.read_text(encoding="utf-8")
    assert (ROOT / "docs" / "pictures" / "validation" / f"{name}.png").is_file()


def test_the_page_is_what_was_kept():
    """`scripts/validate --page` writes it."""
    kept = [validate.kept(case) for case in validate.CASES]
    assert validate.DOCUMENT.read_text(encoding="utf-8") == validate.page(kept)
    assert validate.VERIFICATION.read_text(encoding="utf-8") == validate.verification_page(kept)


def test_reports_count_hits_and_misses_of_what_was_kept():
    """`scripts/validate --page` writes their table, too; the page's own count is by rows."""
    kept = [validate.kept(case) for case in validate.CASES]
    assert TABLE.read_text(encoding="utf-8") == validate.measurements(kept)
    cases = measured_cases()
    total = f"{sum(case.within for case in cases)} of {sum(case.of for case in cases)} | |"
    (line,) = (line for line in validate.page(kept).splitlines() if line.startswith("| all |"))
    assert line.endswith(total)


def test_all_cases_together_take_half_an_hour_at_most():
    assert sum(validate.kept(case).seconds for case in validate.CASES) <= 1800.0


def test_a_quantity_is_held_against_its_tolerance():
    assert Comparison("way", "m", 2.0, 2.03, 0.02).is_met
    assert not Comparison("way", "m", 2.0, 1.95, 0.02).is_met
    assert Comparison("place", "", (0.3, 0.4), 0.3).is_met
    assert not Comparison("place", "", (0.3, 0.4), 0.41).is_met
    assert Comparison("way", "m", 2.0, 1.5).ratio == 0.75 and Comparison("place", "", (0.3, 0.4), 0.3).ratio is None


def test_verification_and_validation_are_told_apart():
    """What is held against a measurement is in a case of that group, with its ratio; what misses has a line first."""
    outcomes = [validate.kept(name) for name in validate.CASES]
    for outcome in outcomes:
        assert bool(outcome.held_against(Against.MEASURED)) == (outcome.case.group == VALIDATION), outcome.case.name
    text = validate.DOCUMENT.read_text(encoding="utf-8")
    first, misses, rest = text.split("## What misses")[0], *text.split("## What misses")[1].split("## Validation", 1)
    missed = [row for outcome in outcomes for row in outcome.comparisons if not row.is_met]
    assert misses.count(f"| {missed[0].quantity} |") == 1
    assert misses.count("\n| [") == len(missed)
    assert first.count("](#") + first.count("README.md#") == len(outcomes) + 1  # and the blind forecasts
    prestwood = next(outcome for outcome in outcomes if outcome.case.name == "prestwood")
    line = next(row for row in prestwood.comparisons if row.quantity == "fill as weight, against the test")
    assert f"| 228 kN | {line.found:.4g} kN | {line.found / 228.0:.2f} | **beyond** 20 % |" in rest


@pytest.mark.long
def test_one_case_runs_and_is_met(blender, tmp_path):
    """The cheapest: friction stops a block where Coulomb says."""
    import sliding_block

    times, way = sliding_block.course(tmp_path, 0.6)
    expected = sliding_block.SPEED_M_S**2 / (2.0 * 0.6 * sliding_block.G)
    assert way[-1] == pytest.approx(expected, rel=0.02)
    assert times[-1] == pytest.approx(2.5, abs=0.05)


@pytest.mark.long
def test_a_weight_on_a_reinforced_beam_goes_as_far_as_plastic_theory_says(blender, tmp_path):
    import drop_weight

    largest, _ = drop_weight.found_m(tmp_path, 300.0, 4.0, substeps=20)
    assert largest == pytest.approx(drop_weight.expected_m(300.0, 4.0), rel=0.1)


@pytest.mark.long
def test_a_strip_rises_by_the_impulse_of_a_blast(blender, tmp_path):
    import blasted_strip

    _, risen = blasted_strip.risen_m(tmp_path, 25.0)
    assert risen.max() == pytest.approx(blasted_strip.expected_m(25.0), rel=0.05)
    assert blasted_strip.by_impulse_m(blasted_strip.impulse_ns(25.0)) > risen.max()


@pytest.mark.long
def test_cubes_that_were_tossed_go_as_far_as_was_measured(blender, tmp_path):
    """57 of the tosses of Pfrommer, Halm and Posa (CoRL 2020), with friction and restitution as they give them."""
    import tossed_cubes

    tosses = tossed_cubes.measured(every=10)
    found = tossed_cubes.tossed(tmp_path, tosses)
    assert found.travels_m.mean() == pytest.approx(tosses.ends.travels_m.mean(), rel=0.03)
    assert found.travels_m.std() == pytest.approx(tosses.ends.travels_m.std(), rel=0.25)
    assert found.rest_s.mean() == pytest.approx(tosses.ends.rest_s.mean(), rel=0.1)
    assert np.median(tossed_cubes.off_by_shares(found, tosses)) < 0.15
    assert np.mean(found.faces == tosses.ends.faces) > 0.5


def test_the_measured_tosses_are_those_of_their_authors():
    """570 of them; 0.405 m and 0.62 s in the middle, and a cube whose centre is half of 0.1048 m up at the end."""
    import tossed_cubes

    tosses = tossed_cubes.measured()
    assert len(tosses) == 570
    assert tosses.ends.travels_m.mean() == pytest.approx(0.405, abs=1e-3)
    assert np.median(tosses.ends.rest_s) == pytest.approx(0.62, abs=5e-3)
    heights = np.loadtxt(tossed_cubes.DATA, delimiter=",", skiprows=1)[:, 16]
    assert heights == pytest.approx(np.full(570, tossed_cubes.SIDE_M / 2.0), abs=3e-3)
    assert abs(tosses.ends.axes[:, 2]).max(axis=1).min() > 0.999  # they lie flat


def test_faces_on_top_and_attitudes_are_those_of_scipy():
    import tossed_cubes

    turns = Rotation.from_euler("xyz", [[0, 0, 30], [90, 0, 10], [180, 0, 0], [0, 90, 5], [0, -90, 0]], degrees=True)
    axes = tossed_cubes.axes_of(turns.as_quat(scalar_first=True))
    np.testing.assert_allclose(axes, turns.as_matrix(), atol=1e-12)
    assert tossed_cubes.faces_on_top(axes).tolist() == [2, 1, 5, 3, 0]


def test_a_toss_rests_once_it_is_slow_for_good():
    import tossed_cubes

    speeds = np.array([[1.0, 1.0], [0.04, 0.5], [0.06, 0.02], [0.01, 0.0]])
    assert tossed_cubes.rest_s(np.array([0.0, 0.1, 0.2, 0.3]), speeds).tolist() == [0.3, 0.2]


def test_what_changes_tosses_is_on_the_page_as_it_was_measured():
    """The README of experiments has the tables that `scripts/experiments/tosses.py` wrote."""
    page = (ROOT / "scripts" / "experiments" / "README.md").read_text(encoding="utf-8")
    for name, keys in (("tosses", 2), ("tosses_by_mujoco", 1)):
        rows = (ROOT / "docs" / "data" / f"{name}.csv").read_text(encoding="utf-8").splitlines()[1:]
        for row in rows:
            numbers = [f"{float(value):.2f}" for value in row.split(",")[keys:-1]]
            assert f"| {' | '.join(numbers)} |" in page, row


def test_laws_of_columns_are_those_of_experiments():
    """Lube and others 2004: 1.24 a and 1.6 √a, which meet at 1.7 about; 0.88 a^(1/6), and no higher than at first."""
    import collapsing_column as case

    assert case.law_of_runout(1.0) == pytest.approx(1.24) and case.law_of_runout(4.0) == pytest.approx(3.2)
    assert case.law_of_runout(1.7) == pytest.approx(1.24 * 1.7, rel=0.02)
    assert case.law_of_height(64.0) == pytest.approx(1.76) and case.law_of_height(0.5) == 0.5


@pytest.mark.parametrize("shape", ["cubes", "splinters"])
def test_blocks_of_columns_are_closed_solids_of_one_volume(shape):
    import collapsing_column as case

    solid = case.block_of(shape, np.random.default_rng(3))
    corners = solid.vertices[solid.triangles]
    volumes = np.einsum("ti,ti->t", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    assert volumes.sum() == pytest.approx(case.SIDE_M**3, rel=1e-6)
    edges = [
        (a, b) for triangle in solid.triangles.tolist() for a, b in zip(triangle, np.roll(triangle, -1), strict=True)
    ]
    assert len(set(edges)) == len(edges) and {(b, a) for a, b in edges} == set(edges)


def test_blocks_of_a_column_lie_within_its_radius_and_apart():
    import collapsing_column as case

    positions = case.positions_m(1.0, 0.4)
    between = np.sqrt(np.sum((positions[:, None] - positions[None]) ** 2, axis=2)) + np.eye(len(positions))
    assert len(positions) == case.COUNT and np.hypot(*positions[:, :2].T).max() <= 0.8
    assert between.min() == pytest.approx(0.4)


def test_the_front_of_a_pile_leaves_out_blocks_that_lie_alone():
    """A disc of 2 m, and a block 5 m away."""
    import collapsing_column as case

    grid = np.arange(-2.0, 2.01, case.SIDE_M)
    points = np.array([(x, y, 0.15) for x in grid for y in grid if x * x + y * y <= 4.0] + [(5.0, 0.0, 0.15)])
    assert case.front_m(points) == pytest.approx(2.0, abs=0.12)


@pytest.mark.long
@pytest.mark.parametrize(("share", "holds"), [(0.85, False), (1.15, True)])
def test_a_beam_that_loses_a_support_needs_the_moments_of_limit_analysis(blender, tmp_path, share, holds):
    import lost_support

    _, sunk = lost_support.sunk_m(tmp_path, share, duration_s=0.8)
    assert (sunk[-1] < 0.15) == holds


@pytest.mark.long
def test_a_beam_that_loses_a_support_goes_further_than_it_rests_by_its_damping(blender, tmp_path):
    import sudden_loss

    _, sunk = sudden_loss.sunk_m(tmp_path, 0.05)
    assert sunk.max() == pytest.approx((1.0 + math.exp(-0.05 * math.pi)) * sudden_loss.at_rest_m(), rel=0.03)


@pytest.mark.long
def test_a_slab_in_40_irregular_shards_comes_down_about_when_plastic_theory_says(blender, tmp_path):
    """25 %, as cracks go along inclined faces: the page has what single seeds came to."""
    import reinforced_slab

    assert reinforced_slab.load_at(*reinforced_slab.course(tmp_path, 40, 1)) == pytest.approx(1.0, abs=0.25)


@pytest.mark.long
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


@pytest.mark.long
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


@pytest.mark.long
@pytest.mark.parametrize(("share", "tips"), [(0.9, False), (1.1, True)])
def test_a_shaft_that_lands_on_an_edge_tips_over_the_other(blender, tmp_path, share, tips):
    import landing_shaft

    _, leans = landing_shaft.course(tmp_path, 1.0, 4.0, share, substeps=20)
    assert (abs(leans[-1]) > np.arctan(1.0 / 4.0)) == tips


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
