# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces of connections at rest, against statics."""

from itertools import pairwise

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

KINDS = ("FIXED", "POINT", "HINGE")

STEPS = ({"frames_per_second": 24, "substeps_per_frame": 10}, {"frames_per_second": 60, "substeps_per_frame": 4})

# Blender keeps gravity in single precision: 9.80665 is 9.8066501617.
GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))

# Bullet works in double precision and its error shrinks by a constant factor every sub-step; what remains after the
# frames played here, and Blender's single-precision masses and places, is below this.
STATICS = 1e-6


@pytest.mark.parametrize("step", STEPS, ids=("24 Hz × 10", "60 Hz × 4"))
@pytest.mark.parametrize("kind", KINDS)
def test_chain_carries_the_weight_below_each_connection(blender, tmp_path, kind, step):
    blocks, masses = Blocks(solver_iterations=200, **step), (100.0, 250.0, 50.0)
    bodies = [blocks.block((0, 0, 10))]
    for number, mass in enumerate(masses, start=1):
        bodies.append(blocks.block((0, 0, 10 - number), mass))
        blocks.connect(kind, (0, 0, 10.5 - number), *bodies[-2:])
    results = blocks.play(tmp_path, 48)
    weights = np.cumsum(masses[::-1])[::-1] * GRAVITY
    # The first body of each pair hangs on to the one above, so each connection pulls it down.
    np.testing.assert_allclose(results.frames.loads.connection_forces_n[-1][:, 2], -weights, rtol=STATICS)
    np.testing.assert_allclose(results.frames.loads.connection_forces_n[-1][:, :2], 0.0, atol=STATICS * weights[0])
    np.testing.assert_allclose(results.frames.loads.connection_moments_nm[-1], 0.0, atol=STATICS * weights[0])
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1][1:, 2], np.array(masses) * GRAVITY, rtol=STATICS)
    expected_sums = weights + np.append(weights[1:], 0.0)
    np.testing.assert_allclose(results.frames.loads.body_sums_n[-1][1:], expected_sums, rtol=STATICS)


@pytest.mark.parametrize("step", STEPS, ids=("24 Hz × 10", "60 Hz × 4"))
@pytest.mark.parametrize("kind", ("FIXED", "HINGE"))
def test_cantilever_carries_shear_and_moment(blender, tmp_path, kind, step):
    """A hinge about the vertical takes the moments about both horizontal axes, like a fixed connection."""
    blocks, mass, lever = Blocks(solver_iterations=200, **step), 100.0, (1.25, 0.5)
    wall = blocks.block((0, 0, 5))
    arm = blocks.block((0.5 + lever[0], lever[1], 5), mass)
    blocks.connect(kind, (0.5, 0.0, 5), wall, arm)
    results = blocks.play(tmp_path, 96)
    weight = mass * GRAVITY
    np.testing.assert_allclose(results.frames.loads.connection_forces_n[-1][0], (0, 0, -weight), atol=STATICS * weight)
    moment = np.cross((*lever, 0.0), (0, 0, -weight))
    np.testing.assert_allclose(
        results.frames.loads.connection_moments_nm[-1][0], moment, atol=STATICS * abs(moment).max()
    )


def test_beam_fixed_at_both_ends_carries_half_its_weight_and_the_full_moment(blender, tmp_path):
    """End moments and moment at mid-span add up to w·L²/8 in any beam under a uniform load, however stiff it is.

    At 240 sub-steps a second, twenty blocks need 20 iterations of the solver for that (10 miss it by 10 %); with 50, as
    here, it is met within 0.1 %.
    """
    count, length, mass = 20, 18.0, 9000.0
    blocks = Blocks(solver_iterations=50, frames_per_second=24, substeps_per_frame=10)
    size = length / count
    walls = [blocks.block((x, 0, 5)) for x in (-0.5, length + 0.5)]
    beam = [blocks.block((size * (i + 0.5), 0, 5), mass / count, (size, 1, 1)) for i in range(count)]
    chain = [walls[0], *beam, walls[1]]
    for i, pair in enumerate(pairwise(chain)):
        blocks.connect("FIXED", (size * i, 0, 5), *pair)
    results = blocks.play(tmp_path, 72)
    forces, moments = results.frames.loads.connection_forces_n[-1], results.frames.loads.connection_moments_nm[-1]
    weight = mass * GRAVITY
    assert forces[0, 2] == pytest.approx(-weight / 2, rel=0.01)
    assert forces[-1, 2] == pytest.approx(weight / 2, rel=0.01)
    end, middle, other_end = moments[[0, count // 2, -1], 1]
    assert abs(middle - (end + other_end) / 2) == pytest.approx(weight * length / 8, rel=0.01)


def test_forces_sum_to_zero_over_all_bodies(blender, tmp_path):
    blocks = Blocks()
    top = blocks.block((0, 0, 10))
    left, right = blocks.block((-1, 0, 9), 10.0), blocks.block((1, 0, 9), 20.0)
    for pair in ((top, left), (left, right), (right, top)):
        blocks.connect("POINT", (0, 0, 9.5), *pair)
    results = blocks.play(tmp_path, 10)
    # Each connection enters once with each sign: only rounding remains, to the seven digits that are kept.
    forces = results.frames.loads.body_forces_n
    assert abs(forces).max() > 1.0
    np.testing.assert_allclose(forces.sum(axis=1, dtype=float), 0.0, atol=3 * 6e-8 * abs(forces).max())
