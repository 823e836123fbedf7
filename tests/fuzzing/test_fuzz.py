# SPDX-License-Identifier: GPL-3.0-or-later
"""A short part of what `scripts/fuzz` does: a few seeds of each player, none of which may go wrong."""

import sys

import pytest
from fuzzing.batches import Ending, Outcome, fewest, outcomes
from fuzzing.blender_steps import BlenderPlayer
from fuzzing.players import PLAYERS
from fuzzing.sequences import REFUSED, Drawn
from support.long_cases import long_but

LENGTHS = {"blender": (3, 10), "scenarios": (6, 5), "folders": (1, 2)}
"""How many sequences of how many steps each plays."""


@pytest.mark.skipif(sys.platform == "win32", reason="steps make pipes, and links to devices")
@pytest.mark.parametrize("player", long_but(["scenarios"], PLAYERS))
def test_random_steps_go_well(player):
    count, length = LENGTHS[player]
    for outcome in outcomes(player, [Drawn(seed, length) for seed in range(1, count + 1)]):
        assert outcome.ending == Ending.WELL, "\n".join((*outcome.done, outcome.text))


def test_bare_blender_does_not_do_what_the_add_on_refused():
    drawn = Drawn(2077, 30, rows=(0, 1, 5, 7), most=3)
    outcome = Outcome(Ending.CRASH, ("use_standard_settings: x", f"press_build: run {{}}: {REFUSED}: Error", "update"))
    first, build, *rest = drawn.steps(BlenderPlayer)
    assert drawn._replace(refused=outcome.refused).steps(BlenderPlayer) == [first, ("update", build[1]), *rest]


def test_the_fewest_steps_are_found():
    assert fewest(range(30), lambda rows: {3, 17, 18} <= set(rows)) == [3, 17, 18]
    assert fewest(range(5), lambda rows: 4 in rows) == [4]
    assert fewest(range(3), lambda rows: len(rows) == 3) == [0, 1, 2]
