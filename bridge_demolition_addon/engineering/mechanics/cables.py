"""Cables that are reeled in: elastic, without weight, and without force where they are slack.

A winch takes in free length L₀; the cable of stiffness EA between two points at a distance L pulls by EA (L - L₀) / L₀.
Where that would be more than the winch holds, it pays out.
"""

from __future__ import annotations

import math

ROPE_MODULUS_PA = 100e9
"""Modulus of elasticity of a rope by its metallic area, as usual of six strands about a core of steel, once it has been
loaded: 90 to 120 GPa (K. Feyrer, 2015, Wire Ropes, 2nd edition, section 2.2)."""

ROPE_FILL = 0.58
"""Metallic area by that of the circle around it, as usual of such ropes (ibid., section 1.6)."""


def rope_stiffness_n(diameter_m: float) -> float:
    """Return the stiffness EA of a usual wire rope of a diameter."""
    return ROPE_MODULUS_PA * ROPE_FILL * math.pi / 4.0 * diameter_m * diameter_m


def cable_force_n(stiffness_n: float, free_m: float, length_m: float) -> float:
    """Return the force of a cable that is stretched from its free length, 0 where it is slack."""
    return stiffness_n * max(length_m - free_m, 0.0) / free_m


def free_length_m(stiffness_n: float, force_n: float, length_m: float) -> float:
    """Return the free length with which a cable of a length has a force."""
    return length_m / (1.0 + force_n / stiffness_n)


def stored_j(stiffness_n: float, force_n: float, free_m: float) -> float:
    """Return the energy F² L₀ / 2 EA in a cable."""
    return 0.5 * force_n * force_n * free_m / stiffness_n


def force_of_step_n(
    stiffness_n: float,
    free_m: float,
    length_m: float,
    lengthens_m_s: float,
    before_n: float,
    step_s: float,
    mass_kg: float,
) -> float:
    """Return the force of a cable at the end of a short step, by an implicit step of the body of a mass that it pulls.

    F = k (Δ + v h) less what this force, in place of the one `before_n`, moves the body by in the step: stable however
    light the body is. At rest it is k Δ. The length grows by `lengthens_m_s`; `free_m` is that at the end of the step.
    """
    spring_n_m = stiffness_n / free_m
    stretched_m = length_m + lengthens_m_s * step_s - free_m
    share = spring_n_m * step_s * step_s / mass_kg
    return max((spring_n_m * stretched_m + share * before_n) / (1.0 + share), 0.0)
