# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies sample which blast zones fire."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats
from support.drilled_columns import ZONE, column_scenario

from bridge_demolition_addon.model.study.file import study_of
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.model.study.settings import StudySettings, Vary
from bridge_demolition_addon.report.wording.study import input_names


def study(folder, *zones, vary=()):
    return study_of(StudySettings(scenario="column.toml", vary=vary), column_scenario(folder, *zones))


@pytest.mark.long
def test_zones_fire_with_their_probability_each_by_itself(tmp_path):
    upper = replace(ZONE, name="upper", middle_m=3.2, probability_fires=0.9)
    whole = study(tmp_path, replace(ZONE, probability_fires=0.7), upper)
    runs = [sampled_run(whole, number) for number in range(1, 2001)]
    fires = np.array([[zone.fires for zone in run.scenario.blast_zones] for run in runs])
    for column, probability in zip(fires.T, (0.7, 0.9), strict=True):
        assert stats.binomtest(int(column.sum()), len(column), probability).pvalue > 0.01
    # Independent: a table of two by two.
    table = [[((fires[:, 0] == a) & (fires[:, 1] == b)).sum() for b in (False, True)] for a in (False, True)]
    assert stats.chi2_contingency(table).pvalue > 0.01
    assert [run.inputs["blast_zones.zone.fires"] for run in runs] == fires[:, 0].tolist()


def test_what_is_sure_to_fire_or_to_fail_is_not_sampled(tmp_path):
    dud = replace(ZONE, name="dud", middle_m=3.2, probability_fires=0.5, fires=False)
    whole = study(tmp_path, ZONE, dud)
    assert whole.variations == ()
    assert not any(sampled_run(whole, number).scenario.blast_zones[1].fires for number in range(1, 20))


def test_a_table_of_the_study_comes_before_the_probability(tmp_path):
    vary = Vary(key="blast_zones.zone.fires", distribution="choice", values=[False])
    whole = study(tmp_path, replace(ZONE, probability_fires=0.99), vary=(vary,))
    assert not any(sampled_run(whole, number).scenario.blast_zones[0].fires for number in range(1, 50))


@pytest.mark.parametrize(("probability", "names"), [(1.0, []), (0.9, ["which blast zones fire"])])
def test_a_study_says_what_it_samples(tmp_path, probability, names):
    whole = study(tmp_path, replace(ZONE, probability_fires=probability))
    assert input_names(whole) == [*names, "the seed of the fracture"]
