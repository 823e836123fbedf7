# SPDX-License-Identifier: GPL-3.0-or-later
"""A sub-step of an elastic structure by numpy: one dense system of equations, and Newton's method with a line search.

It shares with the core what a sub-step is, and neither its order of elimination, its parts, nor its way from guess to
guess: the energy is convex, so that there is one solution.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from reference.terms import ReferenceTerm

from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames, joint_positions

_MOST_STEPS = 200


def velocities_after(
    frames: JointFrames,
    stiffness: np.ndarray,
    damping_s: float,
    bodies: RigidBodies,
    offsets: np.ndarray,
    positions_m: np.ndarray,
    rotations: np.ndarray,
    velocities: np.ndarray,
    acting: np.ndarray,
    terms: Sequence[ReferenceTerm],
    substep_s: float,
) -> np.ndarray:
    """Return velocities (6, n) at the end of a sub-step; those of bodies without mass stay."""
    count = len(bodies)
    own = bodies.mass_matrices(rotations, np.arange(count))
    masses = np.zeros((6 * count, 6 * count))
    for body in range(count):
        masses[6 * body : 6 * body + 6, 6 * body : 6 * body + 6] = own[..., body]
    free = np.repeat(bodies.moves, 6)
    start = velocities.T.ravel()
    chosen = frames.only(acting)
    places = joint_positions(chosen, positions_m, rotations)
    strains = places.deformations() - offsets[:, acting]
    rows = np.zeros((len(acting), 6, 6 * count))
    for number, (one, other) in enumerate(
        zip(*(np.moveaxis(ends, 2, 0) for ends in places.rows().matrices()), strict=True)
    ):
        first, second = chosen.first[number], chosen.second[number]
        rows[number, :, 6 * first : 6 * first + 6] += one
        rows[number, :, 6 * second : 6 * second + 6] += other
    k = np.moveaxis(stiffness[..., acting], 2, 0)
    implicit = substep_s * (substep_s + damping_s)
    levers = [term.levers(count) for term in terms]

    def unbalanced(ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Impulses that are missing, and how they change with the velocities."""
        wrong, slope = masses @ (ends - start), masses.copy()
        amounts = np.einsum("kij,kj->ki", k, substep_s * strains.T - implicit * (rows @ ends))
        wrong -= np.einsum("kij,ki->j", rows, amounts)
        slope += implicit * np.einsum("kia,kij,kjb->ab", rows, k, rows)
        for term, lever in zip(terms, levers, strict=True):
            forces, tangents = term.linear(substep_s * (lever @ ends).T)
            wrong += substep_s * np.einsum("qia,iq->a", lever, forces)
            slope += substep_s * substep_s * np.einsum("qia,ijq,qjb->ab", lever, tangents, lever)
        return wrong, slope

    ends = start.copy()
    wrong, slope = unbalanced(ends)
    scale = abs(masses @ start).max() + abs(wrong).max()
    for _ in range(_MOST_STEPS):
        if abs(wrong[free]).max() < 1e-11 * scale:
            break
        change = np.zeros_like(ends)
        change[free] = np.linalg.solve(slope[np.ix_(free, free)], -wrong[free])
        share = _share(lambda part, start=ends, change=change: unbalanced(start + part * change)[0] @ change)
        ends = ends + share * change
        wrong, slope = unbalanced(ends)
    return ends.reshape(count, 6).T


def _share(slope_at) -> float:
    """Return where a slope that grows from below 0 becomes 0, by halves; 1 where it does not."""
    low, high = 0.0, 1.0
    if slope_at(1.0) <= 0.0:
        return 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope_at(middle) < 0.0 else (low, middle)
    return high
