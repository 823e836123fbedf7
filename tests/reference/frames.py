# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads and work of a frame by numpy: what the compiled core adds up over connections, contacts and bodies."""

from __future__ import annotations

import itertools

import numpy as np

from bridge_demolition_addon.engineering.geometry.vectors import cross_by_component, length
from bridge_demolition_addon.engineering.mechanics.frame_loads import SubstepLoads
from bridge_demolition_addon.engineering.mechanics.stress import PairSums
from bridge_demolition_addon.engineering.mechanics.work import PairImpulses

_NO_PAIR = np.iinfo(np.int64).max


def of_connections(
    pairs: np.ndarray, loads: SubstepLoads, bodies: int, impulses: np.ndarray, peaks: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return resultants (s, n, 3), sums of sizes and of signed numbers (s, n); add to impulses (6, m), follow peaks."""
    forces, moments = loads.connection_forces_n, loads.connection_moments_nm
    sizes, of_all = length(forces), (loads.connection_impulses_ns, loads.connection_angular_impulses_nms)
    for substep in range(len(sizes)):
        higher = sizes[substep] > peaks[0]
        for vectors, largest in ((forces, peaks[1:4]), (moments, peaks[4:])):
            np.copyto(largest, vectors[substep].T, where=higher)
        np.maximum(peaks[0], sizes[substep], out=peaks[0])
        for half, of_kind in zip((impulses[:3], impulses[3:]), of_all, strict=True):
            half += of_kind[substep].T
    sums = PairSums(pairs, None, (len(sizes), bodies))
    return sums.resultants(forces), sums.sums(sizes), sums.differences(loads.signed_2019_ns)


def average_stress(
    pairs: np.ndarray,
    forces: np.ndarray,
    points: np.ndarray,
    centres: np.ndarray,
    volumes: np.ndarray,
    moments: np.ndarray | None = None,
    normals: np.ndarray | None = None,
) -> np.ndarray:
    """Return the average stress (n, 3, 3) of bodies, 0 without a volume."""
    bodies = pairs.T.ravel()

    def averaged(first: np.ndarray, second: np.ndarray) -> np.ndarray:
        sums = np.empty((len(volumes), 3, 3))
        for row, column in np.ndindex(3, 3):
            sums[:, row, column] = np.bincount(bodies, first[:, row] * second[:, column], len(volumes))
        solid = np.where(volumes > 0.0, volumes, np.nan)
        stresses = (sums + sums.transpose(0, 2, 1)) / (2.0 * solid[:, None, None])
        return np.where(volumes[:, None, None] > 0.0, stresses, 0.0)

    both, twice = np.concatenate((forces, -forces)), np.concatenate((points, points))
    stresses = averaged(both, twice - centres[bodies])
    if moments is not None and normals is not None:
        faces, turns = np.concatenate((normals, -normals)), np.concatenate((moments, -moments))
        stresses = stresses + averaged(faces, cross_by_component(faces, turns))
    return stresses


def works(
    between: PairImpulses, motion: np.ndarray, first: np.ndarray, second: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the works (k,) of impulses with the motion (6, n) of first and of second bodies."""
    found = []
    for bodies in (first, second):
        loads, moved = between.components(), motion.take(bodies, axis=1)
        total = loads[0] * moved[0]
        for load, by in zip(loads[1:], moved[1:], strict=True):
            total = total + load * by
        found.append(total)
    return found[0], found[1]


def shared(
    total: np.ndarray,
    returned_j: np.ndarray,
    on_first: np.ndarray,
    on_second: np.ndarray,
    first: np.ndarray,
    second: np.ndarray,
    is_free: np.ndarray,
) -> tuple[np.ndarray, ...]:
    """Return works taken (k,), pairs that make energy (r,), what they make (r,), and bodies that get it, two (n,)."""
    first_free, second_free = is_free[first], is_free[second]
    total = np.where(first_free | second_free, total, 0.0)
    taken = np.minimum(total, 0.0)
    if len(returned_j):
        total, taken = total - returned_j, taken + returned_j
    rows = np.flatnonzero(total > 0.0)
    gains = [
        np.maximum(gain[rows], 0.0) * are_free[rows]
        for gain, are_free in ((on_first, first_free), (-on_second, second_free))
    ]
    both, made = gains[0] + gains[1], total[rows]
    share = np.divide(made, both, out=np.zeros_like(both), where=both > 0.0)
    by_body = [
        np.bincount(bodies[rows], share * gain, len(is_free))
        for bodies, gain in zip((first, second), gains, strict=True)
    ]
    return taken, rows, made, *by_body


class ReferenceTouches:
    """Accounts of the energy that pairs of bodies have taken since they touched, as `Touches` keeps them."""

    def __init__(self, apart: int):
        self._apart, self._substep = apart, 0
        self._pairs, self._taken_j, self._last = np.array([_NO_PAIR]), np.zeros(1), np.zeros(1, int)

    def pass_over(self, substeps: int) -> None:
        """Let sub-steps go by in which no pair does work."""
        self._substep += substeps

    def returned_energies(self, pairs: np.ndarray, work_j: np.ndarray, ends: np.ndarray) -> np.ndarray:
        """Return how much of the work (k,) is given back of what was taken before."""
        returned_j = np.zeros_like(work_j)
        for start, end in itertools.pairwise(ends.tolist()):
            working = start + np.flatnonzero(work_j[start:end])
            if len(working):
                order = working[np.argsort(pairs[working], kind="stable")]
                returned_j[order] = self._book(pairs[order], work_j[order])
            self._substep += 1
        return returned_j

    def _book(self, pairs: np.ndarray, work_j: np.ndarray) -> np.ndarray:
        """Book the work of pairs (k,), in ascending order, in one sub-step; return what they give back."""
        touch = self._last >= self._substep - self._apart
        rows = np.searchsorted(self._pairs, pairs)
        had_j = np.where((self._pairs[rows] == pairs) & touch[rows], self._taken_j[rows], 0.0)
        touch[rows[self._pairs[rows] == pairs]] = False
        touch[-1] = True
        all_pairs = np.concatenate((pairs, self._pairs[touch]))
        order = np.argsort(all_pairs, kind="stable")
        self._pairs = all_pairs[order]
        self._taken_j = np.concatenate((np.maximum(had_j - work_j, 0.0), self._taken_j[touch]))[order]
        self._last = np.concatenate((np.full(len(pairs), self._substep), self._last[touch]))[order]
        return np.clip(work_j, 0.0, had_j)
