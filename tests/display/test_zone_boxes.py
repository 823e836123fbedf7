# SPDX-License-Identifier: GPL-3.0-or-later
"""Boxes and drill holes of blast zones as lines, against the worked example by hand."""

from dataclasses import replace

import numpy as np
import pytest
from support.drilled_columns import ZONE, column_members

from bridge_demolition_addon.display.zone_boxes import box_lines, delay_colours, hole_lines
from bridge_demolition_addon.model.structure.blast_zones import placed_zone


def test_a_box_has_twelve_edges():
    lines = box_lines(np.array([(0.0, 0.0, 0.0), (1.0, 2.0, 3.0)])).reshape(-1, 2, 3)
    lengths = abs(lines[:, 1] - lines[:, 0])
    assert sorted(lengths.sum(axis=1).tolist()) == [1.0] * 4 + [2.0] * 4 + [3.0] * 4
    assert ((lengths > 0.0).sum(axis=1) == 1).all()
    assert len({tuple(sorted(map(tuple, line))) for line in lines.tolist()}) == 12


@pytest.mark.parametrize(("side", "mouth", "end"), [("start", -0.35, 0.1), ("end", 0.35, -0.1)])
def test_holes_go_in_from_their_side(side, mouth, end):
    """Ten holes of 0.45 m into a column of 0.7 m: rows 0.35 m apart, and 0.3 m from hole to hole, staggered."""
    lines = hole_lines(placed_zone(replace(ZONE, side=side), column_members())).reshape(-1, 2, 3)
    assert len(lines) == 10
    np.testing.assert_allclose(lines[:, 0, 0], mouth)
    np.testing.assert_allclose(lines[:, 1, 0], end)
    np.testing.assert_allclose(np.unique(lines[:, 0, 1].round(6)), [-0.175, 0.175])
    first = np.sort(lines[lines[:, 0, 1] < 0.0][:, 0, 2])
    np.testing.assert_allclose(np.diff(first), 0.3)
    assert first.mean() == pytest.approx(1.5 - 0.075)


def test_colours_go_by_the_delay():
    zones = [placed_zone(replace(ZONE, delay_ms=delay), column_members()) for delay in (300.0, 0.0, 600.0)]
    dark, light = delay_colours(zones)[1], delay_colours(zones)[2]
    assert dark.sum() < delay_colours(zones)[0].sum() < light.sum()
    assert len(delay_colours([])) == 0
