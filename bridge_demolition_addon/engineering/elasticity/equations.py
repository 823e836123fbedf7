"""Bodies and elastic connections as blocks of linear equations. All arrays have their components first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .joint_rows import JointRows, matrix_products, transposed


@dataclass(frozen=True, slots=True, eq=False)
class RigidBodies:
    """n bodies of known mass, where no connection is deformed. Those that never move have mass and inertia 0."""

    masses_kg: FloatArray  # (n,)
    inertias_kg_m2: FloatArray  # (3, 3, n), in the axes of the bodies
    positions_m: FloatArray  # (3, n), centres of mass
    rotations: FloatArray  # (3, 3, n)

    def __len__(self) -> int:
        return len(self.masses_kg)

    @property
    def moves(self) -> BoolArray:
        """Whether each body (n,) can move."""
        return self.masses_kg > 0.0

    def mass_matrices(self, rotations: FloatArray, bodies: IntArray) -> FloatArray:
        """Return mass and inertia (6, 6, b) in the axes of the world, of some bodies (b,) in rotations (3, 3, n)."""
        turned = rotations[..., bodies]
        matrices = np.zeros((6, 6, len(bodies)))
        matrices[[0, 1, 2], [0, 1, 2]] = self.masses_kg[bodies]
        of_bodies = self.inertias_kg_m2[..., bodies]
        matrices[3:, 3:] = matrix_products(matrix_products(turned, of_bodies), transposed(turned))
        return matrices


def summed_on_bodies(first: IntArray, second: IntArray, loads: tuple[FloatArray, FloatArray], count: int) -> FloatArray:
    """Return the sums (6, n) of loads (6, m) on first and second bodies (m,), for n bodies."""
    bodies = np.concatenate((first, second))
    return np.stack([np.bincount(bodies, component, count) for component in np.concatenate(loads, axis=1)])


def without(stiffness: FloatArray, rows: IntArray) -> FloatArray:
    """Return stiffness (6, 6, m) with nothing of connections (r,)."""
    left = stiffness.copy()
    left[..., rows] = 0.0
    return left


def connected_parts(moves: BoolArray, first: IntArray, second: IntArray) -> IntArray:
    """Return the part (n,) of each body, by the bodies (m,) of connections; -1 for those that do not move."""
    free = moves[first] & moves[second]
    first, second = first[free], second[free]
    lowest = np.arange(len(moves))  # index of the lowest body that each is known to hang together with
    while len(apart := np.flatnonzero(lowest[first] != lowest[second])):
        ends = lowest[first[apart]], lowest[second[apart]]
        np.minimum.at(lowest, np.concatenate(ends), np.tile(np.minimum(*ends), 2))
        while (lowest[lowest] != lowest).any():
            lowest = lowest[lowest]
    return np.where(moves, np.unique(lowest, return_inverse=True)[1], -1)


def spring_forces(stiffness: FloatArray, strains: FloatArray) -> FloatArray:
    """Return the amounts (6, m) in rows, by stiffness (6, 6, m), of deformations (6, m)."""
    amounts: FloatArray = stiffness[:, 0] * strains[0]
    for column in range(1, 6):
        amounts += stiffness[:, column] * strains[column]
    return amounts


def stiffness_blocks(rows: JointRows, stiffness: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return what connections add to the equations of their first and second bodies, and between: (6, 6, m) each."""
    first, second = rows.matrices()
    first_stressed, second_stressed = (matrix_products(stiffness, matrices) for matrices in (first, second))
    return (
        matrix_products(transposed(first), first_stressed),
        matrix_products(transposed(second), second_stressed),
        matrix_products(transposed(first), second_stressed),
    )
