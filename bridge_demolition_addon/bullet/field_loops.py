"""Copies between arrays and structures as loops, which Numba compiles: import this only where it is installed.

A loop over structures finds all fields of one in the same lines of the cache; numpy goes through all structures for
each field.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..engineering.compilation import compiled


@compiled
def copied(values: Any, starts: Any, offsets: Any) -> Any:
    """Return values (c, n) at offsets (c,) from starts (n,)."""
    found = np.empty((len(offsets), len(starts)), values.dtype)
    for structure in range(len(starts)):
        for field in range(len(offsets)):
            found[field, structure] = values[starts[structure] + offsets[field]]
    return found


@compiled
def of_connections(
    values: Any, flags: Any, impulses: Any, enabled: Any, exists: Any, cracked: Any, feedback: Any, sides: Any
) -> tuple[Any, Any, Any]:
    """Loads (6, k), impulses (m,) and whether each is intact (m,), as `SnapshotTaker.take` has them.

    Impulses, and the flags of what is enabled, are given by `Fields.places`.
    """
    (starts, of_impulse), (places, of_flag) = impulses, enabled
    loads, applied, intact = np.empty((6, len(sides))), np.zeros(len(starts)), np.zeros(len(starts), np.bool_)
    for row in range(len(sides)):
        start = 8 * sides[row]
        for axis in range(3):
            loads[axis, row], loads[3 + axis, row] = feedback[start + axis], feedback[start + 4 + axis]
    for row in range(len(starts)):
        if exists[row]:
            applied[row] = values[starts[row] + of_impulse[0]]
            intact[row] = flags[places[row] + of_flag[0]] != 0 and not cracked[row]
    return loads, applied, intact


@compiled
def intact(flags: Any, enabled: Any, exists: Any, cracked: Any) -> Any:
    """`ConstraintTable.intact`; the flags of what is enabled are given by `Fields.places`."""
    (places, of_flag), found = enabled, np.zeros(len(exists), np.bool_)
    for row in range(len(exists)):
        found[row] = exists[row] and flags[places[row] + of_flag[0]] != 0 and not cracked[row]
    return found


@compiled
def loaded_points(
    values: Any,
    pointers: Any,
    integers: Any,
    counts: Any,
    impulses: Any,
    vectors: Any,
    bodies: Any,
    size: int,
    most: int,
) -> tuple[Any, Any, bool]:
    """`ContactReader.copy`: components (15, k) of points with an impulse, and pointers (2, k) to their bodies.

    The points of a contact lie `size` values after each other. Their counts, impulses, vectors and bodies are given by
    `Fields.places`. Also returns whether each contact has 0 to `most` points; where not, nothing is copied.
    """
    (numbers, of_count), (starts, of_impulses), (_, of_vectors), (owners, of_bodies) = counts, impulses, vectors, bodies
    found, are_few = 0, True
    for contact in range(len(starts)):
        count = integers[numbers[contact] + of_count[0]]
        are_few = are_few and 0 <= count <= most
        for point in range(count if are_few else 0):
            found += _is_loaded(values, starts[contact] + point * size, of_impulses)
    found = found if are_few else 0
    components, pairs, row = np.empty((15, found)), np.empty((2, found), pointers.dtype), 0
    for contact in range(len(starts) if found else 0):
        for point in range(integers[numbers[contact] + of_count[0]]):
            start = starts[contact] + point * size
            if _is_loaded(values, start, of_impulses):
                for field in range(6):
                    components[field, row] = values[start + of_vectors[field]]
                    components[9 + field, row] = values[start + of_vectors[6 + field]]
                for field in range(3):
                    components[6 + field, row] = values[start + of_impulses[field]]
                for field in range(2):
                    pairs[field, row] = pointers[owners[contact] + of_bodies[field]]
                row += 1
    return components, pairs, are_few


@compiled
def _is_loaded(values: Any, start: int, impulses: Any) -> bool:
    """Whether a contact point carries anything: iterations can end with friction where no normal impulse is left."""
    first, second, third = values[start + impulses[0]], values[start + impulses[1]], values[start + impulses[2]]
    return first != 0.0 or second != 0.0 or third != 0.0


@compiled
def write(values: Any, starts: Any, offsets: Any, written: Any) -> None:
    """Write values (c, n) to offsets (c,) from starts (n,)."""
    for structure in range(len(starts)):
        for field in range(len(offsets)):
            values[starts[structure] + offsets[field]] = written[field, structure]


@compiled
def push(
    values: Any, starts: Any, offsets: Any, loads: Any, inverse_masses: Any, impulses: Any, substep_s: float
) -> None:
    """`BodyMotionReader.push`: write loads (6, n) with those of impulses (6, n) to bodies that have any and move."""
    for body in range(len(starts)):
        is_pushed = False
        for axis in range(6):
            is_pushed = is_pushed or impulses[axis, body] != 0.0
        if is_pushed and inverse_masses[body] > 0.0:
            for axis in range(6):
                values[starts[body] + offsets[axis]] = loads[axis, body] + impulses[axis, body] / substep_s


@compiled
def write_limits(
    values: Any, starts: Any, lower: Any, upper: Any, rows: Any, held: Any, resists: Any, limits: Any, signs: Any
) -> None:
    """Write limits (c, r) of rows (r,) where they are held, both alike; those of what does not resist leave it free."""
    for number in range(len(rows)):
        row = rows[number]
        for field in range(len(lower)):
            if held[field, row]:
                limit, rests = limits[field, number] * signs[field], resists[field, row]
                values[starts[row] + lower[field]] = limit if rests else 1.0
                values[starts[row] + upper[field]] = limit if rests else -1.0


@compiled
def are_inertias(tensors: Any, symmetric: float) -> bool:
    """Return whether tensors (3, 3, n) are finite, `symmetric` by a part of the largest number, and not negative."""
    for body in range(tensors.shape[2]):
        largest, difference = 0.0, 0.0
        for axis in range(3):
            if not tensors[axis, axis, body] >= 0.0:
                return False
            for other in range(3):
                size = abs(tensors[axis, other, body])
                if not size < np.inf:
                    return False
                largest = max(largest, size)
                difference = max(difference, abs(tensors[axis, other, body] - tensors[other, axis, body]))
        if not difference <= symmetric * largest:
            return False
    return True


@compiled
def turn_by_torques(
    values: Any,
    integers: Any,
    inertias: Any,
    torques: Any,
    velocities: Any,
    states: Any,
    sleeping: Any,
    times: Any,
    symmetric: float,
) -> bool:
    """`BodyMotionReader.turn_by_torques`; inertias, torques, velocities and states are given by `Fields.places`.

    Returns whether inertias are as expected; where not, and some body would turn, nothing is written.
    """
    (starts, of_inertia), (_, of_torque), (_, of_velocity), (places, of_state) = inertias, torques, velocities, states
    rows, count = np.empty(len(starts), np.int64), 0
    for body in range(len(starts)):
        start, state = starts[body], integers[places[body] + of_state[0]]
        x, y, z = values[start + of_torque[0]], values[start + of_torque[1]], values[start + of_torque[2]]
        is_awake = state != sleeping[0] and state != sleeping[1]
        if (x != 0.0 or y != 0.0 or z != 0.0) and is_awake and np.isfinite(times[body]):
            rows[count] = body
            count += 1
    if count and not are_inertias(copied(values, starts, of_inertia).reshape(3, 3, len(starts)), symmetric):
        return False
    for body in rows[:count]:
        start = starts[body]
        x, y, z = values[start + of_torque[0]], values[start + of_torque[1]], values[start + of_torque[2]]
        for axis in range(3):
            of_row = start + of_inertia[3 * axis], start + of_inertia[3 * axis + 1], start + of_inertia[3 * axis + 2]
            change = values[of_row[0]] * x + values[of_row[1]] * y + values[of_row[2]] * z
            values[start + of_velocity[axis]] = values[start + of_velocity[axis]] + times[body] * change
        for axis in range(3):
            values[start + of_torque[axis]] = 0.0
    return True
