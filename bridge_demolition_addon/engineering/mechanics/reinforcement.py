"""Forces of ductile bars: what reinforcement carries across a crack until it is torn out or apart.

A bar is rigid and plastic. It keeps its two points from parting as long as its yield force suffices, yields under a
constant force where it does not, and never pushes. Its force is found step by step, as a controller would: a part that
answers the speed at which the points part, and a part that grows until that speed is gone and then holds the load.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..geometry.vectors import dot, length, unit

_ANSWER = 0.5
_GROWTH = 0.5
"""Parts of the impulse that would stop the parting at once. With these the error shrinks to 0.71 of itself in a step:
the roots of r² - (2 - growth - answer) r + (1 - answer) = 0 have that magnitude."""

_SMALLEST_GAP_M = 1e-9
"""Points that are nearer than this have no direction yet in which they part; their relative velocity gives it."""


@dataclass(frozen=True, slots=True, eq=False)
class FaceBars:
    """Layers of bars across the faces of m connections, each face's put together."""

    yield_n: FloatArray  # (m,), force at which all bars across a face yield; 0 where there are none
    offsets_m: FloatArray  # (m, 2), where it acts, from the connection's point along the section's y and z
    directions: FloatArray  # (m, 3), of it, along the section's axes; the first is not below 0
    openings_m: FloatArray  # (m,), opening along it at which they rupture

    def with_even(self, even_n: FloatArray, opening_m: float) -> FaceBars:
        """Return them together with bars (m,) that are spread evenly over the faces, and pull across these.

        Those rupture at an opening of their own.
        """
        forces = self.yield_n[:, None] * self.directions
        forces[:, 0] += even_n
        whole, parts = length(forces), self.yield_n + even_n
        share = np.divide(self.yield_n, parts, out=np.zeros_like(parts), where=parts > 0.0)
        along = np.zeros_like(forces)
        along[:, 0] = 1.0
        return FaceBars(
            whole,
            share[:, None] * self.offsets_m,
            np.divide(forces, whole[:, None], out=along, where=whole[:, None] > 0.0),
            share * self.openings_m + (1.0 - share) * opening_m,
        )

    @classmethod
    def none(cls, count: int) -> FaceBars:
        """Return no bars across m faces."""
        along = np.zeros((count, 3))
        along[:, 0] = 1.0
        return cls(np.zeros(count), np.zeros((count, 2)), along, np.zeros(count))


def parting(
    first_points: FloatArray, second_points: FloatArray, first_velocities: FloatArray, second_velocities: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return how far (t,), m, how fast (t,), m/s, and in which direction (t, 3) the two points of each bar part.

    Points, m, and velocities, m/s, (t, 3) are of the positions on both bodies that were one before the crack. The
    directions are unit vectors from the first point to the second.
    """
    gaps, speeds = second_points - first_points, second_velocities - first_velocities
    distances = length(gaps)
    directions = unit(np.where((distances > _SMALLEST_GAP_M)[:, None], gaps, speeds))
    return distances, dot(speeds, directions), directions


def effective_masses(masses_kg: FloatArray, pairs: IntArray) -> FloatArray:
    """Mass (t,) that each bar between a pair (t, 2) of bodies (n,) may take to be its own, kg.

    1/m = 1/m₁ + 1/m₂. A body of mass 0 does not move. The mass is shared out among all bars of a body, which would
    otherwise stop it several times over.
    """
    counts = np.bincount(pairs.ravel(), minlength=len(masses_kg))[pairs].max(axis=1)
    inverse = np.divide(1.0, masses_kg, out=np.zeros(len(masses_kg)), where=masses_kg > 0.0)[pairs].sum(axis=1)
    return np.divide(1.0, inverse * counts, out=np.zeros(len(pairs)), where=inverse > 0.0)


def bar_forces(
    held_n: FloatArray, speeds_m_s: FloatArray, masses_kg: FloatArray, yield_forces_n: FloatArray, substep_s: float
) -> tuple[FloatArray, FloatArray]:
    """Tension (t,) of each bar in the coming sub-step, and the part of it that it holds on with.

    That part was `held_n` before. Speeds are those at which a bar's points part, masses those that it may take for its
    own (`effective_masses`).
    """
    stopping = masses_kg * speeds_m_s / substep_s
    held = np.clip(held_n + _GROWTH * stopping, 0.0, yield_forces_n)
    return np.clip(held + _ANSWER * stopping, 0.0, yield_forces_n), held
