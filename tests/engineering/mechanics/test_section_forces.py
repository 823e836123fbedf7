# SPDX-License-Identifier: GPL-3.0-or-later
"""Section forces against beams and columns cut by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.vectors import axes_in_bodies, carried_axes
from bridge_demolition_addon.engineering.mechanics.section_cuts import section_axes, section_forces


def rotation(axis, angle):
    """Rotation about a unit axis (O. Rodrigues, 1840)."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


@pytest.mark.parametrize(
    "normal, y, z",
    [
        ((1, 0, 0), (0, 1, 0), (0, 0, 1)),  # a beam along the road: the world's own axes
        ((-1, 0, 0), (0, -1, 0), (0, 0, 1)),
        ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
        ((0.6, 0, 0.8), (0, 1, 0), (-0.8, 0, 0.6)),  # a leaning cut: z as steep as the cut
        ((0, 0, -1), (0, 1, 0), (1, 0, 0)),  # foundations: z along the road
        ((0, 0, 1), (0, -1, 0), (1, 0, 0)),
    ],
)
def test_axes_of_a_section(normal, y, z):
    # Rounding of unit vectors.
    np.testing.assert_allclose(section_axes(np.array([normal]))[0].T, [normal, y, z], atol=1e-15)


def test_axes_are_rotations_with_a_level_y_and_the_steepest_z():
    normals = np.random.default_rng(5).normal(size=(200, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    axes = section_axes(normals)
    # Rounding of products of unit vectors.
    np.testing.assert_allclose(axes @ np.swapaxes(axes, 1, 2), np.tile(np.eye(3), (200, 1, 1)), atol=1e-14)
    np.testing.assert_allclose(np.linalg.det(axes), 1.0, atol=1e-14)
    np.testing.assert_allclose(axes[:, 2, 1], 0.0, atol=1e-15)
    # The steepest line in a plane rises like the plane leans: its height is the horizontal part of the normal.
    np.testing.assert_allclose(axes[:, 2, 2], np.hypot(normals[:, 0], normals[:, 1]), atol=1e-14)


def test_a_cut_that_rounding_tilts_is_level():
    tilted = np.array([[1e-9, -1e-9, -1.0]])
    np.testing.assert_allclose(section_axes(tilted)[0, :, 2], (1, 0, 0), atol=1e-8)


def test_cantilever():
    """A beam of 3 m that a wall holds, with 10 N down, 4 N sideways and 5 N of pull at the centre of its free end."""
    load, lever = np.array([5.0, 4.0, -10.0]), np.array([3.0, 0.0, 0.0])
    # The beam does to the wall, which is the first body, what the load does to the beam.
    forces = section_forces(section_axes(np.array([[1.0, 0, 0]])), load[None], np.cross(lever, load)[None])
    assert forces.axial_n.tolist() == [5]
    assert forces.shear_n.tolist() == [[4, -10]]
    assert forces.torsion_nm.tolist() == [0]
    # 10 N × 3 m stretches the upper side, where z is positive; 4 N × 3 m stretches the side where y is negative.
    assert forces.bending_nm.tolist() == [[30, 12]]


def test_bending_signs_are_those_of_the_stress_they_make():
    # Stress s over small parts of a face at x = 0: its moments are M_y = ∫ s z and M_z = -∫ s y.
    points = np.array([[0, y, z] for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    stretched_top = np.column_stack((points[:, 2], 0 * points[:, 0], 0 * points[:, 0]))
    moment = np.cross(points, stretched_top).sum(axis=0)
    forces = section_forces(section_axes(np.array([[1.0, 0, 0]])), np.zeros((1, 3)), moment[None])
    assert forces.bending_nm.tolist() == [[4, 0]]


def test_eccentric_load_on_an_arm_twists():
    """10 N down at the end of an arm, 2 m out along the beam and 1 m to its side: 10 N·m of torsion."""
    load, lever = np.array([0.0, 0.0, -10.0]), np.array([2.0, 1.0, 0.0])
    forces = section_forces(section_axes(np.array([[1.0, 0, 0]])), load[None], np.cross(lever, load)[None])
    assert forces.torsion_nm.tolist() == [-10]
    assert forces.bending_nm.tolist() == [[20, 0]]


def test_column_on_its_foundation_is_pressed():
    # The column is the first body, the ground below it the second, which pushes it up.
    forces = section_forces(section_axes(np.array([[0, 0, -1.0]])), np.array([[0, 0, 500.0]]), np.zeros((1, 3)))
    assert forces.axial_n.tolist() == [-500]
    assert forces.shear_n.tolist() == [[0, 0]]


def test_order_of_a_pair_keeps_tension_and_moment_about_the_level_axis():
    """Seen from the other body, normal, force and moment turn round; tension stays tension, a sagging beam sags."""
    normal, force, moment = np.array([[1.0, 0, 0]]), np.array([[5.0, 4.0, -10.0]]), np.array([[2.0, 30.0, 12.0]])
    one = section_forces(section_axes(normal), force, moment)
    other = section_forces(section_axes(-normal), -force, -moment)
    assert other.axial_n.tolist() == one.axial_n.tolist()
    assert other.torsion_nm.tolist() == one.torsion_nm.tolist()
    assert other.shear_n.tolist() == (one.shear_n * [1, -1]).tolist()
    assert other.bending_nm.tolist() == (one.bending_nm * [1, -1]).tolist()


def test_axes_turn_with_their_bodies():
    """A beam that swings down by 90° about y: what was axial then hangs, and its weight pulls along it."""
    beam, rest = np.array([1]), np.tile(np.eye(3), (2, 1, 1))
    local = axes_in_bodies(section_axes(np.array([[1.0, 0, 0]])), beam, rest)
    swung = np.array([np.eye(3), rotation((0, 1, 0), np.pi / 2)])
    axes = carried_axes(local, beam, swung)
    # cos 90° is 6e-17 in double precision.
    np.testing.assert_allclose(axes[0, :, 0], (0, 0, -1), atol=1e-15)
    forces = section_forces(axes, np.array([[0.0, 0.0, -10.0]]), np.zeros((1, 3)))
    np.testing.assert_allclose(forces.axial_n, [10], atol=1e-14)
    np.testing.assert_allclose(forces.shear_n, [[0, 0]], atol=1e-14)


def test_section_forces_do_not_change_when_everything_turns_together():
    random = np.random.default_rng(11)
    count = 50
    normals = random.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    forces, moments, bodies = random.normal(size=(count, 3)), random.normal(size=(count, 3)), np.arange(count)
    first_turns = np.array([rotation((0.6, 0.0, 0.8), angle) for angle in random.uniform(0, 6, count)])
    turn = rotation((0.0, 0.8, 0.6), 2.0)
    local = axes_in_bodies(section_axes(normals), bodies, first_turns)
    before = section_forces(carried_axes(local, bodies, first_turns), forces, moments)
    after = section_forces(carried_axes(local, bodies, turn @ first_turns), forces @ turn.T, moments @ turn.T)
    # Rounding in products of a few numbers around 1.
    for name in ("axial_n", "shear_n", "torsion_nm", "bending_nm"):
        np.testing.assert_allclose(getattr(after, name), getattr(before, name), atol=1e-13)


def test_no_sections():
    axes = section_axes(np.zeros((0, 3)))
    forces = section_forces(axes, np.zeros((0, 3)), np.zeros((0, 3)))
    assert axes.shape == (0, 3, 3)
    assert forces.axial_n.shape == forces.torsion_nm.shape == (0,)
    assert forces.shear_n.shape == forces.bending_nm.shape == (0, 2)
