# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies whose bars ruptured while they lay deep in each other do not meet until they have been apart."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.bullet.body_motion import BodyMotion
from bridge_demolition_addon.simulation.recording.ruptured_bars import RupturedBars

CUBE_M = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
NONE, FIRST, BOTH = np.array([False, False]), np.array([True, False]), np.array([True, True])


class Places:
    """A row of three cubes, of which the second stands at a place along x, turned about z by an angle."""

    def __init__(self) -> None:
        self.x_m, self.turn = 0.9, 0.0

    def read(self) -> BodyMotion:
        positions_m = np.array([(0.0, self.x_m, 9.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)])
        rotations = np.repeat(np.eye(3)[:, :, None], 3, axis=2)
        sine, cosine = math.sin(self.turn), math.cos(self.turn)
        rotations[:, :, 1] = ((cosine, -sine, 0.0), (sine, cosine, 0.0), (0.0, 0.0, 1.0))
        motion = BodyMotion.room_for(3)
        motion.components[:], motion.asleep[:] = 0.0, False
        motion.position_components_m[:], motion.rotation_components[:] = positions_m, rotations
        motion.inverse_masses[:], motion.inverse_inertia_components[:] = 1.0, rotations
        return motion


@pytest.fixture
def places():
    return Places()


@pytest.fixture
def bars(places):
    """The first two cubes have bars between them; the last two none."""
    return RupturedBars(FIRST, np.array([(0, 1), (1, 2)]), [CUBE_M] * 3, places)


def test_bodies_whose_bars_ruptured_meet_once_they_have_been_apart(bars, places):
    assert not bars.lie_in_each_other(BOTH, BOTH).any()  # held by their bars
    assert bars.lie_in_each_other(NONE, NONE).tolist() == [True, False]  # no other connection waits
    places.x_m = 1.1
    assert not bars.lie_in_each_other(NONE, NONE).any()
    places.x_m = 0.9
    assert not bars.lie_in_each_other(NONE, NONE).any()


def test_a_turned_body_is_apart_where_its_corner_is(bars, places):
    bars.lie_in_each_other(BOTH, BOTH)
    bars.lie_in_each_other(NONE, NONE)
    places.x_m, places.turn = 1.2, math.radians(45.0)
    assert bars.lie_in_each_other(NONE, NONE)[0]  # half the diagonal, 0.707 m, and half a side
    places.x_m = 1.21
    assert not bars.lie_in_each_other(NONE, NONE)[0]


def test_what_is_severed_before_it_yields_meets_at_once(bars):
    assert not bars.lie_in_each_other(NONE, BOTH).any()
    assert not bars.lie_in_each_other(NONE, NONE).any()


def test_bodies_that_lie_in_each_other_by_less_than_contacts_do_meet_at_once(bars, places):
    bars.lie_in_each_other(BOTH, BOTH)
    places.x_m = 0.985
    assert not bars.lie_in_each_other(NONE, NONE).any()


def test_bodies_that_went_apart_a_little_are_held_until_they_are_wholly_apart(bars, places):
    bars.lie_in_each_other(BOTH, BOTH)
    bars.lie_in_each_other(NONE, NONE)
    places.x_m = 0.995
    assert bars.lie_in_each_other(NONE, NONE)[0]
    places.x_m = 1.001
    assert not bars.lie_in_each_other(NONE, NONE)[0]
