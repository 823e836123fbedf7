# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists of lengths, and of points, as rows of the sidebar."""

import pytest

from bridge_demolition_addon.ui.scenario.values import scenario_of

SPANS = "bda.scenario.bridge.span_lengths_m"


@pytest.fixture
def bridge(settings):
    return settings.scenario.bridge


def test_a_row_shows_and_sets_one_number(bridge, settings):
    bridge.span_lengths_m = "[13.0, 8.25]"
    assert (bridge.span_lengths_m_row_0, bridge.span_lengths_m_row_1) == (13.0, 8.25)
    bridge.span_lengths_m_row_1 = 14.1
    assert bridge.span_lengths_m == "[13.0, 14.1]"
    assert scenario_of(settings).bridge.span_lengths_m == (13.0, 14.1)


def test_a_row_that_is_not_there_changes_nothing(bridge):
    bridge.span_lengths_m = "[13.0]"
    bridge.span_lengths_m_row_5 = 4.0
    assert bridge.span_lengths_m == "[13.0]" and bridge.span_lengths_m_row_5 == 0.0


def test_a_text_that_is_no_list_of_numbers_stays(extension, bridge):
    bridge.span_lengths_m = "thirteen"
    bridge.span_lengths_m_row_0 = 4.0
    assert bridge.span_lengths_m == "thirteen"
    with pytest.raises(RuntimeError, match="span_lengths_m is no list of numbers"):
        extension.ops.bda.add_row(path=SPANS)
    assert bridge.span_lengths_m == "thirteen"


def test_rows_are_added_and_removed(extension, bridge):
    bridge.span_lengths_m = "13, 20"
    extension.ops.bda.add_row(path=SPANS)
    assert bridge.span_lengths_m == "[13, 20, 20]"
    extension.ops.bda.remove_row(path=SPANS, number=0)
    extension.ops.bda.remove_row(path=SPANS, number=0)
    with pytest.raises(RuntimeError, match="has to have one or more"):
        extension.ops.bda.remove_row(path=SPANS, number=0)
    assert bridge.span_lengths_m == "[20]"


def test_there_are_as_many_rows_as_there_can_be_shown(extension, bridge):
    bridge.span_lengths_m = str([10.0] * 24)
    with pytest.raises(RuntimeError, match="shows up to 24"):
        extension.ops.bda.add_row(path=SPANS)
    assert bridge.span_lengths_m_row_23 == 10.0


def test_a_row_of_corners_is_a_point(extension, settings):
    zone = settings.scenario.zones.add()
    zone.corners_m = "[[0, 0], [4.5, 0], [4.5, 3]]"
    assert tuple(zone.corners_m_row_1) == (4.5, 0.0)
    zone.corners_m_row_2 = (5.1, 3.3)
    assert zone.corners_m == "[[0, 0], [4.5, 0], [5.1, 3.3]]"
    extension.ops.bda.add_row(path="bda.scenario.zones[0].corners_m", length=2)
    assert zone.corners_m == "[[0, 0], [4.5, 0], [5.1, 3.3], [5.1, 3.3]]"


def test_a_list_that_is_not_there_is_refused(extension):
    with pytest.raises(RuntimeError, match="there is no such list"):
        extension.ops.bda.add_row(path="bda.scenario.bridge.spans")
