# SPDX-License-Identifier: GPL-3.0-or-later
"""What the report of a study says, from runs whose every number is known."""

from dataclasses import replace

import numpy as np
import pytest
from manifold3d import CrossSection
from scipy.stats import spearmanr
from support.report_texts import told_of_study
from support.study_folders import BRIDGE, TOLD_SCENARIO, VARIED, told_debris, told_runs, told_study

from bridge_demolition_addon.engineering.geometry.plan_areas import outlines
from bridge_demolition_addon.model.study.shown_names import shown
from bridge_demolition_addon.report.ensemble.influence import correlation_table
from bridge_demolition_addon.report.ensemble.plan import layers
from bridge_demolition_addon.report.ensemble.study import study_summary


@pytest.fixture(scope="module")
def runs():
    return told_runs()


@pytest.fixture(scope="module")
def told(runs):
    return told_of_study(runs)


def test_the_first_section_begins_with_the_statement(runs, told):
    second = np.sort(runs.distances_m)[-2]
    assert told.statement.startswith(
        'In 93 independent runs, in which charges.mass_kg, charges."mid pier".delay_ms, shards.friction, '
        "connections.type and the seed of the fracture were sampled from the distributions of this study, debris "
        f"stayed within {np.ceil(10.0 * second) / 10.0:.1f} m of the bridge's plan in all but 1. With 95 % confidence "
        "at least 95 % of such runs stay within it."
    )
    assert told.titles[0] == "What this study says"


@pytest.mark.long
def test_before_all_runs_are_there_nothing_is_said():
    told = told_of_study(told_runs(there=60))
    assert told.statement.startswith("60 of 93 runs are there: the study states nothing before all that it needs are")
    assert not any(" confidence at least " in text for text in told.paragraphs)
    assert "limit" not in told.column("study_areas", "area")


def test_the_first_run_alone_can_be_reported():
    told = told_of_study(told_runs(there=1))
    assert told.statement.startswith("1 of 93 runs")
    assert told.column("study_areas", "area")[0] == "bridge"


@pytest.mark.long
def test_runs_that_did_not_finish_are_named_and_count():
    told = told_of_study(told_runs(ends={17: "crashed", 60: "timed_out"}))
    assert told.statement.startswith("These runs set no limit: 2 of 93 did not finish")
    assert "2 of 93 runs did not finish: 17 (crashed), 60 (timed out)." in told.notices
    assert "limit" not in told.column("study_areas", "area")
    beginning = "Where the probability is below 5 % cannot be stated: 2 runs"
    assert any(text.startswith(beginning) for text in told.paragraphs)


def test_runs_that_still_moved_are_counted(told):
    assert any(text.startswith("In 3 of 93 runs not everything had rested for 1 s when") for text in told.notices)


@pytest.mark.parametrize("runout_factor, buffer_m", [(1.82, 5.0), (1.82, None), (1.0, 5.0), (1.0, None)])
def test_the_first_page_says_what_the_distance_to_keep_is_made_of(runout_factor, buffer_m):
    exclusion = replace(TOLD_SCENARIO.exclusion, buffer_m=buffer_m or 0.0, cordon_m=1.0)
    runs = told_runs(told_study(scenario=replace(TOLD_SCENARIO, exclusion=exclusion), runout_factor=runout_factor))
    summary = dict(study_summary(runs)[-1].rows)
    limit_m = np.sort(runs.distances_m)[-2]
    in_all = runout_factor * limit_m + (buffer_m or 0.0)
    words = [f"{np.ceil(10.0 * limit_m) / 10.0:.1f} m around the bridge's plan"]
    added = [f"the factor of {runout_factor:g} for runout"] * (runout_factor > 1.0)
    added += [f"the buffer of {buffer_m} m"] * bool(buffer_m)
    if added:
        words.append(f"{np.ceil(10.0 * in_all) / 10.0:.1f} m with {' and '.join(added)}".replace("5.0 m", "5 m"))
    lacking = "" if buffer_m else "; a buffer has to be added"
    assert summary["Limit"] == f"{', '.join(words)}{lacking}"
    # A cordon of 1 m is shorter than what is to keep from debris.
    assert f"{np.ceil(in_all):.0f} m to keep from debris by this study" in summary["Cordon"]


def test_areas_are_those_that_geometry_gives(runs, told):
    limit_m, buffer_m = runs.conclusions.reach.limit_m, TOLD_SCENARIO.exclusion.buffer_m
    areas = dict(zip(told.column("study_areas", "area"), told.column("study_areas", "area_m2"), strict=True))
    length, width = 28.0, 8.0
    for name, around_m in (("limit", limit_m), ("distance to keep", 1.82 * limit_m + buffer_m)):
        # A rectangle with a band around it (Steiner); the circles of its corners are within polygons of 64 sides.
        exact = length * width + 2.0 * (length + width) * around_m + np.pi * around_m**2
        assert areas[name] == pytest.approx(exact, rel=2.5e-3)
        assert areas[name] > exact
    assert areas["bridge"] == pytest.approx(length * width)
    assert areas["zone Road <1> $2$"] == pytest.approx(52.0 * 8.0)


