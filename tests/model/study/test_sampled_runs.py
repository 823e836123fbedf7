# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws of a study: each by itself, the same everywhere, and from the distributions that were asked for."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.study.file import SEED, study_of
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.model.study.settings import StudySettings, Vary

pytestmark = pytest.mark.slow

HEIGHT = Vary(key="ball.drop_height_m", distribution="normal", mean=5.0, deviation=0.3)
MASS = Vary(key="ball.mass_kg", distribution="lognormal", median=1.0, variation=0.1, factor=True)
PLACE = Vary(key="ball.target_m.1", distribution="uniform", lowest=6.0, highest=7.0)
FRICTION = Vary(key="shards.friction", distribution="triangular", lowest=0.4, most_likely=0.6, highest=0.8)
KIND = Vary(key="connections.type", distribution="choice", values=["FIXED", "HINGE", "POINT"])
ALL = (HEIGHT, MASS, PLACE, FRICTION, KIND)


def study(*vary, scenario=I235, **settings):
    return study_of(StudySettings(scenario="i235.toml", vary=vary, **settings), scenario)


def test_a_draw_is_the_scenario_with_its_inputs():
    drawn = sampled_run(study(*ALL), 17)
    assert list(drawn.inputs) == [SEED, *(vary.key for vary in ALL)]
    scenario = drawn.scenario
    assert drawn.inputs == {
        SEED: scenario.seed,
        "ball.drop_height_m": scenario.ball.drop_height_m,
        "ball.mass_kg": scenario.ball.mass_kg,
        "ball.target_m.1": scenario.ball.target_m[0],
        "shards.friction": scenario.shards.friction,
        "connections.type": scenario.connections.type,
    }
    ball = replace(
        I235.ball,
        drop_height_m=scenario.ball.drop_height_m,
        mass_kg=scenario.ball.mass_kg,
        target_m=(scenario.ball.target_m[0], I235.ball.target_m[1]),
    )
    assert scenario == replace(
        I235,
        seed=scenario.seed,
        ball=ball,
        shards=replace(I235.shards, friction=scenario.shards.friction),
        connections=replace(I235.connections, type=scenario.connections.type),
    )


def test_inputs_have_the_distributions_that_were_asked_for():
    whole = study(*ALL)
    drawn = [sampled_run(whole, number).inputs for number in range(1, 3001)]
    columns = {name: [inputs[name] for inputs in drawn] for name in drawn[0]}
    expected = {
        SEED: stats.uniform(0, 2**31),
        "ball.drop_height_m": stats.norm(5.0, 0.3),
        "ball.mass_kg": stats.lognorm(np.sqrt(np.log(1.01)), scale=10_000.0),
        "ball.target_m.1": stats.uniform(6.0, 1.0),
        "shards.friction": stats.triang(0.5, 0.4, 0.4),
    }
    for name, distribution in expected.items():
        assert stats.kstest(columns[name], distribution.cdf).pvalue > 0.01, name
    counts = [columns["connections.type"].count(kind) for kind in KIND.values]
    assert stats.chisquare(counts).pvalue > 0.01
    for one, other in itertools.combinations(expected, 2):
        assert stats.spearmanr(columns[one], columns[other]).pvalue > 0.001, (one, other)


def test_draws_follow_one_another_independently():
    of_heights = study(HEIGHT)
    heights = [sampled_run(of_heights, number).inputs["ball.drop_height_m"] for number in range(1, 3001)]
    for apart in (1, 2, 93):
        assert stats.spearmanr(heights[apart:], heights[:-apart]).pvalue > 0.01


def test_a_draw_depends_neither_on_the_number_of_runs_nor_on_what_else_varies():
    alone, among_others = study(HEIGHT, runs=59, rank=1), study(MASS, PLACE, HEIGHT, runs=1000)
    for number in (1, 59):
        first, second = sampled_run(alone, number).inputs, sampled_run(among_others, number).inputs
        assert first == {name: second[name] for name in first}
    assert sampled_run(study(HEIGHT, seed=1), 1).inputs != sampled_run(alone, 1).inputs
    assert sampled_run(alone, 2).inputs != sampled_run(alone, 1).inputs


def test_the_seed_of_the_fracture_is_drawn_even_where_nothing_varies():
    seeds = [sampled_run(study(), number).inputs for number in range(1, 101)]
    assert {tuple(seed) for seed in seeds} == {(SEED,)}
    assert len({seed[SEED] for seed in seeds}) == 100


def test_draws_are_these_on_every_machine():
    # What numpy promises of PCG64 and SeedSequence, and arithmetic without rounding of its own choice.
    found = sampled_run(study(*ALL), 1).inputs
    assert {name: value.hex() if isinstance(value, float) else value for name, value in found.items()} == {
        SEED: 1454450061,
        "ball.drop_height_m": "0x1.317135071ecf4p+2",
        "ball.mass_kg": "0x1.58b40bbb040aep+13",
        "ball.target_m.1": "0x1.a3d8ef5325486p+2",
        "shards.friction": "0x1.2d8bbea3b3d69p-1",
        "connections.type": "FIXED",
    }


def test_values_that_contradict_each_other_are_reported_with_the_run():
    lift = {"ball.release_time_s": (0.5, 4.0), "time.duration_s": (1.0, 5.0)}
    varied = [
        Vary(key=name, distribution="uniform", lowest=lowest, highest=highest)
        for name, (lowest, highest) in lift.items()
    ]
    with pytest.raises(ScenarioError, match=r"a run may sample time\.duration_s = 1, which the scenario cannot have"):
        study(*varied, scenario=replace(I235, ball=replace(I235.ball, release_time_s=2.0)))
    both = study(*varied)
    refused = [number for number in range(1, 51) if not can_be_made(both, number)]
    assert 0 < len(refused) < 50
    assert list(sampled_run(both, refused[0]).inputs) == [SEED, *lift]


def can_be_made(study, number):
    try:
        assert sampled_run(study, number).scenario
    except ScenarioError as error:
        assert str(error).startswith("ball.release_time_s is ")
        return False
    return True


def test_a_cache_key_tells_apart_all_that_decides_a_run(tmp_path):
    versions = {"bridge_demolition_addon": "0.1.0", "blender": "5.2.0"}
    base = study(HEIGHT)
    key = sampled_run(base, 1).cache_key(versions)
    assert len(key) == 64
    assert sampled_run(study(HEIGHT, runs=500), 1).cache_key(dict(reversed(versions.items()))) == key
    others = [
        sampled_run(base, 2).cache_key(versions),
        sampled_run(base, 1).cache_key(versions | {"blender": "5.2.1"}),
        sampled_run(study(HEIGHT, least_mass_kg=1.0), 1).cache_key(versions),
        sampled_run(study(HEIGHT, keep="all"), 1).cache_key(versions),
        sampled_run(study(HEIGHT, scenario=replace(I235, title="another")), 1).cache_key(versions),
    ]
    assert len({key, *others}) == 6


def test_a_cache_key_depends_on_what_files_of_the_scenario_hold(tmp_path):
    points = tmp_path / "points.csv"
    scenario = replace(I235, fracture=replace(I235.fracture, points_file=str(points)))
    points.write_text("1,2,3\n")
    before = sampled_run(study(scenario=scenario), 1).cache_key({})
    points.write_text("1,2,4\n")
    assert sampled_run(study(scenario=scenario), 1).cache_key({}) != before
    points.unlink()
    with pytest.raises(ScenarioError, match=r"points\.csv: cannot be read: No such file"):
        sampled_run(study(scenario=scenario), 1).cache_key({})
