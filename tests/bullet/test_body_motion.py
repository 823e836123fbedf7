# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies are read, turned by torques and pushed by the core as by numpy, bit by bit, in memory of our own."""

from dataclasses import replace

import numpy as np
import pytest
from reference import bullet_fields as reference

from bridge_demolition_addon.bullet.body_motion import BodyMotionReader, BulletBodies
from bridge_demolition_addon.bullet.constraints import BulletConnections
from bridge_demolition_addon.bullet.layout import ASLEEP, AWAKE, DISABLED, SYSTEM_V
from bridge_demolition_addon.bullet.memory import DOUBLES, INTEGERS
from bridge_demolition_addon.bullet.tick import Found, SubstepStage, Tick
from bridge_demolition_addon.engineering.core.calls import call
from bridge_demolition_addon.errors import LayoutError, NotFiniteError

BODIES, SIZE = 24, 2048
BODY = SYSTEM_V.body


@pytest.fixture
def memory():
    return np.zeros(BODIES * SIZE // 8)


@pytest.fixture
def addresses(memory):
    """Bodies with random inertias and torques; some sleep, some have no torque."""
    rng = np.random.default_rng(5)
    addresses = memory.ctypes.data + SIZE * rng.permutation(BODIES).astype(np.uint64)
    memory[:] = rng.normal(size=memory.size)
    shapes = rng.normal(size=(BODIES, 3, 3))
    inertias = shapes @ np.swapaxes(shapes, 1, 2)
    inertias = inertias + np.swapaxes(inertias, 1, 2)
    for row in range(3):
        for column in range(3):
            DOUBLES.write(addresses + np.uint64(BODY.inverse_inertia + 32 * row + 8 * column), inertias[:, row, column])
        torques = np.where(np.arange(BODIES) % 4, rng.normal(size=BODIES), 0.0)
        DOUBLES.write(addresses + np.uint64(BODY.total_torque + 8 * row), torques)
    states = np.choose(np.arange(BODIES) % 5, (AWAKE, AWAKE, ASLEEP, AWAKE, DISABLED))
    INTEGERS.write(addresses + np.uint64(BODY.activation), states)
    return addresses


@pytest.fixture
def reader(addresses):
    return BodyMotionReader(SYSTEM_V, addresses)


def turn_by_torques(addresses, times_s):
    """Turn the bodies as before a sub-step in which no connection is elastic."""
    tick = Tick()
    tick.refer(bodies=BulletBodies.of(BODY, addresses), connections=BulletConnections(count=0))
    tick.point("times", times_s, len(addresses))
    tick.next = SubstepStage.TURN
    assert tick.go_on() == Found(0) and tick.next == SubstepStage.BULLET


def test_motion_is_what_numpy_reads_field_by_field(addresses, reader):
    found, (expected, asleep) = reader.read(), reference.motion(SYSTEM_V, addresses)
    parts = found.rotation_components.reshape(9, -1), found.position_components_m, found.velocity_components
    parts = *parts, found.load_components, found.inverse_masses, found.inverse_inertia_components.reshape(9, -1)
    np.testing.assert_array_equal(np.vstack(parts), expected)
    np.testing.assert_array_equal(found.asleep, asleep)
    assert asleep.any() and not asleep.all()


def test_torques_turn_bodies_with_the_bits_of_numpy(memory, addresses, reader):
    before, times = memory.copy(), np.where(np.arange(BODIES) % 7, 1 / 240, np.inf)
    spins, turned = reference.spins_after(SYSTEM_V, addresses, times)
    turn_by_torques(addresses, times)
    np.testing.assert_array_equal(reader.read().velocity_components[3:], spins)
    assert not reader.read().load_components[3:, turned].any()
    # Three numbers of a turned body change, and its three torques end.
    assert (memory != before).sum() == 6 * turned.sum() > 0


@pytest.mark.parametrize("row", [0, BODIES - 1])
@pytest.mark.parametrize("wrong", [1.0, np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", [(0, 0), (0, 1)])
def test_a_wrong_inertia_turns_nothing(memory, addresses, reader, row, wrong, place):
    """On the diagonal it is negative or none, beside it not symmetric."""
    field = addresses[row] + np.uint64(BODY.inverse_inertia + 32 * place[0] + 8 * place[1])
    DOUBLES.write(field, -wrong if place == (0, 0) else wrong + 9.0)
    before = memory.copy()
    with pytest.raises(LayoutError, match="inertia of a body"):
        turn_by_torques(addresses, np.full(BODIES, 1 / 240))
    expected = LayoutError if np.isfinite(wrong) else NotFiniteError
    with pytest.raises(expected, match=r"inertia of (a body is|body .* is no finite)"):
        reader.read()
    np.testing.assert_array_equal(memory, before)


def test_a_body_that_nothing_turns_may_have_any_inertia(memory, addresses, reader):
    DOUBLES.write(
        (addresses + np.uint64(BODY.total_torque))[:, None] + np.uint64(8) * np.arange(3, dtype=np.uint64), 0.0
    )
    DOUBLES.write(addresses + np.uint64(BODY.inverse_inertia), np.nan)
    before = memory.copy()
    turn_by_torques(addresses, np.full(BODIES, 1 / 240))
    np.testing.assert_array_equal(memory, before)


def test_impulses_are_given_with_the_bits_of_numpy(memory, addresses, reader):
    """Where a body has none, or does not move, its loads stay."""
    moves = np.arange(BODIES) % 5 > 0
    impulses = np.where(np.arange(BODIES) % 4, np.random.default_rng(6).normal(size=(6, BODIES)), 0.0)
    motion = replace(reader.read(), inverse_masses=np.where(moves, 0.01, 0.0))
    pushed, before = moves & impulses.any(axis=0), memory.copy()
    bodies = BulletBodies.of(BODY, addresses)
    call("bda_push", bodies, motion.inverse_masses, motion.load_components.copy(), impulses, 1 / 240)
    expected = np.where(pushed, motion.load_components + impulses / (1 / 240), motion.load_components)
    np.testing.assert_array_equal(reader.read().load_components, expected)
    assert (memory != before).sum() == 6 * pushed.sum() > 0


def test_bodies_are_put_where_they_are_told(addresses, reader):
    rows, rng = np.array([3, 0]), np.random.default_rng(7)
    places, turns, before = rng.normal(size=(3, 2)), rng.normal(size=(3, 3, 2)), reader.read()
    reader.set_positions(rows, places, turns)
    after = reader.read()
    np.testing.assert_array_equal(after.position_components_m[:, rows], places)
    np.testing.assert_array_equal(after.rotation_components[..., rows], turns)
    assert (after.position_components_m != before.position_components_m).any(axis=0).sum() == len(rows)
    np.testing.assert_array_equal(after.velocity_components, before.velocity_components)


def test_arrays_of_another_size_are_refused(addresses):
    with pytest.raises(ValueError, match=r"^times has 23 numbers: expected 24$"):
        turn_by_torques(addresses, np.zeros(BODIES - 1))
