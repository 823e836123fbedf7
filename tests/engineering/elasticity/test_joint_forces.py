# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled loops of elastic connections give the bits of numpy, at all angles, with numbers of all sizes."""

from dataclasses import fields, replace

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity import equations, joint_forces
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_forces import (
    ActingJoints,
    added_blocks,
    begun,
    deformations,
    put_loads,
    rows_at,
    slowed,
    stored,
    velocities_alone,
)
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames, joint_positions
from bridge_demolition_addon.engineering.geometry.rotations import rotated

CONNECTIONS, BODIES = 300, 90
LOOPS = "joint_position_loops", "joint_loops", "equation_loops"


@pytest.fixture(params=range(4))
def rng(request):
    return np.random.default_rng(request.param)


@pytest.fixture
def by_numpy(monkeypatch):
    """What a function gives without Numba."""

    def called(function, *arguments):
        with monkeypatch.context() as without:
            for loops in LOOPS:
                without.setattr(joint_forces, loops, lambda: None)
            return function(*arguments)

    return called


def rotations(rng, count):
    """Rotations (3, 3, count) by angles of all sizes; the first by none."""
    angles = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-9.0, 1.0, (count, 1))
    angles[0] = 0.0
    return np.ascontiguousarray(np.moveaxis(rotated(np.tile(np.eye(3), (count, 1, 1)), angles), 0, -1))


def frames(rng):
    points = rng.normal(size=(2, 3, CONNECTIONS))
    axes = [rotations(rng, CONNECTIONS) for _ in range(2)]
    return JointFrames(*rng.integers(0, BODIES, (2, CONNECTIONS)), *axes, *points)


def bodies(rng):
    return rng.normal(size=(3, BODIES)), rotations(rng, BODIES)


def joints(rng):
    of = frames(rng)
    stiffness = rng.normal(size=(6, 6, CONNECTIONS)) * 10.0 ** rng.uniform(0.0, 9.0, CONNECTIONS)
    stiffness[..., 5] = 0.0
    rows = joint_positions(of, *bodies(rng)).rows()
    return ActingJoints(of, rows, stiffness, rng.uniform(0.0, 1e-4, CONNECTIONS))


def strains(rng):
    return rng.normal(size=(6, CONNECTIONS)) * 10.0 ** rng.uniform(-12.0, 0.0, (6, CONNECTIONS))


def assert_same_bits(one, other):
    for first, second in zip(one, other, strict=True):
        np.testing.assert_array_equal(first, second)
        np.testing.assert_array_equal(np.signbit(first), np.signbit(second))


@pytest.mark.slow
def test_deformations_have_the_same_bits(rng, by_numpy):
    given = frames(rng), *bodies(rng)
    assert_same_bits([deformations(*given)], [by_numpy(deformations, *given)])


def test_small_deformations_have_the_same_bits(rng, by_numpy):
    """All angles of a group are small, as they are while a bridge stands."""
    of, axes = frames(rng), rotations(rng, CONNECTIONS)
    turns = rng.normal(size=(BODIES, 3)) * 10.0 ** rng.uniform(-9.0, -2.0, (BODIES, 1))
    turns[:9] = 0.0
    turned = np.ascontiguousarray(np.moveaxis(rotated(np.tile(np.eye(3), (BODIES, 1, 1)), turns), 0, -1))
    given = replace(of, first_axes=axes, second_axes=axes), rng.normal(size=(3, BODIES)), turned
    found = deformations(*given)
    assert_same_bits([found], [by_numpy(deformations, *given)])
    assert abs(found[3:]).max() < 0.2


def test_deformations_at_right_angles_have_the_same_bits(by_numpy):
    """Where a sine or a cosine is 0, the angle is decided by its sign."""
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    turns = np.stack([np.eye(3), quarter, quarter @ quarter, quarter.T, -np.eye(3)], axis=-1)
    count = turns.shape[-1]
    first, second = (ends.ravel() for ends in np.meshgrid(np.arange(count), np.arange(count)))
    axes, points = np.repeat(np.eye(3)[..., None], len(first), axis=-1), np.zeros((3, len(first)))
    given = JointFrames(first, second, axes, axes, points, points), np.zeros((3, count)), turns
    assert_same_bits([deformations(*given)], [by_numpy(deformations, *given)])


