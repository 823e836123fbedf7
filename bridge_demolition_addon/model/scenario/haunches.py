"""Haunches: where a deck is deeper over its supports."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ..schema import ROUNDING, SIZE, Table, key

_PARABOLA, _PIECES = "parabola", 8
"""With these straight pieces a parabola has 0.3 % more area than it should."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Haunches(Table):
    """Haunches of the deck, of its girders or its box girder over supports, whose tops are lower by them: heights of
    piers and abutments are those below a deck without. Webs, and the bottom slab of a box, are deeper in the same
    ratio. The deck is as deep over the whole length of a support. Bars by rule are for the depth between haunches."""

    table: ClassVar[str] = "bridge.haunches"

    length_m: float = key("Length along the road from the axis of a support to either side.", **SIZE)
    depth_m: float = key("How much deeper the deck is at a support.", **SIZE)
    shape: str = key(
        "Whether the underside is straight, or a parabola that is level at its end in the span.",
        default="straight",
        choices=("straight", _PARABOLA),
    )
    supports: tuple[int, ...] | None = key(
        "Supports that have one, from 1 at the first end; by default all but the first and the last.",
        default=None,
        at_least=1,
    )

    def depth_over_m(self, number: int, count: int) -> float:
        """Return how much deeper the deck is over a support, by its number from 0 and the number of supports."""
        return self.depth_m if number in self._numbers(count) else 0.0

    def outline(self, axes_m: Sequence[float], half_m: float) -> tuple[np.ndarray, np.ndarray]:
        """Return positions along the road, and how much deeper the deck is there and evenly between (n,).

        Supports extend so far to both sides of their axes.
        """
        share = np.linspace(1.0, 0.0, _PIECES + 1) if self.shape == _PARABOLA else np.array([1.0, 0.0])
        away, depths = half_m + (self.length_m - half_m) * (1.0 - share), self.depth_m * share
        if self.shape == _PARABOLA:
            depths = depths * share
        places, values = [], []
        for number in self._numbers(len(axes_m)):
            axis = axes_m[number]
            if number > 0:
                places += (axis - away[::-1]).tolist()
                values += depths[::-1].tolist()
            if number < len(axes_m) - 1:
                places += (axis + away).tolist()
                values += depths.tolist()
        return np.array(places), np.array(values)

    def check_along(self, axes_m: Sequence[float], half_m: float) -> None:
        """Check that haunches are longer than supports, and do not meet before they end.

        Raises
        ------
        ScenarioError
            They are not, or do.
        """
        count, numbers = len(axes_m), self._numbers(len(axes_m))
        if not numbers:
            raise self.unexpected("supports", "supports that have one, as this bridge has none but its ends")
        if numbers[-1] >= count or len(set(numbers)) < len(numbers):
            raise self.unexpected("supports", f"different numbers up to {count}, the number of supports of the bridge")
        if self.length_m <= half_m * (1.0 + ROUNDING):
            raise self.unexpected("length_m", f"more than half the length of the longest support, {half_m:g} (m)")
        for number, span in enumerate(after - before for before, after in pairwise(axes_m)):
            ends = (number in numbers) + (number + 1 in numbers)
            # Over a support without one the deck is not deeper.
            room = span - half_m if ends == 1 else span
            if ends * self.length_m > room * (1.0 + ROUNDING):
                raise self.unexpected(
                    "length_m", f"at most {room / ends:g} (m), so that {ends} fit into span {number + 1} of {span:g} m"
                )

    def check_depth(self, below_m: float, what: str) -> None:
        """Check that something is left of what carries them, whose height without them has a name."""
        if self.depth_m > below_m * (1.0 - ROUNDING):
            raise self.unexpected("depth_m", f"less than {what}, of which {below_m:g} (m) can be taken")

    def _numbers(self, count: int) -> list[int]:
        return list(range(1, count - 1)) if self.supports is None else sorted(number - 1 for number in self.supports)
