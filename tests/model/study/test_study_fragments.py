# SPDX-License-Identifier: GPL-3.0-or-later
"""How far fragments fly in the runs of a study: outputs of a run, limits over runs, and what is said of them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom
from support.checkout import EXAMPLES
from support.report_texts import told_of_study
from support.study_folders import told_runs, told_study

from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import Exclusion
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.charge_plan import charge_plan
from bridge_demolition_addon.model.study.conclusions import NEARLY_ALL, conclusions, fragment_outputs
from bridge_demolition_addon.model.study.runs_table import RunRow, RunsTable
from bridge_demolition_addon.model.study.settings import Vary
from bridge_demolition_addon.report.ensemble.plan import layers
from bridge_demolition_addon.report.wording.study import fragments_sentence, study_sentences

pytestmark = pytest.mark.slow

DRILLED = replace(
    read_scenario(EXAMPLES / "drilled" / "two_spans.toml"), exclusion=Exclusion(buffer_m=5.0, cordon_m=300.0)
)
STUDY = told_study(
    scenario=DRILLED,
    vary=(Vary(key="shards.friction", distribution="uniform", lowest=0.4, highest=0.8),),
    criteria=(),
)


def outputs_of(number):
    """Distances that grow with the number of the run."""
    distances = (40.0 + 0.1 * number, 90.0 + 0.1 * number, 110.0 + 0.1 * number, 120.0 + 0.1 * number, 340.0, 200.0)
    names = ("fragments_50_m", "fragments_99_m", NEARLY_ALL, "fragments_farthest_m", "lundborg_m", "mckenzie_m")
    return dict(zip(names, distances, strict=True))


def runs_of(study=STUDY):
    runs = told_runs(study)
    rows = tuple(
        RunRow(row.number, row.status, row.inputs, row.outputs | outputs_of(row.number)) for row in runs.table.rows
    )
    return replace(runs, table=RunsTable(rows))


@pytest.mark.long
def test_a_run_has_the_distances_of_its_zones():
    """By hand: Lundborg 260 (38 / 25.4)^(2/3) m; McKenzie with 54 mm of 1200 kg/m³ under 0.25 m of stemming."""
    outputs = fragment_outputs(DRILLED)
    assert outputs["lundborg_m"] == pytest.approx(260.0 * (38.0 / 25.4) ** (2.0 / 3.0))
    length_m = 0.0735 / (1200.0 * math.pi * 0.038**2 / 4.0)
    burial = (0.25 + length_m / 2.0) / 0.0735 ** (1.0 / 3.0)
    assert outputs["mckenzie_m"] == pytest.approx(9.74 * (38.0 / burial**2.167) ** (2.0 / 3.0), rel=1e-3)
    flown = charge_plan(DRILLED, prepared_members(DRILLED).members).flyrock
    assert outputs[NEARLY_ALL] == max(of.sampled.nearly_all_m for of in flown)
    assert 0.0 < outputs["fragments_50_m"] < outputs["fragments_99_m"] < outputs[NEARLY_ALL]


@pytest.mark.slow
def test_fragments_scatter_with_the_seed_and_not_those_of_a_misfire():
    other = fragment_outputs(replace(DRILLED, seed=DRILLED.seed + 1))
    assert other["fragments_99_m"] != fragment_outputs(DRILLED)["fragments_99_m"]
    failed = replace(DRILLED, blast_zones=[replace(zone, fires=False) for zone in DRILLED.blast_zones])
    assert set(fragment_outputs(failed).values()) == {0.0}
    assert fragment_outputs(replace(DRILLED, blast_zones=())) == {}


def test_limits_are_those_by_rank():
    """The second largest of 93: 95 % of runs stay within it with 1 - P(fewer than 2 of 93 beyond) confidence."""
    said = conclusions(STUDY, runs_of().table).fragments
    assert (said.half_m, said.most_m, said.nearly_all_m) == pytest.approx((49.2, 99.2, 119.2))
    assert said.achieved_confidence == pytest.approx(1.0 - binom.cdf(1, 93, 0.05))
    assert (said.lundborg_m, said.mckenzie_m) == (340.0, 200.0)
    assert conclusions(STUDY, runs_of().table).as_json()["fragments"]["nearly_all_m"] == pytest.approx(119.2)


def test_a_run_that_crashed_has_no_limit_of_its_own():
    rows = list(runs_of().table.rows)
    for number in (3, 7):
        rows[number] = replace(rows[number], status="crashed", outputs={})
    said = conclusions(STUDY, RunsTable(tuple(rows))).fragments
    assert math.isinf(said.nearly_all_m) and not said.are_known
    assert fragments_sentence(said, None).startswith("How far fragments that are smaller than shards fly has no limit")


def test_studies_without_blast_zones_say_nothing_of_fragments():
    study = told_study()
    said = conclusions(study, told_runs(study).table)
    assert said.fragments is None and "fragments" not in said.as_json()


def test_the_sentence_has_all_that_stands_beside():
    said = conclusions(STUDY, runs_of().table)
    (sentence,) = [text for text in study_sentences(STUDY, said) if "Lundborg" in text]
    assert sentence == (
        "Fragments that are smaller than shards: with 95 % confidence for each, in at least 95 % of such runs 50 % of "
        "their mass stay within 50 m of their blast zone, 99 % within 100 m and 99.9 % within 120 m. By Lundborg they "
        "fly up to 340 m, by McKenzie up to 200 m, as if nothing covered the holes. Cordon: 300 m around the bridge's "
        "plan, by the scenario: shorter than 340 m by Lundborg. All of these are known within a factor of 2: factor 2, "
        "no safety distance."
    )


@pytest.mark.long
@pytest.mark.slow
def test_report_and_plan_have_the_limits():
    runs = runs_of()
    told = told_of_study(runs)
    assert "How far fragments fly" in told.titles
    assert told.column("fragment_limits", "distance_m")[:3] == pytest.approx([49.2, 99.2, 119.2])
    assert told.column("fragment_limits", "distance_m")[-1] == 300.0
    areas = layers(runs)
    name = "fragments 99.9 %: factor 2, no safety distance"
    # A circle of 119.2 m about each of six columns: at least as wide as one of them.
    low_x, _, high_x, _ = areas[name].bounds()
    centres = [placed.box_m.mean(axis=0)[0] for placed in charge_plan(DRILLED, prepared_members(DRILLED).members).zones]
    assert high_x == pytest.approx(max(centres) + 119.2, abs=0.1)
    assert low_x == pytest.approx(min(centres) - 119.2, abs=0.1)
    low, high = np.array(areas["cordon"].bounds()).reshape(2, 2)
    assert (low - np.array(runs.bridge.bounds()[:2])).tolist() == pytest.approx([-300.0, -300.0], abs=0.5)
    assert (high > np.array(runs.bridge.bounds()[2:]) + 299.9).all()
