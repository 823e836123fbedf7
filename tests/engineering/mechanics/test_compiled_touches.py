# SPDX-License-Identifier: GPL-3.0-or-later
"""A compiled loop keeps the accounts of bodies that touch with the bits of numpy."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics import touch_loops, touches
from bridge_demolition_addon.engineering.mechanics.touches import Touches

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


@pytest.mark.parametrize("gap", [0, 2, 5])
@pytest.mark.parametrize("is_known", [True, False], ids=["known", "unknown"])
def test_what_comes_back_has_the_same_bits(monkeypatch, gap, is_known):
    frames = list(frames_of(np.random.default_rng(gap), is_known))

    def returned():
        accounts = Touches()
        for frame in frames:
            yield accounts.returned(*frame)
            accounts.pass_over(gap)

    assert touches.touch_loops() is touch_loops
    compiled = list(returned())
    monkeypatch.setattr(touches, "touch_loops", lambda: None)
    for one, other in zip(compiled, returned(), strict=True):
        np.testing.assert_array_equal(one, other)
    assert any((frame > 0.0).any() for frame in compiled)