def test_the_plan_holds_every_run_but_the_farthest(runs):
    area = layers(runs)["limit"]
    outside = [CrossSection(list(rings)) - area for rings in runs.swept]
    assert sum(area.area() > 0.0 for area in outside) == 1


def test_likely_places_are_within_rarer_ones(runs):
    found = layers(runs)
    assert (found["probability above 50 %"] - found["probability above 5 %"]).is_empty()
    assert "probability above 1 %" not in found  # it takes 299 runs
    assert found["probability above 50 %"].area() > 24.0 * 6.0 - 1e-6  # what every run covers


@pytest.mark.long
def test_many_runs_resolve_what_is_rare_and_show_some_dots():
    runs = told_runs(told_study(runs=510, vary=VARIED[2:3], criteria=()))
    assert "probability above 1 %" in layers(runs)
    told = told_of_study(runs)
    assert any(text.startswith("Each dot is one of the first 500 of the 510 runs") for text in told.paragraphs)
    assert len(told.column("farthest_draws", "run")) == 200


def test_rank_correlations_are_those_of_scipy(runs):
    table = correlation_table(runs)
    assert table.rows[0][0] == 'charges."span 1".mass_kg'
    values = {name: [row.inputs[name] for row in runs.table.rows] for name in runs.varied}
    for one, other, found in table.rows:
        outputs = [row.outputs[other] for row in runs.table.rows]
        known = [row for row, value in enumerate(outputs) if value is not None]
        pairs = np.array([(values[one][row], float(outputs[row])) for row in known])
        assert found == pytest.approx(spearmanr(*pairs.T).statistic, abs=1e-12)
    sizes = [abs(row[2]) for row in table.rows]
    assert sizes == sorted(sizes, reverse=True)
    assert not any(row[0] == "connections.type" for row in table.rows)


def test_criteria_have_their_limits(runs, told):
    assert told.column("criteria", "criterion") == [
        *(criterion.name for criterion in runs.ensemble.criteria),
        "all of them",
    ]
    assert told.column("criteria", "met")[0] == 93
    at_least, at_most = told.column("criteria", "at_least_percent"), told.column("criteria", "at_most_percent")
    assert at_least[0] == pytest.approx(100.0 * 0.05 ** (1.0 / 93.0)) and at_most[0] == 100.0


def test_a_study_without_criteria_or_variations_says_so():
    told = told_of_study(told_runs(told_study(vary=(), criteria=())))
    assert any(text.startswith("The study names no [[criteria]]") for text in told.paragraphs)
    assert "What matters" not in told.titles
    assert "in which the seed of the fracture was sampled" in told.statement


def test_the_median_and_the_worst_draw_are_those_of_the_reach(runs, told):
    reaches_m = runs.distances_m
    headings = [column.heading for column in told.tables["median_and_worst"].columns]
    median, worst = np.argsort(reaches_m)[46] + 1, np.argmax(reaches_m) + 1
    assert headings == ["", f"median, run {median}", f"worst, run {worst}"]


def test_draws_are_listed_from_the_farthest(runs, told):
    assert told.column("farthest_draws", "run") == (np.argsort(-runs.distances_m, kind="stable") + 1).tolist()


def test_a_scenario_without_a_site_has_a_plan():
    bare = replace(TOLD_SCENARIO, zones=(), neighbours=(), exclusion=None, site=None, charges=())
    vary = (replace(told_study().settings.vary[2]),)
    told = told_of_study(told_runs(told_study(scenario=bare, vary=vary, criteria=())))
    assert told.statement.endswith("for which a buffer has to be added.")
    assert "distance to keep" in told.column("study_areas", "area")  # by the factor for runout alone


def test_runs_that_moved_nothing_have_a_limit_of_nought():
    runs = told_runs(told_study(criteria=()))
    rows = tuple(replace(row, outputs=dict.fromkeys(row.outputs, 0.0)) for row in runs.table.rows)
    still = replace(runs, table=type(runs.table)(rows), swept=[() for _ in rows])
    told = told_of_study(still)
    assert "debris stayed within 0.0 m of the bridge's plan in all of them" in told.statement
    assert still.hull_corners == 0


def test_the_made_up_runs_reach_as_far_as_they_say(runs):
    # The fixture itself: what the tests above stand on.
    for row in runs.table.rows[:20]:
        low, high = np.array(BRIDGE.bounds()).reshape(2, 2)
        corners = np.concatenate(told_debris(row))
        beyond = np.maximum(low - corners, corners - high).max()
        assert beyond == pytest.approx(row.outputs["reach_m"], abs=1e-4)
    assert outlines(runs.bridge)


@pytest.mark.parametrize(
    "name, words",
    [
        ("reach_m", "debris distance (m)"),
        ('charges."mid. pier".mass_kg', 'charges "mid. pier" mass (kg)'),
        ("largest_force_N", "largest force (N)"),
        ('criteria."road stays free"', "road stays free"),
        ("broken", "broken"),
        ("ball.target_m.1", "ball target 1 (m)"),
        ("connections.breaking_force_kgf", "connections breaking force (kgf)"),
        ("spans.1.lost_share", "spans 1 lost share"),
    ],
)
def test_names_are_shown_with_their_units(name, words):
    assert shown(name) == words
