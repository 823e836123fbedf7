# SPDX-License-Identifier: GPL-3.0-or-later
"""A sub-step in one call before Bullet and one after it, in memory of our own: what is read, put and stored."""

import numpy as np
import pytest
from support.own_ticks import OwnMemory, elastic_tick

from bridge_demolition_addon.bullet.layout import SYSTEM_V
from bridge_demolition_addon.bullet.memory import BYTES
from bridge_demolition_addon.bullet.tick import Found, SubstepStage
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure
from bridge_demolition_addon.errors import LayoutError, NotFiniteError

BODIES, SUBSTEP_S, STIFFNESS_N_M = 5, 1.0 / 240.0, 1e6


class Row:
    """Bodies in a row, of which the first never moves, with elastic connections between neighbours."""

    def __init__(self):
        rng, count = np.random.default_rng(8), BODIES - 1
        masses = np.where(np.arange(BODIES) > 0, rng.uniform(10.0, 50.0, BODIES), 0.0)
        inverse = np.divide(1.0, masses, out=np.zeros(BODIES), where=masses > 0.0)
        positions = np.array([[1.0], [0.0], [0.0]]) * np.arange(BODIES)
        turns = np.ascontiguousarray(np.repeat(np.eye(3)[..., None], BODIES, axis=2))
        bodies = RigidBodies(masses, np.eye(3)[..., None] * masses, positions, turns)
        axes = np.ascontiguousarray(turns[..., 1:])
        points = np.array([[0.5], [0.0], [0.0]]) * np.ones(count)
        ends = np.arange(count), np.arange(1, BODIES)
        stiffness = np.ascontiguousarray(np.eye(6)[..., None] * np.full(count, STIFFNESS_N_M))
        self.structure = ElasticStructure(JointFrames(*ends, axes, axes, points, -points), stiffness, bodies, 0.0)
        moved = positions + 1e-3 * rng.normal(size=(3, BODIES)) * (masses > 0.0)
        self.own = OwnMemory(moved, inverse, count)
        self.own.put_vectors("linear_velocity", rng.normal(size=(BODIES, 3)) * (masses > 0.0)[:, None])
        self.own.put_vectors("total_force", np.array((0.0, 0.0, -9.81)) * masses[:, None])
        self.tick, self.arrays = elastic_tick(self.own, self.structure, SUBSTEP_S)

    def step(self):
        return self.structure.choose(self.structure.intact, np.zeros(BODIES, bool))


@pytest.fixture
def row():
    return Row()


def test_bodies_get_the_velocities_that_were_solved(row):
    """Bullet adds what forces do; torques were turned into angular velocities, and are over."""
    own, step, before = row.own, row.step(), row.own.vectors("linear_velocity")
    assert row.tick.go_on() == Found(0) and row.tick.next == SubstepStage.BULLET
    inverse = row.arrays["motion"][24]
    ends = before + SUBSTEP_S * inverse * own.vectors("total_force")
    np.testing.assert_allclose(ends, step.velocities[:3], rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(own.vectors("angular_velocity"), step.velocities[3:], rtol=1e-12, atol=1e-14)
    assert abs(step.velocities[4:, 1:]).min() > 0.0 and not own.vectors("total_torque").any()


def test_rows_expect_the_deformations_at_the_end(row):
    """Bodies that move as they are to come to the limits of their rows, of which those of turns have the other sign."""
    row.tick.go_on()
    step = row.step()
    coming = row.structure.deformations - SUBSTEP_S * step.rates
    coming[3:] *= -1.0
    for limits in (SYSTEM_V.spring.lower, SYSTEM_V.spring.upper):
        np.testing.assert_array_equal(row.own.limits(limits), coming)


def test_loads_are_of_what_holds(row):
    """A connection that breaks is found at once, and has none; the others have theirs on the bodies that were asked."""
    row.tick.go_on()
    assert row.arrays["loads"].all(axis=0).sum() == 0 and row.arrays["loads"].any(axis=0).all()
    BYTES.write(row.own.springs[2] + np.uint64(SYSTEM_V.constraint.enabled), 0)
    row.tick.next = SubstepStage.READ
    assert row.tick.go_on() == Found.OTHERS_ACT and row.tick.next == SubstepStage.PREDICT
    intact = np.array([True, True, False, True])
    step = row.structure.choose(intact, np.zeros(BODIES, bool))
    row.tick.point("chosen", intact, 4)
    assert row.tick.go_on() == Found(0)
    loads, is_first = row.arrays["loads"], row.arrays["on_first"]
    assert not loads[:, 2].any()
    expected = np.where(is_first[step.acting], step.of_first, step.of_second) / SUBSTEP_S
    np.testing.assert_array_equal(loads[:, step.acting], expected)


def test_parts_that_fall_asleep_are_told(row):
    states = row.own.bodies + np.uint64(SYSTEM_V.body.activation)
    BYTES.write(states, 2)
    assert row.tick.go_on() == Found.OTHERS_ACT


def test_energy_is_half_of_load_by_strain(row):
    """After Bullet: of springs of one stiffness, k/2 Σ e²; what was predicted is added to what Bullet tells."""
    row.tick.go_on()
    row.tick.next = SubstepStage.TAKE
    assert row.tick.go_on() == Found(0) and row.tick.next == SubstepStage.END
    strains = row.structure.deformations
    np.testing.assert_allclose(row.arrays["stored"], 0.5 * STIFFNESS_N_M * (strains**2).sum(axis=0), rtol=1e-12)
    np.testing.assert_array_equal(row.arrays["taken"], row.arrays["loads"])
    assert row.arrays["left_intact"].all()


def test_a_velocity_that_is_no_number_is_named_and_nothing_is_written(row):
    velocities = row.own.vectors("linear_velocity")
    velocities[1, 3] = np.nan
    row.own.put_vectors("linear_velocity", velocities.T)
    before = row.own.memory.copy()
    with pytest.raises(NotFiniteError, match=r"velocity of body .*3"):
        row.tick.go_on()
    np.testing.assert_array_equal(row.own.memory, before)


def test_a_wrong_inertia_is_no_body(row):
    row.own.put("inverse_inertia", -1.0)
    with pytest.raises(LayoutError, match="inertia of a body"):
        row.tick.go_on()


@pytest.mark.parametrize("next_", [-1, 10, 10**9])
def test_stages_that_there_are_not_are_refused(row, next_):
    row.tick.next = next_
    with pytest.raises(ValueError, match="that there are not"):
        row.tick.go_on()


@pytest.mark.parametrize("name", ["sides", "numbers"])
def test_numbers_out_of_range_are_refused(row, name):
    row.tick.go_on()
    row.arrays[name][1] = 10**6
    row.tick.next = SubstepStage.TAKE
    with pytest.raises((ValueError, LayoutError), match=r"that there are not|more than there can be"):
        row.tick.go_on()
