"""Where elastic connections are, as loops that Numba compiles: import this only where it is installed.

The loops give the same bits as `joint_rows`, see `crack_loops`. All arrays have their components first, and their names
are those of the dataclasses that they come from.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..arithmetic import ARCTANGENT, ARCTANGENT_LIMITS, ARCTANGENT_STARTS, PI_REST
from ..compilation import compiled
from ..geometry.vector_loops import crossed, dotted
from .joint_loops import LANES

_COEFFICIENTS = np.array(ARCTANGENT)


@compiled
def deformations(
    first: Any,
    second: Any,
    first_axes: Any,
    second_axes: Any,
    first_points: Any,
    second_points: Any,
    positions: Any,
    rotations: Any,
) -> Any:
    """`JointPositions.deformations` at once with `joint_positions`."""
    count = len(first)
    found, sines, cosines = np.empty((6, count)), np.empty((3, count)), np.empty((3, count))
    for row in range(count):
        a, b = first[row], second[row]
        one, other = _axes(rotations, a, first_axes, row), _axes(rotations, b, second_axes, row)
        lever, lever_of_second = _lever(rotations, a, first_points, row), _lever(rotations, b, second_points, row)
        shift = (
            positions[0, b] - positions[0, a] + lever_of_second[0] - lever[0],
            positions[1, b] - positions[1, a] + lever_of_second[1] - lever[1],
            positions[2, b] - positions[2, a] + lever_of_second[2] - lever[2],
        )
        for axis in range(3):
            found[axis, row] = one[axis][0] * shift[0] + one[axis][1] * shift[1] + one[axis][2] * shift[2]
        about_y = dotted(one[0], other[2])
        sines[0, row], cosines[0, row] = -dotted(one[1], other[2]), dotted(one[2], other[2])
        sines[1, row], cosines[1, row] = about_y, np.sqrt(max(1.0 - about_y * about_y, 0.0))
        sines[2, row], cosines[2, row] = -dotted(one[0], other[1]), dotted(one[0], other[0])
    for axis in range(3):
        _put_angles(sines[axis], cosines[axis], found[3 + axis])
    return found


@compiled
def rows(
    first: Any, second: Any, first_axes: Any, second_axes: Any, first_points: Any, second_points: Any, rotations: Any
) -> tuple[Any, Any, Any, Any]:
    """`JointPositions.rows` at once with `joint_positions`."""
    count = len(first)
    along, first_turning = np.empty((3, 3, count)), np.empty((3, 3, count))
    second_turning, turning = np.empty((3, 3, count)), np.empty((3, 3, count))
    for row in range(count):
        a, b = first[row], second[row]
        one, other = _axes(rotations, a, first_axes, row), _axes(rotations, b, second_axes, row)
        lever, lever_of_second = _lever(rotations, a, first_points, row), _lever(rotations, b, second_points, row)
        for axis in range(3):
            line = one[axis]
            by_first, by_second = crossed(lever, line), crossed(line, lever_of_second)
            for component in range(3):
                along[axis, component, row] = line[component]
                first_turning[axis, component, row] = by_first[component]
                second_turning[axis, component, row] = by_second[component]
        first_z, second_x = one[2], other[0]
        y = crossed(first_z, second_x)
        _put_unit(turning, 0, row, crossed(y, first_z))
        _put_unit(turning, 1, row, y)
        _put_unit(turning, 2, row, crossed(second_x, y))
    return along, first_turning, second_turning, turning


@compiled
def _axes(rotations: Any, body: int, axes: Any, row: int) -> Any:
    """Axes of a frame in the world, one after another, as `joint_rows.matrix_products` has them in columns."""
    return (
        _turned(rotations, body, axes[0, 0, row], axes[1, 0, row], axes[2, 0, row]),
        _turned(rotations, body, axes[0, 1, row], axes[1, 1, row], axes[2, 1, row]),
        _turned(rotations, body, axes[0, 2, row], axes[1, 2, row], axes[2, 2, row]),
    )


@compiled
def _lever(rotations: Any, body: int, points: Any, row: int) -> Any:
    """From the centre of a body to a frame, in the world."""
    return _turned(rotations, body, points[0, row], points[1, row], points[2, row])


@compiled
def _turned(rotations: Any, body: int, x: float, y: float, z: float) -> Any:
    """`joint_rows.turned` of one vector with a body."""
    return (
        rotations[0, 0, body] * x + rotations[0, 1, body] * y + rotations[0, 2, body] * z,
        rotations[1, 0, body] * x + rotations[1, 1, body] * y + rotations[1, 2, body] * z,
        rotations[2, 0, body] * x + rotations[2, 1, body] * y + rotations[2, 2, body] * z,
    )


@compiled
def _put_unit(turning: Any, axis: int, row: int, vector: Any) -> None:
    """Write a vector with length 1; 0 where it has no length."""
    size = np.sqrt(dotted(vector, vector))
    for other in range(3):
        turning[axis, other, row] = vector[other] / size if size > 0.0 else 0.0


@compiled
def _put_angles(y: Any, x: Any, angles: Any) -> None:
    """`arithmetic.arctangent`; of several points at once where all angles of a group are small, as they mostly are."""
    slopes = np.empty(LANES)
    for start in range(0, len(y), LANES):
        of_y, of_x, found = y[start : start + LANES], x[start : start + LANES], angles[start : start + LANES]
        are_small = True
        for lane in range(len(of_y)):
            slopes[lane] = abs(of_y[lane] / of_x[lane])
            are_small &= (of_x[lane] > 0.0) & (slopes[lane] < ARCTANGENT_LIMITS[0])
        if are_small:
            for lane in range(len(of_y)):
                square = slopes[lane] * slopes[lane]
                value = _COEFFICIENTS[-1]
                for number in range(len(_COEFFICIENTS) - 2, -1, -1):
                    value = _COEFFICIENTS[number] + square * value
                less = slopes[lane] * square * value
                angle = ARCTANGENT_STARTS[0, 0] - ((less - ARCTANGENT_STARTS[0, 1]) - slopes[lane])
                found[lane] = math.copysign(angle, of_y[lane])
        else:
            for lane in range(len(of_y)):
                found[lane] = _angle(of_y[lane], of_x[lane])


@compiled
def _angle(y: float, x: float) -> float:
    """`arithmetic.arctangent` of one point."""
    slope = abs(y / x) if y != 0.0 else 0.0
    region = 0
    while region < 4 and not slope < ARCTANGENT_LIMITS[region]:
        region += 1
    if region == 0:
        shorter = slope
    elif region == 1:
        shorter = (2.0 * slope - 1.0) / (2.0 + slope)
    elif region == 2:
        shorter = (slope - 1.0) / (slope + 1.0)
    elif region == 3:
        shorter = (slope - 1.5) / (1.0 + 1.5 * slope)
    else:
        shorter = -1.0 / slope
    square = shorter * shorter
    value = _COEFFICIENTS[-1]
    for number in range(len(_COEFFICIENTS) - 2, -1, -1):
        value = _COEFFICIENTS[number] + square * value
    less = shorter * square * value
    angle = ARCTANGENT_STARTS[region, 0] - ((less - ARCTANGENT_STARTS[region, 1]) - shorter)
    if math.copysign(1.0, x) < 0.0 and slope < np.inf:
        angle = np.pi - (angle - PI_REST)
    return math.copysign(angle, y)
