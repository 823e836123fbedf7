# SPDX-License-Identifier: GPL-3.0-or-later
"""Connections with free motions and with strengths of their own, against statics."""

import numpy as np
import pytest
from support.blocks import Blocks
from support.long_cases import long_but

from bridge_demolition_addon.engineering.mechanics.strength import MOTIONS, Joint, Springs, Strength
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

# Blender keeps gravity in single precision.
GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))
MASS_KG = 100.0
WEIGHT_N = MASS_KG * GRAVITY

# As in test_statics: Bullet works in double precision and has settled after the frames played here.
STATICS = 1e-6
PLACE_M = 1e-6
"""Places of 9 m are kept in single precision, which has steps of a millionth of a metre there."""


def join(blocks, connections, *joints):
    from bridge_demolition_addon.scene.connections.constraints import set_joints

    set_joints(connections, joints, np.arange(len(joints)), blocks.time.step)


@pytest.mark.parametrize("step", ({}, {"frames_per_second": 60, "substeps_per_frame": 4}), ids=("24 × 10", "60 × 4"))
def test_generic_chain_carries_the_weight_below_each_connection(blender, tmp_path, step):
    blocks, masses = Blocks(solver_iterations=200, **step), (100.0, 250.0, 50.0)
    bodies, made = [blocks.block((0, 0, 10))], []
    for number, mass in enumerate(masses, start=1):
        bodies.append(blocks.block((0, 0, 10 - number), mass))
        made.append(blocks.connect("FIXED", (0, 0, 10.5 - number), *bodies[-2:]))
    join(blocks, made, *[Joint("GENERIC")] * 3)
    results = blocks.play(tmp_path, 48)
    weights = np.cumsum(masses[::-1])[::-1] * GRAVITY
    np.testing.assert_allclose(results.frames.loads.connection_forces_n[-1][:, 2], -weights, rtol=STATICS)
    np.testing.assert_allclose(results.frames.loads.connection_moments_nm[-1], 0.0, atol=STATICS * weights[0])


def test_generic_cantilever_carries_shear_and_moment(blender, tmp_path):
    blocks, lever = Blocks(solver_iterations=200), (1.25, 0.5, 0.0)
    wall, arm = blocks.block((0, 0, 5)), blocks.block((0.5 + lever[0], lever[1], 5), MASS_KG)
    join(blocks, [blocks.connect("FIXED", (0.5, 0.0, 5), wall, arm)], Joint("GENERIC"))
    results = blocks.play(tmp_path, 96)
    np.testing.assert_allclose(
        results.frames.loads.connection_forces_n[-1][0], (0, 0, -WEIGHT_N), atol=STATICS * WEIGHT_N
    )
    moment = np.cross(lever, (0, 0, -WEIGHT_N))
    np.testing.assert_allclose(
        results.frames.loads.connection_moments_nm[-1][0], moment, atol=STATICS * abs(moment).max()
    )


@pytest.mark.parametrize("step", ({}, {"frames_per_second": 60, "substeps_per_frame": 1}), ids=("24 × 10", "60 × 1"))
@pytest.mark.parametrize(("share", "holds"), ((0.95, False), (1.05, True)))
def test_generic_breaks_at_its_force(blender, tmp_path, share, holds, step):
    blocks = Blocks(**step)
    hanging = blocks.connect("FIXED", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG))
    join(blocks, [hanging], Joint("GENERIC", breaking_force_n=share * WEIGHT_N))
    assert bool(blocks.play(tmp_path, 24).frames.intact[-1][0]) is holds


@pytest.mark.parametrize("axis", range(3))
def test_a_free_move_falls_freely_and_carries_nothing(blender, tmp_path, axis):
    blocks = Blocks()
    blocks.scene.gravity = WEIGHT_N / MASS_KG * np.eye(3)[axis]
    body = blocks.block((1, 0, 5), MASS_KG)
    sliding = blocks.connect("FIXED", (0.5, 0, 5), blocks.block((0, 0, 5)), body)
    join(blocks, [sliding], Joint("GENERIC", free=(MOTIONS[axis],)))
    results = blocks.play(tmp_path, 24)
    np.testing.assert_allclose(results.frames.loads.connection_forces_n[-1][0], 0.0, atol=STATICS * WEIGHT_N)
    # Velocity first, then place: after n steps of h the way is g h² n (n + 1) / 2.
    steps = 24 * 10
    way = GRAVITY / 240.0**2 * steps * (steps + 1) / 2.0
    assert results.frames.positions_m[-1, 0, axis] - (1, 0, 5)[axis] == pytest.approx(way, rel=1e-5)
    others = np.delete(results.frames.positions_m[-1, 0] - (1, 0, 5), axis)
    np.testing.assert_allclose(others, 0.0, atol=1e-6)


