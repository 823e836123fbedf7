# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes of bars that are given by their axes alone: places and eccentricities by hand."""

import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.vectors import transformed
from bridge_demolition_addon.engineering.steelwork.bar_frames import BarAxes, BarStation, bar_frame
from bridge_demolition_addon.engineering.steelwork.bars import bar_axes
from bridge_demolition_addon.engineering.steelwork.catalogue import section_named


def axes_of(*bars):
    """Axes of bars that are given by begin, end and the name of their section."""
    outlines, areas = [], []
    for begin, end, name in bars:
        section = section_named(name)
        own = bar_axes(np.array(begin, float), np.array(end, float), 0.0)
        outlines.append(transformed(own[:, 1:], np.concatenate(section.rings)))
        areas.append(section.area_m2)
    begins, ends = (np.array([bar[column] for bar in bars], float) for column in (0, 1))
    return BarAxes(begins, ends, outlines, np.array(areas))


def places(frame):
    return np.array(sorted(tuple(place) for place in (frame.places_m.round(6) + 0.0).tolist()))


def shortened(begin, end, by_m):
    """A bar that ends before both of its points, as at gusset plates."""
    way = np.subtract(end, begin) / math.dist(begin, end)
    return np.array(begin) + by_m * way, np.array(end) - by_m * way


def test_diagonals_that_end_at_gusset_plates_meet_in_the_chord():
    """Two panels of 4 m, 3 m high; chords as one bar each, diagonals 0.25 m shorter at both ends."""
    chord, tube = "HEB 200", "CHS 114.3x6.3"
    bottom, tops = ((0, 0, 0), (8, 0, 0)), ((2, 0, 3), (6, 0, 3))
    diagonals = [((0, 0, 0), tops[0]), (tops[0], (4, 0, 0)), ((4, 0, 0), tops[1]), (tops[1], (8, 0, 0))]
    bars = [(*bottom, chord), (*tops, chord), *((*shortened(*ends, 0.25), tube) for ends in diagonals)]
    frame = bar_frame(axes_of(*bars))
    assert places(frame) == pytest.approx(
        np.array([(0, 0, 0), (2, 0, 3), (4, 0, 0), (6, 0, 3), (8, 0, 0)], float), abs=1e-6
    )
    assert len(frame.pieces) == 7  # the lower chord is two
    assert not frame.free_ends
    assert max(frame.eccentricities_m.values()) == pytest.approx(0.0, abs=1e-9)
    assert not frame.radii_m  # a scenario works them out


def test_a_beam_that_lies_lower_keeps_its_axis_and_ends_beside_the_node():
    """Cross beam HEB 200 under the flange of a girder of 1.2 m, whose axis is 0.4 m higher: the girder is divided."""
    girder, beam = "I 1200x300x12x25", "HEB 200"
    frame = bar_frame(axes_of(((0, 0, 0), (10, 0, 0), girder), ((4, 0.1, -0.4), (4, 3, -0.4), beam)))
    assert places(frame) == pytest.approx(np.array([(0, 0, 0), (4, 0, 0), (4, 3, -0.4), (10, 0, 0)], float), abs=1e-6)
    (of_beam,) = (piece for piece in frame.pieces if piece.bar == 1)
    node = [tuple(frame.places_m[number].round(6)) for number in of_beam.nodes].index((4, 0, 0))
    assert of_beam.from_nodes_m[node] == pytest.approx((0, 0, -0.4), abs=1e-9)
    assert frame.eccentricities_m == pytest.approx({0: 0.0, 1: 0.4}, abs=1e-9)
    assert frame.free_ends == ((0, 0), (0, 1), (1, 1))


def test_bars_in_one_line_meet_in_the_middle_of_their_splice():
    frame = bar_frame(axes_of(((0, 0, 0), (4.99, 0, 0), "IPE 300"), ((9, 0, 0.02), (5.01, 0, 0.02), "IPE 300")))
    assert len(frame.places_m) == 3
    assert frame.places_m[1] == pytest.approx((5.0, 0.0, 0.0), abs=1e-9)
    assert frame.eccentricities_m == pytest.approx({0: 0.0, 1: 0.02}, abs=1e-9)


def test_bars_that_pass_each_other_or_end_far_away_are_not_joined():
    crossing = [((0, 0, 0), (4, 0, 4), "L 100x100x10"), ((0, 0.1, 4), (4, 0.1, 0), "L 100x100x10")]
    far = ((10, 0, 0), (10, 0, 4), "HEB 200")
    frame = bar_frame(axes_of(*crossing, far))
    assert frame.crossings == ((0, 1),)
    assert len(frame.pieces) == 3
    assert len(frame.free_ends) == 6
    beside = bar_frame(axes_of(((0, 0, 0), (6, 0, 0), "IPE 300"), ((0, 1, 0), (6, 1, 0), "IPE 300")))
    assert len(beside.free_ends) == 4


def test_a_support_divides_a_bar_where_it_is_and_its_node_lies_there():
    axes = axes_of(((0, 0, 5), (20, 0, 5), "HEB 1000"))
    frame = bar_frame(axes, [BarStation(0, 0.3), BarStation(0, 10.0), BarStation(0, 19.0)])
    assert places(frame) == pytest.approx(np.array([(0.3, 0, 5), (10, 0, 5), (19, 0, 5), (20, 0, 5)], float), abs=1e-6)
    assert [frame.places_m[node][0] for node in frame.node_of_support] == pytest.approx([0.3, 10.0, 19.0])


def test_nodes_leave_room_for_every_bar():
    """Two cross beams 0.15 m apart are in one node; where acute bars leave no room, nodes are smaller."""
    girder = ((0, 0, 0), (10, 0, 0), "HEB 300")
    beams = [((x, 0.2, 0), (x, 4, 0), "HEB 200") for x in (4.0, 4.15)]
    frame = bar_frame(axes_of(girder, *beams))
    on_girder = places(frame)[places(frame)[:, 1] == 0.0]
    assert on_girder == pytest.approx(np.array([(0, 0, 0), (4.075, 0, 0), (10, 0, 0)], float), abs=1e-6)
    assert sorted(frame.eccentricities_m.values()) == pytest.approx([0.0, 0.075, 0.075], abs=1e-9)
    acute = [((0, 0, 0), (3, 0.3, 0), "HEB 300"), ((0, 0, 0), (3, -0.3, 0), "HEB 300")]
    frame = bar_frame(axes_of(*acute))
    (node,) = (number for number, place in enumerate(frame.places_m) if not place.any())
    assert frame.radii_m[node] == pytest.approx(0.4 * math.hypot(3.0, 0.3), rel=1e-6)
