# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole runs: the span of the example falls as it should, and what is written down is what happened."""

import csv
import json
import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.scenarios import I235, SHORT_RUN

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.bridge import deck_underside
from bridge_demolition_addon.model.results.arrays import BALLS_FILE, FRAMES_FILE, INVENTORY_FILE, load_results
from bridge_demolition_addon.model.scenario.file import read_scenario


def run(scenario, folder, pictures=False):
    from bridge_demolition_addon.simulation.run import run_scenario

    summary = run_scenario(scenario, folder, overwrite=False, pictures=pictures, progress=Silence())
    return summary, load_results(folder / "results.npz")


@pytest.fixture(scope="module")
def span(tmp_path_factory):
    """The example as it is, once for all tests that look at it."""
    folder = tmp_path_factory.mktemp("span") / "run"
    return folder, *run(I235, folder)


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.long
def test_shards_weigh_what_the_bridge_weighs(span):
    _, summary, results = span
    # Blender keeps each mass in single precision; the errors of 200 roundings mostly cancel.
    assert summary["mass_kg"]["shard"] == pytest.approx(107_000.0, rel=1e-6)
    assert len(results.inventory.of_kind("shard")) == 200


def test_members_shapes_and_scenario_are_kept(span):
    folder, _, results = span
    shards = results.inventory.of_kind("shard")
    assert set(results.inventory.body_member_kinds[shards]) == {"deck", "pier", "pier cap"}
    deck = shards[results.inventory.body_members[shards] == "deck"]
    corners = np.concatenate(
        [results.inventory.vertices_of(body) + results.frames.positions_m[0, body] for body in deck]
    )
    # The deck is 14 m long with its overhangs, 8.5 m wide and 0.25 m thick.
    np.testing.assert_allclose(np.ptp(corners, axis=0), (14.0, 8.5, 0.25), atol=1e-5)
    assert read_scenario(folder / "scenario_as_run.toml") == I235


def test_deck_stands_until_the_ball_hits(span):
    """Bullet wakes the bridge when the ball's bounding box meets the deck's, one sub-step or two before they touch."""
    _, summary, results = span
    hit = int(np.flatnonzero(results.frames.number == summary["impact"]["frame"])[0])
    shards = results.inventory.of_kind("shard")
    moved = abs(results.frames.positions_m[:hit, shards] - results.frames.positions_m[0, shards])
    assert (moved[:-1] == 0.0).all()
    assert moved.max() < 1e-3
    assert results.frames.intact[:hit].all()
    assert not results.frames.intact[hit].all()


def test_ball_falls_freely_until_it_hits(span):
    """Bullet adds gravity to the velocity once a sub-step, so velocity is exact and distance a half sub-step ahead."""
    _, summary, results = span
    ball = results.inventory.of_kind("ball")[0]
    time = results.frames.time_s - I235.ball.release_time_s
    falling = (time > I235.time.step.substep_s) & (results.frames.time_s < summary["impact"]["time_s"] - 1e-9)
    np.testing.assert_allclose(
        results.frames.velocities_m_s[falling, ball, 2], -STANDARD_GRAVITY_M_S2 * time[falling], rtol=1e-5
    )
    hit = summary["impact"]["time_s"]
    frame = I235.time.step.frame_s
    assert hit - frame <= I235.ball.release_time_s + I235.ball.fall_time_s <= hit + 1e-6


def test_deck_falls_and_ball_goes_through(span):
    _, summary, results = span
    ball = results.inventory.of_kind("ball")[0]
    assert results.frames.positions_m[-1, ball, 2] < deck_underside(I235.bridge)
    shards = results.inventory.of_kind("shard")
    on_deck = shards[results.frames.positions_m[0, shards, 2] > deck_underside(I235.bridge)]
    assert len(on_deck) > 100
    # Within 3 s over 20 seeds, half of the deck came down by 2.4 m or more, and 39 to 71 % of the connections broke.
    fallen = results.frames.positions_m[0, on_deck, 2] - results.frames.positions_m[-1, on_deck, 2]
    assert np.median(fallen) > 2.0
    assert summary["connections"]["broken"] > 0.15 * summary["connections"]["count"]


def test_no_shard_falls_through_the_ground(span):
    """Shards lose their foundation and their neighbours, and meet both again."""
    _, _, results = span
    assert results.frames.positions_m[-1, results.inventory.of_kind("shard"), 2].min() > 0.0


def test_logs_hold_what_was_recorded(span):
    folder, summary, results = span
    forces = rows(folder / "force_log.csv")
    assert len(forces) == len(results.frames) * len(results.inventory.body_names)
    logged = np.array([[float(row[f"force_{axis}_N"]) for axis in ("x", "y", "z", "sum")] for row in forces])
    expected = np.dstack((results.frames.loads.body_forces_n, results.frames.loads.body_sums_n))
    # Nine digits are written, and seven kept: single precision rounds by 6e-8.
    np.testing.assert_allclose(logged, expected.reshape(-1, 4), rtol=1e-7, atol=1e-8)
    debris = rows(folder / "debris_log.csv")
    count = len(results.inventory.body_names)
    assert [row["body"] for row in debris] == 2 * results.inventory.body_names.tolist()
    assert {int(row["frame"]) for row in debris[:count]} == {int(results.frames.number[0])}
    assert {int(row["frame"]) for row in debris[count:]} == {int(results.frames.number[-1])}
    positions = np.array([[float(row[f"{axis}_m"]) for axis in "xyz"] for row in debris]).reshape(2, count, 3)
    np.testing.assert_allclose(positions, results.frames.positions_m[[0, -1]], rtol=1e-7, atol=1e-8)
    throws = [float(row["throw_m"]) for row in debris[count:] if row["body"].startswith("Shard")]
    assert max(throws) == pytest.approx(summary["largest_throw"]["throw_m"], rel=1e-6)


