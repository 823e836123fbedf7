"""Camera targets: what pictures of a demolition are to show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..model.bridge.extent import extent, surface_height
from ..model.bridge.member import Member
from ..model.scenario import Scenario
from ..model.sequence.tool_paths import chisel_tip_positions

_DEBRIS_HEIGHTS = 0.5
"""Ground to be seen around the bridge, as a part of its height: what topples reaches as far as it was high, and its
middle half as far."""


def points_to_see(scenario: Scenario, members: Sequence[Member]) -> np.ndarray:
    """Return the points that a camera is to see: the bridge, what works on it, and the ground where members fall, as
    low as they stand.

    Returns
    -------
    (n, 3) float
        In m.
    """
    (first, right, low), (last, left, top) = extent(members)
    foot = min(float(low), 0.0)
    room = _DEBRIS_HEIGHTS * (top - foot)
    seen = [(x, y, top) for x in (first, last) for y in (right, left)]
    seen += [(x, y, foot) for x in (first - room, last + room) for y in (right - room, left + room)]
    return np.array([*seen, *_of_the_ball(scenario, members), *_of_jackhammers(scenario, members)])


def _of_the_ball(scenario: Scenario, members: Sequence[Member]) -> Iterator[tuple[float, float, float]]:
    ball = scenario.ball
    for drop in ball.drops if ball else ():
        surface = surface_height(scenario, members, drop.target_m)
        yield (*drop.target_m, surface + drop.drop_height_m + ball.diameter_m)
    if ball and ball.cable:
        yield ball.cable.start_m
        yield ball.cable.crane_point_m


def _of_jackhammers(scenario: Scenario, members: Sequence[Member]) -> Iterator[tuple[float, float, float]]:
    """Yield the upper ends of the chisels at the top of their strokes, at both ends of their paths."""
    for hammer in scenario.jackhammers:
        surface = surface_height(scenario, members, hammer.path_m[0])
        (tip,) = chisel_tip_positions(hammer, surface, np.array([hammer.start_time_s]))
        for along, across in hammer.path_m:
            yield along, across, float(tip[2]) + hammer.length_m
