# SPDX-License-Identifier: GPL-3.0-or-later
"""Friction along and across the way, as worlds with elastic connections have it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet.binding import find_dynamics_world
from bridge_demolition_addon.bullet.layout import ONE_DIRECTION, TWO_DIRECTIONS, platform_layout
from bridge_demolition_addon.bullet.memory import read_value
from bridge_demolition_addon.bullet.world import BulletWorld
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

SLOPE, SIDE, FRICTION = math.radians(25.0), math.radians(37.0), 0.3


@pytest.fixture
def rubbing(monkeypatch):
    """Give every world that is recorded friction across the way, as one with elastic connections has."""
    call, modes = BulletWorld.call_around_substeps, []

    def also_rub(world, *actions):
        call(world, *actions)
        world.rub_across(wanted=True)
        modes.append(world)

    monkeypatch.setattr(BulletWorld, "call_around_substeps", also_rub)
    return modes


def on_slope(blender, azimuth):
    """A flat block on a slope of 25° that falls towards an azimuth, and its axes: way, across, normal as columns."""
    blender.ops.wm.read_factory_settings(use_empty=True)
    blocks = Blocks(substeps_per_frame=80, solver_iterations=50)
    sine, cosine = math.sin(SLOPE), math.cos(SLOPE)
    normal = np.array([sine * math.cos(azimuth), sine * math.sin(azimuth), cosine])
    way = np.array([cosine * math.cos(azimuth), cosine * math.sin(azimuth), -sine])
    ground = blocks.block((0, 0, 0), size_m=(60, 60, 1))
    body = blocks.block(tuple(0.6 * normal), 100.0, size_m=(1, 1, 0.2))
    for each in (ground, body):
        each.rotation_euler = (0.0, SLOPE, azimuth)
        each.rigid_body.friction = FRICTION**0.5
    return blocks, np.column_stack((way, np.cross(normal, way), normal))


@pytest.mark.parametrize("azimuth", [0.0, SIDE, math.radians(45.0)])
def test_a_block_slides_down_a_slope_as_coulomb_says(blender, tmp_path, rubbing, azimuth):
    """s = (sin α - μ cos α) g t² / 2, within 1 % after 3 m in any direction of the axes that Bullet takes."""
    blocks, axes = on_slope(blender, azimuth)
    results = blocks.play(tmp_path, 52)
    times, way = results.frames.time_s, (results.frames.positions_m[:, 1] - results.frames.positions_m[0, 1]) @ axes
    down = 0.5 * STANDARD_GRAVITY_M_S2 * (math.sin(SLOPE) - FRICTION * math.cos(SLOPE)) * (times - times[0]) ** 2
    assert way[-1, 0] > 3.0
    assert way[-1, 0] == pytest.approx(down[-1], rel=0.01)
    assert abs(way[-1, 1]) < 0.01 * way[-1, 0]


def test_the_settings_of_blender_come_back(blender, tmp_path, rubbing):
    blocks, _ = on_slope(blender, 0.0)
    blocks.play(tmp_path, 2)
    assert rubbing
    address = find_dynamics_world(platform_layout(), blocks.world)
    assert read_value(address + platform_layout().world.mode, "i") == ONE_DIRECTION != TWO_DIRECTIONS
