# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts of searches and optimisations say what is drawn, in words and by what was run, on results that are kept."""

from dataclasses import replace

import ensembles
import pytest
from matplotlib.figure import Figure

from bridge_demolition_addon.charts.ensemble_charts import search_curve, tradeoff
from bridge_demolition_addon.model.ensemble.folder import ensemble_of_file
from bridge_demolition_addon.model.optimise.conclusions import best_of
from bridge_demolition_addon.model.search.conclusions import answer_of
from bridge_demolition_addon.model.study.runs_table import read_runs


@pytest.fixture(scope="module")
def answer():
    search = ensemble_of_file(ensembles.settings_file("lightest_ball"))
    return answer_of(search, read_runs(ensembles.runs_table("lightest_ball")))


@pytest.fixture(scope="module")
def best():
    optimisation = ensemble_of_file(ensembles.settings_file("least_charge"))
    return best_of(optimisation, read_runs(ensembles.runs_table("least_charge")))


def drawn(draw, result):
    figure = Figure()
    draw(figure, result)
    figure.canvas.draw()
    return figure.axes[0]


def test_a_search_names_its_quantity_in_words_with_its_unit_and_counts_in_plain_numbers(answer):
    axes = drawn(search_curve, answer)
    assert axes.get_xlabel() == "ball mass (kg)"
    low, high = axes.get_xlim()
    shown = [text.get_text() for text in axes.get_xticklabels() if low <= text.get_position()[0] <= high]
    assert {"10000", "20000"} <= set(shown) <= {"5000", "10000", "20000", "50000"}


def test_the_quantity_is_a_factor_where_that_is_searched_for(answer):
    search = replace(answer.search, settings=replace(answer.search.settings, factor=True))
    assert search.shown_quantity == "ball mass (factor)"


def test_one_run_of_each_candidate_has_no_quantile(best):
    settings = best.optimisation.settings
    assert settings.runs_each == 1
    assert drawn(tradeoff, best).get_ylabel() == "debris distance (m), 1 run each"
    several = replace(best.optimisation, settings=replace(settings, runs_each=4, quantile=0.9))
    label = drawn(tradeoff, replace(best, optimisation=several)).get_ylabel()
    assert label == "0.9 quantile of the debris distance (m), 4 runs each"


def test_a_front_of_one_candidate_is_seen(best):
    (front,) = [line for line in drawn(tradeoff, best).lines if line.get_label() == "no other has less of both"]
    on_front = [(one.charge_kg, one.reach_m) for one in best.tried if one.on_front]
    assert [tuple(point) for point in front.get_xydata()] == on_front
    assert len(on_front) == 1 and front.get_marker() == "o"
