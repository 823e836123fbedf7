# SPDX-License-Identifier: GPL-3.0-or-later
"""Prestressed beams at rest, against beam theory: camber, decompression, cracking, ultimate moment, cuts."""

import math

import numpy as np
import pytest
from support.prestressed_beam import (
    AREA_M2,
    AREA_MM2,
    DEPTH_M,
    FORCE_N,
    HEIGHT_M,
    MIDDLE_M,
    MODULUS_M3,
    STRENGTH_N_MM2,
    WIDTH_M,
    Beam,
    beam_text,
    tendon,
)

from bridge_demolition_addon.engineering.elasticity.tendons import CutTendon
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.model.stages.stages import criticality, stages_of
from bridge_demolition_addon.model.stages.tables import stage_row, stage_sentences
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest

pytestmark = pytest.mark.slow

ECCENTRICITY_M = 0.3
STRAIGHT = f"eccentricities_m = [{ECCENTRICITY_M}, {ECCENTRICITY_M}, {ECCENTRICITY_M}]"
DRAPED = f"eccentricities_m = [0.0, {ECCENTRICITY_M}, 0.0]"
CONCRETE = MATERIALS["concrete"]


@pytest.fixture(scope="module")
def straight():
    return Beam(beam_text(tendon(STRAIGHT)))


def camber_m(line, **settings):
    with_it, without = (Beam(beam_text(text, **settings)) for text in (tendon(line), ""))
    return with_it, with_it.middle_rises_m(with_it.rest()) - without.middle_rises_m(without.rest())


def test_camber_of_a_straight_tendon():
    """M L² / 8 E I of the even moment P e."""
    beam, rises_m = camber_m(STRAIGHT)
    by_hand = FORCE_N * ECCENTRICITY_M * beam.span_m**2 / (8.0 * beam.stiffness_nm2)
    assert rises_m == pytest.approx(by_hand, rel=0.02)


@pytest.mark.parametrize("share", [0.5, 2.0])
def test_deflection_is_below_0_where_tendons_lift_the_beam(share):
    """(P e / 8 - 5 M / 48) L² / E I upwards, in the middle, with M = w L² / 8: with half the prestress it hangs."""
    beam = Beam(beam_text(tendon(STRAIGHT, area_mm2=share * AREA_MM2)))
    moments_nm = share * FORCE_N * ECCENTRICITY_M / 8.0 - 5.0 * beam.weight_moment_nm / 48.0
    by_hand = moments_nm * beam.span_m**2 / beam.stiffness_nm2
    assert beam.rest().sag_m == pytest.approx(-by_hand, rel=0.03)


def test_camber_of_a_draped_tendon():
    """5 w L⁴ / 384 E I with w = 8 P e / l², of a tendon that is longer than the span: with moments at the bearings."""
    beam, rises_m = camber_m(DRAPED)
    span_m, length_m = beam.span_m, beam.length_m
    upwards_n_m = 8.0 * FORCE_N * ECCENTRICITY_M / length_m**2
    at_bearings_nm = FORCE_N * ECCENTRICITY_M * (1.0 - (span_m / length_m) ** 2)
    by_hand = 5.0 * upwards_n_m * span_m**4 / 384.0 + at_bearings_nm * span_m**2 / 8.0
    assert rises_m == pytest.approx(by_hand / beam.stiffness_nm2, rel=0.02)


def test_camber_in_irregular_shards():
    """As near as the deflection of a beam in irregular shards by its weight."""
    beam, rises_m = camber_m(STRAIGHT, blocks=60, irregular=True)
    by_hand = FORCE_N * ECCENTRICITY_M * beam.span_m**2 / (8.0 * beam.stiffness_nm2)
    assert rises_m == pytest.approx(by_hand, rel=0.1)


def test_a_kink_presses_upwards():
    """Two straight lines, as of a girder with one deviator: P f L² / 12 E I for a triangle of moments P f."""
    points = f"points_m = [[0, 0, {MIDDLE_M}], [10, 0, {MIDDLE_M - ECCENTRICITY_M}], [20, 0, {MIDDLE_M}]]"
    beam, rises_m = camber_m(points)
    span_m, length_m = beam.span_m, beam.length_m
    at_bearings_nm = FORCE_N * ECCENTRICITY_M * (1.0 - span_m / length_m)
    by_hand = (FORCE_N * ECCENTRICITY_M - at_bearings_nm) * span_m**2 / 12.0 + at_bearings_nm * span_m**2 / 8.0
    assert rises_m == pytest.approx(by_hand / beam.stiffness_nm2, rel=0.02)


