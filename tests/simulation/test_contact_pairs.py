# SPDX-License-Identifier: GPL-3.0-or-later
"""Friction and restitution of each pair of bodies that can meet, in Blender's own simulation: Coulomb, and e² h.

A scenario with all kinds of bodies is built. What its bodies have there is given to slabs, and to what slides and
falls on them.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks
from support.scenarios import I235

from bridge_demolition_addon.engineering.mechanics.contact_pairs import slowest_bounce_m_s
from bridge_demolition_addon.model.scenario import ContactSettings, GroundSurface, Jackhammer
from bridge_demolition_addon.model.scenario.contacts import (
    BallContact,
    GroundContact,
    ShardContact,
    SurfaceContact,
    ToolContact,
)
from bridge_demolition_addon.model.sequence.checked_model import checked_model

CONTACTS = ContactSettings(
    shards=ShardContact(friction=0.5, restitution=0.25),
    ground=GroundContact(friction=0.4, restitution=0.4),
    ball=BallContact(friction=0.3, restitution=0.6),
    tools=ToolContact(friction=0.6, restitution=0.3),
    surfaces=SurfaceContact(friction=0.2, restitution=0.2),
)
PAIRS = {
    ("shard", "shard"): (0.5, 0.25),
    ("shard", "ground"): (0.4, 0.4),
    ("shard", "ball"): (0.3, 0.6),
    ("shard", "tool"): (0.6, 0.3),
    ("shard", "river"): (0.2, 0.2),
    ("ball", "ground"): (0.3 * 0.4 / 0.5, 0.6 * 0.4 / 0.25),
    ("ball", "river"): (0.3 * 0.2 / 0.5, 0.6 * 0.2 / 0.25),
    ("ball", "tool"): (0.3 * 0.6 / 0.5, 0.6 * 0.3 / 0.25),
}
"""Friction and restitution; those of the ball follow, as Bullet multiplies."""

FAR_M = 4.0
"""From lane to lane, one for each pair."""


@pytest.fixture
def values(blender):
    """Friction and restitution that Blender has of one body of each kind."""
    from bridge_demolition_addon.scene.bodies import bodies_of, kind_of, member_of
    from bridge_demolition_addon.scene.demolition import build_demolition

    river = GroundSurface(name="river", kind="water", height_m=0.1, corners_m=((20, 20), (30, 20), (30, 30)))
    hammer = Jackhammer(start_time_s=0.0, end_time_s=1.0, path_m=((6.5, 0.0),), stroke_m=0.2, depth_m=0.1)
    scenario = replace(
        I235,
        contacts=CONTACTS,
        ground=replace(I235.ground, surfaces=(river,)),
        jackhammers=(hammer,),
        fracture=replace(I235.fracture, shards=14),
    )
    scene = blender.context.scene
    build_demolition(scene, scenario, checked_model(scenario))
    bodies = {
        ("river" if member_of(body)[0] == "river" else kind_of(body)): body.rigid_body for body in bodies_of(scene)
    }
    found = {kind: (rigid.friction, rigid.restitution) for kind, rigid in bodies.items()}
    blender.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    return found


def test_what_slides_down_a_slope_has_the_friction_of_the_pair(values, tmp_path):
    """Gravity leans, so that each slides by a t² / 2 with a = g_x - μ g_z; 1 %, as in other tests of blocks."""
    blocks = Blocks(substeps_per_frame=20, solver_iterations=50)
    along, down = 8.0, 9.8
    blocks.scene.gravity = (along, 0.0, -down)
    for lane, (upper, lower) in enumerate(PAIRS):
        y = FAR_M * lane
        slab, block = blocks.block((0, y, -0.5), size_m=(40, 2, 1)), blocks.block((-5, y, 0.1), 100.0, (1, 1, 0.2))
        slab.rigid_body.friction, block.rigid_body.friction = values[lower][0], values[upper][0]
    frames = blocks.play(tmp_path, 24).frames
    for lane, (pair, (friction, _)) in enumerate(PAIRS.items()):
        course = frames.positions_m[:, 2 * lane + 1, 0]
        expected = 0.5 * (along - friction * down) * frames.time_s[-1] ** 2
        assert course[-1] + 5.0 == pytest.approx(expected, rel=0.01), pair


def test_what_falls_bounces_by_the_restitution_of_the_pair(values, tmp_path):
    """A sphere that falls h bounces e² h. It is in the slab by 0.2 mm when Bullet first finds it there, so that it is
    not pushed out either; in the sub-step before it was 40 mm above it, farther than the 17 mm from which Bullet begins
    to slow it down."""
    blocks = Blocks(substeps_per_frame=10, solver_iterations=50)
    substep_s, steps, gravity = 1.0 / 240.0, 235, 9.80665
    fallen_m = gravity * substep_s**2 * steps * (steps + 1) / 2.0
    height_m = fallen_m - 0.0002
    for lane, (upper, lower) in enumerate(PAIRS):
        y = FAR_M * lane
        slab, ball = blocks.block((0, y, -0.5), size_m=(2, 2, 1)), blocks.block((0, y, 0.5 + height_m), 100.0)
        ball.rigid_body.collision_shape = "SPHERE"
        slab.rigid_body.restitution, ball.rigid_body.restitution = values[lower][1], values[upper][1]
        slab.rigid_body.friction = ball.rigid_body.friction = 0.0
    frames = blocks.play(tmp_path, 70).frames
    hit = steps // 10 + 2
    for lane, (pair, (_, restitution)) in enumerate(PAIRS.items()):
        rebound = frames.positions_m[hit:, 2 * lane + 1, 2] - 0.5
        assert rebound.max() == pytest.approx(restitution**2 * height_m, rel=0.02, abs=0.01), pair


def test_bodies_have_what_makes_the_pairs(values):
    """Single precision: 24 binary digits, and a product of two."""
    for (first, second), expected in PAIRS.items():
        products = np.multiply(values[first], values[second])
        assert products == pytest.approx(expected, rel=2.0**-22), (first, second)


def test_nothing_bounces_below_the_speed_that_is_said(blender, tmp_path):
    """Spheres of 1 m with e = 0.5. Up to 0.95 of that speed none rises by 1 % of its fall; of those that are up to
    twice as fast some keep a quarter of their speed."""
    blocks = Blocks(substeps_per_frame=10)
    slowest = slowest_bounce_m_s(0.5, math.sqrt(0.75), 1.0 / 240.0)
    assert slowest == pytest.approx(2.77, abs=0.01)
    speeds = slowest * np.array([0.5, 0.6, 0.7, 0.8, 0.9, 0.95, *np.linspace(1.2, 2.0, 12)])
    heights = speeds**2 / (2.0 * 9.80665)
    slab = blocks.block((0, 0, -0.5), size_m=(200, 200, 1))
    slab.rigid_body.restitution = 1.0
    for lane, height in enumerate(heights):
        ball = blocks.block((FAR_M * lane - 30.0, 0, 0.5 + height), 100.0)
        ball.rigid_body.collision_shape, ball.rigid_body.restitution = "SPHERE", 0.5
    frames = blocks.play(tmp_path, 30).frames
    hits = np.searchsorted(frames.time_s, speeds / 9.80665) + 2
    risen = [frames.positions_m[hit:, lane + 1, 2].max() - 0.5 for lane, hit in enumerate(hits)]
    assert (np.array(risen)[:6] < 0.01 * heights[:6]).all()
    assert np.sqrt(risen / heights).max() > 0.25
