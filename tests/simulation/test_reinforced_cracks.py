# SPDX-License-Identifier: GPL-3.0-or-later
"""Reinforcement across the cracks of elastic connections in Blender, held against statics and plastic theory."""

from __future__ import annotations

import numpy as np
import pytest
from support.blocks import Blocks
from support.growing_weight import animate_gravity

from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli, whole_section_stiffness
from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel
from bridge_demolition_addon.engineering.mechanics.strength import Ductility, Strength
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario import SawCut, Weakening
from bridge_demolition_addon.scene.connections.constraints import Breaking, keep_breaking
from bridge_demolition_addon.scene.connections.elasticity import keep_elasticity
from bridge_demolition_addon.scene.custom_properties import keep_tables

GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))
CONCRETE = ElasticModuli(30e9, 0.2)
SMALL = 0.02
"""Part of the weight with which a simulation begins, so that nothing swings when concrete cracks under it."""


def reinforced(blocks, connection, normal, sides_m, yield_n, elongation_m, steel):
    """Give a connection a face, with sides along the axes of its section, that any shear cracks."""
    area = sides_m[0] * sides_m[1]
    moments = area / 12.0 * np.diag([sides_m[1] ** 2, sides_m[0] ** 2])
    connection["bda_area_m2"], connection["bda_normal"] = area, normal
    connection["bda_second_moments_m4"] = moments.ravel().tolist()
    one = np.ones(1)
    stiffness = whole_section_stiffness(
        CONCRETE.young_pa * one,
        CONCRETE.shear_pa * one,
        area * one,
        moments[None],
        one,
    )
    keep_elasticity(blocks.scene, [connection], stiffness, 0.05)
    strength = Strength(1e9, yield_n / area, 1.0, 1e9, 1e9)
    keep_breaking(blocks.scene, Breaking(strength, 0.0, Ductility(1.0, elongation_m), 0.0, steel))


@pytest.mark.long
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
    animate_gravity(blocks.scene, {1: SMALL, 3: SMALL, 35: 0.7, 80: 0.97, 130: 1.0, 150: 1.0, 180: 0.4})
    results = blocks.play(tmp_path, 195)
    assert not results.frames.intact[-1].any()
    fallen = 9.0 - results.frames.positions_m[:, 1, 2]
    at_yield_m = elongation_m * steel.yield_strain / steel.rupture_strain
    elastic, hardened, let_go = fallen[33], fallen[148], fallen[-1]
    # Steps of damped swinging, and places in single precision at a height of 10 m: 1e-6 m.
    assert elastic == pytest.approx(0.7 * most * at_yield_m, rel=0.02)
    assert hardened == pytest.approx(at_yield_m + 0.5 * (elongation_m - at_yield_m), rel=0.02)
    assert hardened - let_go == pytest.approx(0.6 * most * at_yield_m, rel=0.02)
    forces = abs(results.frames.loads.connection_forces_n[:, 0, 2])
    np.testing.assert_allclose(forces[[148, -1]], [mass_kg * GRAVITY, 0.4 * mass_kg * GRAVITY], rtol=1e-3)
    # Work of yielding by hand: the force grows evenly from where bars yield to the weight, over what stays of the
    # opening. Elastic deformation came back, so it is about all that was lost between the bodies.
    work = results.frames.work
    stays_m = at_yield_m + 0.5 * (elongation_m - at_yield_m) - most * at_yield_m
    by_hand_j = 0.5 * (yield_n + mass_kg * GRAVITY) * stays_m
    assert np.nansum(work.yielding_j) == pytest.approx(by_hand_j, rel=0.01)
    assert results.frames.loads.body_bar_use[-1].max() == pytest.approx(let_go / elongation_m, rel=0.01)


