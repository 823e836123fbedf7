# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams at rest, held against the theory of Timoshenko's beam."""

from dataclasses import fields

import numpy as np
import pytest
from support.elastic_beams import CONCRETE, DENSITY_KG_M3, GRAVITY_M_S2, ElasticBodies, beam, bodies

from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames

LENGTH_M = 12.0
WEIGHT_N_M = DENSITY_KG_M3 * GRAVITY_M_S2
BENDING_NM2 = CONCRETE.young_pa / 12.0
SHEAR_N = 5.0 / 6.0 * CONCRETE.shear_pa
# A beam of n blocks turns at n places instead of everywhere: what that changes goes down with n², and is 1 % with 20
# blocks in a fixed beam, whose weight at the ends of each block bends it less.
BLOCKS = 40
OF_BLOCKS = 0.005


def test_a_cantilever_sags_and_bears_as_theory_says():
    cantilever = beam(BLOCKS)
    rest = cantilever.at_rest()
    tip = LENGTH_M - LENGTH_M / BLOCKS / 2.0
    bent = tip**2 * (6.0 * LENGTH_M**2 - 4.0 * LENGTH_M * tip + tip**2) / (24.0 * BENDING_NM2)
    sag = WEIGHT_N_M * (bent + (LENGTH_M * tip - tip**2 / 2.0) / SHEAR_N)
    assert -rest.positions_m[2, BLOCKS - 1] == pytest.approx(sag, rel=OF_BLOCKS)
    amounts = cantilever.amounts(rest)
    # Statics, but for the way that the centre of mass moves as it sags, a ten-thousandth of the length.
    assert abs(amounts[4, -1]) == pytest.approx(WEIGHT_N_M * LENGTH_M**2 / 2.0, rel=1e-4)
    assert abs(amounts[2, -1]) == pytest.approx(WEIGHT_N_M * LENGTH_M, rel=1e-4)


def test_a_cantilever_swings_as_fast_as_theory_says():
    # S. Timoshenko (1937), Vibration Problems in Engineering: 1.8751² / 2π √(EI / (ρ A L⁴)), less what shear and the
    # inertia of turning take off, 1 % of a beam 12 times as long as deep.
    first = 1.8751040687**2 / (2.0 * np.pi) * np.sqrt(BENDING_NM2 / (DENSITY_KG_M3 * LENGTH_M**4))
    assert beam(BLOCKS).at_rest().frequency_hz == pytest.approx(0.995 * first, rel=0.005)


def test_a_fixed_beam_bears_at_its_ends():
    fixed = beam(BLOCKS, held=("start", "end"))
    rest = fixed.at_rest()
    sag = WEIGHT_N_M * (LENGTH_M**4 / (384.0 * BENDING_NM2) + LENGTH_M**2 / (8.0 * SHEAR_N))
    assert -rest.positions_m[2, :BLOCKS].min() == pytest.approx(sag, rel=OF_BLOCKS)
    moments = abs(fixed.amounts(rest)[4, -2:])
    assert moments == pytest.approx([WEIGHT_N_M * LENGTH_M**2 / 12.0] * 2, rel=OF_BLOCKS)


def test_a_propped_cantilever_shares_its_weight_by_stiffness():
    propped = beam(BLOCKS, rollers=(1.0,))
    amounts = propped.amounts(propped.at_rest())
    free = LENGTH_M**4 / (8.0 * BENDING_NM2) + LENGTH_M**2 / (2.0 * SHEAR_N)
    reaction = WEIGHT_N_M * free / (LENGTH_M**3 / (3.0 * BENDING_NM2) + LENGTH_M / SHEAR_N)
    assert abs(amounts[2, -1]) == pytest.approx(reaction, rel=OF_BLOCKS)
    root = WEIGHT_N_M * LENGTH_M**2 / 2.0 - reaction * LENGTH_M
    assert abs(amounts[4, -2]) == pytest.approx(root, rel=OF_BLOCKS)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2)])
def test_three_posts_share_a_load_by_stiffness_whatever_their_order(order):
    stiff, places, weight = np.array([4e10, 1e10, 2e10]), np.array([-3.0, 0.5, 3.0]), 20_000.0 * GRAVITY_M_S2
    positions = np.array([(0.0, 0.0, 10.0)] + [(places[position], 0.0, 9.5) for position in order])
    joints = [(1 + row, 0, (places[position], 0.0, 9.5)) for row, position in enumerate(order)]
    stiffness = np.zeros((6, 6, 3))
    stiffness[2, 2] = stiff[list(order)]
    stiffness[0, 0] = stiffness[1, 1] = stiff[list(order)] / 3.0
    sizes = np.tile((8.0, 1.0, 1.0), (4, 1))
    posts = bodies(positions, np.array([20_000.0, 0.0, 0.0, 0.0]), sizes, joints, stiffness)
    # A rigid beam on three springs: sink and slope from the balance of forces and moments.
    sums = np.array([[stiff.sum(), (stiff * places).sum()], [(stiff * places).sum(), (stiff * places**2).sum()]])
    sink, slope = np.linalg.solve(sums, [weight, 0.0])
    shares = stiff * (sink + slope * places)
    amounts = abs(posts.amounts(posts.at_rest())[2])
    assert amounts == pytest.approx(shares[list(order)], rel=1e-6)


