"""Cables, and slings from a part to the hook of a crane: what each carries, and how the part turns until it hangs.

Slings are straight, only pull, and stretch. All of them end in one point, the hook, so their forces have no moment
about it: a part hangs at rest with its centre of gravity below the hook. Two slings carry what the lever rule says,
three what equilibrium says, and more than three share it by their stiffness.

Cables that are reeled in are elastic too, without weight, and without force where they are slack. A winch takes in free
length L₀; the cable of stiffness EA between two points at a distance L pulls by EA (L - L₀) / L₀. Where that would be
more than the winch holds, it pays out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arithmetic import arctangent, cosine
from ..arrays import FloatArray
from ..geometry.vectors import cross, dot, length, unit

_SOFT = 1e-10
"""Stiffness, as a share of the whole, that stands for that of directions in which no sling pulls."""

_LINE = 1e-6
"""Distance from a line, as a share of its length, up to which points lie on it."""


@dataclass(frozen=True, slots=True, eq=False)
class Hanging:
    """A part that hangs at rest.

    Attributes
    ----------
    forces_n : (k,) float
        Force of each sling, N; 0 for one that is slack.
    tilt_rad : float
        Angle by which the part has turned out of the position in which it was built.
    """

    forces_n: FloatArray
    tilt_rad: float


def sling_forces_n(points_m: FloatArray, hook_m: FloatArray, force_n: FloatArray, stiffness_n: float) -> FloatArray:
    """Return the forces (k,) of slings that carry a force (3,) at the hook together, N.

    `points_m` (k, 3) are where they hold, `stiffness_n` is EA of each. Slings that would press are slack.
    """
    towards = hook_m - points_m
    lengths, directions = length(towards), unit(towards)
    taut = np.ones(len(points_m), bool)
    forces = np.zeros(len(points_m))
    while taut.any():
        springs = np.where(taut, stiffness_n / lengths, 0.0)
        forces = springs * dot(directions, np.tile(_moved(springs, directions, force_n), (len(points_m), 1)))
        presses = taut & (forces < 0.0)
        if not presses.any():
            break
        taut &= ~presses
    return np.where(taut, forces, 0.0)


def hanging(
    points_m: FloatArray, hook_m: FloatArray, centre_m: FloatArray, weight_n: float, stiffness_n: float
) -> Hanging:
    """Return how a part hangs by slings from points (k, 3) on it to a hook (3,), with its centre of gravity (3,)."""
    line = points_m[int(np.argmax(length(points_m - points_m[0])))] - points_m[0]
    size = float(length(line))
    if size == 0.0:
        return Hanging(np.full(len(points_m), weight_n / len(points_m)), _from_down(centre_m - points_m[0]))
    axis = line / size
    beside = _across(points_m - points_m[0], axis)
    if float(length(beside).max()) > _LINE * size:
        forces = sling_forces_n(points_m, hook_m, weight_n * unit(hook_m - centre_m), stiffness_n)
        return Hanging(forces, _from_down(centre_m - hook_m))
    return _on_a_line(points_m, hook_m, centre_m, axis, weight_n, stiffness_n)


def _on_a_line(
    points_m: FloatArray,
    hook_m: FloatArray,
    centre_m: FloatArray,
    axis: FloatArray,
    weight_n: float,
    stiffness_n: float,
) -> Hanging:
    """Return how a part hangs whose slings hold it along a line: it also swings about that line."""
    (of_hook, of_centre) = (_across((place - points_m[0])[None], axis)[0] for place in (hook_m, centre_m))
    along_m = float(dot(hook_m - centre_m, axis))
    depth_m = float(length(of_hook)) + float(length(of_centre))
    force = weight_n * unit(along_m * axis + depth_m * unit(of_hook))
    sideways = _angle(of_centre, _across(np.array([[0.0, 0.0, -1.0]]), axis)[0])
    lengthways = float(arctangent(abs(along_m), depth_m))
    return Hanging(sling_forces_n(points_m, hook_m, force, stiffness_n), _together(lengthways, sideways))


def _moved(springs: FloatArray, directions: FloatArray, force_n: FloatArray) -> FloatArray:
    """Return how far (3,) a force moves the hook against springs (k,) along directions (k, 3)."""
    matrix = [
        [math.fsum((springs * directions[:, row] * directions[:, column]).tolist()) for column in range(3)]
        for row in range(3)
    ]
    soft = _SOFT * math.fsum(springs.tolist())
    rows = np.array([[matrix[row][column] + soft * (row == column) for column in range(3)] for row in range(3)])
    cofactors = np.array([cross(rows[[one]], rows[[other]])[0] for one, other in ((1, 2), (2, 0), (0, 1))])
    determinant = float(dot(rows[0], cofactors[0]))
    return np.array([float(dot(cofactors[:, row], force_n)) for row in range(3)]) / determinant


def _across(vectors: FloatArray, axis: FloatArray) -> FloatArray:
    """Return the parts of vectors (k, 3) across an axis (3,) of length 1."""
    return vectors - dot(vectors, np.tile(axis, (len(vectors), 1)))[:, None] * axis


def _from_down(vector: FloatArray) -> float:
    return _angle(vector, np.array([0.0, 0.0, -1.0]))


def _angle(one: FloatArray, other: FloatArray) -> float:
    """Return the angle between two vectors (3,), rad; 0 where one has no length."""
    return float(arctangent(length(cross(one[None], other[None]))[0], dot(one, other)))


def _together(one: float, other: float) -> float:
    """Return the angle between the vertical and what was vertical, after turns about two level axes that are square."""
    upright = float(cosine(one)) * float(cosine(other))
    return float(arctangent(math.sqrt(max(1.0 - upright * upright, 0.0)), upright))


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
