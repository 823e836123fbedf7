# SPDX-License-Identifier: GPL-3.0-or-later
"""Several hits of a ball in a row: each falls freely on its own target, and nothing is flung when it is lifted."""

from dataclasses import replace

import numpy as np
import pytest
from support.blocks import Blocks
from support.scenarios import I235

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.timing.timeline import Timeline
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import deck_top
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.results.summary import summarise
from bridge_demolition_addon.model.scenario import Ball, BallHit
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text

HITS = (
    BallHit(lift_time_s=2.0, lift_duration_s=1.0, release_time_s=3.2, target_m=(3, 1), drop_height_m=2.0),
    BallHit(lift_time_s=5.0, lift_duration_s=1.5, release_time_s=7.0, target_m=(-2, 0), drop_height_m=4.0),
)
BALL = Ball(mass_kg=1000, diameter_m=1.0, target_m=(0, 0), drop_height_m=3.0, release_time_s=0.5, hits=HITS)


def site_of(blocks, height_m=0.0):
    from bridge_demolition_addon.scene.tools.build_site import BuildSite

    return BuildSite(blocks.world, Timeline.of(blocks.time.step.frame_s, 10.0), lambda _: height_m, I235.surface_of)


@pytest.fixture(scope="module")
def hits(tmp_path_factory):
    """Three hits on a slab that yields nothing, with a light block beside the place of the first."""
    import bpy

    from bridge_demolition_addon.scene.tools.ball import create_ball

    bpy.ops.wm.read_factory_settings(use_empty=True)
    blocks = Blocks(substeps_per_frame=30)
    blocks.block((0, 0, -0.5), size_m=(30, 30, 1))
    blocks.block((0.85, 0, 0.25), 10.0, size_m=(0.5, 0.5, 0.5))
    create_ball(site_of(blocks), BALL)
    return blocks.play(tmp_path_factory.mktemp("hits"), blocks.time.step.frames(9.0))


def test_each_hit_falls_freely_on_its_own_target(hits):
    summary = summarise(hits, np.array((0, 0, -STANDARD_GRAVITY_M_S2)))
    found = summary["hits_of_the_ball"]
    assert len(found) == 3
    ball = hits.inventory.of_kind("ball")[0]
    substep = hits.frames.substep_s[-1]
    for hit, drop in zip(found, BALL.drops, strict=True):
        speed = np.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * drop.drop_height_m)
        # The speed before the sub-step of the hit lacks up to that sub-step's gravity.
        assert hit["approach_m_s"] == pytest.approx(speed, rel=1e-3 + STANDARD_GRAVITY_M_S2 * substep / speed)
        assert hit["time_s"] == pytest.approx(drop.release_time_s + drop.fall_time_s, abs=2.0 * substep + 1 / 24)
        # All of the momentum goes into the slab, and no more: it does not bounce.
        assert hit["impulse_Ns"] == pytest.approx(BALL.mass_kg * speed, rel=0.01)
        step = np.searchsorted(hits.frames.time_s, hit["time_s"])
        np.testing.assert_allclose(hits.frames.positions_m[step, ball], (*drop.target_m, 0.5), atol=0.05)
    assert summary["impact"]["time_s"] == pytest.approx(0.5 + BALL.fall_time_s, abs=1 / 24)


def test_ball_reaches_the_deck_as_fast_as_a_free_fall(blender, tmp_path):
    """With short sub-steps: the one of the hit lacks up to its own gravity, here 0.0016 m/s of 4.4."""
    from bridge_demolition_addon.scene.tools.ball import create_ball

    blocks = Blocks(substeps_per_frame=250)
    blocks.block((0, 0, -0.5), size_m=(30, 30, 1))
    create_ball(site_of(blocks), replace(BALL, drop_height_m=1.0, release_time_s=0.0, hits=()))
    results = blocks.play(tmp_path, 12)
    (hit,) = summarise(results, np.array((0, 0, -STANDARD_GRAVITY_M_S2)))["hits_of_the_ball"]
    assert hit["approach_m_s"] == pytest.approx(np.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * 1.0), rel=1e-3)


