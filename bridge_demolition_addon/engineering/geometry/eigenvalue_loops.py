"""Eigenvalues of many small matrices as a loop, which Numba compiles: import this only where it is installed.

It gives the same bits as `vectors`, which is read, changed and tested first: every operation here stands there, in the
same order.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled


@compiled
def diagonals(matrices: Any, sweeps: int) -> Any:
    """Diagonals (k, 3) of symmetric matrices (k, 3, 3) by so many sweeps of Jacobi's method."""
    found, rest = np.empty((len(matrices), 3)), np.empty((3, 3))
    for number in range(len(matrices)):
        rest[:] = matrices[number]
        for _ in range(sweeps):
            _turn(rest, 0, 1)
            _turn(rest, 0, 2)
            _turn(rest, 1, 2)
        for axis in range(3):
            found[number, axis] = rest[axis, axis]
    return found


@compiled
def _turn(rest: Any, p: int, q: int) -> None:
    """Turn a matrix by the smaller rotation after which two of its numbers are 0."""
    beside, tangent = rest[p, q], 0.0
    if beside != 0.0:
        ratio = (rest[q, q] - rest[p, p]) / (2.0 * beside)
        tangent = (1.0 if ratio >= 0.0 else -1.0) / (abs(ratio) + np.sqrt(ratio * ratio + 1.0))
    cosine = 1.0 / np.sqrt(tangent * tangent + 1.0)
    sine = tangent * cosine
    for column in range(3):
        first, second = rest[p, column], rest[q, column]
        rest[p, column], rest[q, column] = cosine * first - sine * second, sine * first + cosine * second
    for row in range(3):
        first, second = rest[row, p], rest[row, q]
        rest[row, p], rest[row, q] = cosine * first - sine * second, sine * first + cosine * second
