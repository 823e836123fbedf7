"""The order of firing: how likely two detonators of successive times fire the other way round."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

from ...engineering.statistics.normal import normal_probability
from ..actions import Fact
from .charge_plan import FiredRow

_MS_PER_S = 1e3

_LEAST_SAID = 1e-9
"""Smaller chances are said to be less than this."""


@dataclass(frozen=True, slots=True)
class FiringPair:
    """What fires at one planned time and what fires at the next, so much later.

    `chance` is the probability that one detonator of the later time fires before one of the earlier.
    """

    earlier: tuple[str, ...]
    later: tuple[str, ...]
    apart_s: float
    chance: float


def chance_of_swap(apart_s: float, one_deviation_s: float, other_deviation_s: float) -> float:
    """Return how likely the later of two detonators fires first, with standard deviations of their times.

    Both times are normal and independent: Φ(-Δt / √(s₁² + s₂²)).
    """
    deviation_s = math.sqrt(one_deviation_s * one_deviation_s + other_deviation_s * other_deviation_s)
    return normal_probability(-apart_s / deviation_s) if deviation_s else 0.0


def firing_pairs(rows: Sequence[FiredRow]) -> tuple[FiringPair, ...]:
    """Return each planned time and the next of rows in order of time, without those whose detonators never scatter.

    Of rows at one time that with the widest scatter counts.
    """
    times = [tuple(group) for _, group in groupby(rows, key=lambda row: row.time_s)]
    pairs = []
    for earlier, later in pairwise(times):
        deviations_s = [max(row.deviation_s for row in group) for group in (earlier, later)]
        if any(deviations_s):
            apart_s = later[0].time_s - earlier[0].time_s
            chance = chance_of_swap(apart_s, *deviations_s)
            pairs.append(FiringPair(_names(earlier), _names(later), apart_s, chance))
    return tuple(pairs)


def firing_facts(rows: Sequence[FiredRow]) -> Iterator[Fact]:
    """Yield the pair that is the likeliest to fire the other way round."""
    pairs = firing_pairs(rows)
    if pairs:
        worst = max(pairs, key=lambda pair: pair.chance)
        chance = f"{worst.chance:.2g}" if worst.chance >= _LEAST_SAID else f"less than {_LEAST_SAID:g}"
        yield (
            "order of firing",
            f"a detonator of {worst.later[0]} fires before one of {worst.earlier[0]}, planned "
            f"{_MS_PER_S * worst.apart_s:g} ms earlier, with a chance of {chance}",
        )
        yield "", "of all successive times this is the likeliest, by the scatter of the detonators"


def _names(rows: Sequence[FiredRow]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(f"{row.name} row {row.row}" if row.rows > 1 else row.name for row in rows))
