"""Sums in numpy's order as a loop, which Numba compiles: import this only where it is installed."""

from __future__ import annotations

from typing import Any

from ..compilation import compiled

MOST_TERMS = 128
"""Terms up to which `total` adds in numpy's order, which halves longer sums."""


@compiled
def total(values: Any) -> Any:
    """Sum of up to `MOST_TERMS` values in the order of `numpy.add.reduceat`: the first, and eight sums of the rest."""
    count = len(values)
    if count < 9:
        rest = -0.0
        for at in range(1, count):
            rest += values[at]
        return values[0] + rest
    sums = values[1:9].copy()
    whole = count - 1 - (count - 1) % 8
    for at in range(8, whole):
        sums[at % 8] += values[1 + at]
    rest = ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]))
    for at in range(whole, count - 1):
        rest += values[1 + at]
    return values[0] + rest


@compiled
def total_of_row(rows: Any, row: int, count: int) -> Any:
    """`total` of the first so many values of a row, without a view of them where they are few."""
    if count >= 9:
        return total(rows[row, :count])
    rest = -0.0
    for at in range(1, count):
        rest += rows[row, at]
    return rows[row, 0] + rest