@pytest.mark.slow
def test_rows_have_the_same_bits(rng, by_numpy):
    given = frames(rng), *bodies(rng)
    both = rows_at(*given), by_numpy(rows_at, *given)
    assert_same_bits(*([getattr(rows, item.name) for item in fields(rows)] for rows in both))


@pytest.mark.slow
def test_impulses_have_the_same_bits(rng, by_numpy):
    acting, stretched, velocities, changes = joints(rng), strains(rng), *rng.normal(size=(2, 6, BODIES))
    velocities[:, 3] = 0.0
    first = begun(acting, stretched, 1.0 / 240.0, velocities)
    assert_same_bits(first, by_numpy(begun, acting, stretched, 1.0 / 240.0, velocities))
    given = acting, *first[:2], changes
    assert_same_bits(slowed(*given), by_numpy(slowed, *given))


def test_mass_matrices_have_the_same_bits(rng, monkeypatch):
    masses = np.where(np.arange(BODIES) % 5, rng.uniform(1e2, 1e6, BODIES), 0.0)
    of_all = RigidBodies(masses, rng.normal(size=(3, 3, BODIES)), *bodies(rng))
    given = rotations(rng, BODIES), np.flatnonzero(rng.random(BODIES) < 0.7)
    compiled = of_all.mass_matrices(*given)
    monkeypatch.setattr(equations, "equation_loops", lambda: None)
    assert_same_bits([compiled], [of_all.mass_matrices(*given)])


def test_velocities_without_connections_have_the_same_bits(rng, by_numpy):
    velocities, loads = rng.normal(size=(2, 6, BODIES))
    inverse_masses = np.where(np.arange(BODIES) % 5, rng.uniform(1e-6, 1e-2, BODIES), 0.0)
    given = velocities, rng.uniform(size=(6, BODIES)), inverse_masses, rng.normal(size=(3, 3, BODIES)), loads, 1 / 240
    assert_same_bits([velocities_alone(*given)], [by_numpy(velocities_alone, *given)])


def test_loads_of_what_holds_have_the_same_bits(rng, by_numpy):
    numbers = rng.permutation(CONNECTIONS)[:200]
    holding = np.isin(np.arange(CONNECTIONS), numbers)
    parts = [(chosen, *rng.normal(size=(2, 6, len(chosen)))) for chosen in np.split(np.sort(numbers), [0, 150])]
    compiled, plain = np.ones((2, 6, CONNECTIONS))
    on_first = rng.random(CONNECTIONS) < 0.5
    put_loads(compiled, on_first, holding, parts, 1 / 240)
    by_numpy(put_loads, plain, on_first, holding, parts, 1 / 240)
    assert_same_bits([compiled], [plain])
    assert not compiled[..., ~holding].any() and compiled[..., holding].all()


@pytest.mark.slow
def test_stored_energy_has_the_same_bits(rng, by_numpy):
    given = joints(rng).stiffness, strains(rng)
    assert_same_bits([stored(*given)], [by_numpy(stored, *given)])


@pytest.mark.slow
def test_equations_have_the_same_numbers(rng, by_numpy):
    acting = joints(rng)
    given = acting.rows, acting.stiffness, acting.implicit_s2
    counts = np.triu(np.ones((6, 6), bool)), np.triu(np.ones((6, 6), bool)), np.ones((6, 6), bool)
    for one, other, numbers in zip(added_blocks(*given), by_numpy(added_blocks, *given), counts, strict=True):
        np.testing.assert_array_equal(one[numbers], other[numbers])  # a 0 has any sign


def test_loops_are_used_where_numba_is_installed():
    assert all(getattr(joint_forces, loops)() is not None for loops in LOOPS)
