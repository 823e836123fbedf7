"""Deformations of connections and gaps, their rates by the motion of bodies, and how inertia resists impulses in them.

Each connection has six rows, as Bullet's own constraint between two frames: three shifts of the second frame against
the first, along the axes of the first, and three turns, the angles of Euler in the order x, y, z. Only with these rows
does Bullet know which relative motion to expect.

All arrays have their components first and the connections last, so that numpy works on long stretches of memory.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np

from ..arithmetic import arctangent
from ..arrays import FloatArray, IntArray


@dataclass(frozen=True, slots=True, eq=False)
class JointFrames:
    """Frames of m connections, fixed in their two bodies."""

    first: IntArray  # (m,), the first bodies
    second: IntArray
    first_axes: FloatArray  # (3, 3, m), axes of the frames as columns, in the axes of the body
    second_axes: FloatArray
    first_points_m: FloatArray  # (3, m), from the centre of the body to the frame, in the axes of the body
    second_points_m: FloatArray

    def __len__(self) -> int:
        return len(self.first)

    def only(self, rows: IntArray) -> JointFrames:
        """Return the frames of some connections (r,), in order; not copied where these are all."""
        if len(rows) == len(self):
            return self
        return JointFrames(*(getattr(self, item.name).take(rows, axis=-1) for item in fields(self)))


@dataclass(frozen=True, slots=True, eq=False)
class JointPositions:
    """Positions of the frames of m connections in the world."""

    first_axes: FloatArray  # (3, 3, m), axes of the frames as columns
    second_axes: FloatArray
    first_levers_m: FloatArray  # (3, m), from the centre of the body to the frame
    second_levers_m: FloatArray
    shifts_m: FloatArray  # (3, m), from the first frame to the second

    def only(self, rows: IntArray) -> JointPositions:
        """Return the positions of some connections (r,)."""
        return JointPositions(*(getattr(self, item.name).take(rows, axis=-1) for item in fields(self)))

    def deformations(self) -> FloatArray:
        """Return the shifts in m and turns in rad (6, m) of the second frames against the first."""
        one, other = self.first_axes, self.second_axes
        sines = np.stack(
            (
                -dot_products(one[:, 1], other[:, 2]),
                dot_products(one[:, 0], other[:, 2]),
                -dot_products(one[:, 0], other[:, 1]),
            )
        )
        upright = np.sqrt(np.maximum(1.0 - sines[1] * sines[1], 0.0))
        cosines = np.stack((dot_products(one[:, 2], other[:, 2]), upright, dot_products(one[:, 0], other[:, 0])))
        return np.concatenate((turned_back(one, self.shifts_m), arctangent(sines, cosines)))

    def rows(self) -> JointRows:
        """Return the rows at these positions."""
        first_z, second_x = self.first_axes[:, 2], self.second_axes[:, 0]
        y = cross_products(first_z, second_x)
        turning = np.stack([_unit(axis) for axis in (cross_products(y, first_z), y, cross_products(second_x, y))])
        along = transposed(self.first_axes)
        return JointRows(
            along,
            np.stack([cross_products(self.first_levers_m, axis) for axis in along]),
            np.stack([cross_products(axis, self.second_levers_m) for axis in along]),
            turning,
        )


@dataclass(frozen=True, slots=True, eq=False)
class JointRows:
    """Rates at which deformations of m connections shrink: velocities of the first bodies against the second.

    The first index of each array (3, 3, m) is the row.
    """

    along: FloatArray  # unit vectors along which velocities count
    first_turning: FloatArray  # share of the angular velocities of the first bodies in these rows
    second_turning: FloatArray
    turning: FloatArray  # unit vectors about which relative angular velocities count

    @classmethod
    def empty(cls, count: int) -> JointRows:
        """Return rows of `count` connections, all 0."""
        return cls(*(np.zeros((3, 3, count)) for _ in fields(cls)))

    def set(self, connections: IntArray, rows: JointRows) -> None:
        """Write the rows of some connections (r,)."""
        for item in fields(self):
            getattr(self, item.name)[..., connections] = getattr(rows, item.name)

    def only(self, connections: IntArray) -> JointRows:
        """Return the rows of some connections (r,), in order; not copied where these are all."""
        if len(connections) == self.along.shape[-1]:
            return self
        return JointRows(*(getattr(self, item.name).take(connections, axis=-1) for item in fields(self)))

    def rates(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return how fast deformations shrink (6, m), from velocities and angular velocities (6, m) of both bodies."""
        velocity, angular_velocity = first[:3] - second[:3], first[3:] - second[3:]
        shifting = turned(self.along, velocity)
        shifting += turned(self.first_turning, first[3:])
        shifting += turned(self.second_turning, second[3:])
        return np.concatenate((shifting, turned(self.turning, angular_velocity)))

    def loads(self, amounts: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return what amounts (6, m) in the rows do to the first and to the second bodies.

        Each result (6, m): forces, or impulses, then torques about the centres of the bodies.
        """
        force = turned_back(self.along, amounts[:3])
        torque = turned_back(self.turning, amounts[3:])
        first = turned_back(self.first_turning, amounts[:3]) + torque
        second = turned_back(self.second_turning, amounts[:3]) - torque
        return np.concatenate((force, first)), np.concatenate((-force, second))

    def matrices(self) -> tuple[FloatArray, FloatArray]:
        """Return the rows as matrices (6, 6, m) for the first and for the second bodies; the first index is the row."""
        zeros = np.zeros_like(self.along)
        first = np.concatenate((_beside(self.along, self.first_turning), _beside(zeros, self.turning)))
        second = np.concatenate((_beside(-self.along, self.second_turning), _beside(zeros, -self.turning)))
        return first, second


def joint_positions(frames: JointFrames, positions_m: FloatArray, rotations: FloatArray) -> JointPositions:
    """Return where the frames of m connections between n bodies are."""
    first, second = rotations.take(frames.first, axis=2), rotations.take(frames.second, axis=2)
    first_levers = turned(first, frames.first_points_m)
    second_levers = turned(second, frames.second_points_m)
    between = positions_m.take(frames.second, axis=1) - positions_m.take(frames.first, axis=1)
    return JointPositions(
        matrix_products(first, frames.first_axes),
        matrix_products(second, frames.second_axes),
        first_levers,
        second_levers,
        between + second_levers - first_levers,
    )


def components_first(values: FloatArray) -> FloatArray:
    """Return vectors (3, n) or matrices (3, 3, n), as they are here, of vectors (n, 3) or matrices (n, 3, 3)."""
    return np.moveaxis(values, 0, -1)


def components_last(values: FloatArray) -> FloatArray:
    """Return vectors (n, 3) or matrices (n, 3, 3), as they are elsewhere, of vectors (3, n) or matrices (3, 3, n)."""
    return np.moveaxis(values, -1, 0)


def matrix_products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the products (i, k, m) of matrices (i, j, m) and (j, k, m), summed in a fixed order."""
    total: FloatArray = first[:, 0, None] * second[0]
    for index in range(1, first.shape[1]):
        total += first[:, index, None] * second[index]
    return total


def transposed(matrices: FloatArray) -> FloatArray:
    """Return the transposes (j, i, m) of matrices (i, j, m)."""
    return np.swapaxes(matrices, 0, 1)


def turned(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Return the products (3, m) of matrices (3, 3, m) with vectors (3, m)."""
    products: FloatArray = matrices[:, 0] * vectors[0] + matrices[:, 1] * vectors[1] + matrices[:, 2] * vectors[2]
    return products


def turned_back(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Return the products (3, m) of transposed matrices (3, 3, m) with vectors (3, m)."""
    products: FloatArray = matrices[0] * vectors[0] + matrices[1] * vectors[1] + matrices[2] * vectors[2]
    return products


def dot_products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the products (m,) of vectors (3, m)."""
    products: FloatArray = first[0] * second[0] + first[1] * second[1] + first[2] * second[2]
    return products


def cross_products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the cross products (3, m) of vectors (3, m)."""
    (x, y, z), (a, b, c) = first, second
    return np.stack((y * c - z * b, z * a - x * c, x * b - y * a))


def _beside(left: FloatArray, right: FloatArray) -> FloatArray:
    return np.concatenate((left, right), axis=1)


def _unit(vectors: FloatArray) -> FloatArray:
    lengths = np.sqrt(dot_products(vectors, vectors))
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0.0)


def stiffness_of_points(
    tangents_n_m: FloatArray,
    first_arms_m: FloatArray,
    second_arms_m: FloatArray,
    summed: Callable[[FloatArray], FloatArray] = lambda values: values,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the stiffness (6, 6, c) of q gaps for their first and second bodies, and between these.

    Forces across the gaps grow by tangents (3, 3, q) with their width; they act at arms (3, q) from the centres of the
    bodies. `summed` takes what is of gaps (…, q) together to what is of c connections.
    """
    turning_first, turning_second = (_across(arms, tangents_n_m) for arms in (first_arms_m, second_arms_m))
    to_first, to_second = (cross_products(arms[:, None], tangents_n_m) for arms in (first_arms_m, second_arms_m))
    about_first = cross_products(first_arms_m[:, None], turning_first)
    about_second = cross_products(second_arms_m[:, None], turning_second)
    about_both = cross_products(first_arms_m[:, None], turning_second)
    pushed = summed(tangents_n_m)
    shifted_first, shifted_second = summed(turning_first), summed(turning_second)
    moments_first, moments_second = summed(to_first), summed(to_second)
    return (
        _block(pushed, shifted_first, moments_first, summed(about_first)),
        _block(pushed, shifted_second, moments_second, summed(about_second)),
        -_block(pushed, shifted_second, moments_first, summed(about_both)),
    )


def _across(arms_m: FloatArray, tangents_n_m: FloatArray) -> FloatArray:
    """Growth (3, 3, q) of forces as the body turns, where they grow by tangents as its points shift."""
    return np.swapaxes(cross_products(arms_m[:, None], np.swapaxes(tangents_n_m, 0, 1)), 0, 1)


def _block(shifts: FloatArray, turns: FloatArray, moments: FloatArray, moments_of_turns: FloatArray) -> FloatArray:
    """Matrices (6, 6, c) of four (3, 3, c)."""
    return np.concatenate(
        (np.concatenate((shifts, turns), axis=1), np.concatenate((moments, moments_of_turns), axis=1))
    )


def inertia_tensors(inverse: FloatArray, rotations: FloatArray, masses_kg: FloatArray) -> FloatArray:
    """Return tensors of inertia (3, 3, n) in the axes of the bodies, kg m², from inverse ones in those of the world.

    Rotations (3, 3, n) are from the axes of each body to those of the world. Bodies without a mass have zeros.
    """
    local = matrix_products(matrix_products(transposed(rotations), inverse), rotations)
    (a, b, c), (_, d, e), (_, _, f) = local
    minors = np.stack(
        (
            np.stack((d * f - e * e, c * e - b * f, b * e - c * d)),
            np.stack((c * e - b * f, a * f - c * c, b * c - a * e)),
            np.stack((b * e - c * d, b * c - a * e, a * d - b * b)),
        )
    )
    determinants = a * minors[0, 0] + b * minors[0, 1] + c * minors[0, 2]
    moves = (masses_kg > 0.0) & (determinants > 0.0)
    tensors: FloatArray = np.divide(minors, determinants, out=np.zeros_like(minors), where=moves)
    return tensors


def effective_inverse_masses(
    rows: JointRows, ends: tuple[IntArray, IntArray], inverse_masses: FloatArray, inverse_inertias: FloatArray
) -> FloatArray:
    """Return by how much a unit impulse in each row (6, m) changes the velocity in it, of pairs of bodies.

    Inverse masses (n,) are in 1/kg, inverse inertias (3, 3, n) in 1/(kg m²), in the axes of the world.
    """
    of_bodies = []
    for body, turning in zip(ends, (rows.first_turning, rows.second_turning), strict=True):
        inertia = inverse_inertias[..., body]
        shifts = inverse_masses[body] + _squares(turning, inertia)
        of_bodies.append(np.concatenate((shifts, _squares(rows.turning, inertia))))
    return of_bodies[0] + of_bodies[1]


def _squares(vectors: FloatArray, matrices: FloatArray) -> FloatArray:
    """Products vᵀ M v (3, m) of vectors (3, 3, m), one after another, with matrices (3, 3, m)."""
    turned = matrix_products(vectors, matrices)
    return turned[:, 0] * vectors[:, 0] + turned[:, 1] * vectors[:, 1] + turned[:, 2] * vectors[:, 2]
