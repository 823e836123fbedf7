"""Loads and work of sub-steps as loops, which Numba compiles: import this only where it is installed.

They give the same bits as `frame_loads`, `stress` and `work`, as the loops of cracks do: see `elasticity.crack_loops`.
Components come first.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from ..geometry.vector_loops import crossed


@compiled
def of_connections(
    pairs: Any, bodies: int, forces: Any, moments: Any, signed: Any, substeps_s: Any, impulses: Any, peaks: Any
) -> tuple[Any, Any, Any]:
    """Resultants (3, s, n), sums (s, n) and differences (s, n) on bodies, by loads (3, s, m) and numbers (s, m).

    Adds to impulses (6, m) of forces and moments, and follows the peaks (7, m): the size of the largest force, this
    force, and the moment with it.
    """
    substeps, count = signed.shape
    firsts, seconds = np.zeros((5, substeps, bodies)), np.zeros((5, substeps, bodies))
    for step in range(substeps):
        for row in range(count):
            x, y, z = forces[0, step, row], forces[1, step, row], forces[2, step, row]
            size = np.sqrt(x * x + y * y + z * z)
            for sums, body in ((firsts, pairs[row, 0]), (seconds, pairs[row, 1])):
                for axis in range(3):
                    sums[axis, step, body] += forces[axis, step, row]
                sums[3, step, body] += size
                sums[4, step, body] += signed[step, row]
            is_higher = size > peaks[0, row]
            if is_higher or np.isnan(size):
                peaks[0, row] = size
            for axis in range(3):
                impulses[axis, row] += substeps_s[step] * forces[axis, step, row]
                impulses[3 + axis, row] += substeps_s[step] * moments[axis, step, row]
                if is_higher:
                    peaks[1 + axis, row], peaks[4 + axis, row] = forces[axis, step, row], moments[axis, step, row]
    return firsts[:3] - seconds[:3], firsts[3] + seconds[3], firsts[4] - seconds[4]


@compiled
def products_on_bodies(bodies: Any, first: Any, second: Any, count: int) -> Any:
    """Sums (n, 3, 3) over bodies (k,) of the products of components of vectors (3, k)."""
    sums = np.zeros((count, 3, 3))
    for row in range(len(bodies)):
        for line in range(3):
            for column in range(3):
                sums[bodies[row], line, column] += first[line, row] * second[column, row]
    return sums


@compiled
def stresses_of_connections(
    pairs: Any, forces: Any, moments: Any, normals: Any, points: Any, centres: Any, volumes: Any
) -> Any:
    """Average stresses (n, 3, 3) of bodies, 0 without a volume, under forces and moments (m, 3) of connections.

    `stress.average_stress` and `stress.average_stress_of_moments`, of all first bodies and then of all second ones.
    """
    of_forces, of_moments = np.zeros((len(volumes), 3, 3)), np.zeros((len(volumes), 3, 3))
    for side in range(2):
        sign = 1.0 - 2.0 * side
        for row in range(len(pairs)):
            body = pairs[row, side]
            force = sign * forces[row, 0], sign * forces[row, 1], sign * forces[row, 2]
            normal = sign * normals[row, 0], sign * normals[row, 1], sign * normals[row, 2]
            moment = sign * moments[row, 0], sign * moments[row, 1], sign * moments[row, 2]
            lever = (
                points[row, 0] - centres[body, 0],
                points[row, 1] - centres[body, 1],
                points[row, 2] - centres[body, 2],
            )
            spread = crossed(normal, moment)
            for line in range(3):
                for column in range(3):
                    of_forces[body, line, column] += force[line] * lever[column]
                    of_moments[body, line, column] += normal[line] * spread[column]
    stresses = np.zeros((len(volumes), 3, 3))
    for body in range(len(volumes)):
        if volumes[body] > 0.0:
            twice = 2.0 * volumes[body]
            for line in range(3):
                for column in range(3):
                    by_forces = (of_forces[body, line, column] + of_forces[body, column, line]) / twice
                    by_moments = (of_moments[body, line, column] + of_moments[body, column, line]) / twice
                    stresses[body, line, column] = by_forces + by_moments
    return stresses


@compiled
def works(first: Any, second: Any, impulses: Any, points: Any, angular: Any, motion: Any) -> tuple[Any, Any]:
    """Works (k,) of impulses (3, k) on first and second bodies, with motion (6, n); angular ones may be (3, 0)."""
    on_first, on_second = np.empty(len(first)), np.empty(len(first))
    for row in range(len(first)):
        push = impulses[0, row], impulses[1, row], impulses[2, row]
        x, y, z = crossed((points[0, row], points[1, row], points[2, row]), push)
        if angular.shape[1]:
            x, y, z = x + angular[0, row], y + angular[1, row], z + angular[2, row]
        on_first[row] = _work(push, (x, y, z), motion, first[row])
        on_second[row] = _work(push, (x, y, z), motion, second[row])
    return on_first, on_second


@compiled
def _work(push: Any, turn: Any, motion: Any, body: int) -> Any:
    """Work on a body."""
    work = push[0] * motion[0, body] + push[1] * motion[1, body] + push[2] * motion[2, body]
    return work + turn[0] * motion[3, body] + turn[1] * motion[4, body] + turn[2] * motion[5, body]


@compiled
def shared(
    total: Any, returned: Any, on_first: Any, on_second: Any, first: Any, second: Any, is_free: Any
) -> tuple[Any, Any, Any, Any, Any]:
    """`work._shared`: works taken (k,), pairs that make energy (r,), what they make (r,), and bodies that get it."""
    taken, rows, made, count = np.empty(len(total)), np.empty(len(total), np.int64), np.empty(len(total)), 0
    by_first, by_second = np.zeros(len(is_free)), np.zeros(len(is_free))
    for row in range(len(total)):
        one, other = first[row], second[row]
        work = total[row] if is_free[one] or is_free[other] else 0.0
        lost = np.minimum(work, 0.0)
        if len(returned):
            work, lost = work - returned[row], lost + returned[row]
        taken[row] = lost
        if work > 0.0:
            gains = np.maximum(on_first[row], 0.0) * is_free[one], np.maximum(-on_second[row], 0.0) * is_free[other]
            both = gains[0] + gains[1]
            share = work / both if both > 0.0 else 0.0
            by_first[one] += share * gains[0]
            by_second[other] += share * gains[1]
            rows[count], made[count] = row, work
            count += 1
    return taken, rows[:count].copy(), made[:count].copy(), by_first, by_second
