"""Accounts of bodies that touch as a loop, which Numba compiles: import this only where it is installed.

It gives the same bits as `touches`, as the loops of cracks do: see `elasticity.crack_loops`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled


@compiled
def returned(
    pairs: Any, work: Any, order: Any, ends: Any, known: Any, taken: Any, last: Any, substep: int, apart: int
) -> tuple[Any, Any, Any, Any]:
    """`Touches.returned`, with the accounts after it: known pairs, what each has taken, and when it last did work.

    `order` (k,) are the rows of each sub-step, by their pairs.
    """
    given_back, working = np.zeros(len(work)), np.empty(len(work), np.int64)
    for number in range(len(ends) - 1):
        count = 0
        for row in order[ends[number] : ends[number + 1]]:
            if work[row] != 0.0:
                working[count] = row
                count += 1
        if count:
            accounts, now = (known, taken, last), substep + number
            known, taken, last = _booked(working[:count], pairs, work, given_back, *accounts, now, apart)
    return given_back, known, taken, last


@compiled
def _booked(
    rows: Any,
    pairs: Any,
    work: Any,
    given_back: Any,
    known: Any,
    taken: Any,
    last: Any,
    substep: int,
    apart: int,
) -> tuple[Any, Any, Any]:
    """`Touches._book` of the pairs of rows, in ascending order; notes what they give back."""
    most = len(rows) + len(known)
    all_pairs, all_taken, all_last = np.empty(most, known.dtype), np.empty(most), np.empty(most, last.dtype)
    count, place = 0, 0
    for row in rows:
        while known[place] < pairs[row]:
            if last[place] >= substep - apart:
                all_pairs[count], all_taken[count], all_last[count] = known[place], taken[place], last[place]
                count += 1
            place += 1
        had = 0.0
        if known[place] == pairs[row]:
            had = taken[place] if last[place] >= substep - apart else 0.0
            place += 1
        given_back[row] = np.minimum(np.maximum(work[row], 0.0), had)
        all_pairs[count], all_taken[count] = pairs[row], np.maximum(had - work[row], 0.0)
        all_last[count] = substep
        count += 1
    for rest in range(place, len(known)):
        if last[rest] >= substep - apart or rest == len(known) - 1:  # the last one is no pair, and stays
            all_pairs[count], all_taken[count], all_last[count] = known[rest], taken[rest], last[rest]
            count += 1
    return all_pairs[:count].copy(), all_taken[:count].copy(), all_last[:count].copy()
