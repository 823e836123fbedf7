# SPDX-License-Identifier: GPL-3.0-or-later
"""What the core says of single connections and bodies is what numpy says, at all angles, with numbers of all sizes."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.equations import spring_forces
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames, joint_positions
from bridge_demolition_addon.engineering.elasticity.kept_joints import KeptJoints, velocities_alone
from bridge_demolition_addon.engineering.elasticity.substep import Frames, Places, deformations
from bridge_demolition_addon.engineering.geometry.vectors import rotated

CONNECTIONS, BODIES = 300, 90


@pytest.fixture(params=range(4))
def rng(request):
    return np.random.default_rng(request.param)


def rotations(rng, count):
    """Rotations (3, 3, count) by angles of all sizes; the first by none."""
    angles = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-9.0, 1.0, (count, 1))
    angles[0] = 0.0
    return np.ascontiguousarray(np.moveaxis(rotated(np.tile(np.eye(3), (count, 1, 1)), angles), 0, -1))


def assert_deformations_have_the_same_bits(frames, positions_m, turns):
    chosen = np.arange(1, len(frames))
    found = deformations(Frames.of(frames, positions_m.shape[1]), Places.of(positions_m, turns), chosen)[:, chosen]
    expected = joint_positions(frames, positions_m, turns).deformations()[:, chosen]
    np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(np.signbit(found), np.signbit(expected))
    return found


@pytest.mark.parametrize("alike", [True, False])
def test_deformations_have_the_same_bits(rng, alike):
    """With axes alike on both bodies, angles are as small as the bodies turn."""
    points = rng.normal(size=(2, 3, CONNECTIONS))
    axes = [rotations(rng, CONNECTIONS) for _ in range(2)]
    frames = JointFrames(*rng.integers(0, BODIES, (2, CONNECTIONS)), axes[0], axes[0] if alike else axes[1], *points)
    assert_deformations_have_the_same_bits(frames, rng.normal(size=(3, BODIES)), rotations(rng, BODIES))


def test_deformations_at_right_angles_have_the_same_bits():
    """Where a sine or a cosine is 0, the angle is decided by its sign."""
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    turns = np.stack([np.eye(3), quarter, quarter @ quarter, quarter.T, -np.eye(3)], axis=-1)
    count = turns.shape[-1]
    first, second = (ends.ravel() for ends in np.meshgrid(np.arange(count), np.arange(count)))
    axes, points = np.repeat(np.eye(3)[..., None], len(first), axis=-1), np.zeros((3, len(first)))
    frames = JointFrames(first, second, axes, axes, points, points)
    found = assert_deformations_have_the_same_bits(frames, np.zeros((3, count)), turns)
    assert abs(found[5]).max() == pytest.approx(np.pi)


def test_velocities_without_connections_are_those_of_loads_and_damping(rng):
    velocities, loads = rng.normal(size=(2, 6, BODIES))
    inverse = np.where(np.arange(BODIES) % 5, rng.uniform(1e-6, 1e-2, BODIES), 0.0)
    left, inertias = rng.uniform(size=(6, BODIES)), rng.normal(size=(3, 3, BODIES))
    found = velocities_alone(velocities, left, inverse, inertias, loads, 1.0 / 240.0)
    moves = inverse > 0.0
    gained = np.concatenate((inverse * loads[:3], np.einsum("ijn,jn->in", inertias, loads[3:]) * moves))
    expected = np.where(moves, left, 1.0) * velocities + gained / 240.0
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14)
    with pytest.raises(ValueError, match="numbers of 90 bodies"):
        velocities_alone(velocities[:, :-1], left, inverse, inertias, loads, 1.0 / 240.0)


def test_stored_energy_is_half_of_load_by_strain(rng):
    axes, points = [rotations(rng, CONNECTIONS) for _ in range(2)], rng.normal(size=(2, 3, CONNECTIONS))
    frames = JointFrames(*rng.integers(0, BODIES, (2, CONNECTIONS)), *axes, *points)
    places = rng.normal(size=(3, BODIES)), rotations(rng, BODIES)
    stiffness = rng.normal(size=(6, 6, CONNECTIONS)) * 10.0 ** rng.uniform(0.0, 9.0, CONNECTIONS)
    offsets = joint_positions(frames, *places).deformations() + rng.normal(size=(6, CONNECTIONS))
    chosen = np.flatnonzero(rng.random(CONNECTIONS) < 0.7)
    joints = KeptJoints(frames, BODIES, stiffness, offsets)
    strains = (deformations(joints.core_frames, Places.of(*places), chosen) - offsets)[:, chosen]
    expected = 0.5 * (spring_forces(stiffness[..., chosen], strains) * strains).sum(axis=0)
    scale = 0.5 * (abs(spring_forces(abs(stiffness[..., chosen]), abs(strains))) * abs(strains)).sum(axis=0)
    found = joints.stored_j(chosen, *places)
    assert (abs(found[chosen] - expected) < 1e-14 * scale).all() and np.count_nonzero(found) == len(chosen)
