# SPDX-License-Identifier: GPL-3.0-or-later
"""The job of the overbridge: its page says what hand calculation, statics and its study say."""

import json
import math

import ensembles
import pytest
from support.checkout import EXAMPLES, ROOT

from bridge_demolition_addon.engineering.units import rounded_up
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stability import stability_of
from bridge_demolition_addon.model.structure.facts import connection_facts
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.runs_table import REACH, RESTED, read_runs

FOLDER = EXAMPLES / "overbridge"
GRAVITY_M_S2 = 9.80665
SPAN_M, OVERHANG_M, WIDTH_M, THICKNESS_M = 18.0, 0.5, 9.0, 0.9
STEEL_MM2, YIELD_N_MM2, CONCRETE_N_MM2, DEPTH_MM = 44_300.0, 500.0, 35.0, 840.0


@pytest.fixture(scope="module")
def told():
    return " ".join((ROOT / "docs" / "overbridge.md").read_text(encoding="utf-8").split())


@pytest.fixture(scope="module")
def bridge():
    scenario = read_scenario(FOLDER / "bridge.toml")
    return scenario, checked_model(scenario)


@pytest.fixture(scope="module")
def runs():
    return read_runs(ensembles.runs_table("overbridge"))


def moment_nm():
    """Plane section with a rectangular block under the strength in compression, bars at yield."""
    block_mm = STEEL_MM2 * YIELD_N_MM2 / (WIDTH_M * 1e3 * CONCRETE_N_MM2)
    return 1e-3 * STEEL_MM2 * YIELD_N_MM2 * (DEPTH_MM - 0.5 * block_mm)


def test_bars_and_weight_are_those_of_the_sums_by_hand(told, bridge):
    scenario, model = bridge
    bars = round(WIDTH_M / 0.125) * math.pi / 4.0 * 28.0 * 28.0
    assert bars == pytest.approx(STEEL_MM2, rel=0.002)  # the drawing's area is rounded to 100 mm²
    deck_kg = (2.0 * SPAN_M + 2.0 * OVERHANG_M) * WIDTH_M * THICKNESS_M * 2500.0
    of_deck = [index for index, member in enumerate(model.members) if member.kind == "deck"]
    masses = model.masses_kg[[owner in of_deck for owner in model.member_of_shard.tolist()]]
    assert masses.sum() == pytest.approx(deck_kg)
    assert told.count(f"{deck_kg / 1000.0:.2f} t") >= 1
    by_length = deck_kg / (2.0 * SPAN_M + 2.0 * OVERHANG_M) * GRAVITY_M_S2
    for by_hand_n in (3.0 / 8.0 * by_length * SPAN_M + OVERHANG_M * by_length, 10.0 / 8.0 * by_length * SPAN_M):
        assert f"{round(by_hand_n / 1e3, -1):.0f} kN" in told
    alone_nm = by_length * (2.0 * SPAN_M) ** 2 / 8.0
    assert f"w L² / 8 = {alone_nm / 1e6:.1f} MN·m, and resists {moment_nm() / 1e6:.1f}" in told
    said = [text for name, text in connection_facts(scenario, model) if name == "reinforcement"]
    resists = next(float(text.split(": ")[1].split(" kN·m")[0]) for text in said if text.startswith("deck, along x"))
    assert resists == pytest.approx(moment_nm() / 1e3, rel=0.01)


@pytest.mark.long
def test_it_stands_by_as_much_as_the_page_says(told, bridge):
    stability = stability_of(*bridge, with_factor=True)
    assert stability.verdict == "stands"
    assert f"would come down at {stability.load_factor:.1f} times its weight" in told


def test_the_study_is_told_as_its_runs_are(told, runs):
    settings = read_study(FOLDER / "study.toml").settings
    answer = json.loads(ensembles.answer("overbridge").read_text(encoding="utf-8"))["reach"]
    assert answer["runs"] == settings.runs == len(runs.rows)
    limit = rounded_up(answer["limit_m"], "0.1")
    assert (
        f"debris of 20 kg or more stayed within {limit} m of the bridge's plan in all of {settings.runs} runs" in told
    )
    first, second = (runs.met(f'criteria."the {span} span comes down"') for span in ("first", "second"))
    assert f"Both spans come down in {(first & second).sum()} of {settings.runs}" in told
    outputs = [row.outputs for row in runs.rows]
    resting = [run[RESTED] for run in outputs if run[RESTED] is not None]
    assert f"{len(resting)} come to rest, {min(resting):.0f} to {max(resting):.0f} s after the start" in told
    made = [100.0 * run["made_by_solver_share"] for run in outputs]
    assert f"made {min(made):.0f} to {max(made):.0f} % of the dissipated energy" in told
    assert max(runs.largest(REACH)) <= float(limit)
