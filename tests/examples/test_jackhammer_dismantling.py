# SPDX-License-Identifier: GPL-3.0-or-later
"""A jackhammer takes the slab between two girders out along its path, and the rest of the bridge stays."""

import pytest
from support.example_claims import assert_claims
from support.example_runs import example, run_example

NAME = "jackhammer_dismantling"


@pytest.fixture(scope="module")
def dismantled(tmp_path_factory):
    """The first half of the path."""
    return run_example(example(NAME, 3.2), tmp_path_factory.mktemp("dismantled"))


def test_it_stands_until_the_first_blow(dismantled):
    before = dismantled.at(dismantled.begins_s)
    assert dismantled.results.frames.intact[before].all()
    assert dismantled.moved_m(dismantled.shards, before).max() < 0.01


def test_slab_comes_off_along_the_path_and_girders_carry_the_rest(dismantled):
    assert_claims(NAME, dismantled)
