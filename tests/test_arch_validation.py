# SPDX-License-Identifier: GPL-3.0-or-later
"""What arches of the validation are held against, itself held against published limits and textbook formulas."""

import math

import i235_decks
import laboratory_arches
import numpy as np
import prestwood
import pytest
from arches import Arch, course_of, first_crack_n, limit_load_n, load_shares
from support.moving_boxes import moving_boxes


def semicircle(thickness):
    """Twenty voussoirs with a mean radius of 10 m, and a ring of so much of it."""
    inner = 10.0 * (1.0 - thickness / 2.0)
    return Arch(
        span_m=2.0 * inner, rise_m=inner, ring_m=10.0 * thickness, width_m=1.0, density_kg_m3=2000.0, voussoirs=20
    )


def test_limit_analysis_finds_the_thinnest_semicircle():
    """M. Milankovitch 1907: 0.1075 of the mean radius."""
    assert limit_load_n(semicircle(0.106), 0.1) == 0.0
    assert limit_load_n(semicircle(0.109), 0.1) > 0.0


def test_limit_analysis_agrees_with_a_public_solver_on_prestwood():
    """40.58 kN for 31 voussoirs and a load without width (a public benchmark of Simoncello's data): 6 % by joints."""
    found = [
        limit_load_n(Arch(6.55, 1.428, 0.22, 3.8, 1800.0, voussoirs), -6.55 / 4.0) for voussoirs in (20, 31, 40, 61)
    ]
    assert found == pytest.approx([40.58e3] * 4, rel=0.06)


@pytest.mark.parametrize(("bond_pa", "published_n"), [(0.0, 261.0), (1e5, 919.0)])
def test_limit_analysis_agrees_with_a_published_one_with_and_without_bond(bond_pa, published_n):
    """Bertolesi and others 2018, a lower bound by finite elements: 25 % by joints, and by how bond is spread there."""
    arch = laboratory_arches.ARCHES["ring of 60 mm"]
    assert limit_load_n(arch, laboratory_arches.LOAD_X_M, bond_pa) == pytest.approx(published_n, rel=0.25)


def test_beam_theory_of_a_flat_arch_is_that_of_a_beam_built_in_at_both_ends():
    """P L / 8 at ends and middle, and stress M / W."""
    arch = Arch(span_m=10.0, rise_m=1e-4, ring_m=0.5, width_m=0.4, density_kg_m3=1e-3, voussoirs=20)
    modulus = 0.4 * 0.5**2 / 6.0
    assert first_crack_n(arch, 0.0, 1e6) == pytest.approx(8.0 * modulus * 1e6 / 10.0, rel=0.01)


def test_fill_weighs_what_lies_between_ring_and_road():
    arch = Arch(8.0, 2.0, 0.4, 3.0, 2000.0, 200, fill_n_m3=20e3, cover_m=0.3)
    outer, half = arch.inner_m + 0.4, arch.angles[-1]
    chord = 2.0 * outer * math.sin(half)
    segment = outer**2 * (half - math.sin(half) * math.cos(half))
    depth_at_ends = 2.4 + 0.3 - arch.on_arc(outer, half)[1]
    expected = 20e3 * 3.0 * (chord * depth_at_ends - segment)
    assert sum(weight for _, weight in arch.fill()) == pytest.approx(expected, rel=1e-3)


def test_fill_pushes_with_the_pressure_of_rankine_on_the_height_of_the_back():
    """On one side K γ (d₂² - d₁²) / 2 by width, between the depths of crown and springing; K = 4.02 for 37°."""
    arch = Arch(8.0, 2.0, 0.4, 3.0, 2000.0, 400, fill_n_m3=20e3, cover_m=0.3, pressure=prestwood.PASSIVE)
    springing = arch.on_arc(arch.inner_m + 0.4, arch.angles[-1])[1]
    depth = 2.4 + 0.3 - springing
    expected = 4.02 * 20e3 * (depth**2 - 0.3**2) / 2.0 * 3.0
    assert sum(push for position, push in arch.pushes() if position[0] > 0.0) == pytest.approx(expected, rel=2e-3)


def test_fill_that_resists_lets_prestwood_carry_what_others_calculate_with_soil():
    """Simoncello and others 2020: 245 kN with their model of the soil. Only voussoirs beyond the crown lean on it."""
    limit = prestwood.LOADINGS["all of its passive pressure"].limit
    assert limit.load_n == pytest.approx(245e3, rel=0.1)
    assert limit.pushes_n[:10].sum() == 0.0 and limit.pushes_n[10:].sum() > 100e3


def test_a_load_that_spreads_is_divided_among_voussoirs():
    arch = prestwood.LOADINGS["fill as weight"].arch
    shares = load_shares(arch, prestwood.LOAD_X_M, 0.8)
    assert sum(share for _, _, share in shares) == pytest.approx(1.0)
    assert sum(share * point[0] for _, point, share in shares) == pytest.approx(prestwood.LOAD_X_M, abs=1e-6)
    assert len(load_shares(arch, prestwood.LOAD_X_M)) == 1


def test_what_is_borne_is_the_load_less_what_speeds_up_the_blocks():
    """A block of 2 t that goes down with 3 m/s² under 10 kN bears 4 kN of it."""
    times = np.arange(25) / 24.0
    positions = np.zeros((25, 1, 3))
    positions[:, 0, 2] = 50.0 - 1.5 * times**2
    speeds = np.zeros_like(positions)
    speeds[:, 0, 2] = -3.0 * times
    results = moving_boxes(times, np.array([[1.0, 1.0, 1.0]]), positions, velocities_m_s=speeds)
    mass = float(results.inventory.masses_kg[0])
    course = course_of(results, {0: 1.0}, np.full(25, 5.0 * mass))
    assert course.resistance_n == pytest.approx(2.0 * mass, rel=1e-4)
    assert course.borne_n(1.0) == pytest.approx(2.0 * mass, rel=1e-4)


def test_parts_of_decks_that_fell_are_parts_of_their_mass():
    positions = np.zeros((2, 3, 3))
    positions[:, :, 2] = [[5.0, 5.0, 5.0], [1.0, 4.0, 5.0]]
    results = moving_boxes(
        np.array([0.0, 1.0]),
        np.array([[1.0, 1.0, 1.0], [1.0, 1.0, 3.0], [1.0, 1.0, 1.0]]),
        positions,
        body_members=np.array(["deck 1", "deck 1", "deck 2"]),
        body_member_kinds=np.array(["deck", "deck", "deck"]),
    )
    assert i235_decks.fallen_shares(results) == [0.25, 0.0]
