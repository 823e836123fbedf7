# SPDX-License-Identifier: GPL-3.0-or-later
"""Connections hold and break at the force they are given, whatever the time step."""

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.engineering.timing.timeline import TimeStep
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.scene.connections.constraints import rewrite_thresholds, set_breaking_force

MASS_KG = 100.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2

STEPS = (
    {"frames_per_second": 24, "substeps_per_frame": 10},
    {"frames_per_second": 60, "substeps_per_frame": 1},
    {"frames_per_second": 30, "frames_per_second_base": 1.001, "substeps_per_frame": 7},
    {"frames_per_second": 25, "substeps_per_frame": 20, "time_scale": 0.1},
)


@pytest.mark.parametrize("step", STEPS, ids=("24 × 10", "60 × 1", "29.97 × 7", "slow motion"))
@pytest.mark.parametrize("kind", ("FIXED", "POINT", "HINGE"))
@pytest.mark.parametrize(("share", "holds"), ((0.95, False), (1.05, True)))
def test_hanging_block(blender, tmp_path, kind, step, share, holds):
    blocks = Blocks(**step)
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG)
    blocks.connect(kind, (0, 0, 9.5), ceiling, block, share * WEIGHT_N)
    results = blocks.play(tmp_path, 24)
    assert bool(results.frames.intact[-1][0]) is holds
    sunk = 9.0 - results.frames.positions_m[-1, 1, 2]
    if holds:
        assert sunk < 1e-3
        assert results.frames.loads.connection_forces_n[-1][0, 2] == pytest.approx(-WEIGHT_N, rel=1e-4)
    else:
        elapsed = results.frames.time_s[-1]
        # It falls freely from the second sub-step on at the latest; half g·t² is what an ideal fall would give.
        assert sunk == pytest.approx(STANDARD_GRAVITY_M_S2 * elapsed**2 / 2, rel=0.1)
        np.testing.assert_array_equal(results.frames.loads.connection_forces_n[-1], 0.0)


CHANGES = (
    {"substeps_per_frame": 40},
    {"fps": 60},
    {"fps_base": 2.0},
    {"time_scale": 0.25},
    {"substeps_per_frame": 3, "fps": 48, "time_scale": 0.5},
)


def change_step(scene, change):
    world = scene.rigidbody_world
    for name, value in change.items():
        setattr(scene.render if name.startswith("fps") else world, name, value)


def hanging(share):
    blocks = Blocks()
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG)
    connection = blocks.connect("FIXED", (0, 0, 9.5), ceiling, block)
    set_breaking_force(connection, share * WEIGHT_N, TimeStep(24, 1.0, 10, 1.0))
    return blocks


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: ", ".join(change))
@pytest.mark.parametrize(("share", "holds"), ((0.95, False), (1.05, True)))
def test_a_force_stays_what_it_is_when_the_step_changes(blender, tmp_path, share, holds, change):
    blocks = hanging(share)
    change_step(blocks.scene, change)
    assert bool(blocks.play(tmp_path, 24).frames.intact[-1][0]) is holds


def test_nothing_is_written_where_the_step_is_the_same(blender):
    blocks = hanging(1.0)
    assert not rewrite_thresholds(blocks.scene)
    change_step(blocks.scene, {"fps": 25})
    assert rewrite_thresholds(blocks.scene)
    assert not rewrite_thresholds(blocks.scene)


def test_thresholds_that_somebody_set_stay(blender):
    blocks = Blocks()
    by_hand = blocks.connect("FIXED", (0, 0, 9.5), blocks.block((0, 0, 10)), blocks.block((0, 0, 9), 1.0), 240.0)
    change_step(blocks.scene, {"fps": 60})
    assert not rewrite_thresholds(blocks.scene)
    assert by_hand.rigid_body_constraint.breaking_threshold == 1.0