@pytest.mark.parametrize("line", [STRAIGHT, DRAPED])
def test_prestress_is_in_equilibrium_with_itself(line):
    beam = Beam(beam_text(tendon(line)))
    centres = np.vstack((beam.model.centres_m, np.zeros(3)))
    unturned = np.repeat(np.eye(3)[:, :, None], len(centres), axis=2)
    loads = beam.model.tendons.forces_of_shards(beam.model.centres_m).loads(centres.T, unturned)
    assert np.abs(loads[:3].sum(axis=1)).max() < 1e-9 * FORCE_N
    moments = loads[3:].T + np.cross(centres, loads[:3].T)
    assert np.abs(moments.sum(axis=0)).max() < 1e-9 * FORCE_N


def test_supports_carry_the_weight_alone(straight):
    without = Beam(beam_text())
    carried = [beam.rest().loads.forces_n[beam.model.bearings.springs.rows, 2] for beam in (straight, without)]
    assert carried[0] == pytest.approx(carried[1], rel=1e-6)


def test_decompression_moment(straight):
    """P (e + W / A): the lower edge in the middle is without stress there."""
    by_hand = FORCE_N * (ECCENTRICITY_M + MODULUS_M3 / AREA_M2) / straight.weight_moment_nm

    def lower_edge_pa(factor):
        loads, row = straight.rest(factor).loads, straight.middle_face
        axial_n = loads.forces_n[row] @ straight.model.connections.normals[row]
        return axial_n / AREA_M2 - loads.moments_nm[row, 1] / MODULUS_M3

    first, second = lower_edge_pa(0.9), lower_edge_pa(1.1)
    factor = 0.9 + 0.2 * first / (first - second)
    assert first < 0.0
    assert factor == pytest.approx(by_hand, rel=0.02)


def test_cracking_moment(straight):
    """P e + W (f_ct + P / A): plain concrete bends as it is pulled."""
    moment_nm = FORCE_N * ECCENTRICITY_M + MODULUS_M3 * (CONCRETE.bending_pa + FORCE_N / AREA_M2)
    factor = moment_nm / straight.weight_moment_nm
    assert not straight.rest(0.98 * factor).cracked.any()
    assert straight.rest(1.02 * factor).cracked.any()


def test_ultimate_moment(straight):
    """A f_p (d - a / 2) with a = A f_p / (b f_c): EN 1992-1-1:2004, 3.1.7 (3) and 6.1 (2), without safety factors."""
    pull_n = AREA_MM2 * STRENGTH_N_MM2
    depth_m = DEPTH_M / 2.0 + ECCENTRICITY_M - 0.5 * pull_n / (WIDTH_M * CONCRETE.compression_pa)
    assert straight.collapse_factor() == pytest.approx(pull_n * depth_m / straight.weight_moment_nm, rel=0.02)


def test_without_bond_its_force_stays_as_it_is():
    """P d about the pressed edge: what it gains as cracks open is left out."""
    beam = Beam(beam_text(tendon(STRAIGHT, more="bonded = false")))
    by_hand = FORCE_N * (DEPTH_M / 2.0 + ECCENTRICITY_M) / beam.weight_moment_nm
    assert beam.collapse_factor() == pytest.approx(by_hand, rel=0.02)


def test_a_cut_takes_the_force_over_the_transmission_length(straight):
    """EN 1992-1-1:2004, 8.10.2.2, by hand: f_bpt = 3.2 f_ct, l_pt = 1.25 · 0.19 · 15.7 mm · 1000 / f_bpt."""
    tensile_n_mm2 = 0.3 * (CONCRETE.compression_pa / 1e6) ** (2.0 / 3.0)
    length_m = 1.25 * 0.19 * 0.0157 * 1000.0 / (3.2 * tensile_n_mm2)
    assert straight.model.tendons.steel.transmission_m == pytest.approx([length_m], rel=1e-3)
    forces = straight.bridge.tendons(straight.whole > 0.0, [CutTendon(0, 10.25)])
    away_m = np.abs(forces.passages.distances_m - 10.25)
    assert forces.forces_n == pytest.approx(FORCE_N * np.minimum(away_m / length_m, 1.0), rel=1e-6)


