# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints of steel that ruptured keep their bodies from meeting until these have been apart."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.bullet.body_motion import BodyMotion
from bridge_demolition_addon.engineering.mechanics.section_cuts import ConnectedFaces
from bridge_demolition_addon.simulation.recording.ruptured_joints import RupturedJoints

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
        return BodyMotion(positions_m, rotations, np.zeros((6, 3)), np.ones(3), np.zeros((6, 3)), np.zeros(3, bool))


@pytest.fixture
def places():
    return Places()


@pytest.fixture
def joints(places):
    """The first two cubes have a joint of steel; the last two another connection."""
    pairs, along_x = np.array([(0, 1), (1, 2)]), np.array([(1.0, 0.0, 0.0)] * 2)
    faces = ConnectedFaces(pairs, np.zeros((2, 3)), along_x, np.ones(2), np.zeros((2, 2, 2)))
    return RupturedJoints(FIRST, faces, [CUBE_M] * 3, places)


def test_bodies_of_a_ruptured_joint_meet_once_they_have_been_apart(joints, places):
    assert not joints.lie_in_each_other(BOTH, BOTH).any()  # held by its hinge
    assert joints.lie_in_each_other(NONE, NONE).tolist() == [True, False]  # no other connection waits
    places.x_m = 1.1
    assert not joints.lie_in_each_other(NONE, NONE).any()
    places.x_m = 0.9
    assert not joints.lie_in_each_other(NONE, NONE).any()


def test_a_turned_body_is_apart_where_its_corner_is(joints, places):
    joints.lie_in_each_other(BOTH, BOTH)
    places.x_m, places.turn = 1.2, math.radians(45.0)
    assert joints.lie_in_each_other(NONE, NONE)[0]  # half the diagonal, 0.707 m, and half a side
    places.x_m = 1.21
    assert not joints.lie_in_each_other(NONE, NONE)[0]


def test_what_is_severed_before_it_yields_meets_at_once(joints):
    assert not joints.lie_in_each_other(NONE, BOTH).any()
    assert not joints.lie_in_each_other(NONE, NONE).any()


def test_boxes_lie_along_the_bar_of_the_joint(places):
    """Two thin pieces of a bar at 45°: apart by a little more than nothing along it, as boxes of the world are not."""
    turn = np.array([(1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (0.0, 0.0, math.sqrt(2.0))]) / math.sqrt(2.0)
    piece_m = CUBE_M * (1.0, 0.1, 0.1) @ turn.T
    faces = ConnectedFaces(
        np.array([(0, 1), (1, 2)]), np.zeros((2, 3)), np.tile(turn[:, 0], (2, 1)), np.ones(2), np.zeros((2, 2, 2))
    )
    joints = RupturedJoints(FIRST, faces, [piece_m] * 3, places)
    joints.lie_in_each_other(BOTH, BOTH)
    places.x_m = 0.14  # across the bar by 0.1
    assert joints.lie_in_each_other(NONE, NONE)[0]
    places.x_m = 0.142
    assert not joints.lie_in_each_other(NONE, NONE)[0]
