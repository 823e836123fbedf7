"""Springs between two bodies as loops, which Numba compiles: import this only where it is installed.

The loops give the same bits as `spring_law` and `gaps`, as those of cracks do: see `crack_loops`. All arrays have their
components first.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from ..geometry.vector_loops import crossed


@compiled
def resisted(
    vertical: Any, sideways: Any, capacity: Any, friction: Any, pulls: Any, pressed: Any, gaps: Any
) -> tuple[Any, Any]:
    """`PressedSprings.resisted`."""
    count = gaps.shape[1]
    forces, tangents = np.empty((3, count)), np.zeros((3, 3, count))
    held = np.empty(2)
    for row in range(count):
        wanted = -vertical[row] * gaps[2, row]
        acts = pulls[row] or wanted > 0.0
        forces[2, row] = min(wanted, capacity[row]) if acts else 0.0
        held[0], held[1] = -sideways[0, row] * gaps[0, row], -sideways[1, row] * gaps[1, row]
        size = np.sqrt(held[0] * held[0] + held[1] * held[1])
        if not np.isinf(friction[row]):
            limit = friction[row] * pressed[row]
        else:
            limit = np.inf if pulls[row] or pressed[row] > 0.0 else 0.0 * pressed[row]
        slides = size > limit
        share = limit / size if slides else 1.0
        across = share / (size * size) if slides else 0.0
        tangents[2, 2, row] = vertical[row] * (1.0 if acts and wanted < capacity[row] else 0.0)
        for axis in range(2):
            forces[axis, row] = share * held[axis]
            for other in range(2):
                whole = sideways[axis, row] if axis == other else 0.0
                turning = across * held[axis] * held[other] * sideways[other, row]
                tangents[axis, other, row] = whole * share - turning
    return forces, tangents


@compiled
def rates(velocities: Any, first: Any, second: Any, first_arms: Any, second_arms: Any) -> Any:
    """`Gaps.rates`."""
    result = np.empty(first_arms.shape)
    for row in range(len(first)):
        one, other = first[row], second[row]
        arm = second_arms[0, row], second_arms[1, row], second_arms[2, row]
        turning = crossed((velocities[3, other], velocities[4, other], velocities[5, other]), arm)
        arm = first_arms[0, row], first_arms[1, row], first_arms[2, row]
        first_turning = crossed((velocities[3, one], velocities[4, one], velocities[5, one]), arm)
        for axis in range(3):
            moving = velocities[axis, other] + turning[axis]
            result[axis, row] = moving - velocities[axis, one] - first_turning[axis]
    return result


@compiled
def summed_loads(forces: Any, arms: Any, arms_below: Any, of: Any, above_first: Any) -> tuple[Any, Any]:
    """`springs.loads_of_springs`."""
    count = len(above_first)
    above, below = np.zeros((6, count)), np.zeros((6, count))
    for row in range(len(of)):
        force = forces[0, row], forces[1, row], forces[2, row]
        back = -force[0], -force[1], -force[2]
        moment = crossed((arms[0, row], arms[1, row], arms[2, row]), force)
        moment_below = crossed((arms_below[0, row], arms_below[1, row], arms_below[2, row]), back)
        for axis in range(3):
            above[axis, of[row]] += force[axis]
            above[3 + axis, of[row]] += moment[axis]
            below[axis, of[row]] += back[axis]
            below[3 + axis, of[row]] += moment_below[axis]
    return _in_order(above, below, above_first)


@compiled
def _in_order(above: Any, below: Any, above_first: Any) -> tuple[Any, Any]:
    """What is of bodies above and below as of first and second bodies."""
    first, second = np.empty_like(above), np.empty_like(above)
    for row in range(len(above_first)):
        for axis in range(6):
            if above_first[row]:
                first[axis, row], second[axis, row] = above[axis, row], below[axis, row]
            else:
                first[axis, row], second[axis, row] = below[axis, row], above[axis, row]
    return first, second


@compiled
def summed_stiffness(tangents: Any, arms: Any, arms_below: Any, of: Any, above_first: Any) -> tuple[Any, Any, Any]:
    """`springs.stiffness_of_springs`."""
    count = len(above_first)
    sums = np.zeros((8, 3, 3, count))
    turning, turning_below = np.empty((3, 3)), np.empty((3, 3))
    for row in range(len(of)):
        arm = arms[0, row], arms[1, row], arms[2, row]
        below = arms_below[0, row], arms_below[1, row], arms_below[2, row]
        for axis in range(3):
            line = tangents[axis, 0, row], tangents[axis, 1, row], tangents[axis, 2, row]
            by_arm, by_below = crossed(arm, line), crossed(below, line)
            for other in range(3):
                turning[axis, other], turning_below[axis, other] = by_arm[other], by_below[other]
        for other in range(3):
            column = tangents[0, other, row], tangents[1, other, row], tangents[2, other, row]
            turned = turning[0, other], turning[1, other], turning[2, other]
            turned_below = turning_below[0, other], turning_below[1, other], turning_below[2, other]
            moments, moments_below = crossed(arm, column), crossed(below, column)
            about, about_below, about_both = (
                crossed(arm, turned),
                crossed(below, turned_below),
                crossed(arm, turned_below),
            )
            for axis in range(3):
                sums[0, axis, other, of[row]] += tangents[axis, other, row]
                sums[1, axis, other, of[row]] += turning[axis, other]
                sums[2, axis, other, of[row]] += turning_below[axis, other]
                sums[3, axis, other, of[row]] += moments[axis]
                sums[4, axis, other, of[row]] += moments_below[axis]
                sums[5, axis, other, of[row]] += about[axis]
                sums[6, axis, other, of[row]] += about_below[axis]
                sums[7, axis, other, of[row]] += about_both[axis]
    return _blocks_in_order(sums, above_first)


@compiled
def _blocks_in_order(sums: Any, above_first: Any) -> tuple[Any, Any, Any]:
    """Blocks of first bodies, of second ones, and between them."""
    count = len(above_first)
    of_first, of_second, between = np.empty((6, 6, count)), np.empty((6, 6, count)), np.empty((6, 6, count))
    for row in range(count):
        above, below = (of_first, of_second) if above_first[row] else (of_second, of_first)
        for axis in range(3):
            for other in range(3):
                above[axis, other, row], below[axis, other, row] = sums[0, axis, other, row], sums[0, axis, other, row]
                above[axis, 3 + other, row] = sums[1, axis, other, row]
                below[axis, 3 + other, row] = sums[2, axis, other, row]
                above[3 + axis, other, row] = sums[3, axis, other, row]
                below[3 + axis, other, row] = sums[4, axis, other, row]
                above[3 + axis, 3 + other, row] = sums[5, axis, other, row]
                below[3 + axis, 3 + other, row] = sums[6, axis, other, row]
                _put(between, above_first[row], axis, other, row, -sums[0, axis, other, row])
                _put(between, above_first[row], axis, 3 + other, row, -sums[2, axis, other, row])
                _put(between, above_first[row], 3 + axis, other, row, -sums[3, axis, other, row])
                _put(between, above_first[row], 3 + axis, 3 + other, row, -sums[7, axis, other, row])
    return of_first, of_second, between


@compiled
def _put(between: Any, above_first: Any, line: int, column: int, row: int, value: float) -> None:
    """Write a number of the block between two bodies, with lines for the first of them."""
    if above_first:
        between[line, column, row] = value
    else:
        between[column, line, row] = value
