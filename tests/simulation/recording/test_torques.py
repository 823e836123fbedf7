# SPDX-License-Identifier: GPL-3.0-or-later
"""Torques on bodies, against Coulomb's friction and Euler's second law of motion."""

from math import exp, log

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario import Load
from bridge_demolition_addon.scene.custom_properties import keep_tables

MASS_KG = 100.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2
FRICTION = 0.5


@pytest.fixture
def block_on_ground(blender):
    blocks = Blocks(substeps_per_frame=20, solver_iterations=50)
    ground, block = blocks.block((0, 0, -0.5), size_m=(20, 20, 1)), blocks.block((0, 0, 0.25), MASS_KG, (1, 1, 0.5))
    for body, value in ((ground, 1.0), (block, FRICTION)):
        body.rigid_body.friction = value
    return blocks


@pytest.mark.parametrize("point_m", [(0, 0, 0.05), (0, 0, 0.45), (0.45, 0, 0.1)])
def test_a_block_rests_that_is_pushed_by_less_than_friction_wherever_that_is(block_on_ground, point_m, tmp_path):
    """Where Bullet gets the torque itself, the block creeps by 2 to 3 mm/s."""
    most_n = 0.6 * FRICTION * WEIGHT_N
    keep_tables(
        block_on_ground.scene,
        "loads",
        [Load(point_m=point_m, direction=(1, 0, 0), times_s=(0, 0.1), forces_n=(0, most_n))],
    )
    frames = block_on_ground.play(tmp_path, 24).frames
    assert abs(frames.positions_m[-1, 1] - frames.positions_m[0, 1]).max() < 1e-5
    assert np.nansum(frames.work.made_j) < 1e-6


@pytest.mark.parametrize("height_m", [0.05, 0.45])
def test_a_block_slides_as_fast_wherever_it_is_pushed(block_on_ground, height_m, tmp_path):
    """a = (F - μ m g) / m, from t = 0.1 s μ m g / F on; more slowly before 0.1 s, while the force grows."""
    most_n = 1.5 * FRICTION * WEIGHT_N
    load = Load(point_m=(0, 0, height_m), direction=(1, 0, 0), times_s=(0, 0.1), forces_n=(0, most_n))
    keep_tables(block_on_ground.scene, "loads", [load])
    frames = block_on_ground.play(tmp_path, 24).frames
    excess = (most_n - FRICTION * WEIGHT_N) / MASS_KG
    grown_m_s = excess * (0.1 - 0.1 / 1.5) / 2.0
    speed = grown_m_s + excess * (frames.time_s[-1] - 0.1)
    # The force is that of the middle of each sub-step, of which 48 are in its growth.
    assert frames.velocities_m_s[-1, 1, 0] == pytest.approx(speed, rel=1e-3)


@pytest.mark.parametrize("damping", [0.0, 0.5, 1.0])
def test_a_free_body_turns_faster_by_torque_over_inertia(blender, damping, tmp_path):
    """I dω/dt = F r - λ I ω, with the damping of Blender: e^(-λ) is left after a second, nothing where it is 1."""
    blocks = Blocks(substeps_per_frame=20)
    blocks.scene.use_gravity = False
    blocks.block((0, 0, 0), MASS_KG).rigid_body.angular_damping = damping
    force_n, arm_m, inertia = 1.0, 0.5, MASS_KG / 6.0
    keep_tables(
        blocks.scene,
        "loads",
        [Load(point_m=(arm_m, 0, 0), direction=(0, 1, 0), times_s=(0, 2), forces_n=(force_n, force_n))],
    )
    frames = blocks.play(tmp_path, 24).frames
    accelerated = force_n * arm_m / inertia
    time_s, substep_s = float(frames.time_s[-1]), float(frames.substep_s[-1])
    if damping == 1.0:
        expected = accelerated * substep_s  # of the last sub-step
    elif damping:
        rate = -log(1.0 - damping)
        expected = accelerated / rate * (1.0 - exp(-rate * time_s))
    else:
        expected = accelerated * time_s
    # First order in the sub-step, 1/480 s: 0.07 % with a rate of 0.7 1/s. The arm turns by 0.01 rad at most.
    assert frames.angular_velocities_rad_s[-1, 0, 2] == pytest.approx(expected, rel=2e-3)
