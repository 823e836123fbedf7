# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of Bullet's solver: how many there are in a sub-step, and that enough of them find what statics has."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet.world import BulletWorld
from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli, whole_section_stiffness
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.scene.connections.elasticity import keep_elasticity

CONCRETE, MASS_KG, COUNT, HALF_SUPPORT_M = ElasticModuli(30e9, 0.2), 2400.0, 13, 0.4


def fallen(blender, tmp_path, monkeypatch, passes, least_change_m_s):
    """Positions of a stack of blocks that lands, with so many passes, and fewer once velocities change less."""
    blender.ops.wm.read_factory_settings(use_empty=True)
    blocks = Blocks(solver_iterations=passes)
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    for level in range(3):
        blocks.block((0.1 * level, 0, 0.6 + 1.1 * level), 100.0)
    call = BulletWorld.call_around_substeps

    def also_end_passes(world, *actions):
        call(world, *actions)
        world.end_passes(least_change_m_s)

    monkeypatch.setattr(BulletWorld, "call_around_substeps", also_end_passes)
    folder = Path(tempfile.mkdtemp(dir=tmp_path))
    return blocks.play(folder, 24).frames.positions_m


def test_passes_end_where_nothing_changes_any_more(blender, tmp_path, monkeypatch):
    one = fallen(blender, tmp_path, monkeypatch, 1, 0.0)
    assert (fallen(blender, tmp_path, monkeypatch, 50, 1e6) == one).all()
    many = fallen(blender, tmp_path, monkeypatch, 50, 0.0)
    assert (many != one).any()
    assert (fallen(blender, tmp_path, monkeypatch, 50, 1e-300) == many).all()


def sag_mm(blender, tmp_path, substeps):
    """Sag of a beam of blocks in one row, whose first and last lie loose on others: middle against ends."""
    blender.ops.wm.read_factory_settings(use_empty=True)
    blocks = Blocks(substeps_per_frame=substeps, solver_iterations=1000)
    row = [blocks.block((x, 0, 1.0), MASS_KG) for x in range(COUNT)]
    for x in (0, COUNT - 1):
        blocks.block((x, 0, 0.0), size_m=(2.0 * HALF_SUPPORT_M, 1, 1))  # whose edges lie under no joint
    for body in blocks.world.collection.objects:
        body.rigid_body.friction = 0.0  # which would hold the ends as they turn
    ones, moments = np.ones(COUNT - 1), np.full((COUNT - 1, 2, 2), np.eye(2) / 12.0)
    connections = [blocks.connect("FIXED", (x + 0.5, 0, 1.0), row[x], row[x + 1]) for x in range(COUNT - 1)]
    for connection in connections:
        connection["bda_area_m2"], connection["bda_normal"] = 1.0, (1.0, 0.0, 0.0)
        connection["bda_second_moments_m4"] = moments[0].ravel().tolist()
    stiffness = whole_section_stiffness(CONCRETE.young_pa * ones, CONCRETE.shear_pa * ones, ones, moments, ones)
    keep_elasticity(blocks.scene, connections, stiffness, 0.05)
    heights_m = blocks.play(Path(tempfile.mkdtemp(dir=tmp_path)), 48).frames.positions_m[-1, :COUNT, 2].astype(float)
    return 1e3 * (heights_m[[0, -1]].mean() - heights_m[COUNT // 2])


@pytest.mark.slow
def test_a_beam_that_lies_loose_sags_as_statics_says_however_long_substeps_are(blender, tmp_path):
    """Blocks turn against each other by M / (E I) a metre, and slide by V / (5/6 G A); the inner edges of what the beam
    lies on carry it.

    Within 1 %; without friction, which would hold the ends as they turn. With 10 passes it is off by 30 % at 240
    sub-steps a second, and by 9 % at 480.
    """
    weight_n_m, half_m, reach_m = MASS_KG * STANDARD_GRAVITY_M_S2, COUNT / 2.0, COUNT // 2 - HALF_SUPPORT_M
    joints_m = np.arange(0.5, COUNT / 2.0 - 0.5)  # from the middle
    moments_nm = weight_n_m * half_m * (reach_m - joints_m) - weight_n_m * (half_m - joints_m) ** 2 / 2.0
    turned = moments_nm / (CONCRETE.young_pa / 12.0)
    slid_m = weight_n_m * joints_m / (CONCRETE.shear_pa * 5.0 / 6.0)
    expected_mm = 1e3 * float((turned * (COUNT // 2 - joints_m) + slid_m).sum())
    for substeps in (10, 20, 40):
        assert sag_mm(blender, tmp_path, substeps) == pytest.approx(expected_mm, rel=0.01)
