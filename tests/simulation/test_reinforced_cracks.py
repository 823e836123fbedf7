"""Reinforcement across the cracks of elastic connections in Blender, held against statics and plastic theory."""

from __future__ import annotations

import numpy as np
import pytest
from blocks import Blocks

from bridge_demolition_addon.core.elasticity.section_stiffness import ElasticModuli, section_stiffness
from bridge_demolition_addon.core.elasticity.steel_bars import Steel
from bridge_demolition_addon.core.mechanics.strength import Ductility, Strength
from bridge_demolition_addon.core.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.scene.connections.breaking_settings import Breaking, keep_breaking
from bridge_demolition_addon.scene.connections.elasticity import keep_elasticity

GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))
CONCRETE = ElasticModuli(30e9, 0.2)
SMALL = 0.02
"""Part of the weight with which a simulation begins, so that nothing swings when concrete cracks under it."""


def reinforced(blocks, connection, normal, sides_m, yield_n, elongation_m, steel):
    """Give a connection a face with sides along y and z (of x and y, where it looks down) that any shear cracks."""
    area = sides_m[0] * sides_m[1]
    moments = area / 12.0 * np.diag([sides_m[1] ** 2, sides_m[0] ** 2])
    connection["bda_area_m2"], connection["bda_normal"] = area, normal
    connection["bda_second_moments_m4"] = moments.ravel().tolist()
    one = np.ones(1)
    stiffness = section_stiffness(
        CONCRETE.young_pa * one,
        CONCRETE.shear_pa * one,
        area * one,
        moments[None],
        one,
        np.ones((1, 2), bool),
    )
    keep_elasticity(blocks.scene, [connection], stiffness, 0.05)
    strength = Strength(1e9, yield_n / area, 1.0, 1e9, 1e9)
    keep_breaking(blocks.scene, Breaking(strength, 0.0, Ductility(1.0, elongation_m), 0.0, steel))


def weigh(scene, shares):
    """Have the weight of everything be shares of what it is, by the frames between which they change evenly."""
    for frame, share in shares.items():
        scene.gravity[2] = -share * GRAVITY
        scene.keyframe_insert("gravity", index=2, frame=frame)
    for curve in scene.animation_data.action.layers[0].strips[0].channelbags[0].fcurves:
        for each in curve.keyframe_points:
            each.interpolation = "LINEAR"


def test_a_block_stretches_its_bars_as_the_bilinear_law_says(blender, tmp_path):
    """It hangs by them, and its weight grows past the force at which they yield, and is taken off them again."""
    blocks, mass_kg, elongation_m = Blocks(), 2000.0, 0.1
    steel, most = Steel(hardening=1.5), 1.25
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), mass_kg)
    block.rigid_body.linear_damping = 0.9  # or it would swing on the slope on which they harden
    connection = blocks.connect("FIXED", (0, 0, 9.5), ceiling, block)
    yield_n = mass_kg * GRAVITY / most
    reinforced(blocks, connection, (0.0, 0.0, -1.0), (1.0, 1.0), yield_n, elongation_m, steel)
    blocks.scene.gravity[0] = 1e-3
    weigh(blocks.scene, {1: SMALL, 3: SMALL, 50: 0.7, 120: 0.97, 200: 1.0, 230: 1.0, 270: 0.4})
    results = blocks.play(tmp_path, 290)
    assert not results.frames.intact[-1].any()
    fallen = 9.0 - results.frames.positions_m[:, 1, 2]
    at_yield_m = elongation_m * steel.yield_strain / steel.rupture_strain
    elastic, hardened, let_go = fallen[48], fallen[228], fallen[-1]
    # Steps of damped swinging, and places in single precision at a height of 10 m: 1e-6 m.
    assert elastic == pytest.approx(0.7 * most * at_yield_m, rel=0.02)
    assert hardened == pytest.approx(at_yield_m + 0.5 * (elongation_m - at_yield_m), rel=0.02)
    assert hardened - let_go == pytest.approx(0.6 * most * at_yield_m, rel=0.02)
    forces = abs(results.frames.loads.connection_forces_n[:, 0, 2])
    np.testing.assert_allclose(forces[[228, -1]], [mass_kg * GRAVITY, 0.4 * mass_kg * GRAVITY], rtol=1e-3)


LENGTH_M, DEPTH_M, WIDTH_M = 4.0, 0.5, 1.0


@pytest.mark.parametrize(("substeps", "iterations"), [(10, 10), (20, 50)])
def test_a_cantilever_turns_in_a_plastic_hinge_at_the_moment_of_plastic_theory(blender, tmp_path, substeps, iterations):
    """A_s f_y z, with z half of the depth: all bars yield about the pressed edge, where contact bears.

    Its weight grows in 10 s to 1.2 times the one under which m g L/2 gets there. Bars do not harden, so that nothing
    holds it from there on.
    """
    blocks = Blocks(substeps_per_frame=substeps, solver_iterations=iterations)
    mass_kg, frames = 2400.0 * LENGTH_M * DEPTH_M * WIDTH_M, 240
    wall = blocks.block((-0.5, 0, 10), 0.0, (1, WIDTH_M, 2 * DEPTH_M))
    arm = blocks.block((LENGTH_M / 2, 0, 10), mass_kg, (LENGTH_M, WIDTH_M, DEPTH_M))
    connection = blocks.connect("FIXED", (0, 0, 10), wall, arm)
    yield_n = mass_kg * GRAVITY * (LENGTH_M / 2) / (DEPTH_M / 2)
    sides_m = (WIDTH_M, DEPTH_M)
    reinforced(blocks, connection, (1.0, 0.0, 0.0), sides_m, yield_n, 0.2, Steel(hardening=1.0))
    weigh(blocks.scene, {1: SMALL, 3: SMALL, frames: 1.2})
    results = blocks.play(tmp_path, frames)
    weights = np.interp(np.arange(frames + 1) + 1, (3, frames), (SMALL, 1.2))[: len(results.frames.time_s)]
    opening = -results.frames.rotations[:, 1, 2, 0] * DEPTH_M
    pull = results.frames.loads.connection_forces_n[:, 0, 0]
    # The first bars yield when those at the top do: A_s f_y shared as the opening, a triangle from the pressed edge.
    top, bottom = 0.5 + 0.5 / np.sqrt(3.0), 0.5 - 0.5 / np.sqrt(3.0)
    first_yield = (top**2 + bottom**2) / top  # of A_s f_y h / 2
    stands = weights < 0.97 * first_yield
    # Bars that do not yet yield open the crack by no more than their elongation at yield, by the levers.
    assert opening[stands].max() < 0.2 / 20.0 / top
    # As long as it stands, what bars pull is what the edge is pressed by: the moment, by levers from the edge.
    expected = weights[stands] * (top + bottom) * 0.5 * yield_n / (top**2 + bottom**2)
    np.testing.assert_allclose(pull[stands][12:], expected[12:], atol=0.03 * yield_n)
    # At the moment of plastic theory all bars yield, and none bears more.
    yields = (weights > 1.0) & (opening < 0.1)
    assert yields.any()
    np.testing.assert_allclose(pull[yields], yield_n, rtol=0.02)
    # The bars nearest to the pressed edge yield last; it turns freely from there on.
    fallen = weights[np.argmax(opening > 0.2 / 20.0 / bottom)]
    assert fallen == pytest.approx(1.0, abs=0.05)
