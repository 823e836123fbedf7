# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts of a study: what they draw is what they were given."""

import numpy as np
import pytest
from manifold3d import CrossSection
from matplotlib.colors import to_rgb

from bridge_demolition_addon.charts.ensemble_charts import (
    LIMIT_COLOUR,
    InputPanel,
    correlation_map,
    limit_over_runs,
    output_against_inputs,
    output_panels_height_mm,
    reach_distribution,
    study_plan,
)
from bridge_demolition_addon.charts.style import blank_figure
from bridge_demolition_addon.model.scenario import Neighbour

REACHES_M = np.array([3.0, 1.0, np.inf, 2.0, 6.0, 4.0, 5.0, 7.0])


NEIGHBOURS = (
    Neighbour(name="House", position_m=(15.0, 3.0, 2.0)),
    Neighbour(name="Town", position_m=(5000.0, 0.0, 2.0)),
)


@pytest.fixture
def figure():
    return blank_figure(6.0, 4.0, layout="constrained")


def line(axes, label):
    (found,) = [line for line in axes.lines if line.get_label().startswith(label)]
    return found


def test_shares_are_of_all_runs_also_of_those_that_did_not_finish(figure):
    reach_distribution(figure, REACHES_M, (6.0, "6.00 m"), 0.9)
    upper, lower = figure.axes
    distances, shares = line(lower, "share").get_data()
    assert distances.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    assert shares.tolist() == [number / 8.0 for number in range(8)]
    assert sum(bar.get_height() for bar in upper.patches) == 7
    assert line(lower, "limit, 6.00 m").get_xdata() == [6.0, 6.0]
    assert line(lower, "90 %").get_ydata() == [0.9, 0.9]


def test_without_a_limit_none_is_drawn(figure):
    reach_distribution(figure, REACHES_M, None, 0.9)
    assert not [line for axes in figure.axes for line in axes.lines if to_rgb(line.get_color()) == to_rgb(LIMIT_COLOUR)]


def test_the_course_of_the_limit_has_its_points_and_marks_runs_without_an_end(figure):
    limit_over_runs(figure, REACHES_M, np.array([6, 7, 8]), np.array([np.inf, 6.0, 7.0]))
    (axes,) = figure.axes
    assert line(axes, "limit by the runs so far").get_xdata().tolist() == [6, 7, 8]
    np.testing.assert_array_equal(line(axes, "limit by the runs so far").get_ydata(), [np.nan, 6.0, 7.0])
    assert line(axes, "no limit by the runs so far").get_xdata().tolist() == [6]
    assert line(axes, "runs that did not finish").get_xdata().tolist() == [3]
    np.testing.assert_array_equal(line(axes, "largest so far").get_ydata(), [3.0, 3.0, *[np.nan] * 6])
    np.testing.assert_array_equal(line(axes, "median so far").get_ydata(), [3.0, 2.0, 3.0, 2.5, 3.0, 3.5, 4.0, 4.5])


def test_each_input_has_a_panel_with_all_runs(figure):
    numbers, texts = np.array([1.0, 2.0, 3.0]), np.array(["TNT", "C-4", "TNT"], object)
    panels = [InputPanel("mass (kg)", numbers, 0.5), InputPanel("explosive", texts, None)]
    output_against_inputs(figure, "reach (m)", np.array([7.0, 8.0, 9.0]), panels)
    first, second = figure.axes
    assert first.collections[0].get_offsets().tolist() == [[1.0, 7.0], [2.0, 8.0], [3.0, 9.0]]
    assert second.collections[0].get_offsets().tolist() == [[1.0, 7.0], [0.0, 8.0], [1.0, 9.0]]
    assert [text.get_text() for text in second.get_xticklabels()] == ["C-4", "TNT"]
    assert (first.get_title(), second.get_title()) == ("rank correlation +0.50", "")
    assert output_panels_height_mm(5) == 2.0 * output_panels_height_mm(4)


def test_correlations_beyond_chance_are_bold(figure):
    values = np.array([[0.95, -0.1], [np.nan, -0.31]])
    correlation_map(figure, ["mass", "delay"], ["reach", "throw"], values, by_chance=0.3)
    (axes,) = figure.axes
    texts = {text.get_text(): text for text in axes.texts}
    assert {name: text.get_fontweight() for name, text in texts.items()} == {
        "+0.95": "bold",
        "-0.10": "normal",
        "-0.31": "bold",
    }
    assert texts["-0.31"].get_position() == (1, 1)


def test_the_plan_has_a_legend_for_all_that_it_shows(figure):
    bridge = CrossSection.square((10.0, 4.0))
    likely = {"likely <1 $": bridge.offset(2.0), "likelier": bridge.offset(1.0)}
    limits = {"limit": bridge.offset(5.0), "distance to keep": bridge.offset(8.0)}
    study_plan(figure, bridge, likely, limits, neighbours=NEIGHBOURS)
    (legend,) = figure.legends
    names = [text.get_text() for text in legend.get_texts()]
    assert names == ["likely <1 \\$", "likelier", "bridge before", "limit", "distance to keep", "neighbours"]
    (axes,) = figure.axes
    assert [text.get_text() for text in axes.texts] == ["House"]
    low, high = axes.get_xlim()
    assert -10.0 < low < -8.0 and 18.0 < high < 20.0


def test_a_plan_without_limit_and_debris_shows_the_bridge(figure):
    study_plan(figure, CrossSection.square((10.0, 4.0)), {}, {})
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["bridge before"]
