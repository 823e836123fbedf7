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
    """Layers of bars across the faces of m connections, each face's put together.

    Attributes
    ----------
    yield_n : (m,) float
        Force at which all bars across a face yield; 0 where there are none.
    offsets_m : (m, 2) float
        Where that force acts, from the point of the connection along the section's y and z.
    """

    yield_n: FloatArray
    offsets_m: FloatArray

    def with_even(self, even_n: FloatArray) -> FaceBars:
        """Return them together with bars (m,) that are spread evenly over the faces."""
        whole = self.yield_n + even_n
        share = np.divide(self.yield_n, whole, out=np.zeros_like(whole), where=whole > 0.0)
        return FaceBars(whole, share[:, None] * self.offsets_m)


def parting(
    first_points: FloatArray, second_points: FloatArray, first_velocities: FloatArray, second_velocities: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """How far, how fast and in which direction the two points of each bar part.

    Parameters
    ----------
    first_points, second_points, first_velocities, second_velocities : (t, 3) float
        Places in m and velocities in m/s of the points on both bodies, which were one before the crack.

    Returns
    -------
    distances, rates : (t,) float
        In m and m/s.
    directions : (t, 3) float
        Unit vectors from the first point to the second.
    """
    gaps, speeds = second_points - first_points, second_velocities - first_velocities
    distances = length(gaps)
    directions = unit(np.where((distances > _SMALLEST_GAP_M)[:, None], gaps, speeds))
    return distances, dot(speeds, directions), directions


def effective_masses(masses_kg: FloatArray, pairs: IntArray, turning_kg: FloatArray | float = 0.0) -> FloatArray:
    """Mass (t,) that each bar between a pair (t, 2) of bodies (n,) may take to be its own, kg.

    1/m = 1/m₁ + 1/m₂, where a body of mass 0 does not move, and what is given, (t,) 1/kg, as a bar beside the middle of
    its bodies turns them. It is shared out among all bars of a body: bars that know nothing of each other would
    otherwise stop it several times over.
    """
    counts = np.bincount(pairs.ravel(), minlength=len(masses_kg))[pairs].max(axis=1)
    inverse = np.divide(1.0, masses_kg, out=np.zeros(len(masses_kg)), where=masses_kg > 0.0)[pairs].sum(axis=1)
    inverse = inverse + turning_kg
    return np.divide(1.0, inverse * counts, out=np.zeros(len(pairs)), where=inverse > 0.0)


def bar_forces(
    held_n: FloatArray, speeds_m_s: FloatArray, masses_kg: FloatArray, yield_forces_n: FloatArray, substep_s: float
) -> tuple[FloatArray, FloatArray]:
    """Tension of each bar in the coming sub-step, and the part of it that it holds on with.

    Parameters
    ----------
    held_n : (t,) float
        What it held on with before.
    speeds_m_s, masses_kg, yield_forces_n : (t,) float
        Rate at which its points part, the mass it may take for its own, and the force at which it yields.
    substep_s : float
        Length of the sub-step.
    """
    stopping = masses_kg * speeds_m_s / substep_s
    held = np.clip(held_n + _GROWTH * stopping, 0.0, yield_forces_n)
    return np.clip(held + _ANSWER * stopping, 0.0, yield_forces_n), held
