"""Elastic connections as loops, which Numba compiles: import this only where it is installed.

The loops give the same bits as `joint_rows` and `equations`, as those of cracks do: see `crack_loops`. All arrays have
their components first, and their names are those of the dataclasses that they come from.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..arithmetic import ARCTANGENT, ARCTANGENT_LIMITS, ARCTANGENT_STARTS, PI_REST
from ..compilation import compiled
from ..geometry.vector_loops import crossed, dotted

_COEFFICIENTS = np.array(ARCTANGENT)

_LANES = 64
"""Connections in a group: processors work on several at once that are beside each other, and a group fits a cache."""


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
def _put_angles(y: Any, x: Any, angles: Any) -> None:
    """`arithmetic.arctangent`; of several points at once where all angles of a group are small, as they mostly are."""
    slopes = np.empty(_LANES)
    for start in range(0, len(y), _LANES):
        of_y, of_x, found = y[start : start + _LANES], x[start : start + _LANES], angles[start : start + _LANES]
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


@compiled
def grouped(along: Any, first_turning: Any, second_turning: Any, turning: Any, stiffness: Any) -> Any:
    """Rows of connections, 9 numbers each, and stiffness in groups (g, 72, 64); the last group is filled up with 0."""
    count = along.shape[2]
    found = np.zeros(((count + _LANES - 1) // _LANES, 72, _LANES))
    for group in range(len(found)):
        start, size = group * _LANES, min(_LANES, count - group * _LANES)
        for at in range(9):
            line, column = at // 3, at % 3
            for lane in range(size):
                found[group, at, lane] = along[line, column, start + lane]
                found[group, 9 + at, lane] = first_turning[line, column, start + lane]
                found[group, 18 + at, lane] = second_turning[line, column, start + lane]
                found[group, 27 + at, lane] = turning[line, column, start + lane]
        for at in range(36):
            for lane in range(size):
                found[group, 36 + at, lane] = stiffness[at // 6, at % 6, start + lane]
    return found


@compiled
def begun(
    first: Any, second: Any, joints: Any, implicit: Any, strains: Any, substep_s: float, velocities: Any
) -> tuple[Any, Any, Any]:
    """`joint_forces.begun`, with joints as `grouped`."""
    count = len(first)
    rates, amounts = np.empty((6, count)), np.empty((6, count))
    of_seconds, of_bodies = np.empty((count, 6)), np.zeros((velocities.shape[1], 6))
    moving, room = np.ascontiguousarray(velocities.T), np.zeros((7, 6, _LANES))
    rate, strain, amount, of_first, of_second = room[0], room[1], room[2], room[3], room[4]
    for group in range(len(joints)):
        start, size = group * _LANES, min(_LANES, count - group * _LANES)
        _rates(joints[group], first, second, start, size, moving, room[5:], rate)
        for axis in range(6):
            for lane in range(size):
                row = start + lane
                rates[axis, row] = rate[axis, lane]
                strain[axis, lane] = substep_s * strains[axis, row] - implicit[row] * rate[axis, lane]
        for axis in range(6):
            _stressed(joints[group], 36 + 6 * axis, strain, amount[axis])
            for lane in range(size):
                amounts[axis, start + lane] = amount[axis, lane]
        _loads(joints[group], amount, of_first, of_second)
        for lane in range(size):
            row = start + lane
            for axis in range(6):
                of_bodies[first[row], axis] += of_first[axis, lane]
                of_seconds[row, axis] = of_second[axis, lane]
    _add_seconds(second, of_seconds, of_bodies)
    return rates, amounts, np.ascontiguousarray(of_bodies.T)


@compiled
def slowed(
    first: Any, second: Any, joints: Any, implicit: Any, rates: Any, amounts: Any, changes: Any
) -> tuple[Any, Any, Any, Any]:
    """`joint_forces.slowed`, with joints as `grouped`."""
    count = len(first)
    slowing, on_first, on_second = np.empty((6, count)), np.empty((6, count)), np.empty((6, count))
    of_seconds, of_bodies = np.empty((count, 6)), np.zeros((changes.shape[1], 6))
    moving, room = np.ascontiguousarray(changes.T), np.zeros((7, 6, _LANES))
    rate, strain, amount, of_first, of_second = room[0], room[1], room[2], room[3], room[4]
    for group in range(len(joints)):
        start, size = group * _LANES, min(_LANES, count - group * _LANES)
        _rates(joints[group], first, second, start, size, moving, room[5:], rate)
        for axis in range(6):
            for lane in range(size):
                row = start + lane
                slowing[axis, row] = rates[axis, row] + rate[axis, lane]
                strain[axis, lane] = implicit[row] * rate[axis, lane]
        for axis in range(6):
            _stressed(joints[group], 36 + 6 * axis, strain, amount[axis])
            for lane in range(size):
                amount[axis, lane] = amounts[axis, start + lane] - amount[axis, lane]
        _loads(joints[group], amount, of_first, of_second)
        for axis in range(6):
            for lane in range(size):
                on_first[axis, start + lane] = of_first[axis, lane]
                on_second[axis, start + lane] = of_second[axis, lane]
        for lane in range(size):
            row = start + lane
            for axis in range(6):
                of_bodies[first[row], axis] += of_first[axis, lane]
                of_seconds[row, axis] = of_second[axis, lane]
    _add_seconds(second, of_seconds, of_bodies)
    return slowing, on_first, on_second, np.ascontiguousarray(of_bodies.T)


@compiled
def _rates(joints: Any, first: Any, second: Any, start: int, size: int, velocities: Any, room: Any, rates: Any) -> None:
    """`JointRows.rates` of a group by velocities (n, 6) of bodies; room (2, 6, 64) is for those of its own bodies."""
    one, other = room[0], room[1]
    for lane in range(size):
        a, b = first[start + lane], second[start + lane]
        for axis in range(6):
            one[axis, lane], other[axis, lane] = velocities[a, axis], velocities[b, axis]
    for axis in range(3):
        at, shifting, turning = 3 * axis, rates[axis], rates[3 + axis]
        for lane in range(_LANES):
            x, y, z = one[0, lane] - other[0, lane], one[1, lane] - other[1, lane], one[2, lane] - other[2, lane]
            shifting[lane] = joints[at, lane] * x + joints[at + 1, lane] * y + joints[at + 2, lane] * z
        _add_products(joints, at + 9, one, shifting)
        _add_products(joints, at + 18, other, shifting)
        for lane in range(_LANES):
            x, y, z = one[3, lane] - other[3, lane], one[4, lane] - other[4, lane], one[5, lane] - other[5, lane]
            turning[lane] = joints[at + 27, lane] * x + joints[at + 28, lane] * y + joints[at + 29, lane] * z


@compiled
def _add_products(joints: Any, at: int, velocities: Any, rates: Any) -> None:
    """Add what angular velocities, the last of velocities (6, 64), do in a row that begins at a number."""
    for lane in range(_LANES):
        rates[lane] += (
            joints[at, lane] * velocities[3, lane]
            + joints[at + 1, lane] * velocities[4, lane]
            + joints[at + 2, lane] * velocities[5, lane]
        )


@compiled
def _stressed(joints: Any, at: int, strains: Any, amounts: Any) -> None:
    """One row of `equations.stressed` of a group, whose stiffness begins at a number."""
    for lane in range(_LANES):
        amounts[lane] = (
            joints[at, lane] * strains[0, lane]
            + joints[at + 1, lane] * strains[1, lane]
            + joints[at + 2, lane] * strains[2, lane]
            + joints[at + 3, lane] * strains[3, lane]
            + joints[at + 4, lane] * strains[4, lane]
            + joints[at + 5, lane] * strains[5, lane]
        )


@compiled
def _loads(joints: Any, amounts: Any, of_first: Any, of_second: Any) -> None:
    """`JointRows.loads` of a group."""
    for axis in range(3):
        force, on_first, on_second = of_first[axis], of_first[3 + axis], of_second[3 + axis]
        _turned_back(joints, axis, amounts, force)
        _turned_back(joints, axis + 9, amounts, on_first)
        _turned_back(joints, axis + 18, amounts, on_second)
        for lane in range(_LANES):
            torque = (
                joints[axis + 27, lane] * amounts[3, lane]
                + joints[axis + 30, lane] * amounts[4, lane]
                + joints[axis + 33, lane] * amounts[5, lane]
            )
            of_second[axis, lane] = -force[lane]
            on_first[lane] += torque
            on_second[lane] -= torque


@compiled
def _turned_back(joints: Any, at: int, amounts: Any, loads: Any) -> None:
    """`joint_rows.turned_back` of the first three amounts of a group."""
    for lane in range(_LANES):
        loads[lane] = (
            joints[at, lane] * amounts[0, lane]
            + joints[at + 3, lane] * amounts[1, lane]
            + joints[at + 6, lane] * amounts[2, lane]
        )


@compiled
def _add_seconds(second: Any, of_second: Any, of_bodies: Any) -> None:
    """Add loads (k, 6) on second bodies to those (n, 6) that have all of first ones, as `summed_on_bodies` does."""
    for row in range(len(second)):
        for axis in range(6):
            of_bodies[second[row], axis] += of_second[row, axis]


@compiled
def velocities_alone(
    velocities: Any, left: Any, inverse_masses: Any, inverse_inertias: Any, loads: Any, substep_s: float
) -> Any:
    """`joint_forces.velocities_alone`."""
    alone = np.empty(velocities.shape)
    for body in range(len(inverse_masses)):
        moves = inverse_masses[body] > 0.0
        for axis in range(3):
            gained = inverse_masses[body] * loads[axis, body]
            turning = (
                inverse_inertias[axis, 0, body] * loads[3, body]
                + inverse_inertias[axis, 1, body] * loads[4, body]
                + inverse_inertias[axis, 2, body] * loads[5, body]
            ) * (1.0 if moves else 0.0)
            stays, turns = (left[axis, body], left[3 + axis, body]) if moves else (1.0, 1.0)
            alone[axis, body] = stays * velocities[axis, body] + substep_s * gained
            alone[3 + axis, body] = turns * velocities[3 + axis, body] + substep_s * turning
    return alone


@compiled
def clear_loads(loads: Any, holding: Any) -> None:
    """Write 0 for connections that do not hold."""
    for row in range(len(holding)):
        if not holding[row]:
            loads[:, row] = 0.0


@compiled
def put_loads(loads: Any, on_first: Any, numbers: Any, of_first: Any, of_second: Any, substep_s: float) -> None:
    """Write the loads of some connections by their impulses."""
    for axis in range(6):
        for row in range(len(numbers)):
            number = numbers[row]
            loads[axis, number] = (of_first[axis, row] if on_first[number] else of_second[axis, row]) / substep_s


@compiled
def stored(stiffness: Any, strains: Any) -> Any:
    """`joint_forces.stored`."""
    count = strains.shape[1]
    energies = np.zeros(count)
    for row in range(count):
        for axis in range(6):
            amount = stiffness[axis, 0, row] * strains[0, row]
            for column in range(1, 6):
                amount += stiffness[axis, column, row] * strains[column, row]
            energies[row] += 0.5 * amount * strains[axis, row]
    return energies


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
def _put_unit(turning: Any, axis: int, row: int, vector: Any) -> None:
    """Write a vector with length 1; 0 where it has no length."""
    size = np.sqrt(dotted(vector, vector))
    for other in range(3):
        turning[axis, other, row] = vector[other] / size if size > 0.0 else 0.0


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
    hard, one, other = np.zeros((6, 6, _LANES)), np.zeros((6, 6, _LANES)), np.zeros((6, 6, _LANES))
    by_one, by_other = np.empty((6, 6, _LANES)), np.empty((6, 6, _LANES))
    for start in range(0, count, _LANES):
        size = min(_LANES, count - start)
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
