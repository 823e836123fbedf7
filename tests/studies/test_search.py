# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches in Blender whose answer is known: the mass at which a block tears off what it hangs on."""

import json

import numpy as np
import pytest
import trimesh

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.search.neyer import NeyerTest
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.search.file import read_search

pytestmark = pytest.mark.long

SIDE_M, NECK_M, GRAVITY_M_S2 = 1.0, 0.1, 9.80665
VARIATION = 0.2
SPREAD = float(np.sqrt(np.log(1.0 + VARIATION**2)))

SCENARIO = """
[scenario]
title = "A block that hangs"
[time]
duration_s = 0.3
frames_per_second = 24
[fracture]
shards = 2
[[geometry]]
name = "hook"
file = "hook.obj"
density_kg_m3 = 2400
[[geometry]]
name = "block"
file = "block.obj"
density_kg_m3 = 2400
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
[[supports]]
member = "hook"
[shards]
use_deactivation = false
start_deactivated = false
"""
SEARCH = """
[search]
scenario = "scenario.toml"
key = "geometry.block.density_kg_m3"
lowest = {lowest}
highest = {highest}
logarithmic = true
spread = 0.3
trials = {trials}
seed = 4
{more}
[[vary]]
key = "connections.strength_factor"
distribution = "lognormal"
median = 1.0
variation = 0.2
[[criteria]]
name = "it falls"
kind = "collapsed"
share = 0.01
"""


def search_file(folder, trials=40, lowest=800, highest=16000, more=""):
    """Write a search, the scenario and its meshes."""
    folder.mkdir(exist_ok=True)
    for name, size, height in (("hook", NECK_M, 10.0 + NECK_M / 2.0), ("block", SIDE_M, 10.0 - SIDE_M / 2.0)):
        mesh = trimesh.creation.box((size, size, size))
        mesh.apply_translation((0.0, 0.0, height))
        mesh.export(folder / f"{name}.obj")
    (folder / "scenario.toml").write_text(SCENARIO, encoding="utf-8")
    path = folder / "search.toml"
    path.write_text(SEARCH.format(trials=trials, lowest=lowest, highest=highest, more=more), encoding="utf-8")
    return path


def torn_off_at_kg_m3():
    """Density at which the stress in the neck of the median strength is that strength."""
    return MATERIALS["concrete"].tension_pa * NECK_M**2 / (GRAVITY_M_S2 * SIDE_M**3)


def test_median_and_spread_of_a_known_strength_are_found(tmp_path, capfd):
    path, output = search_file(tmp_path), tmp_path / "out"
    assert main(["search", str(path), "--output", str(output), "--jobs", "2"]) == 0
    answer = json.loads((output / "search.json").read_text(encoding="utf-8"))
    assert answer["trials"] == 40 and answer["ended_as"] == "all runs were made"
    low, high = answer["median_limits"]
    assert low <= torn_off_at_kg_m3() <= high < 2.0 * low
    assert answer["limit"] >= torn_off_at_kg_m3() * np.exp(1.2816 * SPREAD)
    # Of 40 trials the spread comes out within a factor of two in all but a few of a hundred.
    assert 0.5 * SPREAD < answer["spread"] < 2.0 * SPREAD
    said = capfd.readouterr().out
    assert "geometry.block.density_kg_m3: half of all runs meet them at" in said
    for name in ("trials.csv", "curve.csv", "curve.png"):
        assert (output / name).stat().st_size > 0 and name in said
    trials = (output / "trials.csv").read_text(encoding="utf-8").splitlines()
    assert len(trials) == 41
    # Every run is as its own strength says, which is sampled for it alone.
    head = trials[0].split(",")
    factor, density, fell = (
        head.index(next(column for column in head if column.startswith(name)))
        for name in ("in.connections.strength_factor", "in.geometry.block.density_kg_m3", "out.success")
    )
    for row in [trial.split(",") for trial in trials[1:]]:
        used = float(row[density]) / (torn_off_at_kg_m3() * float(row[factor]))
        assert (used > 1.0) == (row[fell] == "true") or used == pytest.approx(1.0, abs=0.01)


