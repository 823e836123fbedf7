# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads are as large as they are said to be at each time, and are refused where they say nothing."""

import math
from dataclasses import replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Load
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.sequence.ending import first_event_s, last_event_s

LOAD = Load(members=("deck",), times_s=(1, 2, 4), forces_n=(10, 30, 0))


@pytest.mark.parametrize(
    ("time_s", "force_n"), [(0.0, 0.0), (0.99, 0.0), (1.0, 10.0), (1.5, 20.0), (2.0, 30.0), (3.0, 15.0), (9.0, 0.0)]
)
def test_it_goes_in_straight_lines_from_time_to_time(time_s, force_n):
    assert LOAD.force_n(time_s) == force_n


def test_its_direction_is_one_long():
    assert LOAD.unit_direction == (0.0, 0.0, -1.0)
    assert replace(LOAD, direction=(3, 0, 4)).unit_direction == (0.6, 0.0, 0.8)


def test_a_bridge_is_left_alone_until_it_begins_and_is_not_done_before_its_last_time():
    alone = replace(I235, ball=None)
    assert first_event_s(replace(alone, loads=(LOAD,))) == 1.0
    later = replace(LOAD, forces_n=(0, 0, 5))
    assert first_event_s(replace(alone, loads=(later,))) == 2.0
    assert first_event_s(replace(alone, loads=(replace(LOAD, forces_n=(0, 0, 0)),))) == math.inf
    assert last_event_s(replace(alone, loads=(LOAD,))) == 4.0


def test_it_is_written_without_loss():
    box = {"lowest_corner_m": (0, 0, 0), "highest_corner_m": (1, 2, 3)}
    loads = (LOAD, Load(point_m=(1, 2, 3), direction=(0, 1, 0), times_s=(0.1 + 0.2,), forces_n=(1e5,), **box))
    scenario = replace(I235, loads=loads)
    assert scenario_from_text(scenario_text(scenario)) == scenario


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"members": None}, "loads.members is missing: expected it, the two corners of a box, or a point"),
        ({"direction": (0, 0, 0)}, "loads.direction is a list of length 3, all 0: expected a direction"),
        ({"forces_n": (1, 2)}, "loads.forces_n is a list of length 2: expected as many as loads.times_s, 3"),
        ({"forces_n": (1, 2, -3)}, r"loads.forces_n.3 is -3: expected a list of one or more numbers of at least 0"),
        ({"times_s": (1, 2, 2)}, r"loads.times_s.3 is 2.0: expected more than the one before, 2.0 \(s\)"),
        ({"lowest_corner_m": (0, 0, 0)}, "loads.highest_corner_m is missing: expected it with loads.lowest_corner_m"),
    ],
)
def test_what_says_nothing_is_refused(given, text):
    with pytest.raises(ScenarioError, match=text):
        replace(LOAD, **given)


def test_a_load_begins_within_the_run():
    late = Load(members=("deck",), times_s=(I235.time.duration_s,), forces_n=(1,))
    with pytest.raises(ScenarioError, match=r"loads.times_s.1 is 5.0: expected less than time.duration_s, 5.0"):
        replace(I235, loads=(late,))
