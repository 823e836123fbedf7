# SPDX-License-Identifier: GPL-3.0-or-later
"""What documents say of studies, searches and optimisations is what their kept results say."""

import json
import math

import ensembles
import numpy as np
import pytest
from scipy.stats import spearmanr
from support.checkout import EXAMPLES, ROOT, said_of

from bridge_demolition_addon.model.sequence.ending import FASTEST
from bridge_demolition_addon.model.study.conclusions import debris_limit
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.runs_table import REACH, RESTED, read_runs
from bridge_demolition_addon.report.wording.study import limit_sentence

NAME = "drilled_two_spans"
CHARGE_G, DELAY_MS = 'blast_zones."P2.1".charge_g', 'blast_zones."P2.1".delay_ms'


def page(*path):
    """A page in one line."""
    return " ".join(ROOT.joinpath(*path).read_text(encoding="utf-8").split())


@pytest.fixture(scope="module")
def told():
    return page("docs", "studies.md")


@pytest.fixture(scope="module")
def runs():
    return read_runs(ensembles.runs_table(NAME))


def test_the_limit_is_that_of_the_runs(told, runs):
    settings = read_study(EXAMPLES / "studies" / f"{NAME}.toml").settings
    reaches_m = runs.largest(REACH)
    assert len(reaches_m) == settings.runs
    limit = debris_limit(reaches_m, settings.quantile, settings.confidence, settings.rank)
    said = json.loads(ensembles.answer(NAME).read_text(encoding="utf-8"))["reach"]
    assert limit.limit_m == said["limit_m"]
    words = limit_sentence(limit, ("what varies",), settings.least_mass_kg, None).split(". ")[0]
    stayed = words[words.index("debris of") :]
    assert f"{stayed}, and with 95 % confidence at least 95 % of such runs stay within it" in told


def test_the_criteria_are_those_of_the_runs(told, runs):
    first, second = (runs.met(f'criteria."the {span} span comes down"') for span in ("first", "second"))
    assert f"{(first & second).sum()} of {len(first)} runs bring both spans down" in told
    said = json.loads(ensembles.answer(NAME).read_text(encoding="utf-8"))
    assert f"at least {math.floor(100.0 * said['success']['at_least'])} % of such runs do, so" in told
    first, second = (part for part in said["standing"] if part["what"].startswith("span"))
    assert f"The first span may stand in {first['happened']} of {first['runs']} runs" in told
    assert f"in at most {100.0 * first['at_most']:.2f} % of such runs, the second in {second['happened']}" in told
    in_readme = page("README.md")
    assert f"in at most {math.ceil(1000.0 * first['at_most']) / 10.0:g} % of such runs the first may stand" in in_readme
    reach = said["reach"]
    assert f"within {math.ceil(10.0 * reach['limit_m']) / 10.0:g} m, " in in_readme
    assert f"{math.ceil(10.0 * reach['limit_m'] * reach['runout_factor']) / 10.0:g} m with the factor" in in_readme


def test_what_rested_and_what_is_doubtful_is_that_of_the_runs(told, runs):
    said = json.loads(ensembles.answer(NAME).read_text(encoding="utf-8"))
    assert (said["still_moving"], said["single_moving"]) == (runs.still_moving, runs.single_moving)
    assert f"{len(runs) - runs.still_moving} of {len(runs)} came to rest" in told
    assert f"in {runs.single_moving} single shards still moved" in told
    fastest_m_s = FASTEST * read_study(EXAMPLES / "studies" / f"{NAME}.toml").scenario.time.rest_speed_m_s
    assert f"at less than {fastest_m_s:g} m/s" in told
    rested_s = runs.output("came_to_rest_s")
    rested_s = rested_s[np.isfinite(rested_s)]
    assert f"came to rest, {rested_s.min():.0f} to {rested_s.max():.0f} s after their start" in told
    doubtful = said["doubtful_throws"]
    assert f"explain {doubtful['throws']} throws, in {doubtful['runs']} of the runs" in told
    assert f"Without them the limit is {doubtful['limit_m'] + 0.05:.1f} m" in told


def test_runs_with_a_misfire_are_counted(told, runs):
    zones = [runs.input(name) for name in runs.inputs if name.endswith(".fires")]
    misfires = sum(1 - zone.astype(int) for zone in zones)
    assert f"In {(misfires > 0).sum()} of them one zone or two misfire" in told and misfires.max() == 2


