"""Energy of a run: potential, of motion and of rotation, and what is lost of their sum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import dot, transformed_back
from ...engineering.units import STANDARD_GRAVITY_M_S2
from .arrays import Results
from .frames import Frame

_SPHERE = 0.4
"""Moment of inertia of a solid sphere by mass and radius squared."""


@dataclass(frozen=True, eq=False, slots=True)
class Energy:
    """Energies of all bodies that can move, over k recorded steps, (k,) J.

    `potential_j` is above that of the lowest of all steps, so that it is never negative.
    """

    times_s: np.ndarray
    potential_j: np.ndarray
    translation_j: np.ndarray
    rotation_j: np.ndarray

    @property
    def kinetic_j(self) -> np.ndarray:
        return self.translation_j + self.rotation_j

    @property
    def dissipated_j(self) -> np.ndarray:
        """Return the energy lost since the first step, (k,): into impacts, friction, damping and breaking.

        Negative where something else than gravity does work, such as charges, a prescribed motion, or the solver.
        """
        total = self.potential_j + self.kinetic_j
        return total[0] - total


def energy_of(results: Results, gravity_m_s2: float = STANDARD_GRAVITY_M_S2) -> Energy:
    """Return the energies of the bodies that can move, rotation by the `moments_of_inertia` of the simulation."""
    masses, frames = results.inventory.masses_kg, results.frames
    potentials = (gravity_m_s2 * frames.positions_m[:, :, 2] * masses).sum(axis=1)
    angular_velocities_rad_s = transformed_back(frames.rotations, frames.angular_velocities_rad_s)
    return Energy(
        times_s=frames.time_s,
        potential_j=potentials - potentials.min(),
        translation_j=0.5 * (dot(frames.velocities_m_s, frames.velocities_m_s) * masses).sum(axis=1),
        rotation_j=0.5 * (np.square(angular_velocities_rad_s) * moments_of_inertia(results)).sum(axis=(1, 2)),
    )


def kinetic_energies(frame: Frame, masses_kg: np.ndarray, moments_kg_m2: np.ndarray) -> np.ndarray:
    """Return the kinetic energy (n,) of each body in a frame, J, with what `moments_of_inertia` gives."""
    angular_velocities_rad_s = transformed_back(frame.rotations, frame.angular_velocities_rad_s)
    translation = dot(frame.velocities_m_s, frame.velocities_m_s) * masses_kg
    return 0.5 * (translation + (np.square(angular_velocities_rad_s) * moments_kg_m2).sum(axis=1))


def moments_of_inertia(results: Results) -> np.ndarray:
    """Return the moments of inertia (n, 3) about each body's own axes as Bullet uses them, kg·m².

    A ball is a sphere. Bullet takes a convex hull for the box around it, in the body's own axes: for a shard up to
    twice what its true shape has.
    """
    inventory, masses = results.inventory, results.inventory.masses_kg
    moments = np.zeros((len(masses), 3))
    bodies = np.flatnonzero((masses > 0.0) & (inventory.vertex_counts > 0))
    if not len(bodies):
        return moments
    own = inventory.vertices_by_body()
    squares = np.square([np.ptp(own[body], axis=0) for body in bodies])
    moments[bodies] = masses[bodies, None] * (squares.sum(axis=1, keepdims=True) - squares) / 12.0
    balls = inventory.body_kinds[bodies] == "ball"
    moments[bodies[balls]] = (_SPHERE * masses[bodies[balls]] * squares[balls].max(axis=1) / 4.0)[:, None]
    return moments
