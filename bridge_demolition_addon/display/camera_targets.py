"""Camera targets: what pictures of a demolition are to show."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from ..model.bridge.member import Member
from ..model.bridge.preparation import extent, surface_height
from ..model.scenario import Scenario

_DEBRIS_HEIGHTS = 0.5
"""Ground to be seen around the bridge, as a part of its height: what topples reaches as far as it was high, and its
middle half as far."""


def points_to_see(scenario: Scenario, members: Sequence[Member]) -> np.ndarray:
    """Return points (n, 3), m, for a camera: bridge, what works on it, and the ground where members fall."""
    (first, right, low), (last, left, top) = extent(members)
    foot = min(float(low), 0.0)
    room = _DEBRIS_HEIGHTS * (top - foot)
    seen = [(x, y, top) for x in (first, last) for y in (right, left)]
    seen += [(x, y, foot) for x in (first - room, last + room) for y in (right - room, left + room)]
    for action in scenario.actions:
        seen += action.points_of_interest(partial(surface_height, scenario, members))
    return np.array(seen)