def test_no_input_explains_the_debris_distance(told, runs):
    """By scipy, which the report does not use."""
    fires = {name: runs.input(name).astype(float) for name in runs.inputs if name != "scenario.seed"}
    varied = {name: values for name, values in fires.items() if len(set(values)) > 1}
    largest = max(abs(spearmanr(values, runs.largest(REACH))[0]) for values in varied.values())
    assert f"no rank correlation is above {largest + 0.005:.2f} either way" in told


def test_the_page_on_searches_says_what_the_search_says():
    found = json.loads(ensembles.answer("lightest_ball").read_text(encoding="utf-8"))
    shown = page("docs", "search.md")
    median, likely, sure = (rounded(found[key] / 1000.0) for key in ("median", "value", "limit"))
    said = f"with a ball of {median} t, most likely, 90 % with {likely} t, and with 95 % confidence with {sure} t"
    assert said in shown
    assert (found["probability"], found["confidence"]) == (0.9, 0.95)
    runs = [row for row in read_runs(ensembles.runs_table("lightest_ball")).rows if row.status == "done"]
    down, left = ([row for row in runs if row.outputs["success"] is success] for success in (True, False))
    lightest = min(row.inputs["ball.mass_kg"] for row in down)
    heaviest = max(row.inputs["ball.mass_kg"] for row in left)
    assert f"All balls lighter than {rounded(lightest / 1000.0)} t left dents" in shown
    assert f"all heavier than {rounded(heaviest / 1000.0)} t brought the span down" in shown
    dents_cm = [100.0 * row.outputs["spans.1.drop_m"] for row in left if row.inputs["ball.mass_kg"] < lightest]
    assert f"of {min(dents_cm):.0f} to {max(dents_cm):.0f} cm" in shown


def test_the_page_on_optimisation_says_what_the_optimisation_says():
    found = json.loads(ensembles.answer("least_charge").read_text(encoding="utf-8"))
    shown, fresh = page("docs", "optimise.md"), found["confirmed"]
    for text in (
        f"brought both spans down in {fresh['successes']} of {fresh['runs']}",
        f"at least {100.0 * fresh['least_probability']:.0f} % of such runs succeed",
        f"The one that was chosen needs {rounded(fresh['value'])} kg",
        f"has {found['values'][CHARGE_G]:.0f} g in each hole of the middle pier, which goes at "
        f"{found['values'][DELAY_MS]:.0f} ms",
    ):
        assert text in shown
    assert not fresh["meets_the_probability"]


def rounded(value):
    return f"{value:.1f}"


def test_the_example_from_ifc_says_what_its_study_came_to():
    found = read_runs(ensembles.runs_table("lillebruen"))
    study, example = (said_of(EXAMPLES / folder / "lillebruen.toml") for folder in ("studies", "imported"))
    reaches_m, count = np.sort(found.largest(REACH)), len(found.rows)
    within = f"stays within {reaches_m[-1]:.1f} m of the bridge's plan in all of {count} runs"
    assert f"{within}, and within {reaches_m[-2]:.1f} m in {count - 1} of them" in study
    down = found.met('criteria."the deck comes down"').sum()
    assert f"comes down in {down}; in the other {count - down}" in study
    assert f"in {down} of {count} runs the deck comes down" in example
    outputs = [row.outputs for row in found.rows]
    rest_s = [run[RESTED] for run in outputs if run[RESTED] is not None]
    assert f"{len(rest_s)} runs come to rest" in study
    assert f"{len(rest_s)} come to rest within 20 s, after {min(rest_s):.0f} to {max(rest_s):.0f} s" in example
    throws_m, made = ([run[key] for run in outputs] for key in ("largest_throw_m", "made_by_solver_share"))
    assert f"the farthest throw is {min(throws_m):.1f} to {max(throws_m):.1f} m" in example
    doubtful = [run["doubtful_throws"] for run in outputs]
    shares = f"{100 * min(made):.0f} to {100 * max(made):.0f} %"
    assert f"{shares} of the dissipated energy, and {min(doubtful)} to {max(doubtful)} throws" in study
    assert f"and {shares} in those of the study" in example
    without_m = max(run["reach_without_doubtful_m"] for run in outputs)
    assert f"{without_m:.1f}" == f"{reaches_m[-1]:.1f}"
