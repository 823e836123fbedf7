# SPDX-License-Identifier: GPL-3.0-or-later
"""A run begins with what was built, whatever the scene shows and whatever was done to it before."""

import pytest
from support.blocks import Blocks

from bridge_demolition_addon.display.contours import ContourSettings
from bridge_demolition_addon.simulation.blender_events import contours_of, shown_results

HEIGHT_M, FRAMES = 5.0, 25


@pytest.fixture
def falling(blender):
    """A block above another."""
    blocks = Blocks()
    blocks.block((0.0, 0.0, 0.0))
    blocks.block((0.0, 0.0, HEIGHT_M), 10.0)
    yield blocks
    contours_of(blocks.scene).hide()
    shown_results(blocks.scene).forget()


def shown_where_it_fell(blocks, folder):
    """Play, and show the last frame in colours after Blender has forgotten the frames that it played."""
    folder.mkdir()
    blocks.play(folder, FRAMES)
    contours_of(blocks.scene).show(ContourSettings())
    blocks.scene.frame_set(FRAMES)
    blocks.world.solver_iterations += 1
    contours_of(blocks.scene).refresh()


def height_shown_m(blender, blocks):
    block = blocks.world.collection.objects[1]
    return block.evaluated_get(blender.context.evaluated_depsgraph_get()).matrix_world.translation.z


def test_a_run_begins_with_the_bridge_where_colours_show_the_rubble_of_the_last(blender, falling, tmp_path):
    shown_where_it_fell(falling, tmp_path / "first")
    assert height_shown_m(blender, falling) < 2.0
    (tmp_path / "second").mkdir()
    second = falling.play(tmp_path / "second", FRAMES)
    assert second.frames.positions_m[0, 1, 2] == HEIGHT_M


def test_so_does_what_is_played_without_recording(blender, falling, tmp_path):
    shown_where_it_fell(falling, tmp_path / "first")
    for frame in (1, 2, 3):
        falling.scene.frame_set(frame)
    contours_of(falling.scene).settings = None  # shows where Blender has the block, and edits nothing
    falling.scene.frame_set(4)
    assert height_shown_m(blender, falling) > HEIGHT_M - 0.2