@pytest.mark.long
def test_a_saw_cut_through_the_tendon_cuts_it():
    saw = "[[saw_cuts]]\ntime_s = 0.5\npoint_m = [15.01, 0.0, 3.5]\nnormal = [1.0, 0.0, 0.0]\n"
    beam = Beam(beam_text(tendon(STRAIGHT, more="bonded = false") + saw))
    _, cut = stages_of(beam.scenario, beam.bridge, lambda done, total: None)
    # F² L / 2 E A of all of it.
    energy_j = FORCE_N**2 * 20.0 / (2.0 * 195e9 * AREA_MM2 * 1e-6)
    assert [(part.name, part.released_j) for part in cut.tendons] == [("tendon", pytest.approx(energy_j, rel=1e-6))]
    assert cut.loose.any()


@pytest.mark.long
def test_stages_after_each_cut_of_a_tendon():
    """It comes down as it cracks, or, if that is more, at P d about the pressed edge."""
    cut = "[[tendon_cuts]]\ntime_s = 0.3\n"
    beam = Beam(beam_text(tendon(STRAIGHT, more="bonded = false") + cut, blocks=8))
    stages = stages_of(beam.scenario, beam.bridge, lambda done, total: None)
    for stage, force_n in zip(stages, (FORCE_N, 0.0), strict=True):
        cracked_nm = force_n * (DEPTH_M / 2.0 + ECCENTRICITY_M)
        cracking_nm = force_n * ECCENTRICITY_M + MODULUS_M3 * (CONCRETE.bending_pa + force_n / AREA_M2)
        by_hand = max(cracked_nm, cracking_nm) / beam.weight_moment_nm
        assert stage.collapse_factor == pytest.approx(by_hand, rel=0.02)
    assert [stage.step for stage in stages] == ["as it was built", "tendon cut of tendon"]
    energy_kj = FORCE_N**2 * 20.0 / (2.0 * 195e9 * AREA_MM2 * 1e-6) / 1e3
    row = stage_row(2, stages[1], beam.bridge)
    assert row["tendons_released_kJ"] == pytest.approx(energy_kj, rel=1e-6)
    assert any(f"tendon tendon lets go {energy_kj:.1f} kJ" in text for text in stage_sentences(stages[1], row))


def test_criticality_cuts_the_tendons_of_members(straight):
    effects = {effect.member: effect.falls_kg for effect in criticality(straight.bridge, lambda done, total: None)}
    assert effects["deck"] == 0.0
    assert effects["pier 1"] > 0.0


def test_pretensioned_ends_have_no_force():
    """Without anchorages bond builds the force up: none at the end of the member."""
    beam = Beam(beam_text(tendon(STRAIGHT, more="anchored = false")))
    forces = beam.model.tendons.forces_of_shards(beam.model.centres_m)
    length_m = float(beam.model.tendons.steel.transmission_m[0])
    from_end_m = np.minimum(forces.passages.distances_m, 20.0 - forces.passages.distances_m)
    assert forces.forces_n == pytest.approx(FORCE_N * np.minimum(from_end_m / length_m, 1.0), rel=1e-6)


def test_a_straight_tendon_does_not_buckle_what_it_presses():
    """Under 11 MN, a third of Euler's load, the beam deflects as without: a dead load would add half of that."""
    beam = Beam(beam_text(tendon(f"points_m = [[0, 0, {MIDDLE_M}], [20, 0, {MIDDLE_M}]]", area_mm2=11_000.0)))
    euler_n = math.pi**2 * beam.stiffness_nm2 / beam.span_m**2
    assert 0.3 < 11e6 / euler_n < 0.35
    without = Beam(beam_text())
    rises = [one.middle_rises_m(one.rest()) for one in (beam, without)]
    assert rises[0] == pytest.approx(rises[1], rel=0.02)


def test_heights_of_a_parabola_are_below_the_middle():
    path_m = Beam(beam_text(tendon(DRAPED))).model.tendons.paths_m[0]
    assert path_m[:, 2].min() == pytest.approx(HEIGHT_M + DEPTH_M / 2.0 - ECCENTRICITY_M)
    assert path_m[[0, -1], 2] == pytest.approx([MIDDLE_M, MIDDLE_M])


def test_at_rest_before_anything_is_the_same_in_checks(straight):
    rest = model_at_rest(straight.model, straight.scenario.joints)
    assert rest.positions_m == pytest.approx(straight.rest().uncracked.positions_m, abs=1e-9)
