# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of the bodies of a connection that breaks."""

import pytest
from support.blocks import Blocks

WEAK_N = 1.0


def test_block_lands_on_the_ground_it_was_connected_to(blender, tmp_path):
    blocks = Blocks()
    ground = blocks.block((0, 0, -0.5))
    block = blocks.block((0, 0, 1.5), 100.0)
    blocks.connect("FIXED", (0, 0, 0.5), ground, block, WEAK_N)
    results = blocks.play(tmp_path, 48)
    assert not results.frames.intact[-1][0]
    # Contacts rest within some millimetres of touching.
    assert results.frames.positions_m[-1, 1, 2] == pytest.approx(0.5, abs=0.01)


def test_bodies_stay_apart_only_for_as_long_as_one_connection_holds(blender, tmp_path):
    """Two connections between the same bodies: the weak one breaks, and the strong one still forbids collisions."""
    blocks = Blocks()
    ground = blocks.block((0, 0, -0.5))
    block = blocks.block((0, 0, 0.4), 100.0)
    blocks.connect("FIXED", (0, 0, 0), ground, block)
    blocks.connect("POINT", (0, 0, 0), ground, block, WEAK_N)
    results = blocks.play(tmp_path, 24)
    assert results.frames.intact[-1].tolist() == [True, False]
    # Were they to collide, the ground would push the block out of its 10 cm inside.
    assert results.frames.positions_m[-1, 1, 2] == pytest.approx(0.4, abs=1e-3)
