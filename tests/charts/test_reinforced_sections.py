# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections with bars: where bars are drawn, and what is written beside them."""

import math

import numpy as np
import pytest
from support.bridges_by_rule import LM1, bridge, layer, scenario, scheduled

from bridge_demolition_addon.charts.reinforced_sections import bar_positions, draw_sections, sections_to_draw
from bridge_demolition_addon.charts.style import blank_figure
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario import Abutments, BoxGirder, Deck, Girders

ABUTMENTS = Abutments(length_m=1.5, width_m=9.0, height_m=5.0)


def drawn(of_bridge):
    members, schedule = prepared_members(scenario(of_bridge)).members, scheduled(of_bridge)
    sections = sections_to_draw(members, schedule)
    figure = blank_figure(6.7, 5.1)
    draw_sections(figure, sections, schedule)
    return figure, sections, schedule


def test_bars_of_a_slab_are_at_their_depth_and_evenly_spread():
    """The deck is from 5.5 to 6.1 m high and 3.7 m wide: outer bars have the cover beside them, 45 mm."""
    _, sections, schedule = drawn(bridge())
    (row,) = layer(schedule, "deck", "bottom", "x")
    positions = bar_positions(row, sections[0].members[0], sections[0])
    assert len(positions) == row.choice.number
    assert positions[:, 1] == pytest.approx(5.5 + row.layer.depth_m)
    radius = 0.5 * row.choice.diameter_m
    assert (positions[0, 0], positions[-1, 0]) == pytest.approx((-1.85 + 0.045 + radius, 1.85 - 0.045 - radius))
    assert np.diff(positions[:, 0]) == pytest.approx(row.choice.spacing_m)


def test_bars_of_a_column_are_within_its_four_sides():
    _, sections, schedule = drawn(bridge(skew_deg=20.0))
    section = sections[-1]
    (column,) = section.members
    corners = column.without_skew(column.solid.vertices)[:, [1, 0]]
    for side in ("start", "end", "right", "left"):
        (row,) = layer(schedule, column.name, side, "z")
        positions = bar_positions(row, column, section)
        assert len(positions) == row.choice.number
        least = np.minimum(positions - corners.min(axis=0), corners.max(axis=0) - positions).min()
        assert least == pytest.approx(0.045 + 0.010 + 0.5 * row.choice.diameter_m)  # cover and link


def test_bars_in_two_rows_are_all_there():
    girders = Girders(number=4, width_m=0.5, depth_m=1.0)
    _, sections, schedule = drawn(bridge(LM1, spans=(16.0,), deck=Deck(width_m=8.5, thickness_m=0.25), girders=girders,
                                         pier_caps=None, piers=None, abutments=ABUTMENTS))  # fmt: skip
    assert [member.name for member in sections[0].members] == ["deck", *(f"girder {n}" for n in (1, 2, 3, 4))]
    (row,) = layer(schedule, "girder 1", "bottom", "x")
    assert row.choice.rows > 1
    positions = bar_positions(row, sections[0].members[1], sections[0])
    assert len(positions) == row.choice.number
    assert len(np.unique(positions[:, 1].round(6))) == row.choice.rows
    bottom = float(sections[0].members[1].solid.vertices[:, 2].min())
    assert positions[:, 1].min() == pytest.approx(bottom + 0.045 + 0.010 + 0.5 * row.choice.diameter_m)


def test_what_is_drawn_and_written():
    figure, sections, schedule = drawn(bridge())
    assert [section.title for section in sections] == ["deck", "pier 1 cap", "pier 1 column 1"]
    deck, cap, column = figure.axes
    words = deck.get_xlabel().splitlines()[1:]
    rows = [row for row in schedule.bars if "deck" in row.members]
    assert sorted(words) == sorted(f"{row.where}: {row.bars_text}" for row in rows)
    areas = [patch.get_path().get_extents().size for patch in (deck.patches[0], cap.patches[0], column.patches[0])]
    np.testing.assert_allclose([math.prod(size) for size in areas], [3.7 * 0.6, 1.2 * 0.6, 0.7 * 0.7])


def test_hollows_are_left_white():
    box = BoxGirder(width_m=5.0, depth_m=1.3, web_thickness_m=0.4, bottom_thickness_m=0.25)
    figure, *_ = drawn(bridge(LM1, deck=Deck(width_m=8.0, thickness_m=0.25), box_girder=box, pier_caps=None,
                              piers=None, abutments=ABUTMENTS))  # fmt: skip
    outer, hollow = figure.axes[0].patches
    assert hollow.get_facecolor()[:3] == (1.0, 1.0, 1.0) and outer.get_facecolor()[:3] == (0.9, 0.9, 0.9)
    assert hollow.get_path().get_extents().size == pytest.approx((4.2, 1.05))
