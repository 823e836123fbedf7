"""Equations of bodies and elastic connections, as loops that Numba compiles: import this only where it is installed.

The loops give the same numbers as `equations`, see `crack_loops`. All arrays have their components first, and their
names are those of the dataclasses that they come from.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from .joint_loops import LANES


@compiled
def mass_matrices(masses: Any, inertias: Any, rotations: Any, bodies: Any) -> Any:
    """`RigidBodies.mass_matrices`."""
    found, half = np.zeros((6, 6, len(bodies))), np.empty((3, 3))
    for row in range(len(bodies)):
        turn, inertia = rotations[:, :, bodies[row]], inertias[:, :, bodies[row]]
        for line in range(3):
            for column in range(3):
                half[line, column] = (
                    turn[line, 0] * inertia[0, column]
                    + turn[line, 1] * inertia[1, column]
                    + turn[line, 2] * inertia[2, column]
                )
        for line in range(3):
            found[line, line, row] = masses[bodies[row]]
            for column in range(3):
                found[3 + line, 3 + column, row] = (
                    half[line, 0] * turn[column, 0] + half[line, 1] * turn[column, 1] + half[line, 2] * turn[column, 2]
                )
    return found


@compiled
def blocks(
    along: Any, first_turning: Any, second_turning: Any, turning: Any, stiffness: Any, implicit: Any
) -> tuple[Any, Any, Any]:
    """`equations.stiffness_blocks`, with stiffness times `implicit`; own ones have no numbers below the diagonal.

    Sums leave out the zeros of rows: they differ at most in the sign of a 0.
    """
    count = along.shape[2]
    of_first, of_second, between = np.zeros((6, 6, count)), np.zeros((6, 6, count)), np.empty((6, 6, count))
    hard, one, other = np.zeros((6, 6, LANES)), np.zeros((6, 6, LANES)), np.zeros((6, 6, LANES))
    by_one, by_other = np.empty((6, 6, LANES)), np.empty((6, 6, LANES))
    for start in range(0, count, LANES):
        size = min(LANES, count - start)
        for line in range(6):
            for column in range(6):
                for lane in range(size):
                    hard[line, column, lane] = implicit[start + lane] * stiffness[line, column, start + lane]
        for line in range(3):
            for column in range(3):
                for lane in range(size):
                    row = start + lane
                    one[column, line, lane], other[column, line, lane] = (
                        along[line, column, row],
                        -along[line, column, row],
                    )
                    one[3 + column, line, lane] = first_turning[line, column, row]
                    other[3 + column, line, lane] = second_turning[line, column, row]
                    one[3 + column, 3 + line, lane] = turning[line, column, row]
                    other[3 + column, 3 + line, lane] = -turning[line, column, row]
        for column in range(6):
            for line in range(6):
                _sum(hard[line], one[column], column, by_one[column, line])
                _sum(hard[line], other[column], column, by_other[column, line])
        for line in range(6):
            for column in range(6):
                if line <= column:
                    _sum(one[line], by_one[column], line, of_first[line, column, start : start + size])
                    _sum(other[line], by_other[column], line, of_second[line, column, start : start + size])
                _sum(one[line], by_other[column], line, between[line, column, start : start + size])
    return of_first, of_second, between


@compiled
def _sum(first: Any, second: Any, column: int, sums: Any) -> None:
    """Sums of products over the six rows of a group; shifts, columns up to 2, are in the first three of them alone."""
    if column < 3:
        for lane in range(len(sums)):
            sums[lane] = (
                first[0, lane] * second[0, lane] + first[1, lane] * second[1, lane] + first[2, lane] * second[2, lane]
            )
    else:
        for lane in range(len(sums)):
            sums[lane] = (
                first[0, lane] * second[0, lane]
                + first[1, lane] * second[1, lane]
                + first[2, lane] * second[2, lane]
                + first[3, lane] * second[3, lane]
                + first[4, lane] * second[4, lane]
                + first[5, lane] * second[5, lane]
            )


@compiled
def add(totals: Any, places: Any, at: Any, values: Any, chosen: Any, upper: bool) -> None:
    """Add chosen values (k,) of (6, 6, c) to totals, whose places are (6, 6, d) at (k,), number after number.

    Some belong to blocks of which only the upper triangle counts.
    """
    for line in range(6):
        for column in range(line if upper else 0, 6):
            for row in range(len(at)):
                totals[places[line, column, at[row]]] += values[line, column, chosen[row]]
