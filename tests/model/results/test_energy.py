# SPDX-License-Identifier: GPL-3.0-or-later
"""Energies against formulas of mechanics."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes, turned_about_z

from bridge_demolition_addon.model.results.energy import energy_of, moments_of_inertia

G = 9.80665


def test_energies_of_known_motion():
    positions, velocities = np.zeros((2, 1, 3)), np.zeros((2, 1, 3))
    positions[:, 0, 2], velocities[1, 0] = [10.0, 4.0], (3.0, 4.0, 0.0)
    energy = energy_of(moving_boxes([0, 1], [(1, 1, 2)], positions, velocities_m_s=velocities))
    assert energy.potential_j == pytest.approx([2000 * G * 6, 0.0])
    assert energy.kinetic_j == pytest.approx([0.0, 2000 * 25 / 2])
    assert energy.dissipated_j == pytest.approx([0.0, 2000 * G * 6 - 25_000])


def test_rotation_is_about_the_axes_of_the_body():
    """A box of 1, 2 and 3 m that spins about its own long axis, which was turned away from the world's."""
    turn = np.array([[[[0.0, 0, 1], [1, 0, 0], [0, 1, 0]]]])  # its z axis along x
    spin = np.array([[[2.0, 0.0, 0.0]]])
    results = moving_boxes([0.0], [(1, 2, 3)], np.zeros((1, 1, 3)), rotations=turn, spins_rad_s=spin, masses_kg=[6.0])
    assert energy_of(results).rotation_j == pytest.approx([6.0 * (1 + 4) / 12 * 2.0**2 / 2])


def test_moments_of_boxes_and_balls():
    positions = np.zeros((1, 3, 3))
    kinds = ["shard", "ball", "ground"]
    results = moving_boxes([0.0], [(1, 2, 3), (4, 4, 4), (9, 9, 9)], positions, kinds=kinds, masses_kg=[12.0, 5.0, 0.0])
    moments = moments_of_inertia(results)
    assert moments[0] == pytest.approx([4 + 9, 1 + 9, 1 + 4])
    assert moments[1] == pytest.approx([0.4 * 5 * 2**2] * 3)
    assert not moments[2].any()


def test_free_fall_loses_nothing():
    times = np.linspace(0.0, 2.0, 49)
    positions, velocities = np.zeros((49, 1, 3)), np.zeros((49, 1, 3))
    positions[:, 0, 2], velocities[:, 0, 2] = -G * times**2 / 2, -G * times
    spins = np.broadcast_to((0.0, 0.0, 3.0), (49, 1, 3))
    rotations = turned_about_z(3.0 * times)[:, None]
    results = moving_boxes(
        times, [(1, 2, 1)], positions, velocities_m_s=velocities, rotations=rotations, spins_rad_s=spins
    )
    energy = energy_of(results)
    np.testing.assert_allclose(energy.dissipated_j, 0.0, atol=1e-9 * energy.potential_j[0])
    np.testing.assert_allclose(energy.rotation_j, energy.rotation_j[0])