def test_bars_that_are_weakened_stretch_further_and_those_that_are_sawn_through_let_go(blender, tmp_path):
    """Half of the bars are half as stiff; without any a block falls freely."""
    blocks, mass_kg, elongation_m = Blocks(), 2000.0, 0.1
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), mass_kg)
    connection = blocks.connect("FIXED", (0, 0, 9.5), ceiling, block)
    yield_n = 4.0 * mass_kg * GRAVITY
    reinforced(blocks, connection, (0.0, 0.0, -1.0), (1.0, 1.0), yield_n, elongation_m, Steel())
    blocks.scene.gravity[0] = 1e-3
    animate_gravity(blocks.scene, {1: SMALL, 3: SMALL, 24: 1.0})
    weakened_s, cut_s = 2.0, 3.0
    keep_tables(
        blocks.scene,
        "changes",
        [
            Weakening(time_s=weakened_s, lowest_corner_m=(-1, -1, 8), highest_corner_m=(1, 1, 11), factor=0.5),
            SawCut(time_s=cut_s, point_m=(0, 0, 9.5), normal=(0, 0, 1)),
        ],
    )
    results = blocks.play(tmp_path, 84)
    times, fallen = results.frames.time_s, 9.0 - results.frames.positions_m[:, 1, 2]
    before, after = (np.flatnonzero(times < time_s - 1e-6)[-1] for time_s in (weakened_s, cut_s))
    at_yield_m = elongation_m / 20.0
    assert fallen[before] == pytest.approx(0.25 * at_yield_m, rel=0.02)
    assert fallen[after] == pytest.approx(0.5 * at_yield_m, rel=0.02)
    falling_s = times[-1] - cut_s
    assert results.frames.velocities_m_s[-1, 1, 2] == pytest.approx(-GRAVITY * falling_s, rel=0.02)
    assert (results.frames.loads.connection_forces_n[-1] == 0.0).all()


LENGTH_M, DEPTH_M, WIDTH_M = 4.0, 0.5, 1.0


class CrackedCantilever:
    """A beam that is held at a wall by bars alone, whose weight grows, as shares of what `plastic_nm` bears."""

    def __init__(self, folder, steel, elongation_m, growth, **time):
        blocks, frames = Blocks(**time), max(growth)
        self.mass_kg = 2400.0 * LENGTH_M * DEPTH_M * WIDTH_M
        wall = blocks.block((-0.5, 0, 10), 0.0, (1, WIDTH_M, 2 * DEPTH_M))
        arm = blocks.block((LENGTH_M / 2, 0, 10), self.mass_kg, (LENGTH_M, WIDTH_M, DEPTH_M))
        arm.rigid_body.linear_damping = arm.rigid_body.angular_damping = 0.9  # so that it swings but at first
        connection = blocks.connect("FIXED", (0, 0, 10), wall, arm)
        # A_s f_y z, with z half of the depth: bars that are spread evenly all yield about the pressed edge.
        self.plastic_nm = self.mass_kg * GRAVITY * LENGTH_M / 2
        yield_n = self.plastic_nm / (DEPTH_M / 2)
        reinforced(blocks, connection, (1.0, 0.0, 0.0), (WIDTH_M, DEPTH_M), yield_n, elongation_m, steel)
        growth = {1: SMALL, 3: SMALL} | growth
        animate_gravity(blocks.scene, growth)
        self.results = blocks.play(folder, frames)
        numbers = 1 + np.arange(len(self.results.frames.time_s))
        self.weights = np.interp(numbers, list(growth), list(growth.values()))
        self.opening_m = -self.results.frames.rotations[:, 1, 2, 0] * DEPTH_M


