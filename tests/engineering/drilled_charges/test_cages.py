# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars that stand bare between two bodies: elastic, yielding, buckling, folding, straightened again, ruptured."""

import numpy as np
import pytest
from reference.bare_bars import bow_m, folding_force_n
from scipy import integrate
from support.core_terms import forces_and_tangents, term_in_substep

from bridge_demolition_addon.engineering.drilled_charges.bare_bars import (
    buckling_force_n,
    compression_n,
    yield_force_n,
)
from bridge_demolition_addon.engineering.drilled_charges.cages import BareBars, Cages
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure, StepInput

LEVEL = np.repeat(np.eye(3)[:, :, None], 2, axis=2)
DIAMETER_M = 0.025
AREA_M2 = np.pi * DIAMETER_M**2 / 4.0


def cage(bared_m, count=8.0, from_row=10, **law):
    """A group of bars between two bodies, the upper one 4 m above the lower, and its positions."""
    positions = np.array([(0.0, 0.0), (0.0, 0.0), (0.0, 4.0)])
    below, above = 2.0 - bared_m / 2.0, 2.0 + bared_m / 2.0
    points = [np.array([[0.3], [0.2], [height]]) for height in (below, above)]
    one = np.ones(1)
    cages = Cages(from_row, **law)
    bars = BareBars(np.array([0]), np.array([1]), *points, count * one, DIAMETER_M * one, 500e6 * one)
    assert cages.add(bars, positions, LEVEL).tolist() == [0]
    return cages, positions


def force_n(cages, positions, moved_m):
    """Upward force on the upper body where it is so much higher than it was; then the bars have settled there."""
    moved = positions + np.array([[0.0, 0.0], [0.0, 0.0], [0.0, moved_m]])
    step = term_in_substep(cages, np.array([0]), moved, LEVEL)
    forces, _ = forces_and_tangents(step, np.zeros((1, 1)))
    cages.update_plastic_state(moved, LEVEL)
    return -forces[0, 0] * step.arrays["directions"][2, 0]


def test_a_bar_folds_in_three_hinges():
    """d 25 mm over 1.5 m, ends 0.3 m closer: each half is inclined by arccos 0.8, so that the bow is 0.45 m.

    With M_p = 500 × 25³ / 6 = 1.302 kN·m, 2 M_p / w is 5.79 kN, and the force takes hardly anything of M_p.
    """
    assert bow_m(1.5, 0.3) == pytest.approx(0.45)
    assert folding_force_n(0.025, 1.5, 0.3) == pytest.approx(5.79e3, rel=2e-3)
    # Before it has folded it buckles; a short one yields.
    assert folding_force_n(0.025, 1.5, 0.0) == pytest.approx(buckling_force_n(0.025, 1.5))
    assert folding_force_n(0.025, 0.4, 0.0) == pytest.approx(yield_force_n(0.025))
    for bared_m in (0.4, 1.5):
        assert folding_force_n(0.025, bared_m, 0.0, straight=False) == pytest.approx(compression_n(0.025, bared_m))
    assert folding_force_n(0.025, 1.5, 0.3, straight=False) == pytest.approx(5.79e3, rel=2e-3)
    assert folding_force_n(0.025, 1.5, 1.5) == pytest.approx(2.0 * 1302.0 / 0.75, rel=1e-3)


def test_the_work_of_folding_is_that_of_its_hinges():
    """Both ends turn by θ and the middle by 2 θ: from 0.1 to 0.3 m closer, 4 M_p (θ₂ - θ₁)."""
    closer = np.linspace(0.1, 0.3, 2001)
    forces = folding_force_n(0.025, 1.5, closer)
    turned = np.arccos(1.0 - 0.3 / 1.5) - np.arccos(1.0 - 0.1 / 1.5)
    assert integrate.trapezoid(forces, closer) == pytest.approx(4.0 * 500e6 * 0.025**3 / 6.0 * turned, rel=0.01)


def test_bars_are_elastic_at_first():
    """E A / l, up and down."""
    cages, positions = cage(0.9)
    stiffness = 8.0 * 200e9 * AREA_M2 / 0.9
    for moved_m in (1e-4, -1e-4, 5e-4, -5e-4, 0.0):
        assert force_n(cages, positions, moved_m) == pytest.approx(-stiffness * moved_m, abs=1.0)
    assert cages.folded_m(np.array([0])) == pytest.approx(0.0, abs=1e-12)
    assert cages.pressed_n(np.array([0])) == pytest.approx(stiffness * 5e-4, rel=1e-6)


def test_bars_yield_and_rupture_in_tension():
    """At 0.0025 of their length, and at 0.05 of it for good; back, they are elastic again."""
    cages, positions = cage(0.9)
    assert force_n(cages, positions, 0.01) == pytest.approx(-1963.5e3, rel=1e-3)
    assert force_n(cages, positions, 0.01 - 0.9 * 0.0025) == pytest.approx(0.0, abs=1e3)
    assert force_n(cages, positions, 0.044) == pytest.approx(-1963.5e3, rel=1e-3)
    force_n(cages, positions, 0.05)  # 5.3 % stay
    assert force_n(cages, positions, 0.03) == 0.0


