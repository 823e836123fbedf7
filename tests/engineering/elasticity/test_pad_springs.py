# SPDX-License-Identifier: GPL-3.0-or-later
"""Two blocks, one on the other with springs between them, stepped in time: both move, and forces are as by hand."""

from dataclasses import replace

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.bearings import Bearings, PadSprings
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.equilibrium import equilibrium
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure, StepInput

pytestmark = pytest.mark.slow

VERTICAL_N_M, SIDEWAYS_N_M = 4e8, 1e8
SUBSTEP_S = 0.001
PLACES_M = np.array([[-0.5, -0.5, 1.0], [0.5, -0.5, 1.0], [-0.5, 0.5, 1.0], [0.5, 0.5, 1.0]])


def four_pads(*, friction=np.inf, pulls=False, breaking_n=np.inf, travel_m=1.0):
    """Four springs in one connection, which share the stiffness evenly."""
    return PadSprings(
        rows=np.zeros(1, int),
        parts=np.zeros(4, int),
        places_m=PLACES_M,
        vertical_n_m=np.full(4, VERTICAL_N_M / 4),
        sideways_n_m=np.full((4, 2), SIDEWAYS_N_M / 4),
        friction=np.array([friction]),
        pulls=np.array([pulls]),
        travel_m=np.array([travel_m]),
        bearings=np.zeros(1, int),
        breaking_n=np.array([breaking_n]),
    )


class Blocks:
    """Two cubes with sides of 1 m, of 1 t and 3 t, the lighter one on the other; nothing else holds either.

    They do not turn as time passes: their inertia is too large.
    """

    masses = np.array([1000.0, 3000.0])

    def __init__(self, springs, *, above_first=True):
        order = (0, 1) if above_first else (1, 0)
        ends = [np.array([body]) for body in order]
        axes = np.eye(3)[:, :, None]
        levers = [np.array([[0.0, 0.0, -0.5 if body == 0 else 0.5]]).T for body in order]
        self.frames = JointFrames(*ends, axes, axes, *levers)
        inertias = np.zeros((3, 3, 2))
        inertias[[0, 1, 2], [0, 1, 2]] = 1e15
        self.positions = np.array([[0.0, 0.0, 1.5], [0.0, 0.0, 0.5]]).T
        self.rotations = np.repeat(np.eye(3)[:, :, None], 2, axis=2)
        self.bodies = RigidBodies(self.masses, inertias, self.positions, self.rotations)
        self.bearings = Bearings(springs, *ends, np.zeros(1, int), self.positions, self.rotations)
        stiffness = np.zeros((6, 6, 1))
        self.structure = ElasticStructure(self.frames, stiffness, self.bodies, 0.0, bearings=self.bearings)
        self.velocities = np.zeros((6, 2))

    def step(self, forces, count, *, slowed=0.0):
        """Push both bodies with forces (3, 2) for some sub-steps; a share of the relative velocity is lost in each."""
        for _ in range(count):
            mean = (self.velocities[:3] * self.masses).sum(axis=1, keepdims=True) / self.masses.sum()
            self.velocities[:3] = mean + (1.0 - slowed) * (self.velocities[:3] - mean)
            self.velocities[:3] += SUBSTEP_S * np.asarray(forces) / self.masses
            self.structure.update_plastic_state(self.positions, self.rotations)
            start = StepInput(self.positions, self.rotations, self.velocities, np.zeros(2, bool))
            step = self.structure.step(start, np.ones(1, bool), SUBSTEP_S)
            self.velocities[:3] += step.of_bodies[:3] / self.masses
            self.positions = self.positions + SUBSTEP_S * self.velocities[:3]
        self.on_first_n, self.on_second_n = step.of_first[:, 0] / SUBSTEP_S, step.of_second[:, 0] / SUBSTEP_S
        return self

    @property
    def gap_m(self):
        return self.positions[:, 0] - self.positions[:, 1] - (0.0, 0.0, 1.0)


def pressed(force_n, sideways_n=0.0):
    """Forces that press the blocks together, and push them past each other."""
    return np.array([[sideways_n, 0.0, -force_n], [-sideways_n, 0.0, force_n]]).T