def test_nothing_is_flung_by_the_lift(hits):
    ball = hits.inventory.of_kind("ball")[0]
    speeds = np.linalg.norm(hits.frames.velocities_m_s, axis=2)
    for hit in HITS:
        lifting = (hits.frames.time_s > hit.lift_time_s) & (
            hits.frames.time_s <= hit.lift_time_s + hit.lift_duration_s + 1 / 24
        )
        begin = np.flatnonzero(lifting)[0]
        way = np.linalg.norm(
            np.diff(hits.frames.positions_m[begin - 1 :, ball][: lifting.sum() + 1], axis=0), axis=1
        ).sum()
        assert speeds[lifting, ball].max() < 1.55 * way / hit.lift_duration_s
        assert np.linalg.norm(hits.frames.positions_m[begin, ball] - hits.frames.positions_m[begin - 1, ball]) < 0.05
        np.testing.assert_allclose(
            hits.frames.positions_m[lifting][-1, ball], (*hit.target_m, hit.drop_height_m + 0.5), atol=1e-3
        )
        block = 1
        assert speeds[lifting, block].max() < 0.5


def test_ball_is_lifted_from_where_it_has_rolled(blender, tmp_path):
    """Blender itself would take it to the guessed place, above the target, in one frame: at 120 m/s from 5 m below."""
    from bridge_demolition_addon.scene.tools.ball import create_ball

    blocks = Blocks()
    blocks.block((0, 0, -10.5), size_m=(30, 30, 1))
    slope = blocks.block((0, 0, -0.5), size_m=(4, 4, 1))
    slope.rotation_euler[1] = 0.5
    settings = replace(BALL, hits=(replace(HITS[0], lift_time_s=4.0, lift_duration_s=3.0, release_time_s=7.5),))
    create_ball(site_of(blocks, 0.6), settings)
    results = blocks.play(tmp_path, 24 * 8)
    row = results.inventory.of_kind("ball")[0]
    lifted = int(np.flatnonzero(results.frames.time_s > 4.02)[0])  # the ball rolls on in the frame up to 4 s
    before = results.frames.positions_m[lifted - 1, row]
    assert before[2] < -9.0 and np.hypot(*before[:2]) > 3.0
    moves = np.linalg.norm(np.diff(results.frames.positions_m[lifted - 1 : lifted + 73, row], axis=0), axis=1)
    assert moves[0] < 0.05
    assert moves.max() < 1.51 * moves.sum() / 72.0
    turns = np.diff(results.frames.rotations[lifted - 1 : lifted + 73, row], axis=0)
    assert abs(turns).max() < 1e-3
    np.testing.assert_allclose(results.frames.positions_m[lifted + 72, row], (3, 1, 0.6 + 2.0 + 0.5), atol=1e-3)


@pytest.mark.long
def test_scenario_with_hits_in_a_row(tmp_path):
    from bridge_demolition_addon.simulation.run import run_scenario

    hit = BallHit(lift_time_s=1.5, lift_duration_s=1.0, release_time_s=2.7, target_m=(3.0, 1.0), drop_height_m=2.0)
    ball = replace(I235.ball, drop_height_m=1.0, release_time_s=0.1, hits=(hit,))
    scenario = replace(I235, time=replace(I235.time, duration_s=3.5), ball=ball)
    assert scenario_from_text(scenario_text(scenario)) == scenario
    summary = run_scenario(scenario, tmp_path / "run", overwrite=False, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run" / "results.npz")
    row = results.inventory.of_kind("ball")[0]
    released = np.searchsorted(results.frames.time_s, 2.7)
    np.testing.assert_allclose(
        results.frames.positions_m[released - 1, row], (3.0, 1.0, deck_top(I235.bridge) + 2.0 + 0.67), atol=1e-3
    )
    assert summary["impact"]["time_s"] == pytest.approx(0.1 + ball.fall_time_s, abs=0.1)


@pytest.mark.parametrize(
    "values, text",
    [
        (
            {"lift_time_s": 1.0},
            r"ball.hits.lift_time_s is 1.0: expected at least 1.2822 \(s\), when the ball that is ",
        ),
        ({"release_time_s": 2.5}, r"ball.hits.release_time_s is 2.5: expected at least 3.04167 \(s\), a frame after"),
        ({"release_time_s": 5.0}, r"ball.hits.release_time_s is 5.0: expected less than time.duration_s, 5.0"),
        ({"target_m": (30, 0)}, r"ball.hits.target_m.1 is 30.0: expected a position on the deck"),
    ],
)
def test_wrong_hits_are_refused(values, text):
    with pytest.raises(ScenarioError, match=text):
        replace(I235, ball=replace(BALL, hits=[replace(HITS[0], **values)]))
