# SPDX-License-Identifier: GPL-3.0-or-later
"""Equations of bodies: solutions agree with those of a full matrix, for any pattern and order."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.equations import BlockSystem

BODIES, CONNECTIONS = 12, 40


@pytest.fixture(params=range(3))
def rng(request):
    return np.random.default_rng(request.param)


def problem(rng, bodies=BODIES, connections=CONNECTIONS):
    """Ends of connections, several between two bodies and in both orders, and numbers of bodies and connections."""
    first, second = rng.integers(0, bodies, (2, connections))
    second = np.where(first == second, -1, second)  # -1 does not move
    shapes = rng.normal(size=(connections, 6, 12))
    whole = np.swapaxes(shapes, 1, 2) @ shapes
    blocks = [whole[:, :6, :6], whole[:, 6:, 6:], whole[:, :6, 6:]]
    own = np.repeat(np.diag(rng.uniform(1.0, 2.0, 6))[..., None], bodies, axis=-1)
    return first, second, own, [np.ascontiguousarray(np.moveaxis(block, 0, -1)) for block in blocks]


def full_matrix(first, second, own, blocks, kept):
    bodies = own.shape[-1]
    matrix = np.zeros((bodies, 6, bodies, 6))
    for body in range(bodies):
        matrix[body, :, body] += own[..., body]
    for row in kept:
        one, other = first[row], second[row]
        matrix[one, :, one] += blocks[0][..., row]
        if other >= 0:
            matrix[other, :, other] += blocks[1][..., row]
            matrix[one, :, other] += blocks[2][..., row]
            matrix[other, :, one] += blocks[2][..., row].T
    return matrix.reshape(6 * bodies, 6 * bodies)


def solution(given, kept, right):
    """Solve by chosen connections of all blocks, half of them as numbers that are forgotten."""
    first, second, own, blocks = given
    system, half = BlockSystem(own.shape[-1], first, second), len(kept) // 2
    system.assemble(own, kept[:half], *(block[..., kept[:half]] for block in blocks))
    system.factor(kept[half:], *(block[..., kept[half:]] for block in blocks))
    return system.solve(right)


def test_a_solution_is_that_of_the_full_matrix(rng):
    given, right = problem(rng), rng.normal(size=(6, BODIES))
    kept = np.flatnonzero(rng.random(CONNECTIONS) < 0.8)
    expected = np.linalg.solve(full_matrix(*given, kept), right.T.ravel()).reshape(-1, 6).T
    np.testing.assert_allclose(solution(given, kept, right), expected, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize(("bodies", "connections"), [(1, 0), (1, 3), (2, 9), (30, 0), (60, 30), (60, 90), (40, 700)])
def test_patterns_from_none_to_full_are_solved(rng, bodies, connections):
    """Bodies that nothing couples, trees, loops, and all to all."""
    given, right = problem(rng, bodies, connections), rng.normal(size=(6, bodies))
    kept = np.arange(connections)
    expected = np.linalg.solve(full_matrix(*given, kept), right.T.ravel()).reshape(-1, 6).T
    np.testing.assert_allclose(solution(given, kept, right), expected, rtol=1e-8, atol=1e-10)


def test_a_chain_fills_nothing_in():
    """Least degree eliminates a chain from its ends, whatever its numbers: as many numbers as blocks are coupled."""
    bodies, rng = 3000, np.random.default_rng(1)
    numbers = rng.permutation(bodies)
    first, second = numbers[:-1], numbers[1:]
    ones = np.repeat(np.eye(6)[..., None], bodies - 1, axis=-1)
    system, right = BlockSystem(bodies, first, second), rng.normal(size=(6, bodies))
    system.assemble(np.repeat(np.eye(6)[..., None], bodies, axis=-1), np.arange(bodies - 1), ones, ones, -ones)
    system.factor()
    found = system.solve(right)
    residual = found.copy()
    np.add.at(residual.T, first, (found[:, first] - found[:, second]).T)
    np.add.at(residual.T, second, (found[:, second] - found[:, first]).T)
    np.testing.assert_allclose(residual, right, atol=1e-10)


def test_bodies_that_there_are_not_are_refused():
    with pytest.raises(ValueError, match="not one of 2"):
        BlockSystem(2, np.array([0]), np.array([2]))
    with pytest.raises(ValueError, match="1 first and 2 second"):
        BlockSystem(2, np.array([0]), np.array([1, 0]))
