"""How the shards of a blast zone leave their member: away from its axis, without touching anything, until all are out.

A blasted zone clears within some hundredths of a second, and what is on the way out carries nothing. Rigid bodies would
go on carrying by contact, and would jam. So they leave level, at speeds that keep them apart, and touch others again
from the moment when the last of them is out of the section.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...engineering.geometry.vectors import AXES, length, unit
from ..schema import given

if TYPE_CHECKING:
    from .zone_firings import ZoneFiring

LEAVING_M_S = 5.0
"""Least speed on the way out of the section: 0.35 m take 70 ms."""

FALLING_M_S = 1.0
"""Speed of rubble once it is out: from 3 m it lands 0.8 m beside the member."""

_SPREAD = 0.5
"""Speeds of what is thrown lie within this part of their mean, evenly; shards that are farther out are faster."""

_ON_AXIS_M = 1e-6

_WITH_ROOM = 4.0
"""Room beside a section, by its width, up to which nothing may stand where shards leave to: what leaves another column
needs as much as they do.
"""

_NOTHING = np.zeros((0, 2, 3))


@dataclass(frozen=True, slots=True, eq=False)
class Departure:
    """Velocities (b, 3), m/s, of bodies on their way out of the section, for how long, and from then on."""

    leaving_m_s: np.ndarray
    duration_s: float
    after_m_s: np.ndarray


def departure_of(
    zone: ZoneFiring, centres_m: np.ndarray, boxes_m: np.ndarray, others_m: np.ndarray = _NOTHING
) -> Departure:
    """Return how bodies leave a zone, by their centres of mass (b, 3) and the boxes around them (b, 2, 3).

    Each moves across its member, away from the middle of the section, those that are farther out no slower: so no two
    of them come closer on the way. Where one of `others_m`, the boxes (k, 2, 3) around what is not of this member, is
    next to it, bodies that would leave towards it pass the others to the opposite side: columns of a pier would throw
    their concrete into each other. Rubble of a level member falls straight down.
    """
    section = np.array((given(zone.lowest_corner_m), given(zone.highest_corner_m)))
    from_axis = centres_m - section.mean(axis=0)
    from_axis[:, AXES.index(zone.along)] = 0.0
    is_thrown = zone.speed_m_s > 0.0
    if is_thrown or zone.along == "z":
        directions = _outwards(_turned_from(others_m, from_axis, section), AXES.index(zone.along))
    else:
        directions = np.tile((0.0, 0.0, -1.0), (len(centres_m), 1))
    after_m_s = zone.speed_m_s * _by_rank(length(from_axis)) if is_thrown else np.full(len(centres_m), FALLING_M_S)
    # One factor for all keeps the order of their speeds.
    leaving_m_s = after_m_s * max(LEAVING_M_S / float(after_m_s.min()), 1.0)
    leaving = leaving_m_s[:, None] * directions
    return Departure(leaving, _time_out_s(leaving, boxes_m, section), after_m_s[:, None] * directions)


def _outwards(from_axis: np.ndarray, along: int) -> np.ndarray:
    """Return unit vectors (b, 3) away from the axis; what lies on it goes along the next axis."""
    lies_on_it = length(from_axis) < _ON_AXIS_M
    moved = np.where(lies_on_it[:, None], np.eye(3)[(along + 1) % 3], from_axis)
    return unit(moved)


def _turned_from(others_m: np.ndarray, from_axis: np.ndarray, section: np.ndarray) -> np.ndarray:
    """Return vectors (b, 3) from the axis that point to no side where another thing stands, and between two to none."""
    turned, widths = from_axis.copy(), section[1] - section[0]
    for axis in (0, 1):
        rest = [other for other in range(3) if other != axis]
        level = (others_m[:, 0, rest] < section[1, rest]).all(axis=1) & (others_m[:, 1, rest] > section[0, rest]).all(
            axis=1
        )
        beyond = others_m[level, 0, axis] - section[1, axis], section[0, axis] - others_m[level, 1, axis]
        above, below = (bool(((gap > -_ON_AXIS_M) & (gap < _WITH_ROOM * widths[axis])).any()) for gap in beyond)
        if above or below:
            turned[:, axis] = (below - above) * np.abs(from_axis[:, axis])
    return turned


def _by_rank(distances_m: np.ndarray) -> np.ndarray:
    """Return factors (b,) on the mean speed, evenly from the body that is nearest to the axis to the farthest."""
    ranks = np.empty(len(distances_m))
    ranks[np.argsort(distances_m, kind="stable")] = (np.arange(len(distances_m)) + 0.5) / len(distances_m)
    return 1.0 - _SPREAD + 2.0 * _SPREAD * ranks


def _time_out_s(leaving_m_s: np.ndarray, boxes_m: np.ndarray, section: np.ndarray) -> float:
    """Return when the last box (b, 2, 3) is out of the section, past any of its sides."""
    to_go = np.where(leaving_m_s > 0.0, section[1] - boxes_m[:, 0], boxes_m[:, 1] - section[0])
    speeds = np.abs(leaving_m_s)
    times = np.divide(to_go, speeds, out=np.full_like(to_go, np.inf), where=speeds > 0.0)
    return float(times.min(axis=1).max())
