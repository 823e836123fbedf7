# SPDX-License-Identifier: GPL-3.0-or-later
"""Accounts of bodies that touch are those of numpy, to the bit."""

import numpy as np
import pytest
from reference.frames import ReferenceTouches

from bridge_demolition_addon.engineering.mechanics.touches import APART, Touches

PAIRS, SUBSTEPS = 12, 8


def frames_of(rng, is_known):
    """Pairs that touch in each of some frames, with their work and the ends of sub-steps; often they do none."""
    for _ in range(20):
        touching = [rng.permutation(PAIRS)[: rng.integers(0, PAIRS)] for _ in range(SUBSTEPS)]
        ends = np.concatenate(([0], np.cumsum([len(pairs) for pairs in touching])))
        work = rng.normal(size=ends[-1]) * (rng.uniform(size=ends[-1]) < 0.3)
        if not is_known:
            work[rng.integers(len(work))] = np.nan
        yield np.concatenate(touching), work, ends


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("gap", [0, 2, 5])
@pytest.mark.parametrize("is_known", [True, False], ids=["known", "unknown"])
def test_what_comes_back_is_that_of_the_reference(seed, gap, is_known):
    accounts, expected, most = Touches(), ReferenceTouches(APART), 0.0
    for frame in frames_of(np.random.default_rng(seed), is_known):
        found = accounts.returned_energies(*frame)
        np.testing.assert_array_equal(found, expected.returned_energies(*frame))
        most = max(most, np.nanmax(found))
        accounts.pass_over(gap)
        expected.pass_over(gap)
    assert most > 0.0


def test_sub_steps_without_contacts_and_rows_that_there_are_not():
    accounts, nothing = Touches(), np.zeros(0, int)
    assert accounts.returned_energies(nothing, np.zeros(0), np.zeros(4, int)).shape == (0,)
    with pytest.raises(ValueError, match="rows that there are not"):
        accounts.returned_energies(np.array([3, 4]), np.array([-1.0, 1.0]), np.array([2, 4]))
    with pytest.raises(ValueError, match="work has numbers of type int64: expected float64"):
        accounts.returned_energies(np.array([3, 4]), np.array([-1, 1]), np.array([0, 2]))
