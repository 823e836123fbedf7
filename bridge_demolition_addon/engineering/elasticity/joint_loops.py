"""What elastic connections do in a sub-step, as loops that Numba compiles: import this only where it is installed.

The loops give the same bits as `joint_rows` and `joint_forces`, see `crack_loops`. All arrays have their components
first, and their names are those of the dataclasses that they come from.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled

LANES = 64
"""Connections in a group: processors work on several at once that are beside each other, and a group fits a cache."""


@compiled
def grouped(along: Any, first_turning: Any, second_turning: Any, turning: Any, stiffness: Any) -> Any:
    """Rows of connections, 9 numbers each, and stiffness in groups (g, 72, 64); the last group is filled up with 0."""
    count = along.shape[2]
    found = np.zeros(((count + LANES - 1) // LANES, 72, LANES))
    for group in range(len(found)):
        start, size = group * LANES, min(LANES, count - group * LANES)
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
    moving, room = np.ascontiguousarray(velocities.T), np.zeros((7, 6, LANES))
    rate, strain, amount, of_first, of_second = room[0], room[1], room[2], room[3], room[4]
    for group in range(len(joints)):
        start, size = group * LANES, min(LANES, count - group * LANES)
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
    moving, room = np.ascontiguousarray(changes.T), np.zeros((7, 6, LANES))
    rate, strain, amount, of_first, of_second = room[0], room[1], room[2], room[3], room[4]
    for group in range(len(joints)):
        start, size = group * LANES, min(LANES, count - group * LANES)
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
        for lane in range(LANES):
            x, y, z = one[0, lane] - other[0, lane], one[1, lane] - other[1, lane], one[2, lane] - other[2, lane]
            shifting[lane] = joints[at, lane] * x + joints[at + 1, lane] * y + joints[at + 2, lane] * z
        _add_products(joints, at + 9, one, shifting)
        _add_products(joints, at + 18, other, shifting)
        for lane in range(LANES):
            x, y, z = one[3, lane] - other[3, lane], one[4, lane] - other[4, lane], one[5, lane] - other[5, lane]
            turning[lane] = joints[at + 27, lane] * x + joints[at + 28, lane] * y + joints[at + 29, lane] * z


@compiled
def _add_products(joints: Any, at: int, velocities: Any, rates: Any) -> None:
    """Add what angular velocities, the last of velocities (6, 64), do in a row that begins at a number."""
    for lane in range(LANES):
        rates[lane] += (
            joints[at, lane] * velocities[3, lane]
            + joints[at + 1, lane] * velocities[4, lane]
            + joints[at + 2, lane] * velocities[5, lane]
        )


@compiled
def _stressed(joints: Any, at: int, strains: Any, amounts: Any) -> None:
    """One row of `equations.stressed` of a group, whose stiffness begins at a number."""
    for lane in range(LANES):
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
        for lane in range(LANES):
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
    for lane in range(LANES):
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