def test_a_bar_fixed_at_both_ends_hangs_from_the_stiffer_one():
    size, weight = 1.0, 1000.0 * GRAVITY_M_S2
    stiffness = np.zeros((6, 6, 2))
    stiffness[range(6), range(6)] = np.array([4e9, 1e9])
    positions = np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.5), (0.0, 0.0, -0.5)])
    joints = [(1, 0, (0.0, 0.0, 0.5)), (2, 0, (0.0, 0.0, -0.5))]
    bar = bodies(positions, np.array([1000.0, 0.0, 0.0]), np.full((3, 3), size), joints, stiffness)
    assert abs(bar.amounts(bar.at_rest())[2]) == pytest.approx([0.8 * weight, 0.2 * weight], rel=1e-9)


def test_a_deck_of_two_spans_swings_as_fast_as_one_of_them_by_itself():
    """The lowest mode bends one span up and the other down, and has no moment over the middle support."""
    blocks, length_m = 48, 24.0
    deck = beam(blocks, length_m, held=(), rollers=(0.0, 0.5, 1.0))
    supports = slice(-3, None)
    deck.stiffness[[1, 2], [1, 2], supports] = 1e13  # neither down nor aside
    deck.stiffness[3, 3, supports] = 1e13  # nor over
    deck.stiffness[0, 0, -3] = 1e13
    wave, density = np.pi / (length_m / 2.0), DENSITY_KG_M3
    bending, shear, turning = CONCRETE.young_pa / 12.0, 5.0 / 6.0 * CONCRETE.shear_pa, density / 12.0
    # S. Timoshenko (1921), Philosophical Magazine 41, 744:
    # ω⁴ ρI ρA / κGA - ω² (ρA + ρI k² + EI k² ρA / κGA) + EI k⁴ = 0.
    terms = (turning * density / shear, density + wave**2 * (turning + bending * density / shear), bending * wave**4)
    square = (terms[1] - np.sqrt(terms[1] ** 2 - 4.0 * terms[0] * terms[2])) / (2.0 * terms[0])
    # 24 blocks a span: their turning between them alone costs 0.1 %.
    assert deck.at_rest().frequency_hz == pytest.approx(np.sqrt(square) / (2.0 * np.pi), rel=0.005)


def test_a_part_without_support_stays_where_it_is():
    loose = beam(4, held=())
    rest = loose.at_rest()
    assert not rest.held.any() and rest.frequency_hz == 0.0
    assert (rest.positions_m == loose.positions_m).all()


def test_a_mechanism_has_no_equilibrium():
    swing = beam(4, held=(), rollers=(0.0,))
    rest = swing.at_rest()
    assert not rest.held.any()
    assert (rest.positions_m == swing.positions_m).all()


def test_a_mechanism_leaves_other_parts_to_rest():
    cantilever, swing = beam(4), beam(4, held=(), rollers=(0.0,))
    count = len(cantilever.masses_kg)
    both = {
        name: np.concatenate((getattr(cantilever, name), getattr(swing, name)), axis=-1)
        for name in ("stiffness", "masses_kg", "inertias_kg_m2", "positions_m", "rotations")
    }
    frames = {
        field.name: np.concatenate((getattr(cantilever.frames, field.name), getattr(swing.frames, field.name)), axis=-1)
        for field in fields(cantilever.frames)
    }
    frames["first"][len(cantilever.frames) :] += count
    frames["second"][len(cantilever.frames) :] += count
    rest = ElasticBodies(frames=JointFrames(**frames), **both).at_rest()
    alone = cantilever.at_rest()
    assert rest.held.tolist() == [*alone.held.tolist(), *[False] * len(swing.masses_kg)]
    np.testing.assert_allclose(rest.positions_m[:, :count], alone.positions_m, atol=1e-12)
    assert rest.frequency_hz == pytest.approx(alone.frequency_hz)


def test_a_beam_that_is_free_to_slide_swings_up_and_down_as_theory_says():
    """Simply supported: π/2 √(EI / (ρ A L⁴)), less 3 % by shear and the inertia of turning in one 12 times as long."""
    sliding = beam(BLOCKS, held=(), rollers=(0.0, 1.0))
    first = np.pi / 2.0 * np.sqrt(BENDING_NM2 / (DENSITY_KG_M3 * LENGTH_M**4))
    by_depth = (np.pi / LENGTH_M) ** 2 / 12.0
    # S. Timoshenko (1937), Vibration Problems in Engineering: both corrections are to the square of the frequency.
    corrected = first * (1.0 - by_depth / 2.0 * (1.0 + BENDING_NM2 * 12.0 / SHEAR_N))
    # Rayleigh's shape under its weight is within a thousandth of the true one; blocks make the rest.
    assert sliding.at_rest().frequency_hz == pytest.approx(corrected, rel=0.01)
