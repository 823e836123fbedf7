# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies are turned by torques and pushed by compiled loops as by numpy, bit by bit, in memory of our own."""

from dataclasses import replace

import numpy as np
import pytest

from bridge_demolition_addon.bullet import body_motion
from bridge_demolition_addon.bullet.body_motion import BodyMotionReader
from bridge_demolition_addon.bullet.layout import ASLEEP, AWAKE, DISABLED, SYSTEM_V
from bridge_demolition_addon.bullet.memory import DOUBLES, INTEGERS
from bridge_demolition_addon.errors import LayoutError

BODIES, SIZE = 24, 2048
BODY = SYSTEM_V.body


@pytest.fixture
def memory():
    return np.zeros(BODIES * SIZE // 8)


@pytest.fixture
def reader(memory):
    """Reader of bodies with random inertias and torques; some sleep, some have no torque."""
    rng = np.random.default_rng(5)
    addresses = memory.ctypes.data + SIZE * rng.permutation(BODIES).astype(np.uint64)
    shapes = rng.normal(size=(BODIES, 3, 3))
    inertias = shapes @ np.swapaxes(shapes, 1, 2)
    inertias = inertias + np.swapaxes(inertias, 1, 2)
    for row in range(3):
        for column in range(3):
            DOUBLES.write(addresses + np.uint64(BODY.inverse_inertia + 32 * row + 8 * column), inertias[:, row, column])
        torques = np.where(np.arange(BODIES) % 4, rng.normal(size=BODIES), 0.0)
        DOUBLES.write(addresses + np.uint64(BODY.total_torque + 8 * row), torques)
        DOUBLES.write(addresses + np.uint64(BODY.angular_velocity + 8 * row), rng.normal(size=BODIES))
    states = np.choose(np.arange(BODIES) % 5, (AWAKE, AWAKE, ASLEEP, AWAKE, DISABLED))
    INTEGERS.write(addresses + np.uint64(BODY.activation), states)
    return BodyMotionReader(SYSTEM_V, addresses)


@pytest.fixture
def without_numba(monkeypatch):
    return lambda: monkeypatch.setattr(body_motion, "field_loops", lambda: None)


def test_torques_turn_bodies_with_the_same_bits(memory, reader, without_numba):
    before, times = memory.copy(), np.where(np.arange(BODIES) % 7, 1 / 240, np.inf)
    reader.turn_by_torques(times)
    compiled, memory[:] = memory.copy(), before
    without_numba()
    reader.turn_by_torques(times)
    np.testing.assert_array_equal(compiled, memory)
    # Three numbers of a turned body change, and its three torques end.
    turned = np.flatnonzero(
        (np.arange(BODIES) % 4 > 0) & (np.arange(BODIES) % 7 > 0) & np.isin(np.arange(BODIES) % 5, (0, 1, 3))
    )
    assert (compiled != before).sum() == 6 * len(turned)


@pytest.mark.parametrize("numba", [True, False], ids=["compiled", "by numpy"])
def test_a_wrong_inertia_turns_nothing(memory, reader, without_numba, numba):
    if not numba:
        without_numba()
    memory[(BODY.inverse_inertia + 8) // 8] += 1.0
    before = memory.copy()
    with pytest.raises(LayoutError, match="inertia of a body"):
        reader.turn_by_torques(np.full(BODIES, 1 / 240))
    np.testing.assert_array_equal(memory, before)


def test_impulses_are_given_with_the_same_bits(memory, reader, without_numba):
    """Where a body has none, or does not move, its loads stay."""
    moves = np.arange(BODIES) % 5 > 0
    impulses = np.where(np.arange(BODIES) % 4, np.random.default_rng(6).normal(size=(6, BODIES)), 0.0)
    motion = replace(reader.read(), inverse_masses=np.where(moves, 0.01, 0.0))
    before = memory.copy()
    reader.push(motion, impulses, 1 / 240)
    compiled, memory[:] = memory.copy(), before
    without_numba()
    reader.push(motion, impulses, 1 / 240)
    np.testing.assert_array_equal(compiled, memory)
    assert (compiled != before).sum() == 6 * (moves & (np.arange(BODIES) % 4 > 0)).sum()