def test_summary_is_what_was_returned(span):
    folder, summary, results = span
    assert json.loads((folder / "summary.json").read_text(encoding="utf-8")) == summary
    over_time = summary["connections"]["over_time"]
    assert (over_time["time_s"][0], over_time["time_s"][-1]) == tuple(results.frames.time_s[[0, -1]])
    assert all(
        a + b == summary["connections"]["count"] for a, b in zip(over_time["intact"], over_time["broken"], strict=True)
    )
    assert np.all(np.diff(over_time["broken"]) >= 0)
    # Bullet's own sub-steps are in single precision.
    assert summary["simulated_s"] == pytest.approx(I235.time.duration_s, rel=1e-6)


def test_saved_scene_plays_what_was_recorded(span, blender):
    folder, _, results = span
    blender.ops.wm.open_mainfile(filepath=str(folder / "scene.blend"))
    scene = blender.context.scene
    for step in (5, len(results.frames) - 1, 40):
        scene.frame_set(int(results.frames.number[step]))
        graph = blender.context.evaluated_depsgraph_get()
        for body in (1, 50, 150):
            name = str(results.inventory.body_names[body])
            position = blender.data.objects[name].evaluated_get(graph).matrix_world.translation
            # The cache keeps single precision.
            np.testing.assert_allclose(position, results.frames.positions_m[step, body], atol=1e-5)


def test_files_of_a_run_that_has_ended_are_let_go_of(tmp_path):
    """None of them is mapped or open: Windows removes no such file."""
    run(SHORT_RUN, tmp_path / "run")
    assert not any((tmp_path / "run" / name).exists() for name in (FRAMES_FILE, BALLS_FILE, INVENTORY_FILE))
    if sys.platform.startswith("linux"):
        open_files = [os.readlink(path) for path in Path("/proc/self/fd").iterdir() if path.is_symlink()]
        mapped = Path("/proc/self/maps").read_text(encoding="utf-8")
        assert str(tmp_path) not in "\n".join([*open_files, mapped])


@pytest.mark.long
def test_same_scenario_gives_the_same_logs(tmp_path):
    short = replace(
        I235, time=replace(I235.time, duration_s=1.0), ball=replace(I235.ball, drop_height_m=0.5, release_time_s=0.1)
    )
    for name in ("first", "second"):
        summary, _ = run(short, tmp_path / name)
        assert summary["connections"]["broken"] > 0
    for log in ("force_log.csv", "debris_log.csv"):
        assert (tmp_path / "first" / log).read_bytes() == (tmp_path / "second" / log).read_bytes()


@pytest.mark.long
def test_awake_bridge_stands_where_its_strength_suffices_and_hands_its_weight_to_the_ground(tmp_path):
    awake = replace(
        I235,
        ball=None,
        time=replace(I235.time, duration_s=3.0),
        shards=replace(I235.shards, start_deactivated=False, use_deactivation=False),
        connections=replace(I235.connections, breaking_force_kgf=50_000),
    )
    summary, results = run(awake, tmp_path / "run")
    assert summary["connections"]["broken"] == 0
    assert summary["impact"] is None
    sag = (results.frames.positions_m[0] - results.frames.positions_m[-1])[:, 2].max()
    assert sag < 0.05
    ground = results.inventory.of_kind("ground")[0]
    weight = 107_000.0 * STANDARD_GRAVITY_M_S2
    # The last swaying of the deck, damped by 4 % a second, is still in it.
    assert results.frames.loads.body_forces_n[-1, ground, 2] == pytest.approx(-weight, rel=1e-3)


@pytest.mark.long
def test_pictures_show_before_impact_and_after(tmp_path):
    from matplotlib.image import imread

    small = replace(
        I235,
        time=replace(I235.time, duration_s=1.0),
        ball=replace(I235.ball, drop_height_m=0.5, release_time_s=0.1),
        pictures=replace(I235.pictures, width_px=160, height_px=90),
    )
    run(small, tmp_path / "run", pictures=True)
    pictures = [imread(tmp_path / "run" / "frames" / f"{name}.png") for name in ("before", "impact", "after")]
    assert all(picture.shape[:2] == (90, 160) and picture.std() > 0.02 for picture in pictures)
    assert abs(pictures[0] - pictures[1]).max() > 0.1
    assert abs(pictures[1] - pictures[2]).max() > 0.1


def test_a_run_says_that_bodies_have_values_of_their_own(tmp_path):
    """Of a scenario of earlier versions, with what it left out as it was: 0.8 for the ground and 0.5 for the ball."""
    from bridge_demolition_addon.simulation.run import run_scenario

    class Noted(Silence):
        def __init__(self):
            self.stages = []

        def stage(self, text):
            self.stages.append(text)

    noted = Noted()
    earlier = replace(
        SHORT_RUN, shards=replace(SHORT_RUN.shards, friction=0.6), time=replace(SHORT_RUN.time, duration_s=0.1)
    )
    run_scenario(earlier, tmp_path / "run", overwrite=False, pictures=False, progress=noted)
    given = "for single bodies, as in older files: shard 0.6 and 0, ball 0.5 and 0, ground 0.8 and 0"
    assert any(given in stage for stage in noted.stages)
    assert read_scenario(tmp_path / "run" / "scenario_as_run.toml") == earlier