def test_a_search_goes_on_where_it_was_stopped_and_does_not_depend_on_how_many_run(tmp_path):
    path = search_file(tmp_path, trials=12)
    whole = tmp_path / "whole"
    assert main(["search", str(path), "--output", str(whole), "--jobs", "1", "--quiet"]) == 0
    halved = tmp_path / "halved"
    assert main(["search", str(path), "--output", str(halved), "--jobs", "2", "--quiet"]) == 0
    draws = sorted((halved / "draws").iterdir())
    for draw in draws[::2]:
        (draw / "outcome.json").unlink()
    assert main(["search", str(path), "--output", str(halved), "--jobs", "2", "--quiet"]) == 0
    for name in ("trials.csv", "search.json", "curve.csv"):
        assert (whole / name).read_bytes() == (halved / name).read_bytes()


def test_what_never_or_always_happens_is_said_after_the_opening_trials(tmp_path, capfd):
    never = search_file(tmp_path / "never", lowest=10, highest=100)
    assert main(["search", str(never), "--output", str(tmp_path / "a"), "--jobs", "1"]) == 0
    assert "0 of 8 runs met all criteria: the criteria were never met in the range" in capfd.readouterr().out
    always = search_file(tmp_path / "always", lowest=50000, highest=90000)
    assert main(["search", str(always), "--output", str(tmp_path / "b"), "--jobs", "1"]) == 0
    said = capfd.readouterr().out
    assert "8 of 8 runs met all criteria: the criteria were always met in the range" in said
    assert "Runs went from 50000 to 90000: move search.lowest" in said


def test_a_search_stops_when_its_limit_is_close_enough(tmp_path):
    path = search_file(tmp_path, trials=40, more="within = 6000.0")
    assert main(["search", str(path), "--output", str(tmp_path / "out"), "--quiet", "--jobs", "1"]) == 0
    answer = json.loads((tmp_path / "out" / "search.json").read_text(encoding="utf-8"))
    assert answer["ended_as"] == "the limit is as close as was asked for" and answer["trials"] < 40
    assert answer["limit"] - answer["value"] <= 6000.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("lowest = 800", "lowest = 0"), "search.lowest is 0"),
        (("highest = 16000", "highest = 700"), "more than search.lowest, 800"),
        (("trials = 40", "trials = 5"), "search.trials is 5"),
        (('key = "geometry.block.density_kg_m3"', 'key = "ball.mass_kg"'), "ball.mass_kg is not in the scenario"),
        (('key = "geometry.block.density_kg_m3"', 'key = "connections.strength_factor"'), "searched along and sampled"),
        (("[[criteria]]", "[[criterion]]"), "criterion"),
        (('scenario = "scenario.toml"', 'scenario = "none.toml"'), "none.toml"),
    ],
)
def test_a_wrong_search_is_refused_in_words(tmp_path, change, said, capfd):
    path = search_file(tmp_path)
    path.write_text(path.read_text(encoding="utf-8").replace(*change), encoding="utf-8")
    with pytest.raises(ScenarioError, match=said.replace(".", r"\.")):
        read_search(path)
    assert main(["search", str(path), "--output", str(tmp_path / "out")]) == 2
    assert not (tmp_path / "out").exists()


def test_levels_stay_in_the_range_and_on_the_steps(tmp_path):
    search = read_search(search_file(tmp_path, more="step = 250.0"))
    scale = search.scale
    test = NeyerTest(*scale.ends, scale.spread, scale.rounded)
    values = [scale.tried(level) for level in test.levels([False] * 20, 21)]
    assert max(values) == 16000.0 and min(values) >= 800.0
    assert all(value % 250.0 == 0.0 for value in values)
