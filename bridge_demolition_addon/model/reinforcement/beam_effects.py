"""Design moments and shear forces of a beam under 1.35 times its permanent and 1.5 times its variable loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.reinforced_concrete.influence_lines import (
    InfluenceLines,
    MovingLoad,
    extreme_effects,
    permanent_effects,
)
from ...engineering.reinforced_concrete.materials import PERMANENT_FACTOR, VARIABLE_FACTOR


@dataclass(frozen=True, slots=True, eq=False)
class BeamEffects:
    """Design effects along a beam with n points: permanent loads count 1.35 times, or once where they relieve."""

    lines: InfluenceLines
    largest_nm: np.ndarray  # (n,), moments
    least_nm: np.ndarray  # (n,)
    shears_n: np.ndarray  # (n - 1,), larger of both directions, between the points
    permanent_reactions_n: np.ndarray  # (r,), without factors

    @property
    def sagging_nm(self) -> float:
        return float(max(self.largest_nm.max(), 0.0))

    @property
    def hogging_nm(self) -> float:
        return float(max(-self.least_nm.min(), 0.0))

    def shear_beyond_n(self, supports_m: Sequence[float], distance_m: float) -> float:
        """Return the largest shear force farther from all supports than a distance; 0 where nothing is.

        Between two points a shear is that of axles at or beyond the next one: so the part before the distance counts.
        """
        apart = np.abs(self.lines.between_m[:, None] - np.array(supports_m)).min(axis=1)
        before = 1.5 * np.diff(self.lines.points_m)
        is_beyond = (apart >= distance_m - before) & (apart.max() >= distance_m)
        return float(self.shears_n[is_beyond].max(initial=0.0))

    def hogging_beyond_nm(self, supports_m: Sequence[float], distance_m: float) -> float:
        """Return the largest hogging moment at the faces of supports or farther from these."""
        apart = np.abs(self.lines.points_m[:, None] - np.array(supports_m)).min(axis=1)
        return float(max(-self.least_nm[apart >= distance_m].min(initial=0.0), 0.0))


def beam_effects(lines: InfluenceLines, permanent_n_m: float, moving: Sequence[MovingLoad]) -> BeamEffects:
    """Return the design effects of a permanent load by length and of moving loads, one of them at a time."""
    points = lines.points_m
    moments = permanent_effects(points, lines.moments, permanent_n_m)
    shears = permanent_effects(points, lines.shears, permanent_n_m)
    least, largest = extreme_effects(points, lines.moments, moving)
    downwards, upwards = extreme_effects(points, lines.shears, [_everywhere(load) for load in moving])
    raised, lowered = np.maximum(PERMANENT_FACTOR * shears, shears), np.minimum(PERMANENT_FACTOR * shears, shears)
    return BeamEffects(
        lines,
        np.maximum(PERMANENT_FACTOR * moments, moments) + VARIABLE_FACTOR * largest,
        np.minimum(PERMANENT_FACTOR * moments, moments) + VARIABLE_FACTOR * least,
        np.maximum(raised + VARIABLE_FACTOR * upwards, -(lowered + VARIABLE_FACTOR * downwards)),
        permanent_effects(points, lines.reactions, permanent_n_m),
    )


def _everywhere(load: MovingLoad) -> MovingLoad:
    """Return a load that counts for all effects."""
    return replace(load, hogging_only=False)
