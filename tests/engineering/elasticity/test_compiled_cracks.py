# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled loops of cracks give the bits of numpy, also where bars have not stretched, yield, or are not there."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity import crack_loops
from bridge_demolition_addon.engineering.elasticity.compiled_cracks import (
    CompiledCrackLaw,
    quickest,
    stiffness_of_corners,
    summed,
)
from bridge_demolition_addon.engineering.elasticity.crack_law import CrackLaw
from bridge_demolition_addon.engineering.elasticity.gaps import stiffness_of_points
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars

COUNT = 4 * 150


def law(seed):
    """Return a law of gaps, a quarter of them without bars, and gaps from a micrometre to 10 cm, one of them closed."""
    rng = np.random.default_rng(seed)
    has_bars = np.arange(COUNT) % 4 > 0
    directions, normals = rng.normal(size=(2, 3, COUNT))
    bars = Bars(*(rng.uniform(0.0, most, COUNT) * has_bars for most in (1e6, 1e9, 1e7)))
    found = CrackLaw(
        bars,
        1e-3 * rng.normal(size=(3, COUNT)),
        rng.uniform(0.0, 1e-3, COUNT),
        normals / np.sqrt((normals * normals).sum(axis=0)),
        directions / np.sqrt((directions * directions).sum(axis=0)),
        rng.uniform(0.0, 1e9, COUNT),
        np.where(np.arange(COUNT) % 3 > 0, 1e-3 * rng.normal(size=(3, COUNT)), 0.0),
        rng.uniform(0.0, 1e5, COUNT),
    )
    gaps = rng.normal(size=(3, COUNT)) * 10.0 ** rng.uniform(-6.0, -1.0, COUNT)
    gaps[:, 5] = 0.0
    return found, gaps


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_forces_and_tangents_have_the_same_bits(seed):
    reference, gaps = law(seed)
    compiled = CompiledCrackLaw(reference, crack_loops)
    np.testing.assert_array_equal(compiled.forces(gaps), reference.forces(gaps))
    for one, other in zip(compiled.linear(gaps), reference.linear(gaps), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.slow
def test_stiffness_has_the_same_bits():
    reference, gaps = law(1)
    tangents = reference.linear(gaps)[1]
    arms = np.random.default_rng(1).normal(size=(2, 3, COUNT))
    expected = stiffness_of_points(tangents, *arms, lambda values: summed(values, 4))
    for one, other in zip(stiffness_of_corners(tangents, *arms, 4), expected, strict=True):
        np.testing.assert_array_equal(one, other)


def test_loops_are_used_where_numba_is_installed():
    assert isinstance(quickest(law(1)[0]), CompiledCrackLaw)
