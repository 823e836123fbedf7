# SPDX-License-Identifier: GPL-3.0-or-later
"""Average stress against cubes, columns and beams worked out by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.stress import (
    average_stress,
    principal_stresses,
    von_mises,
)

FACES = np.vstack((np.eye(3), -np.eye(3)))
"""Outward normals of a cube, and the centres of its faces where it has edges of 2."""

# A cube with edges of 2 m around a centre away from the origin; its volume is 8 m³ and each face has 4 m².
CENTRE, VOLUME, AREA = np.array([[5.0, -3.0, 10.0]]), np.array([8.0]), 4.0

NO_INDICES, NO_VECTORS = np.zeros(0, int), np.zeros((0, 3))


def stress_of(bodies, forces, points, centres, volumes, *faces):
    """Stress of bodies under loads on each; what loads them has no volume."""
    pairs = np.column_stack((bodies, np.full(len(bodies), len(volumes))))
    of_all = average_stress(pairs, forces, points, np.vstack((centres, np.zeros(3))), np.append(volumes, 0.0), *faces)
    assert not of_all[-1].any()
    return of_all[:-1]


def stress_of_moments(bodies, moments, normals, volumes):
    """Stress of bodies under moments about the centre of the first."""
    nothing = np.zeros_like(moments)
    return stress_of(bodies, nothing, nothing, np.zeros((len(volumes), 3)), volumes, moments, normals)


def stress_of_cube(forces, points=FACES):
    return stress_of(np.zeros(len(forces), int), np.asarray(forces, float), points + CENTRE, CENTRE, VOLUME)[0]


def test_pulled_cube_carries_force_over_area():
    force = 12.0
    pull = force * FACES * [1, 0, 0]
    assert stress_of_cube(pull).tolist() == np.diag([force / AREA, 0, 0]).tolist()


def test_a_push_is_negative():
    assert stress_of_cube(-12.0 * FACES * [0, 0, 1]).tolist() == np.diag([0, 0, -3]).tolist()


def test_cube_under_water_carries_the_pressure_everywhere():
    pressure = 7.0
    assert stress_of_cube(-pressure * AREA * FACES).tolist() == (-pressure * np.eye(3)).tolist()


def test_pure_shear():
    # Stress τ on the faces that look along x acts along y, on those along y it acts along x.
    shear = 2.5
    stress = shear * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
    assert stress_of_cube(AREA * FACES @ stress).tolist() == stress.tolist()
    # Mohr's circle of pure shear: ±τ; von Mises √3 τ. Rounding only.
    assert von_mises(stress[None]) == pytest.approx([np.sqrt(3) * shear])
    assert principal_stresses(stress[None]) == pytest.approx(np.array([[shear, -shear]]))


def test_any_uniform_stress_comes_back_from_its_tractions():
    random = np.random.default_rng(3).normal(size=(3, 3))
    stress = random + random.T
    # Rounding in sums of six products around 1.
    np.testing.assert_allclose(stress_of_cube(AREA * FACES @ stress), stress, atol=1e-14)


def test_column_of_blocks_under_its_own_weight():
    """Average stress of a block is that at its middle, -ρ g (h - z): what lies above, and half of itself."""
    count, edge, density, gravity = 5, 2.0, 2400.0, 9.80665
    weight = density * edge**3 * gravity
    middles = edge * (np.arange(count) + 0.5)
    centres = np.column_stack((np.zeros(count), np.zeros(count), middles))
    carried = weight * np.arange(count, 0, -1)  # by the joint below each block
    lifted = np.column_stack((np.zeros(count), np.zeros(count), carried))
    joints = centres - [0, 0, edge / 2]
    bodies = np.concatenate((np.arange(count), np.arange(count - 1)))
    forces, points = np.vstack((lifted, -lifted[1:])), np.vstack((joints, joints[1:]))
    stresses = stress_of(bodies, forces, points, centres, np.full(count, edge**3))
    np.testing.assert_allclose(stresses[:, 2, 2], -density * gravity * (count * edge - middles), rtol=1e-14)
    stresses[:, 2, 2] = 0.0
    assert not stresses.any()


def test_falling_and_braked_bodies_carry_what_their_inertia_makes():
    # A bar of mass m pulled at one end by F through its centre accelerates: the stress falls from F/A to 0 along it.
    force = 10.0
    assert stress_of_cube([[force, 0, 0]], FACES[:1])[0, 0] == force / AREA / 2
    # In free fall nothing touches it.
    assert not stress_of_cube(NO_VECTORS, NO_VECTORS).any()


def test_a_load_that_only_turns_leaves_no_stress():
    # Four forces round the cube, all in the same sense: a couple about z and nothing else.
    turning = np.cross([0, 0, 1], FACES)
    assert stress_of_cube(turning).tolist() == np.zeros((3, 3)).tolist()


def test_shear_of_a_beam_needs_the_moments_at_its_ends():
    """A weightless block of a beam, 2 m long: shear V at both ends, and a moment that grows by V times its length."""
    shear, tension, moment = 30.0, 50.0, 7.0
    ends = np.array([[1.0, 0, 0], [-1.0, 0, 0]])
    forces = np.array([[tension, 0, shear], [-tension, 0, -shear]])
    # Equilibrium about y: 2 × (lever 1 × shear) is turned back by the difference of the end moments.
    moments = np.array([[0, moment + 2 * shear, 0], [0, -moment, 0]])
    assert np.cross(ends, forces).sum(axis=0) + moments.sum(axis=0) == pytest.approx(np.zeros(3))
    bodies, normals = np.zeros(2, int), ends
    of_forces = stress_of_cube(forces, ends)
    total = of_forces + stress_of_moments(bodies, moments, normals, VOLUME)[0]
    expected = np.zeros((3, 3))
    expected[0, 0], expected[0, 2], expected[2, 0] = tension / AREA, shear / AREA, shear / AREA
    # Rounding only: every number is of the order of 10.
    np.testing.assert_allclose(total, expected, atol=1e-14)
    assert of_forces[0, 2] == shear / AREA / 2


@pytest.mark.parametrize("edges", [(2.0, 3.0), (0.5, 4.0)])
def test_moments_spread_over_a_face_of_any_shape_like_the_forces_they_stand_for(edges):
    """Bending stress summed over small parts of a rectangular face gives the same as its moment, shifted or not."""
    parts = np.linspace(-0.5, 0.5, 41)
    y, z = (axis.ravel() for axis in np.meshgrid(parts * edges[0], parts * edges[1]))
    points = np.column_stack((np.ones(len(y)), y, z))
    forces = np.column_stack((3.0 * z - 2.0 * y, 0 * y, 0 * y))
    moment = np.cross(points, forces).sum(axis=0)
    spread = stress_of(np.zeros(len(y), int), forces, points + CENTRE, CENTRE, VOLUME)
    at_once = stress_of_moments(np.zeros(1, int), moment[None], np.array([[1.0, 0, 0]]), VOLUME)
    # Sums of 1681 terms up to 10 cancel to a few thousand; rounding stays below 1e-10.
    np.testing.assert_allclose(at_once, spread, atol=1e-10)


def test_torsion_and_the_side_of_the_normal_do_not_count():
    bodies, normal = np.zeros(1, int), np.array([[0.6, 0.8, 0.0]])
    # Rounding of the cross product of a vector of 5 with its own direction.
    np.testing.assert_allclose(stress_of_moments(bodies, 5.0 * normal, normal, VOLUME), 0.0, atol=1e-15)
    moment = np.array([[1.0, 2.0, 3.0]])
    one_way = stress_of_moments(bodies, moment, normal, VOLUME)
    assert one_way.tolist() == stress_of_moments(bodies, moment, -normal, VOLUME).tolist()


def test_stress_turns_with_the_body():
    angle = 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    pull = 12.0 * FACES * [1, 0, 0]
    turned = stress_of_cube(pull @ turn.T, FACES @ turn.T)
    np.testing.assert_allclose(turned, turn @ stress_of_cube(pull) @ turn.T, atol=1e-14)
    assert von_mises(turned[None]) == pytest.approx([3.0])


@pytest.mark.parametrize(
    "stress, equivalent, largest, smallest",
    [
        (np.diag([100.0, 0, 0]), 100, 100, 0),
        (np.diag([-5.0, -5, -5]), 0, -5, -5),
        # √(½[(50-20)² + (20+10)² + (-10-50)²]) = √2700
        (np.diag([50.0, 20, -10]), np.sqrt(2700), 50, -10),
        # Plane stress 80, 20 with shear 40: centre 50, radius √(30² + 40²) = 50; √(80² - 80·20 + 20² + 3·40²) = 100.
        (np.array([[80.0, 40, 0], [40, 20, 0], [0, 0, 0]]), 100, 100, 0),
    ],
)
def test_known_tensors(stress, equivalent, largest, smallest):
    # Rounding of stresses up to 100: 1e-12.
    assert von_mises(stress[None])[0] == pytest.approx(equivalent, abs=1e-12)
    assert principal_stresses(stress[None])[0] == pytest.approx([largest, smallest], abs=1e-12)


def test_bodies_without_loads_without_volume_and_with_unknown_loads():
    bodies, points = np.array([1, 2]), np.zeros((2, 3))
    forces = np.array([[1.0, 0, 0], [np.nan, 0, 0]])
    stresses = stress_of(bodies, forces, points, np.ones((4, 3)), np.array([1.0, 0.0, 1.0, 1.0]))
    assert not stresses[[0, 1, 3]].any()
    assert np.isnan(stresses[2]).any()
    assert np.isnan(von_mises(stresses)).tolist() == [False, False, True, False]
    assert np.isnan(principal_stresses(stresses)).all(axis=1).tolist() == [False, False, True, False]


def test_no_bodies():
    stresses = stress_of(NO_INDICES, NO_VECTORS, NO_VECTORS, NO_VECTORS, np.zeros(0))
    assert stresses.shape == (0, 3, 3)
    assert von_mises(stresses).shape == (0,)
    assert principal_stresses(stresses).shape == (0, 2)