@pytest.mark.long
@pytest.mark.parametrize(("substeps", "iterations"), [(10, 1), (15, 20)])
def test_a_cantilever_turns_in_a_plastic_hinge_at_the_moment_of_plastic_theory(blender, tmp_path, substeps, iterations):
    """Bars that do not harden hold it up to A_s f_y z, and not beyond."""
    steel, elongation_m = Steel(hardening=1.0), 0.2
    time = {"substeps_per_frame": substeps, "solver_iterations": iterations}
    cracked = CrackedCantilever(tmp_path, steel, elongation_m, {240: 1.2}, **time)
    at_yield_m = elongation_m * steel.yield_strain / steel.rupture_strain
    weights, opening = cracked.weights, cracked.opening_m
    stands = (weights > 0.4) & (weights < 0.95)
    loads = cracked.results.frames.loads
    # Statics: the crack bears the weight of the whole beam, at its middle, and nothing along it.
    expected = weights[stands] * cracked.mass_kg * GRAVITY
    np.testing.assert_allclose(-loads.connection_forces_n[stands, 0, 2], expected, rtol=0.02)
    np.testing.assert_allclose(abs(loads.connection_moments_nm[stands, 0, 1]), expected * LENGTH_M / 2, rtol=0.02)
    assert abs(loads.connection_forces_n[stands, 0, 0]).max() < 0.02 * cracked.plastic_nm / (DEPTH_M / 2)
    # Elastic: the bars at the edge that opens bear M / h, and stretch by that share of their elongation at yield. The
    # pressed edge gives way by next to nothing.
    np.testing.assert_allclose(opening[stands], weights[stands] * at_yield_m, rtol=0.03)
    # The weight under which it gives way: from there on nothing holds it.
    fallen = weights[np.argmax(opening > 1.1 * at_yield_m)]
    assert fallen == pytest.approx(1.0, abs=0.03)
    assert opening[-1] > 3 * at_yield_m
    # Work of the hinge by hand: M_p times the rotation in which bars yield, all of them at the edge that opens.
    by_hand_j = cracked.plastic_nm * (opening[-1] - at_yield_m) / DEPTH_M
    work = cracked.results.frames.work
    assert np.nansum(work.dissipated_j) == pytest.approx(by_hand_j, rel=0.01)
    assert np.nansum(work.yielding_j) == pytest.approx(by_hand_j, rel=0.01)


@pytest.mark.long
def test_bars_that_harden_hold_a_hinge_until_they_rupture(blender, tmp_path):
    """A cantilever whose bars harden to 3 times their yield force stands under 1.4 times what that bears."""
    steel, elongation_m = Steel(hardening=3.0), 0.2
    cracked = CrackedCantilever(tmp_path, steel, elongation_m, {60: 0.95, 180: 1.4, 240: 1.4})
    at_yield_m = elongation_m * steel.yield_strain / steel.rupture_strain
    expected = at_yield_m + 0.4 / 2.0 * (elongation_m - at_yield_m)
    # The arm has turned by 0.1 rad by then, and has swung on the slope on which bars harden: some per cent of that.
    np.testing.assert_allclose(cracked.opening_m[-1], expected, rtol=0.06)
    np.testing.assert_allclose(
        abs(cracked.results.frames.loads.connection_moments_nm[-1, 0, 1]), 1.4 * cracked.plastic_nm, rtol=0.02
    )


@pytest.mark.long
def test_a_block_that_is_pushed_off_slides_beyond_friction_and_dowels(blender, tmp_path):
    """A crack under a flat block, with bars across it: 0.7 of what presses (EN 1992-1-1, 6.2.5) and 0.9 √(f_c f_y) of
    the bars' area (fib Model Code 2010, 7.3-51), for C35 and B500."""
    blocks, mass_kg, elongation_m, side_m = Blocks(), 2000.0, 0.02, 2.0
    steel = Steel(hardening=1.0)
    base, block = blocks.block((0, 0, 10), 0.0, (side_m, side_m, 0.2)), blocks.block((0, 0, 10.2), mass_kg, (2, 2, 0.2))
    block.rigid_body.linear_damping = 0.9  # so that it does not swing on its bars
    connection = blocks.connect("FIXED", (0, 0, 10.1), base, block)
    of_dowels = 0.9 * np.sqrt(35.0 * 500.0) / 500.0
    yield_n = 0.5 * mass_kg * GRAVITY / of_dowels
    reinforced(blocks, connection, (0.0, 0.0, 1.0), (side_m, side_m), yield_n, elongation_m, steel)
    pushes = {1: 0.0, 3: SMALL, 60: 1.0, 130: 1.3}
    animate_gravity(blocks.scene, pushes, axis=0)
    results = blocks.play(tmp_path, 130)
    moved_m = results.frames.positions_m[:, 1, 0] - results.frames.positions_m[0, 1, 0]
    elastic_m = elongation_m * steel.yield_strain / steel.rupture_strain / of_dowels
    shares = np.interp(1 + np.arange(len(moved_m)), list(pushes), list(pushes.values()))
    slides_at = shares[np.argmax(moved_m > 1.5 * elastic_m)]
    assert slides_at == pytest.approx(0.7 + 0.5, rel=0.03)
