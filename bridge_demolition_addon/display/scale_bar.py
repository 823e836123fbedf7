"""The scale bar of a picture: a staff on the ground beside the bridge, in stripes of known length."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..engineering.geometry.solids import box
from .dressing import DrawnPart, Stuff

STRIPES = 5
_ROUND = (1.0, 2.0, 5.0)
_PART_OF_VIEW = 0.35
_WIDTH_OF_LENGTH = 0.03


@dataclass(frozen=True, slots=True)
class ScaleBar:
    """A bar along x of `length_m` from its `start_m` (3,), on the ground."""

    length_m: float
    start_m: tuple[float, float, float]

    @property
    def text(self) -> str:
        """What stands beside it."""
        return f"{self.length_m:g} m"

    def parts(self) -> list[DrawnPart]:
        """Return its stripes, white and black in turn, all equally long."""
        stripe, width = self.length_m / STRIPES, _WIDTH_OF_LENGTH * self.length_m
        x, y, z = self.start_m
        return [
            DrawnPart(
                Stuff.BLACK if number % 2 else Stuff.WHITE,
                box((stripe, width, width / 2.0), (x + (number + 0.5) * stripe, y, z + width / 4.0)),
            )
            for number in range(STRIPES)
        ]


def scale_bar(points_m: np.ndarray, ground_m: float) -> ScaleBar:
    """Return the bar for a picture of points (n, 3), m: along x, at the edge nearest to a camera beside the road.

    It is as long as the largest of 1, 2 and 5 times a power of ten that is at most a third of the view.
    """
    lowest, highest = points_m.min(axis=0), points_m.max(axis=0)
    most = _PART_OF_VIEW * float(highest[0] - lowest[0])
    power = 10.0 ** math.floor(math.log10(most))
    length = max(factor * power for factor in _ROUND if factor * power <= most * (1.0 + 1e-9))
    return ScaleBar(length, (float(lowest[0] + highest[0] - length) / 2.0, float(lowest[1]), ground_m))
