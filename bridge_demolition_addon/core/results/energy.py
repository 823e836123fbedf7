"""Energy of a run: potential, of motion and of rotation, and what is lost of their sum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..units import STANDARD_GRAVITY_M_S2
from .arrays import Results

_SPHERE = 0.4
"""Moment of inertia of a solid sphere by mass and radius squared."""


@dataclass(frozen=True, eq=False, slots=True)
class Energy:
    """Energies of all bodies that can move, over k recorded steps, J.

    Attributes
    ----------
    times_s
        (k,) times.
    potential_j
        (k,) above the heights at the lowest of all steps, so that it is never negative.
    translation_j, rotation_j
        (k,) of the motion of centres of mass, and of rotation about them.
    """

    times_s: np.ndarray
    potential_j: np.ndarray
    translation_j: np.ndarray
    rotation_j: np.ndarray

    @property
    def kinetic_j(self) -> np.ndarray:
        """(k,) both parts of it."""
        return self.translation_j + self.rotation_j

    @property
    def dissipated_j(self) -> np.ndarray:
        """(k,) what is missing of the first step's energy: into impacts, friction, damping and breaking.

        Negative where something else than gravity does work, such as charges, a prescribed motion, or the solver
        itself as it presses bodies apart.
        """
        total = self.potential_j + self.kinetic_j
        return total[0] - total


def energy_of(results: Results, gravity_m_s2: float = STANDARD_GRAVITY_M_S2) -> Energy:
    """Energies of the bodies that can move.

    Those of rotation are reckoned with the moments of inertia that Bullet gives its bodies, so that they are the
    simulation's own; see `moments_of_inertia`.
    """
    masses = results.inventory.masses_kg
    potentials = gravity_m_s2 * results.frames.positions_m[:, :, 2] @ masses
    spins = np.einsum("knji,knj->kni", results.frames.rotations, results.frames.angular_velocities_rad_s)
    return Energy(
        times_s=results.frames.time_s,
        potential_j=potentials - potentials.min(),
        translation_j=0.5 * (results.frames.velocities_m_s**2).sum(axis=2) @ masses,
        rotation_j=0.5 * (spins**2 * moments_of_inertia(results)).sum(axis=(1, 2)),
    )


def moments_of_inertia(results: Results) -> np.ndarray:
    """Moments of inertia (n, 3) about each body's own axes as Bullet reckons with them, kg·m².

    A ball is a sphere. Bullet takes a convex hull for the box around it, in the body's own axes: for a shard up to
    twice what its true shape has.
    """
    moments = np.zeros((len(results.inventory.masses_kg), 3))
    for body in np.flatnonzero(results.inventory.masses_kg > 0.0):
        corners = results.inventory.vertices_of(body)
        if not len(corners):
            continue
        squares = np.ptp(corners, axis=0) ** 2
        if results.inventory.body_kinds[body] == "ball":
            moments[body] = _SPHERE * results.inventory.masses_kg[body] * squares.max() / 4.0
        else:
            moments[body] = results.inventory.masses_kg[body] * (squares.sum() - squares) / 12.0
    return moments
