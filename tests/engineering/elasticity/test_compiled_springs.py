# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled loops of springs give the bits of numpy, also where springs lift off, slide, crush or pull."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity import compiled_springs, springs
from bridge_demolition_addon.engineering.elasticity.gaps import Gaps
from bridge_demolition_addon.engineering.elasticity.spring_law import PressedSprings
from bridge_demolition_addon.engineering.elasticity.springs import (
    SpringPositions,
    loads_of_springs,
    stiffness_of_springs,
)

SPRINGS, CONNECTIONS, BODIES = 240, 60, 40


@pytest.fixture(params=range(4))
def rng(request):
    return np.random.default_rng(request.param)


@pytest.fixture
def by_numpy(monkeypatch):
    """What a function gives without Numba."""

    def called(function, *arguments):
        with monkeypatch.context() as without:
            without.setattr(compiled_springs, "spring_loops", lambda: None)
            without.setattr(springs, "spring_loops", lambda: None)
            return function(*arguments)

    return called


def law(rng):
    number = np.arange(SPRINGS)
    return PressedSprings(
        rng.uniform(1e6, 1e9, SPRINGS),
        rng.uniform(0.0, 1e8, (2, SPRINGS)) * (number % 7 > 0),
        np.where(number % 3 > 0, np.inf, rng.uniform(1e3, 1e5, SPRINGS)),
        np.where(number % 4 > 0, rng.uniform(0.0, 0.8, SPRINGS), np.inf),
        number % 5 == 0,
        rng.uniform(0.0, 1e5, SPRINGS) * (number % 6 > 0),
    )


def positions(rng):
    of = np.sort(rng.integers(0, CONNECTIONS, SPRINGS))
    above, below = rng.integers(0, BODIES, (2, SPRINGS))
    anchors = rng.normal(size=(2, 3, SPRINGS))
    return SpringPositions(of, above, below, *anchors, rng.integers(0, 2, CONNECTIONS) > 0)


def assert_same_bits(one, other):
    for first, second in zip(one, other, strict=True):
        np.testing.assert_array_equal(first, second)
        np.testing.assert_array_equal(np.signbit(first), np.signbit(second))


@pytest.mark.slow
def test_forces_and_tangents_have_the_same_bits(rng):
    springs_law = law(rng)
    gaps_m = rng.normal(size=(3, SPRINGS)) * 10.0 ** rng.uniform(-8.0, -1.0, SPRINGS)
    gaps_m[:, 7] = 0.0
    assert_same_bits(compiled_springs.resisted(springs_law, gaps_m), springs_law.resisted(gaps_m))


def test_rates_have_the_same_bits(rng):
    first, second = rng.integers(0, BODIES, (2, SPRINGS))
    gaps = Gaps(first, second, *rng.normal(size=(3, 3, SPRINGS)))
    velocities = rng.normal(size=(6, BODIES))
    assert_same_bits([compiled_springs.rates(gaps, velocities)], [gaps.rates(velocities)])


@pytest.mark.slow
def test_stiffness_has_the_same_bits(rng, by_numpy):
    of = positions(rng)
    tangents, arms = law(rng).resisted(1e-4 * rng.normal(size=(3, SPRINGS)))[1], rng.normal(size=(2, 3, SPRINGS))
    given = (of, tangents, *arms)
    assert_same_bits(stiffness_of_springs(*given), by_numpy(stiffness_of_springs, *given))


@pytest.mark.slow
def test_loads_have_the_same_bits(rng, by_numpy):
    given = (positions(rng), *rng.normal(size=(3, 3, SPRINGS)))
    assert_same_bits(loads_of_springs(*given), by_numpy(loads_of_springs, *given))


def test_loops_are_used_where_numba_is_installed():
    assert compiled_springs.spring_loops() is not None
