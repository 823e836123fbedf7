# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces and energy of tendons, by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.tendons import (
    CutTendon,
    TendonForces,
    TendonPassages,
    TendonSteel,
    transmission_length_m,
)
from bridge_demolition_addon.engineering.geometry.vectors import rotated

FORCE_N, AREA_M2, LENGTH_M, TRANSMISSION_M = 1.5e6, 1.5e-3, 20.0, 1.0
WHOLE_J = FORCE_N**2 * LENGTH_M / (2.0 * 195e9 * AREA_M2)


def steel(*, bonded=True, anchored=True):
    return TendonSteel(
        forces_n=np.array([FORCE_N]),
        areas_m2=np.array([AREA_M2]),
        lengths_m=np.array([LENGTH_M]),
        transmission_m=np.array([TRANSMISSION_M]),
        bonded=np.array([bonded]),
        anchored=np.array([anchored]),
    )


def tendon(of_steel, blocks=10):
    """A tendon with a kink in the middle through blocks of 2 m in a row."""
    size_m = LENGTH_M / blocks
    at = size_m * np.arange(1, blocks)
    slope = np.where(at < LENGTH_M / 2.0, -0.06, 0.06)
    directions = np.stack((np.ones(len(at)), np.zeros(len(at)), slope))
    points = np.stack((at, np.full(len(at), 0.1), -0.06 * np.minimum(at, LENGTH_M - at)))
    passages = TendonPassages(
        tendons=np.zeros(len(at), int),
        first=np.arange(blocks - 1),
        second=np.arange(1, blocks),
        distances_m=at,
        points_m=points,
        directions=directions / np.sqrt(np.square(directions).sum(axis=0)),
        connections=np.arange(blocks - 1),
        openings_m=np.full(len(at), 0.01 if of_steel.bonded[0] else np.inf),
        of_bars=np.full(len(at), 0.25),
    )
    positions = np.stack((size_m * (np.arange(blocks) + 0.5), np.zeros(blocks), np.zeros(blocks)))
    return TendonForces(of_steel, passages, positions, unturned(blocks)), positions


def unturned(count):
    return np.repeat(np.eye(3)[:, :, None], count, axis=2)


def test_transmission_length():
    """EN 1992-1-1:2004, 8.10.2.2: α1 α2 φ σ / (η_p1 η_1 f_ct) = 1.25 · 0.19 · 15.7 mm · 1200 / (3.2 · 2.9)."""
    assert transmission_length_m(0.0157, 1200e6, 2.9e6) == pytest.approx(0.4822, abs=1e-4)


@pytest.mark.parametrize("moved", [False, True])
def test_forces_and_moments_are_zero_together(moved):
    forces, positions = tendon(steel())
    rotations = unturned(10)
    if moved:
        random = np.random.default_rng(1)
        positions = positions + random.normal(0.0, 0.05, positions.shape)
        rotations = np.moveaxis(rotated(np.moveaxis(rotations, 2, 0), random.normal(0.0, 0.3, (10, 3))), 0, 2)
    loads = forces.loads(positions, rotations)
    assert np.abs(loads[:3].sum(axis=1)).max() < 1e-9 * FORCE_N
    moments = loads[3:] + np.cross(positions.T, loads[:3].T).T
    assert np.abs(moments.sum(axis=1)).max() < 1e-9 * FORCE_N


def test_anchorages_press_and_a_kink_lifts():
    """P at the ends, inwards, and 2 P sin α up where the tendon has its kink, between two faces."""
    forces, positions = tendon(steel())
    loads = forces.loads(positions, unturned(10))
    slope = 0.06 / np.hypot(1.0, 0.06)
    assert loads[0, [0, -1]] == pytest.approx([FORCE_N / np.hypot(1.0, 0.06), -FORCE_N / np.hypot(1.0, 0.06)])
    assert loads[2, 1:-1].sum() == pytest.approx(2.0 * FORCE_N * slope)
    assert np.abs(loads[:3, 1:4]).max() < 1e-9 * FORCE_N


def test_energy_without_bond_goes_as_a_whole():
    forces, _ = tendon(steel(bonded=False))
    assert forces.stored_j() == pytest.approx([WHOLE_J])
    assert forces.cut([CutTendon(0, 3.0)]) == pytest.approx([WHOLE_J])
    assert not forces.forces_n.any()
    assert forces.cut([CutTendon(0, 9.0)]) == pytest.approx([0.0])


def test_energy_with_bond_goes_near_the_cut():
    """∫ (1 - (x / l)²) dx = 2/3 l to both sides: F² / 2 E A · 4/3 l."""
    forces, _ = tendon(steel())
    released_j = forces.cut([CutTendon(0, 10.0)])
    assert released_j == pytest.approx([FORCE_N**2 / (2.0 * 195e9 * AREA_M2) * 4.0 / 3.0 * TRANSMISSION_M])
    assert forces.forces_n[4] == 0.0
    assert forces.forces_n[[3, 5]] == pytest.approx([FORCE_N, FORCE_N])


def test_ends_without_anchorages_have_less_energy():
    forces, _ = tendon(steel(anchored=False))
    assert forces.stored_j() == pytest.approx([WHOLE_J * (1.0 - 4.0 / 3.0 * TRANSMISSION_M / LENGTH_M)])


def test_a_cut_weakens_the_bars_that_the_tendon_is_a_part_of():
    forces, _ = tendon(steel())
    forces.cut([CutTendon(0, 10.0)])
    left = forces.bars_left(9)
    assert left[4] == pytest.approx(0.75)
    assert np.delete(left, 4) == pytest.approx(1.0)


def test_a_wide_crack_ruptures_it():
    forces, positions = tendon(steel())
    apart = positions.copy()
    apart[0, 5:] += 0.009
    assert not forces.update_plastic_state(apart, unturned(10)).any()
    apart[0, 5:] += 0.002
    assert forces.update_plastic_state(apart, unturned(10))[0] > 0.0
    assert forces.forces_n[4] == 0.0
