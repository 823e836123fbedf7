"""A short part of what `scripts/fuzz` does: a few seeds of each player, none of which may go wrong."""

import sys

import pytest
from fuzzing.batches import Ending, fewest, outcomes
from fuzzing.players import PLAYERS
from fuzzing.sequences import Drawn

LENGTHS = {"blender": (4, 12), "scenarios": (8, 5), "folders": (1, 3)}
"""How many sequences of how many steps each plays."""


@pytest.mark.skipif(sys.platform == "win32", reason="steps make pipes, and links to devices")
@pytest.mark.parametrize("player", PLAYERS)
def test_random_steps_go_well(player):
    count, length = LENGTHS[player]
    for outcome in outcomes(player, [Drawn(seed, length) for seed in range(1, count + 1)]):
        assert outcome.ending == Ending.WELL, "\n".join((*outcome.done, outcome.text))


def test_the_fewest_steps_are_found():
    assert fewest(range(30), lambda rows: {3, 17, 18} <= set(rows)) == [3, 17, 18]
    assert fewest(range(5), lambda rows: 4 in rows) == [4]
    assert fewest(range(3), lambda rows: len(rows) == 3) == [0, 1, 2]
