"""The scale bar of a picture: a staff on the ground next to the bridge, in stripes of known length."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..engineering.arrays import FloatArray
from ..engineering.geometry.solids import box
from ..engineering.terrain.surface import RecordedGround
from .dressing import DrawnPart, Stuff

STRIPES = 5
_ROUND = (1.0, 2.0, 5.0)
_PART_OF_VIEW = 0.35
_WIDTH_OF_LENGTH = 0.03

_SAMPLES, _LEG_M = 41, 0.06
"""Positions along a bar at which the ground is looked at, and how thick its legs are."""


@dataclass(frozen=True, slots=True)
class ScaleBar:
    """A bar along x of `length_m` from its `start_m` (3,), on the ground.

    Where the ground is uneven it lies on the highest place under it, and `legs_m` says how high its two ends are.
    """

    length_m: float
    start_m: tuple[float, float, float]
    legs_m: tuple[float, float] = (0.0, 0.0)

    @property
    def text(self) -> str:
        """Its label."""
        return f"{self.length_m:g} m"

    def parts(self) -> list[DrawnPart]:
        """Return its stripes, white and black in turn, all equally long, and legs where an end is off the ground."""
        stripe, width = self.length_m / STRIPES, _WIDTH_OF_LENGTH * self.length_m
        x, y, z = self.start_m
        legs = [
            DrawnPart(Stuff.BLACK, box((_LEG_M, _LEG_M, leg), (at, y, z - leg / 2.0)))
            for at, leg in zip((x, x + self.length_m), self.legs_m, strict=True)
            if leg > _LEG_M
        ]
        stripes = [
            DrawnPart(
                Stuff.BLACK if number % 2 else Stuff.WHITE,
                box((stripe, width, width / 2.0), (x + (number + 0.5) * stripe, y, z + width / 4.0)),
            )
            for number in range(STRIPES)
        ]
        return [*stripes, *legs]


def scale_bar(points_m: FloatArray, ground: RecordedGround) -> ScaleBar:
    """Return the bar for a picture of points (n, 3), m: along x, at the edge nearest to a camera beside the road.

    It is as long as the largest of 1, 2 and 5 times a power of ten that is at most a third of the view.
    """
    lowest, highest = points_m.min(axis=0), points_m.max(axis=0)
    most = _PART_OF_VIEW * float(highest[0] - lowest[0])
    power = 10.0 ** math.floor(math.log10(most))
    length = max(factor * power for factor in _ROUND if factor * power <= most * (1.0 + 1e-9))
    x, y = float(lowest[0] + highest[0] - length) / 2.0, float(lowest[1])
    along = x + length * np.linspace(0.0, 1.0, _SAMPLES)
    heights = ground.heights_at(np.column_stack((along, np.full(_SAMPLES, y))))
    top = float(heights.max())
    return ScaleBar(length, (x, y, top), (top - float(heights[0]), top - float(heights[-1])))
