"""Large arrays piece by piece, so that what is worked out from them takes little memory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

_NUMBERS = 1 << 18
"""In a piece: what is worked out from it stays in the processor's cache."""


def blocks_of(values: np.ndarray) -> Iterator[np.ndarray]:
    """Give an array in pieces along its first axis, in order."""
    values = np.atleast_1d(values)
    rows = max(1, _NUMBERS // max(1, values[:1].size))
    for first in range(0, len(values), rows):
        yield values[first : first + rows]
