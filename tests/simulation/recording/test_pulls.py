# SPDX-License-Identifier: GPL-3.0-or-later
"""Cables that are reeled in, in Blender's own simulation, against Hooke's law, friction, and statics of what tips."""

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.pulls import Pull
from bridge_demolition_addon.model.scenario import Removal
from bridge_demolition_addon.scene.bodies import mark_member
from bridge_demolition_addon.scene.custom_properties import keep_tables, run_tables_of

MASS_KG = 1000.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2
STIFFNESS_N = 1e6
KEYS = {
    "name": "cable",
    "point_m": (0.5, 0.0, 0.1),
    "anchor_m": (20.5, 0.0, 0.1),
    "start_s": 0.25,
    "speed_m_s": 0.2,
    "largest_force_n": 100e3,
    "breaking_force_n": 200e3,
    "stiffness_n": STIFFNESS_N,
}


def pulled_block(folder, friction, seconds, size_m=(1, 1, 0.2), changes=(), **keys):
    """Return results and cable of a block on the ground that is pulled along x."""
    blocks = Blocks(substeps_per_frame=20, solver_iterations=50)
    ground = blocks.block((0, 0, -0.5), size_m=(40, 20, 1))
    block = blocks.block((0, 0, size_m[2] / 2.0), MASS_KG, size_m)
    mark_member(block, "block", "pier")
    for body, value in ((ground, 1.0), (block, friction)):
        body.rigid_body.friction = value
    keep_tables(blocks.scene, "pulls", [Pull(**(KEYS | keys))])
    keep_tables(blocks.scene, "changes", changes)
    results = blocks.play(folder, round(24 * seconds))
    return results, blocks.recording.pulls


def test_a_cable_that_moves_nothing_pulls_by_its_stiffness(blender, tmp_path):
    """EA / L₀ · Δ with L₀ = L - v t: 20 m, 1 MN, 0.2 m/s."""
    _, pulls = pulled_block(tmp_path, 2.0, 1.25)
    (course,) = (np.array(cable.course) for cable in pulls.cables)
    reeled_m = 0.2 * np.clip(course[:, 0] - 0.25, 0.0, None)
    # The force of a sub-step is that at its end. The ground gives way by as much as contacts of Bullet do.
    np.testing.assert_allclose(course[:, 1], STIFFNESS_N * reeled_m / (20.0 - reeled_m), rtol=0.01, atol=20.0)
    assert course[-1, 1] > 9e3


@pytest.mark.long
def test_the_work_of_a_cable_is_what_a_block_has_and_what_friction_took(blender, tmp_path):
    """½ m v² + μ m g s; it slides at the speed of the winch at last, against μ m g."""
    friction = 0.5
    results, pulls = pulled_block(tmp_path, friction, 6.0)
    (cable,) = pulls.cables
    slid_m = results.frames.positions_m[-1, 1, 0] - results.frames.positions_m[0, 1, 0]
    speed_m_s = results.frames.velocities_m_s[-1, 1, 0]
    assert slid_m > 0.5
    took_j = 0.5 * MASS_KG * speed_m_s**2 + friction * WEIGHT_N * slid_m
    # 2 %: friction of Bullet acts where contacts are found once in a sub-step.
    assert cable.work_j == pytest.approx(took_j, rel=0.02)
    # What was reeled in is the way of the block and the stretch of the cable.
    reeled_m = slid_m + cable.length_m - cable.free_m
    assert reeled_m == pytest.approx(0.2 * 5.75, rel=1e-3)


@pytest.mark.parametrize(("part", "tips"), [(0.95, False), (1.05, True)])
def test_a_column_tips_where_the_moment_of_the_cable_is_more_than_that_of_its_weight(blender, tmp_path, part, tips):
    """F h = W b / 2, with the cable level at its top: h = 4 m, b = 1 m."""
    most_n = part * WEIGHT_N * 0.5 / 4.0
    results, _ = pulled_block(
        tmp_path,
        1.0,
        6.0,
        size_m=(1, 1, 4),
        point_m=(0.5, 0.0, 4.0),
        anchor_m=(200.0, 0.0, 4.0),
        speed_m_s=None,
        growth_n_s=most_n,
        largest_force_n=most_n,
    )
    upright = results.frames.rotations[-1, 1, 2, 2]
    assert (upright < 0.5) if tips else (upright > 0.9999)


def test_a_cable_breaks_at_its_force_and_lets_go(blender, tmp_path):
    """5 kN at 20 kN/s from 0.25 s on: at 0.5 s, with F² L / 2 EA = 249 J; the block has moved nowhere."""
    results, pulls = pulled_block(tmp_path, 2.0, 1.0, speed_m_s=None, growth_n_s=20e3, breaking_force_n=5e3)
    (cable,) = pulls.cables
    assert cable.ended == "broke"
    assert cable.ended_s == pytest.approx(0.5, abs=0.01)
    assert cable.let_go_j == pytest.approx(0.5 * 5e3**2 * 20.0 / STIFFNESS_N, rel=0.02)
    (summary,) = pulls.summary()
    times, forces = (np.array(summary["course"][name]) for name in ("time_s", "force_N"))
    assert (forces[times > 0.55] == 0.0).all() and forces.max() == pytest.approx(5e3, rel=0.2)
    assert abs(results.frames.positions_m[-1, 1, 0] - results.frames.positions_m[0, 1, 0]) < 0.01


def test_a_winch_pays_out_at_its_largest_force(blender, tmp_path):
    _, pulls = pulled_block(tmp_path, 2.0, 2.0, largest_force_n=8e3)
    (cable,) = pulls.cables
    # 8 kN are 0.159 m at 0.2 m/s.
    assert cable.held_s == pytest.approx(0.25 + 20.0 * 8e3 / (STIFFNESS_N + 8e3) / 0.2, abs=0.02)
    assert cable.force_n == cable.largest_n == 8e3


def test_a_cable_on_what_is_taken_away_lets_go(blender, tmp_path):
    _, pulls = pulled_block(tmp_path, 2.0, 1.0, changes=[Removal(time_s=0.75, members=("block",))])
    (cable,) = pulls.cables
    assert cable.ended == "its body was removed" and cable.ended_s == pytest.approx(0.75, abs=0.05)


def test_cables_are_kept_with_the_scene(blender):
    blocks = Blocks()
    pulls = (Pull(**KEYS), Pull(**(KEYS | {"name": "other", "diameter_mm": 30.0, "stiffness_n": None})))
    keep_tables(blocks.scene, "pulls", pulls)
    assert run_tables_of(blocks.scene, "pulls") == pulls


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"growth_n_s": 1e4}, "pulls.speed_m_s and pulls.growth_n_s are given together"),
        ({"speed_m_s": None}, "has no speed_m_s or growth_n_s"),
        ({"stiffness_n": None}, "has no diameter_mm or stiffness_n"),
        ({"anchor_m": (0.5, 0.0, 0.2)}, "anchor_m is .*expected a point 0.5 m or more from pulls.point_m"),
        ({"stiffness_n": 1e5}, "stiffness_n is 100000: expected a cable that its force"),
        ({"largest_force_n": 0.0}, "largest_force_n is 0"),
        ({"lowest_corner_m": (0.0, 0.0, 0.0)}, "highest_corner_m"),
    ],
)
def test_what_is_no_cable_is_refused(keys, message):
    with pytest.raises(ScenarioError, match=message):
        Pull(**(KEYS | keys))