@pytest.mark.slow
@pytest.mark.parametrize("above_first", [True, False])
def test_blocks_pressed_together_come_closer_by_force_over_stiffness(above_first):
    blocks = Blocks(four_pads(), above_first=above_first).step(pressed(2e5), 100, slowed=0.3)
    assert blocks.gap_m == pytest.approx([0.0, 0.0, -2e5 / VERTICAL_N_M], rel=1e-6, abs=1e-12)
    up = blocks.on_first_n if above_first else blocks.on_second_n
    assert up[:3] == pytest.approx([0.0, 0.0, 2e5], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("above_first", [True, False])
def test_what_one_gets_the_other_loses(above_first):
    """Momentum of both together stays what the forces from outside made of it."""
    forces = np.array([[3e4, 1e4, -2e5], [0.0, 0.0, 2e5]]).T
    blocks = Blocks(four_pads(friction=0.05), above_first=above_first).step(forces, 40)
    momentum = (blocks.velocities[:3] * blocks.masses).sum(axis=1)
    assert momentum == pytest.approx(40 * SUBSTEP_S * forces.sum(axis=1), abs=1e-6)


def test_it_holds_sideways_by_its_stiffness():
    blocks = Blocks(four_pads()).step(pressed(2e5, 5e4), 100, slowed=0.3)
    assert blocks.gap_m[0] == pytest.approx(5e4 / SIDEWAYS_N_M, rel=1e-3)


def test_it_slides_where_friction_ends_and_resists_by_that_meanwhile():
    """Pushed with 0.3 of the pressing force against a friction of 0.1: the difference moves both, by their masses."""
    blocks = Blocks(four_pads(friction=0.1)).step(pressed(2e5), 100, slowed=0.3)
    before = blocks.velocities[0, 0] - blocks.velocities[0, 1]
    blocks.step(pressed(2e5, 6e4), 50)
    assert blocks.on_first_n[0] == pytest.approx(-0.1 * 2e5, rel=1e-3)
    slip = (6e4 - 2e4) * (1 / 1000.0 + 1 / 3000.0) * 50 * SUBSTEP_S
    assert blocks.velocities[0, 0] - blocks.velocities[0, 1] - before == pytest.approx(slip, rel=0.01)


def test_it_lets_go_what_is_lifted_unless_it_holds_against_uplift():
    lifted = Blocks(four_pads()).step(pressed(-1e4), 20)
    assert lifted.on_first_n.tolist() == [0.0] * 6
    assert lifted.gap_m[2] > 0.0
    held = Blocks(four_pads(pulls=True)).step(pressed(-1e4), 100, slowed=0.3)
    assert held.on_first_n[2] == pytest.approx(-1e4, rel=1e-6)
    assert held.gap_m[2] == pytest.approx(1e4 / VERTICAL_N_M, rel=1e-6)


def test_what_presses_in_every_sub_step_holds_sideways_though_it_is_apart_before_each():
    """As where it slides on a body that rotates, and by rounding. It would have gone by 65 mm, a t² / 2."""
    sideways_n = 1e4
    blocks = Blocks(four_pads()).step(pressed(1e5, sideways_n), 300, slowed=0.05)
    for _ in range(100):
        blocks.step(pressed(1e5, sideways_n), 1, slowed=0.0)
        blocks.positions[2, 0] += 3e-4  # it is pressed together by 0.25 mm
    assert blocks.gap_m[2] > 0.0
    assert abs(blocks.gap_m[0]) < 2e-3


@pytest.mark.parametrize(("breaking_n", "fails"), [(5.1e4, False), (4.9e4, True)])
def test_it_fails_by_the_force_sideways_not_by_that_which_presses(breaking_n, fails):
    blocks = Blocks(four_pads(breaking_n=breaking_n)).step(pressed(2e5, 5e4), 100, slowed=0.3)
    assert blocks.bearings.failed(np.ones(1, bool), np.ones(1)).tolist() == ([0] if fails else [])


def test_it_fails_where_bodies_have_left_each_other():
    blocks = Blocks(four_pads(travel_m=0.01)).step(pressed(-1e4), 30)
    assert blocks.gap_m[2] < 0.01
    assert not len(blocks.bearings.failed(np.ones(1, bool), np.ones(1)))
    blocks.step(pressed(-1e4), 30)
    assert blocks.gap_m[2] > 0.01
    assert blocks.bearings.failed(np.ones(1, bool), np.ones(1)).tolist() == [0]


def test_energy_that_it_stores_is_that_of_a_spring():
    blocks = Blocks(four_pads()).step(pressed(2e5), 100, slowed=0.3)
    stored = blocks.structure.stored_j(blocks.positions, blocks.rotations)
    assert stored == pytest.approx([0.5 * 2e5**2 / VERTICAL_N_M], rel=1e-6)


def at_rest(springs, force, moment_y=0.0):
    """A block on a fixed one at rest under a force at its centre and a moment: the equilibrium."""
    blocks = Blocks(springs)
    masses = np.array([1000.0, 0.0])
    inertias = blocks.bodies.inertias_kg_m2 * 1e-15 * (masses > 0.0)
    loads = np.zeros((6, 2))
    loads[:3, 0], loads[4, 0] = force, moment_y
    bodies = replace(blocks.bodies, masses_kg=masses, inertias_kg_m2=inertias)
    stiffness = np.zeros((6, 6, 1))
    return equilibrium(blocks.frames, stiffness, bodies, np.zeros(3), loads, blocks.bearings)


def test_at_rest_it_carries_what_lies_on_it_and_turns_by_its_springs():
    """About the middle of the pads, four springs with arms of 0.5 m: θ = M / (k a²), where no pad lifts off.

    The block leans by that, and so the load is off by 0.5 m θ, which is another thousandth of the moment.
    """
    rest = at_rest(four_pads(), (0.0, 0.0, -2e5), 2e4)
    turn = 2e4 / (VERTICAL_N_M * 0.5**2)
    assert rest.rotations[0, 2, 0] == pytest.approx(turn, rel=2e-3)
    moment = 2e4 + 2e5 * 0.5 * rest.rotations[0, 2, 0]
    assert rest.loads[:, 0] == pytest.approx([0.0, 0.0, 2e5, 0.0, -moment, 0.0], rel=1e-5, abs=1e-3)


def test_a_block_topples_whose_load_is_beyond_its_pads():
    """They are 0.5 m from the middle; what holds against uplift does not let go."""
    assert at_rest(four_pads(), (0.0, 0.0, -2e5), 0.45 * 2e5).held[0]
    assert not at_rest(four_pads(), (0.0, 0.0, -2e5), 0.55 * 2e5).held[0]
    assert at_rest(four_pads(pulls=True), (0.0, 0.0, -2e5), 0.55 * 2e5).held[0]


def test_at_rest_friction_holds_up_to_its_limit_and_no_further():
    held = at_rest(four_pads(friction=0.2), (0.19 * 2e5, 0.0, -2e5), -0.5 * 0.19 * 2e5)
    assert held.loads[0, 0] == pytest.approx(-0.19 * 2e5, rel=1e-5)
    assert not at_rest(four_pads(friction=0.2), (0.21 * 2e5, 0.0, -2e5), -0.5 * 0.21 * 2e5).held[0]


def test_springs_of_connections_that_are_left_are_numbered_among_these():
    two = replace(four_pads(), rows=np.array([1, 4]), parts=np.array([0, 0, 1, 1]), friction=np.array([0.1, 0.2]))
    two = replace(two, **{name: np.repeat(getattr(two, name), 2) for name in ("pulls", "travel_m", "breaking_n")})
    two = replace(two, bearings=np.array([0, 1]))
    left = two.among(np.array([True, False, True, False, True]))
    assert left.rows.tolist() == [2]
    assert left.parts.tolist() == [0, 0]
    assert left.friction.tolist() == [0.2]
    assert left.places_m.tolist() == PLACES_M[2:].tolist()


def test_bearings_without_any_connection_left_carry_nothing():
    none = four_pads().among(np.zeros(1, bool))
    rest = at_rest(none, (0.0, 0.0, -2e5))
    assert not rest.held[0]
    assert not rest.loads.any()