@pytest.mark.parametrize("axis", range(3))
def test_a_free_turn_carries_no_moment_about_its_axis_and_all_others(blender, tmp_path, axis):
    """Two supports: one holds everything, and one lets the beam turn; a pair of forces turns it about one axis."""
    blocks = Blocks(solver_iterations=200)
    wall, arm = blocks.block((0, 0, 5)), blocks.block((1, 0, 5), MASS_KG)
    made = [blocks.connect("FIXED", (1, 0, 5), wall, arm)]  # in its centre, so that its weight turns it about nothing
    join(blocks, made, Joint("GENERIC", free=(MOTIONS[3 + axis],)))
    side = np.eye(3)[(axis + 1) % 3]
    weight = blocks.block(tuple(np.array((1.0, 0.0, 5.0)) + side), MASS_KG)
    blocks.connect("FIXED", (1, 0, 5), arm, weight)
    blocks.scene.gravity = GRAVITY * np.eye(3)[(axis + 2) % 3]  # turns about the axis that is free
    results = blocks.play(tmp_path, 2)
    assert abs(results.frames.loads.connection_moments_nm[-1][0, axis]) < STATICS * WEIGHT_N
    turned = results.frames.rotations[-1, 1]
    assert turned[axis, axis] == pytest.approx(1.0, abs=1e-6)
    assert abs(turned - np.eye(3)).max() > 1e-3


def test_each_connection_breaks_at_its_own_strength(blender, tmp_path):
    """Four blocks of the same weight hang from 0.01 m²: strong, weak, by a force that holds, by one that does not."""
    from bridge_demolition_addon.scene.connections.constraints import Breaking, keep_breaking

    blocks, area = Blocks(), 0.01
    stress = WEIGHT_N / area
    made = []
    for number in range(4):
        top, block = blocks.block((3 * number, 0, 10)), blocks.block((3 * number, 0, 9), MASS_KG)
        made.append(blocks.connect("FIXED", (3 * number, 0, 9.5), top, block))
        made[-1]["bda_area_m2"], made[-1]["bda_normal"] = area, (0.0, 0.0, -1.0)
    strong, weak = (Strength(1e9, share * stress, 1e9, 1e9, 1e9) for share in (1.05, 0.95))
    keep_breaking(blocks.scene, Breaking(strong))
    join(
        blocks,
        made,
        Joint("FIXED", strength=strong),
        Joint("FIXED", strength=weak),
        Joint("FIXED", breaking_force_n=1.05 * WEIGHT_N),
        Joint("FIXED", breaking_force_n=0.95 * WEIGHT_N),
    )
    assert blocks.play(tmp_path, 24).frames.intact[-1].tolist() == [True, False, True, False]


def test_a_strength_of_its_own_without_one_of_the_scene(blender, tmp_path):
    blocks, area = Blocks(), 0.01
    made = []
    for number in range(2):
        top, block = blocks.block((3 * number, 0, 10)), blocks.block((3 * number, 0, 9), MASS_KG)
        made.append(blocks.connect("FIXED", (3 * number, 0, 9.5), top, block))
        made[-1]["bda_area_m2"], made[-1]["bda_normal"] = area, (0.0, 0.0, -1.0)
    weak = Strength(1e9, 0.95 * WEIGHT_N / area, 1e9, 1e9, 1e9)
    join(blocks, made, Joint("FIXED", breaking_force_n=10.0 * WEIGHT_N), Joint("FIXED", strength=weak))
    assert blocks.play(tmp_path, 24).frames.intact[-1].tolist() == [True, False]


@pytest.mark.parametrize("stiffness", long_but([20_000.0], (20_000.0, 200_000.0)))
def test_a_weight_sinks_by_its_weight_over_the_stiffness(blender, tmp_path, stiffness):
    blocks = Blocks()
    hanging = blocks.connect("FIXED", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG))
    damped = Springs(stiffness, 0.6 * (stiffness * MASS_KG) ** 0.5)
    join(blocks, [hanging], Joint("GENERIC_SPRING", ("move z",), damped))
    results = blocks.play(tmp_path, 240)
    assert 9.0 - results.frames.positions_m[-1, 1, 2] == pytest.approx(WEIGHT_N / stiffness, abs=PLACE_M)
    np.testing.assert_allclose(
        results.frames.loads.connection_forces_n[-1][0], (0, 0, -WEIGHT_N), atol=STATICS * WEIGHT_N
    )


