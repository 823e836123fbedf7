# SPDX-License-Identifier: GPL-3.0-or-later
"""A jackhammer takes the slab between two girders out along its path, beginning with its first blows."""

import pytest
from support.example_claims import assert_begins
from support.example_runs import begun

NAME = "jackhammer_dismantling"


@pytest.fixture(scope="module")
def dismantled(session_folder):
    return begun(NAME, session_folder)


@pytest.mark.long
def test_it_stands_until_the_first_blow(dismantled):
    before = dismantled.at(dismantled.begins_s)
    assert dismantled.results.frames.intact[before].all()
    assert dismantled.moved_m(dismantled.shards, before).max() < 0.01


@pytest.mark.long
def test_the_slab_is_cut_fine_and_breaks_under_the_chisel_and_girders_stay(dismantled):
    assert not dismantled.results.frames.intact[-1].all()
    assert_begins(NAME, dismantled)
