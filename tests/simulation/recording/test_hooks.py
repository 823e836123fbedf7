# SPDX-License-Identifier: GPL-3.0-or-later
"""A block on a sling, in Blender's own simulation, whose support is taken away: the load on the hook of the crane."""

import math

import numpy as np
import pytest
from support.blocks import Blocks
from support.long_cases import long_but

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.changes.removals import LiftingAway
from bridge_demolition_addon.model.lifts import Pick, sling_of
from bridge_demolition_addon.model.scenario import Lift, Removal
from bridge_demolition_addon.scene.bodies import mark_member
from bridge_demolition_addon.scene.custom_properties import keep_tables, run_tables_of

MASS_KG = 1000.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2
FREE_S, LIFT_S = 1.5, 3.5


def lifted_block(folder, pretension):
    """Return the cable, the lift and the results of a block on another one that is taken away before it is lifted."""
    blocks = Blocks(substeps_per_frame=20, solver_iterations=50)
    blocks.block((0, 0, -0.5), size_m=(10, 10, 1))
    names = {"below": blocks.block((0, 0, 0.5), MASS_KG), "part": blocks.block((0, 0, 1.5), MASS_KG)}
    for name, body in names.items():
        mark_member(body, name, "block")
    lift = Lift(
        name="pick",
        members=("part",),
        from_s=0.0,
        lift_s=LIFT_S,
        capacity_kg=2000.0,
        pretension=pretension,
        diameter_mm=10.0,
    )
    sling = sling_of(lift, 1, (0.0, 0.0, 2.0), (0.0, 0.0, 12.0), pretension * WEIGHT_N, Pick("pick", MASS_KG, MASS_KG))
    keep_tables(blocks.scene, "pulls", [sling])
    away = LiftingAway(time_s=LIFT_S, name="pick", members=("part",))
    changes = (Removal(time_s=FREE_S, members=("below",)), away)
    keep_tables(blocks.scene, "changes", changes)
    assert run_tables_of(blocks.scene, "pulls") == (sling,) and run_tables_of(blocks.scene, "changes") == changes
    results = blocks.play(folder, 24 * 4)
    return blocks.recording.pulls, lift, results


@pytest.mark.parametrize("pretension", long_but([0.5], [0.0, 0.5, 1.0]))
def test_a_part_that_comes_free_suddenly_pulls_with_up_to_twice_what_it_had_not_taken_up(blender, tmp_path, pretension):
    """A linear spring: W (2 - p) at most, and p W before. 5 %: its steps damp it."""
    pulls, lift, _ = lifted_block(tmp_path, pretension)
    (hook,) = pulls.hooks.summary()
    assert hook["name"] == lift.name and hook["weight_N"] == pytest.approx(WEIGHT_N)
    assert hook["largest_hook_N"] / WEIGHT_N == pytest.approx(2.0 - pretension, rel=0.05)
    (cable,) = pulls.cables
    course = np.array(cable.course)
    before = course[(course[:, 0] > 1.2) & (course[:, 0] < FREE_S - 0.05)]
    np.testing.assert_allclose(before[:, 1], pretension * WEIGHT_N, rtol=0.02, atol=20.0)
    # It swings by its weight, with the first half of a period until the largest: π √(m L / EA).
    if pretension < 1.0:
        half_s = math.pi * math.sqrt(MASS_KG * 10.0 / lift.elastic_n)
        assert hook["largest_hook_s"] == pytest.approx(FREE_S + half_s, abs=0.05)
    assert cable.ended == "its body was removed" and cable.ended_s == pytest.approx(LIFT_S, abs=0.05)


def test_what_is_lifted_away_does_no_work_any_more(blender, tmp_path):
    """It keeps the velocity of the sub-step before, by which its weight of 9.8 kN would work 200 J in each sub-step."""
    _, _, results = lifted_block(tmp_path, 1.0)
    after, work = results.frames.time_s > LIFT_S + 0.1, results.frames.work
    for energy_j in (work.gravity_j, work.loads_j, work.made_by_contacts_j, work.made_by_lifting_j):
        assert np.abs(energy_j[after]).sum() < 0.1
