# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled factors have the bits of QDLDL, whatever the pattern; where it rounds otherwise all is left to it."""

from types import SimpleNamespace

import numpy as np
import pytest
import qdldl
from scipy.sparse import csc_matrix, random_array, triu

from bridge_demolition_addon.engineering.elasticity import panel_factors, sparse_system
from bridge_demolition_addon.engineering.elasticity.panel_factors import PanelFactors, factor_loops, loops_like_qdldl
from bridge_demolition_addon.engineering.elasticity.sparse_system import BlockSystem

pytestmark = pytest.mark.skipif(loops_like_qdldl() is None, reason="QDLDL rounds otherwise on this processor")


@pytest.fixture(params=range(5))
def rng(request):
    return np.random.default_rng(request.param)


def equations(rng, size, density):
    """Equations that couple few unknowns, at random, each by about the same; the diagonal is the largest."""
    coupled = random_array((size, size), density=density, rng=rng, data_sampler=lambda size: rng.normal(size=size))
    whole = coupled + coupled.T + csc_matrix(np.diag(rng.uniform(5.0, 9.0, size)))
    return csc_matrix(triu(whole, format="csc"))


def assert_like_qdldl(matrix, rng):
    solver = qdldl.Solver(matrix, upper=True)
    factors = PanelFactors(factor_loops(), matrix.indptr, matrix.indices, np.asarray(solver.factors()[2]))
    for _ in range(2):
        factors.factor(matrix.data)
        right = rng.normal(size=matrix.shape[0])
        found = factors.solve(right.reshape(-1, 6).T).T.ravel()
        np.testing.assert_array_equal(found, solver.solve(right))
        matrix.data = matrix.data * rng.uniform(0.9, 1.1, matrix.nnz)
        solver.update(matrix, upper=True)


@pytest.mark.parametrize("density", [0.0, 0.01, 0.03, 0.2, 1.0])
def test_equations_of_any_pattern_are_solved_with_the_bits_of_qdldl(rng, density):
    assert_like_qdldl(equations(rng, 96, density), rng)


@pytest.mark.parametrize("bodies", [1, 2, 60])
def test_equations_of_bodies_are_solved_with_the_bits_of_qdldl(rng, bodies, monkeypatch):
    """Neighbours in a row of bodies are connected, and some at random, also with what does not move."""
    first = np.concatenate((np.arange(bodies), rng.integers(0, bodies, bodies)))
    second = np.concatenate((np.arange(1, bodies), [-1], rng.integers(-1, bodies, bodies)))
    second[first == second] = -1
    shapes = rng.normal(size=(len(first), 6, 12))
    whole = np.moveaxis(np.swapaxes(shapes, 1, 2) @ shapes, 0, -1)
    blocks = [np.ascontiguousarray(block) for block in (whole[:6, :6], whole[6:, 6:], whole[:6, 6:])]
    own = np.repeat(np.diag(rng.uniform(1.0, 2.0, 6))[..., None], bodies, axis=-1)
    right, connections = rng.normal(size=(6, bodies)), np.arange(len(first))

    def solutions():
        system, found = BlockSystem(bodies, first, second), []
        for factor in (1.0, 1.7, 0.3):
            system.assemble(factor * own, connections, *blocks)
            system.factor()
            found.append(system.solve(right))
        return found

    compiled = solutions()
    monkeypatch.setattr(sparse_system, "loops_like_qdldl", lambda: None)
    np.testing.assert_array_equal(compiled, solutions())


def test_loops_are_left_out_where_qdldl_rounds_otherwise(monkeypatch):
    loops = factor_loops()
    rounded = SimpleNamespace(**{name: getattr(loops, name) for name in dir(loops) if not name.startswith("_")})
    rounded.solved = lambda *given: np.nextafter(loops.solved(*given), 0.0)
    monkeypatch.setattr(panel_factors, "factor_loops", lambda: rounded)
    assert loops_like_qdldl.__wrapped__() is None


def test_without_numba_there_are_no_loops(monkeypatch):
    monkeypatch.setattr(panel_factors, "factor_loops", lambda: None)
    assert loops_like_qdldl.__wrapped__() is None
