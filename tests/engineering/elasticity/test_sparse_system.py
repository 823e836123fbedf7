# SPDX-License-Identifier: GPL-3.0-or-later
"""Equations of bodies: compiled sums give the bits of numpy, and solutions agree with those of a full matrix."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity import sparse_system
from bridge_demolition_addon.engineering.elasticity.sparse_system import BlockSystem

BODIES, CONNECTIONS = 12, 40


@pytest.fixture(params=range(3))
def rng(request):
    return np.random.default_rng(request.param)


@pytest.fixture
def without_numba(monkeypatch):
    monkeypatch.setattr(sparse_system, "equation_loops", lambda: None)


def problem(rng):
    """Ends of connections, several between two bodies and in both orders, and numbers of bodies and connections."""
    first, second = rng.integers(0, BODIES, (2, CONNECTIONS))
    second = np.where(first == second, -1, second)  # -1 does not move
    shapes = rng.normal(size=(CONNECTIONS, 6, 12))
    whole = np.swapaxes(shapes, 1, 2) @ shapes
    blocks = [whole[:, :6, :6], whole[:, 6:, 6:], whole[:, :6, 6:]]
    own = np.repeat(np.diag(rng.uniform(1.0, 2.0, 6))[..., None], BODIES, axis=-1)
    return first, second, own, [np.ascontiguousarray(np.moveaxis(block, 0, -1)) for block in blocks]


def full_matrix(first, second, own, blocks, kept):
    matrix = np.zeros((BODIES, 6, BODIES, 6))
    for body in range(BODIES):
        matrix[body, :, body] += own[..., body]
    for row in kept:
        one, other = first[row], second[row]
        matrix[one, :, one] += blocks[0][..., row]
        if other >= 0:
            matrix[other, :, other] += blocks[1][..., row]
            matrix[one, :, other] += blocks[2][..., row]
            matrix[other, :, one] += blocks[2][..., row].T
    return matrix.reshape(6 * BODIES, 6 * BODIES)


def solution(given, kept, right):
    """Solve by chosen connections of all blocks, half of them as numbers that are forgotten."""
    first, second, own, blocks = given
    system, half = BlockSystem(BODIES, first, second), len(kept) // 2
    system.assemble(own, kept[:half], *(block[..., kept[:half]] for block in blocks))
    system.factor(kept[half:], *(block[..., kept[half:]] for block in blocks))
    return system.solve(right)


def test_a_solution_is_that_of_the_full_matrix(rng):
    given, right = problem(rng), rng.normal(size=(6, BODIES))
    kept = np.flatnonzero(rng.random(CONNECTIONS) < 0.8)
    expected = np.linalg.solve(full_matrix(*given, kept), right.T.ravel()).reshape(-1, 6).T
    np.testing.assert_allclose(solution(given, kept, right), expected, rtol=1e-8, atol=1e-10)