def test_a_spring_that_is_too_stiff_for_the_step_is_softened_as_the_reference_says(blender, tmp_path):
    blocks = Blocks()
    hanging = blocks.connect("FIXED", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG))
    join(blocks, [hanging], Joint("GENERIC_SPRING", ("move z",), Springs(2e6, 8000.0)))
    results = blocks.play(tmp_path, 240)
    assert 9.0 - results.frames.positions_m[-1, 1, 2] == pytest.approx(
        WEIGHT_N / (MASS_KG * 240.0**2 / 16.0), abs=PLACE_M
    )


def test_a_weight_swings_on_its_spring_in_the_time_of_an_oscillator(blender, tmp_path):
    blocks, stiffness = Blocks(), 20_000.0
    hanging = blocks.connect("FIXED", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG))
    join(blocks, [hanging], Joint("GENERIC_SPRING", ("move z",), Springs(stiffness)))
    results = blocks.play(tmp_path, 240)
    times, heights = results.frames.time_s, results.frames.positions_m[:, 1, 2] - (9.0 - WEIGHT_N / stiffness)
    falling = np.flatnonzero((heights[:-1] > 0.0) & (heights[1:] <= 0.0))
    share = heights[falling] / (heights[falling] - heights[falling + 1])
    crossings = times[falling] + share * (times[falling + 1] - times[falling])
    # Crossings lie between frames a tenth of a period apart, along a chord; over 20 periods that is far below 0.1 %.
    periods = np.diff(crossings)
    assert len(periods) > 18
    assert periods.mean() == pytest.approx(2.0 * np.pi * (MASS_KG / stiffness) ** 0.5, rel=1e-3)


@pytest.mark.parametrize("stiffness", long_but([20_000.0], (20_000.0, 200_000.0)))
def test_an_arm_turns_until_the_spring_carries_its_moment(blender, tmp_path, stiffness):
    blocks, lever = Blocks(solver_iterations=50), np.array((1.25, 0.5, 0.0))
    wall, arm = blocks.block((0, 0, 5)), blocks.block((0.5 + lever[0], lever[1], 5), MASS_KG)
    turning = Springs(turning_stiffness_nm_rad=stiffness, turning_damping_nms_rad=0.02 * stiffness)
    join(blocks, [blocks.connect("FIXED", (0.5, 0.0, 5), wall, arm)], Joint("GENERIC_SPRING", ("turn y",), turning))
    results = blocks.play(tmp_path, 240)
    angle = np.arcsin(-results.frames.rotations[-1, 1][2, 0])
    moment = lever[0] * np.cos(angle) * WEIGHT_N  # its own lever, shorter by as much as the arm has turned
    # Ten seconds of damping leave some 1e-5 of the swing.
    assert stiffness * angle == pytest.approx(moment, rel=1e-4)
    assert results.frames.loads.connection_moments_nm[-1][0, 1] == pytest.approx(moment, rel=1e-4)
    assert results.frames.loads.connection_moments_nm[-1][0, 0] == pytest.approx(-lever[1] * WEIGHT_N, rel=1e-4)


def test_blenders_own_generic_pulls_with_more_than_twice_the_weight_at_its_start(blender, tmp_path):
    """Why none is built. In the first sub-step of h nothing holds, and the block falls by g h² at g h. The second stops
    that, bears the weight, and takes back a fifth of the way (Bullet's error reduction, 0.2): m g h (1 + 1 + 0.2).
    """
    blocks = Blocks()
    hanging = blocks.connect("GENERIC", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG))
    for name in (f"{kind}_{axis}" for kind in ("lin", "ang") for axis in "xyz"):
        setattr(hanging.rigid_body_constraint, f"use_limit_{name}", True)
        setattr(hanging.rigid_body_constraint, f"limit_{name}_lower", 0.0)
        setattr(hanging.rigid_body_constraint, f"limit_{name}_upper", 0.0)
    peaks = blocks.play(tmp_path, 2).frames.loads.connection_peaks_n[1]
    assert peaks == pytest.approx([2.2 * WEIGHT_N], rel=1e-3)


def test_ours_pulls_with_the_weight_from_its_start(blender, tmp_path):
    blocks = Blocks()
    hanging = blocks.connect("FIXED", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG))
    join(blocks, [hanging], Joint("GENERIC"))
    assert blocks.play(tmp_path, 2).frames.loads.connection_peaks_n[1] == pytest.approx([WEIGHT_N], rel=STATICS)
