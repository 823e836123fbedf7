# SPDX-License-Identifier: GPL-3.0-or-later
"""Guesses of forces that yield: they end where all is in balance, also where Newton's method alone goes in circles."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.guesses import GuessedForces, next_shares

MOST = 40


class Yielding(GuessedForces):
    """Springs (q,) with forces of their own motion, which yield at ±1."""

    def __init__(self, stiffness):
        super().__init__(np.arange(len(stiffness)), np.arange(len(stiffness)))
        self._stiffness = stiffness
        self._begin_at(np.zeros((1, len(stiffness))))

    def forces(self, moved):
        return np.clip(self._stiffness * moved, -1.0, 1.0)

    def _moved(self, velocities):
        return velocities[:1]

    def _resisted(self, moved):
        return self.forces(moved)

    def _linear(self, moved):
        return self.at_rest + self.tangents * moved

    def _begin_at(self, moved):
        forces = self.forces(moved)
        self.tangents = np.where(abs(forces) < 1.0, self._stiffness, 0.0)
        self.at_rest = forces - self.tangents * moved

    def _slack(self):
        return np.full(len(self._stiffness), 1e-9)

    def changed(self):
        raise AssertionError("the equations are made by the test")

    blocks = loads = of_bodies = changed


def coupled(seed, count=8):
    """Return a matrix that couples springs, loads on them, and their stiffness."""
    rng = np.random.default_rng(seed)
    shape = rng.normal(size=(count, count))
    return shape @ shape.T + 0.01 * np.eye(count), rng.normal(scale=20.0, size=count), rng.uniform(1.0, 1e4, size=count)


def followed(problems, go_all_the_way=False):
    """Guess the motion of parts that are not connected; return it, and how many guesses it took at most."""
    parts = np.repeat(np.arange(len(problems)), [len(loads) for _, loads, _ in problems])
    springs = Yielding(np.concatenate([stiffness for *_, stiffness in problems]))
    for number in range(MOST):
        moved = np.zeros((6, len(parts)))
        for part, (matrix, loads, _) in enumerate(problems):
            mine = parts == part
            moved[0, mine] = np.linalg.solve(
                matrix + np.diag(springs.tangents[0, mine]), loads - springs.at_rest[0, mine]
            )
        off = springs.take(moved)
        if not off.any():
            return moved[0], number
        are_off = np.bincount(parts, off, len(problems)) > 0
        shares = np.ones(len(problems)) if go_all_the_way else next_shares([springs], [parts], are_off)
        springs.go(shares[parts])
    return moved[0], MOST


def unbalanced(problem, moved):
    matrix, loads, stiffness = problem
    return abs(matrix @ moved + np.clip(stiffness * moved, -1.0, 1.0) - loads).max()


@pytest.mark.parametrize("seed", range(40))
def test_guesses_end_in_balance(seed):
    problem = coupled(seed)
    moved, guesses = followed([problem])
    assert guesses < 25
    assert unbalanced(problem, moved) < 1e-7


def test_newton_alone_goes_in_circles():
    """Else the test above would show nothing."""
    ends = [followed([coupled(seed)], go_all_the_way=True)[1] for seed in range(40)]
    assert max(ends) == MOST


def test_parts_do_not_hold_each_other_up():
    """Together they take as many guesses as the slowest of them alone, and end where they end alone."""
    problems = [coupled(seed) for seed in range(6)]
    alone = [followed([problem]) for problem in problems]
    moved, guesses = followed(problems)
    np.testing.assert_allclose(moved, np.concatenate([one for one, _ in alone]), rtol=1e-9, atol=1e-12)
    assert guesses == max(number for _, number in alone)
