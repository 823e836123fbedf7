"""Inertia of bodies, and how it resists impulses in the rows of connections. Arrays have their components first."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from .joint_rows import JointRows, matrix_products, transposed


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
