# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads are shared out among the shards that they mean."""

from dataclasses import replace

import numpy as np
import pytest

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.as_built import Structure
from bridge_demolition_addon.model.loads.part import placed_loads
from bridge_demolition_addon.model.scenario import Load

# Three blocks of a deck, the first of them held, and a pier; the last body is the ground.
CENTRES_M = np.array([(0, 0, 5), (1, 0, 5), (2, 0, 5), (2, 0, 2), (0, 0, 0)], float)
STRUCTURE = Structure(
    centres_m=CENTRES_M,
    masses_kg=np.array([0.0, 100.0, 300.0, 50.0, 0.0]),
    member_names=np.array(["deck", "deck", "deck", "pier 1", ""]),
    member_kinds=np.array(["deck", "deck", "deck", "pier", ""]),
    is_shard=np.array([False] + [True] * 3 + [False]),
    held=np.array([True] + [False] * 4),
    pairs=np.zeros((0, 2), int),
    points_m=np.zeros((0, 3)),
    normals=np.zeros((0, 3)),
    bearings=np.zeros(0, int),
    boxes_m=CENTRES_M[:, None] + np.array([(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)]),
)
GROWING = {"times_s": (0, 1), "forces_n": (0, 1)}
BOX = {"lowest_corner_m": (-1, -1, 4), "highest_corner_m": (1.5, 1, 6)}


def test_a_point_in_a_long_shard_is_not_taken_for_one_of_a_short_one_beside_it():
    boxes_m = STRUCTURE.boxes_m.copy()
    boxes_m[1, :, 0] = 0.5, 9.5
    (placed,) = placed_loads([Load(point_m=(4.0, 0.0, 5.0), **GROWING)], replace(STRUCTURE, boxes_m=boxes_m))
    assert placed.bodies.tolist() == [1]
    assert placed.arms_m.tolist() == [[3.0, 0.0, 0.0]]


@pytest.mark.parametrize(
    ("part", "bodies", "shares", "arm_m"),
    [
        ({"members": ["deck"]}, [1, 2], [0.25, 0.75], None),
        ({"members": ["pier"]}, [3], [1.0], None),
        (BOX, [1], [1.0], None),
        ({"point_m": (1.9, 0.0, 5.5)}, [2], [1.0], [-0.1, 0.0, 0.5]),
        # The held block is the nearest, but bears nothing that would be seen.
        ({"members": ["deck"], "point_m": (0.1, 0.0, 5.0)}, [1], [1.0], [-0.9, 0.0, 0.0]),
        ({"point_m": (2.0, 0.0, 3.6)}, [2], [1.0], [0.0, 0.0, -1.4]),
        ({"point_m": (2.0, 0.0, 3.4)}, [3], [1.0], [0.0, 0.0, 1.4]),
        ({"members": ["pier"], "point_m": (1.9, 0.0, 5.5)}, [3], [1.0], [-0.1, 0.0, 3.5]),
    ],
)
def test_loads_find_what_bears_them(part, bodies, shares, arm_m):
    (placed,) = placed_loads([Load(**part, **GROWING)], STRUCTURE)
    assert placed.bodies.tolist() == bodies
    assert placed.shares.tolist() == shares
    assert placed.arms_m == pytest.approx(np.tile(arm_m or (0.0, 0.0, 0.0), (len(bodies), 1)))


@pytest.mark.parametrize(
    ("part", "text"),
    [
        ({"members": ["pier 3"]}, r'loads.members names "pier 3": expected names or kinds of members, which are deck'),
        ({"members": ["pier"], **BOX}, r"\[\[loads\]\] number 1: no shard that can move is there; expected members or"),
    ],
)
def test_what_nothing_bears_is_refused(part, text):
    with pytest.raises(ScenarioError, match=text):
        placed_loads([Load(**part, **GROWING)], STRUCTURE)