def test_bars_press_with_what_they_resist_and_less_once_they_have_folded():
    cages, positions = cage(0.9)
    assert force_n(cages, positions, -0.005) == pytest.approx(1495.3e3, rel=1e-3)
    folded = force_n(cages, positions, -0.205)
    assert folded < 0.5 * 1495.3e3  # by what had stayed before
    folded = force_n(cages, positions, -0.2051)
    assert folded == pytest.approx(8.0 * folding_force_n(0.025, 0.9, 0.205), rel=0.02)
    # Pulled straight again they resist as little, and their yield force once they are straight.
    assert force_n(cages, positions, -0.1) == pytest.approx(-folded, rel=0.02)
    force_n(cages, positions, 0.001)
    assert force_n(cages, positions, 0.01) == pytest.approx(-1963.5e3, rel=1e-3)


def test_bars_with_a_bow_press_with_what_they_may_be_counted_on_for():
    """8 of 25 mm over 0.9 m: λ 1.146, χ 0.4605 of 8 × 245.4 kN."""
    cages, positions = cage(0.9, straight=False)
    assert force_n(cages, positions, -0.002) == pytest.approx(904.1e3, rel=1e-3)


def test_bars_without_a_body_hold_nothing():
    cages, positions = cage(0.9)
    cages.let_go(np.array([1]))
    assert force_n(cages, positions, -0.01) == 0.0


def test_the_forces_of_a_substep_are_those_at_its_end():
    """Implicit: a body of 1e6 t on bars that falls with 0.1 m/s meets k v dt, until they buckle."""
    cages, positions = cage(0.9, from_row=0)
    bodies = RigidBodies(np.array([0.0, 1e9]), np.repeat(1e9 * np.eye(3)[..., None], 2, axis=2), positions, LEVEL)
    none = np.zeros(0, int)
    frames = JointFrames(none, none, *np.zeros((2, 3, 3, 0)), *np.zeros((2, 3, 0)))
    structure = ElasticStructure(frames, np.zeros((6, 6, 0)), bodies, np.zeros(0))
    structure.stand_bare(cages)
    stiffness, substep_s = 8.0 * 200e9 * AREA_M2 / 0.9, 1e-3
    for speed_m_s in (0.1, 10.0):
        velocities = np.zeros((6, 2))
        velocities[2, 1] = -speed_m_s
        step = structure.step(StepInput(positions, LEVEL, velocities, np.zeros(2, bool)), np.zeros(0, bool), substep_s)
        pressed = step.of_bodies[2, 1] / substep_s
        assert pressed == pytest.approx(min(stiffness * speed_m_s * substep_s, 1495.3e3), rel=1e-3)


def turn(rates, step_s):
    """Rotation by angular velocities in a step (O. Rodrigues)."""
    angle = np.linalg.norm(rates) * step_s
    x, y, z = rates / np.linalg.norm(rates)
    across = np.array([(0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)])
    return np.eye(3) + np.sin(angle) * across + (1.0 - np.cos(angle)) * across @ across


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "speed_m_s", "rate_rad_s"), [(0, 3.0, 2.0), (1, 8.0, 25.0), (2, 8.0, 25.0)])
def test_bars_between_two_flying_bodies_make_no_energy(seed, speed_m_s, rate_rad_s):
    """Whatever they do to the bars, the momentum of both stays, and no more kinetic energy comes than there was."""
    masses, substep_s = np.array([2000.0, 1200.0]), 0.002
    inertias = np.eye(3)[:, :, None] * masses / 6.0
    positions, rotations = np.array([(0.0, 0.0), (0.0, 0.0), (0.0, 2.5)]), LEVEL.copy()
    none, cages = np.zeros(0, int), Cages(0)
    frames = JointFrames(none, none, *np.zeros((2, 3, 3, 0)), *np.zeros((2, 3, 0)))
    bodies = RigidBodies(masses, inertias, positions, rotations)
    structure = ElasticStructure(frames, np.zeros((6, 6, 0)), bodies, np.zeros(0))
    corners = np.array([(-0.25, -0.25, 0.25, 0.25), (-0.25, 0.25, -0.25, 0.25)])
    ends = [np.vstack([corners, np.full((1, 4), height)]) for height in (0.5, 2.0)]
    lower, alike = np.zeros(4, int), np.ones(4)
    cages.add(BareBars(lower, lower + 1, *ends, 2.0 * alike, 0.025 * alike, 500e6 * alike), positions, rotations)
    structure.stand_bare(cages)
    random = np.random.default_rng(seed).normal(size=(6, 2))
    velocities = random * np.repeat((speed_m_s, rate_rad_s), 3)[:, None]
    momentum, energies = (masses * velocities[:3]).sum(axis=1), []
    for _ in range(500):
        energies.append(0.5 * (masses * (velocities[:3] ** 2 + velocities[3:] ** 2 / 6.0)).sum())
        structure.update_plastic_state(positions, rotations)
        start = StepInput(positions, rotations, velocities, np.zeros(2, bool))
        velocities = structure.step(start, np.zeros(0, bool), substep_s).velocities
        structure.end_substep()
        positions = positions + substep_s * velocities[:3]
        turned = [turn(velocities[3:, body], substep_s) @ rotations[..., body] for body in range(2)]
        rotations = np.stack(turned, axis=2)
    assert max(energies) <= 1.01 * energies[0]
    assert energies[-1] < 0.97 * energies[0]
    np.testing.assert_allclose((masses * velocities[:3]).sum(axis=1), momentum, atol=1e-6 * abs(momentum).max())
