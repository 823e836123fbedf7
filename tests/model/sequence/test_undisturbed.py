# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a bridge stood until something was done to it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.run_folders import G, flying_shards
from support.scenarios import I235

from bridge_demolition_addon.model.blast.settings import BlastSettings
from bridge_demolition_addon.model.scenario import Charge, Geometry, SawCut
from bridge_demolition_addon.model.sequence.ending import fell_by_itself, first_event_s, self_collapse_text

FRAME_S = 1 / 24
ALONE = replace(I235, ball=None)


def still(results):
    """The same run, in which nothing moves or breaks."""
    frames = results.frames
    positions = np.broadcast_to(frames.positions_m[:1], frames.positions_m.shape).copy()
    return replace(results, frames=replace(frames, positions_m=positions, intact=np.ones_like(frames.intact)))


def test_the_first_event_is_what_is_done_first():
    assert first_event_s(ALONE) == math.inf
    # Free fall: the root of 2 h / g.
    ball = I235.ball
    fall_s = math.sqrt(2 * ball.drop_height_m / G)
    assert first_event_s(I235) == pytest.approx(ball.release_time_s + fall_s - I235.time.step.frame_s)
    cut = SawCut(time_s=0.4, point_m=(6, 0, 0), normal=(1, 0, 0))
    assert first_event_s(replace(I235, saw_cuts=(cut,))) == 0.4
    charges = (Charge(position_m=(0, 0, 1), mass_kg=5, delay_ms=30), Charge(position_m=(0, 0, 1), mass_kg=0.0))
    assert first_event_s(replace(I235, blast=BlastSettings(start_s=0.2), charges=charges)) == pytest.approx(0.23)
    off = BlastSettings(start_s=0.2, explosion=False)
    assert first_event_s(replace(ALONE, blast=off, charges=charges)) == math.inf


def test_a_member_that_is_thrown_does_not_fall_by_itself():
    thrown = Geometry(name="block", file="block.stl", density_kg_m3=2400.0, velocity_m_s=(3.0, 0.0, 0.0))
    awake = replace(ALONE.shards, start_deactivated=False)
    still_member = replace(thrown, velocity_m_s=(0.0, 0.0, 0.0))
    assert first_event_s(replace(ALONE, shards=awake, geometry=(thrown,))) == 0.0
    assert fell_by_itself(flying_shards(), replace(ALONE, shards=awake, geometry=(thrown,))) is None
    assert fell_by_itself(flying_shards(), replace(ALONE, shards=awake, geometry=(still_member,)))


def test_a_bridge_that_falls_before_is_told_of():
    results = flying_shards()  # they fall freely from the beginning, and break in the tenth frame
    cut = SawCut(time_s=0.5, point_m=(6, 0, 0), normal=(1, 0, 0))
    found = fell_by_itself(results, replace(ALONE, saw_cuts=(cut,)))
    count = len(results.inventory.pairs)
    assert (found.until_s, found.broken, found.connections) == (0.5, math.ceil(count / 2), count)
    assert found.first_break_s == pytest.approx(10 * FRAME_S)
    assert found.largest_move_m >= G / 2 * 0.5**2 * (1 - 1e-5), "free fall, and sideways"
    told = self_collapse_text(found)
    assert told.startswith(f"The bridge does not stand by itself: {found.broken} of {count} connections broke")
    assert "the first at 0.42 s" in told and "up to 0.50 s, before anything was done" in told


def test_what_comes_after_the_first_event_does_not_count():
    early = SawCut(time_s=FRAME_S / 2, point_m=(6, 0, 0), normal=(1, 0, 0))
    assert fell_by_itself(flying_shards(), replace(ALONE, saw_cuts=(early,))) is None
    assert self_collapse_text(None) == ""


def test_a_bridge_that_stands_is_not_told_of():
    assert fell_by_itself(still(flying_shards()), ALONE) is None


def test_a_bridge_that_only_slides_away_is_told_of_too():
    results = flying_shards()
    slides = replace(results, frames=replace(results.frames, intact=np.ones_like(results.frames.intact)))
    found = fell_by_itself(slides, ALONE)
    assert (found.broken, found.first_break_s, found.until_s) == (0, None, None)
    assert "though nothing was done to it" in self_collapse_text(found)
