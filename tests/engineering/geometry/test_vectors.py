# SPDX-License-Identifier: GPL-3.0-or-later
"""Vectors and small matrices against numpy's own, and by hand where there is nothing to divide by."""

import numpy as np
import pytest
from reference.geometry import diagonalised, symmetric_eigenvectors_2d

from bridge_demolition_addon.engineering.geometry.vectors import (
    cross_2d,
    distance,
    dot,
    length,
    outer,
    product,
    symmetric_eigenvalues,
    symmetric_eigenvectors,
    transformed,
    transformed_back,
    unit,
)

RANDOM = np.random.default_rng(3)
FIRST, SECOND = RANDOM.normal(size=(2, 50, 3))
MATRICES, OTHERS = RANDOM.normal(size=(2, 50, 3, 3))

# A few roundings of numbers of some units.
ROUNDING = 1e-14


def close(found, expected):
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=ROUNDING)


def test_products_are_those_of_the_reference():
    close(dot(FIRST, SECOND), (FIRST * SECOND).sum(axis=1))
    close(dot(FIRST[:, None], SECOND), FIRST @ SECOND.T)
    close(transformed(MATRICES, FIRST), np.einsum("nij,nj->ni", MATRICES, FIRST))
    close(transformed(MATRICES[0], FIRST), FIRST @ MATRICES[0].T)
    close(transformed_back(MATRICES, FIRST), np.einsum("nij,ni->nj", MATRICES, FIRST))
    close(product(MATRICES, OTHERS), MATRICES @ OTHERS)
    close(outer(FIRST, SECOND), np.einsum("ni,nj->nij", FIRST, SECOND))
    close(cross_2d(FIRST[:, :2], SECOND[:, :2]), np.cross(FIRST, SECOND)[:, 2])


def test_lengths_and_distances():
    close(length(FIRST), np.linalg.norm(FIRST, axis=1))
    close(distance(FIRST[:, None], SECOND), np.linalg.norm(FIRST[:, None] - SECOND, axis=2))
    close(length(unit(FIRST)), 1.0)
    assert unit(np.zeros((2, 3))).tolist() == [[0, 0, 0], [0, 0, 0]]


def test_eigenvalues_of_symmetric_matrices():
    matrices = MATRICES + np.swapaxes(MATRICES, 1, 2)
    np.testing.assert_allclose(symmetric_eigenvalues(matrices), np.linalg.eigvalsh(matrices), rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("matrix", [np.zeros((3, 3)), np.eye(3), np.ones((3, 3)), np.diag([3.0, 1.0, 2.0])])
def test_eigenvalues_that_are_equal_or_zero(matrix):
    close(symmetric_eigenvalues(matrix), np.linalg.eigvalsh(matrix))


def test_principal_axes_in_a_plane():
    matrices = (MATRICES + np.swapaxes(MATRICES, 1, 2))[:, :2, :2]
    values, vectors = symmetric_eigenvectors_2d(matrices)
    close(values, np.linalg.eigvalsh(matrices))
    close(np.swapaxes(vectors, 1, 2) @ vectors, np.broadcast_to(np.eye(2), (50, 2, 2)))
    close(matrices @ vectors, vectors * values[:, None])


@pytest.mark.parametrize("matrix", [np.diag([4.0, 1.0]), np.diag([1.0, 4.0]), np.zeros((2, 2)), 2.0 * np.eye(2)])
def test_principal_axes_that_lie_along_the_axes(matrix):
    values, vectors = symmetric_eigenvectors_2d(matrix)
    assert values.tolist() == sorted(np.diag(matrix))
    close(matrix @ vectors, vectors * values)


def symmetric_matrices(seed):
    """Random ones, and ones that are diagonal already, equal in some axes, or of very different sizes."""
    rng = np.random.default_rng(seed)
    matrices = rng.normal(size=(3000, 3, 3)) * 10.0 ** rng.integers(-150, 150, (3000, 1, 1))
    matrices[:500] *= rng.integers(0, 2, (500, 3, 3))
    matrices[500:1000] = rng.integers(-1, 2, (500, 3, 3))
    matrices[1000:1500, 0] *= 1e-9
    return np.concatenate((matrices + np.swapaxes(matrices, 1, 2), np.zeros((1, 3, 3)), 1e200 * np.eye(3)[None]))


@pytest.mark.parametrize("seed", range(2))
def test_eigenvalues_and_eigenvectors_are_those_of_the_reference(seed):
    matrices = symmetric_matrices(seed)
    values, rows = diagonalised(matrices, np.broadcast_to(np.eye(3), matrices.shape))
    found, columns = symmetric_eigenvectors(matrices.reshape(2, -1, 3, 3))
    order = np.argsort(values, axis=-1, kind="stable")
    np.testing.assert_array_equal(symmetric_eigenvalues(matrices), np.sort(values, axis=-1))
    np.testing.assert_array_equal(found.reshape(-1, 3), np.sort(values, axis=-1))
    rows = np.take_along_axis(rows, order[..., None], axis=-2)
    np.testing.assert_array_equal(np.swapaxes(columns, -1, -2).reshape(-1, 3, 3)[:, :2], rows[:, :2])


def test_matrices_stay_as_they_are():
    matrices = np.asfortranarray(MATRICES + np.swapaxes(MATRICES, 1, 2))
    before = matrices.copy()
    assert symmetric_eigenvalues(matrices[:0]).shape == (0, 3)
    symmetric_eigenvectors(matrices)
    assert matrices.tolist() == before.tolist()
