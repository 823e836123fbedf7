"""Exclusion zone: plan area, designed drop, predicted debris and a buffer.

These are the four areas that BS 6187:2011, *Code of practice for full and partial demolition*, makes up an exclusion
zone from. How wide the buffer has to be is for the engineer to say: the simulation knows neither pieces smaller than
its shards nor what flies off at an impact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, JoinType

from ...engineering.arithmetic import cosine
from ...engineering.geometry.plan_areas import distances_outside, outlines, united
from ..results.arrays import Results
from ..results.motion import relative_to_ground
from ..scenario import Exclusion
from .footprint import footprint, swept_footprint

_CIRCLE_SEGMENTS = 64
"""Corners of a full circle around a corner; they lie on the circle, so that its sides cut 0.1 % of the radius."""


@dataclass(frozen=True, eq=False, slots=True)
class ExclusionZone:
    """Areas of an exclusion zone: the bridge's plan, the designed drop area with it, and debris at any time of the run.

    The whole is all of these with the buffer around them.
    """

    plan: CrossSection
    drop: CrossSection
    debris: CrossSection
    whole: CrossSection

    @property
    def largest_distance_m(self) -> float:
        """Return the largest distance of the zone's edge from the bridge's plan."""
        corners = np.concatenate(outlines(self.whole))
        return float(distances_outside(self.plan, corners).max())

    @property
    def bounds_m(self) -> tuple[float, float, float, float]:
        """Return smallest x and y, largest x and y."""
        return tuple(self.whole.bounds())


def exclusion_zone(results: Results, settings: Exclusion) -> ExclusionZone:
    """Return the exclusion zone of a run."""
    results = relative_to_ground(results)
    shards = results.inventory.of_kind("shard")
    plan = footprint(results, shards, 0)
    drop = widened(plan, settings.designed_drop_m)
    debris = swept_footprint(results, np.concatenate([shards, results.inventory.of_kind("ball")]))
    return ExclusionZone(plan, drop, debris, widened(united([plan, drop, debris]), settings.buffer_m))


def widened_around(area: CrossSection, distance_m: float) -> CrossSection:
    """Return an area with everything nearer to it than a distance, and up to 0.13 % of that more: never less."""
    return widened(area, distance_m / float(cosine(math.pi / _CIRCLE_SEGMENTS)))


def widened(area: CrossSection, distance_m: float) -> CrossSection:
    """Return an area with everything nearer to it than a distance."""
    if distance_m <= 0.0:
        return area
    return area.offset(distance_m, JoinType.Round, circular_segments=_CIRCLE_SEGMENTS)
