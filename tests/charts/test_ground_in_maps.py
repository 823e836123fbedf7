# SPDX-License-Identifier: GPL-3.0-or-later
"""The ground in maps and in the report of a run: contour lines where they belong, and what became of the file."""

from dataclasses import asdict, replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from bridge_demolition_addon.charts.plan_maps import draw_ground, plan_axes
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.terrain.levelling import Levelled
from bridge_demolition_addon.engineering.terrain.surface import NamedSurface, RecordedGround, Surface
from bridge_demolition_addon.model.results.records import record_of
from bridge_demolition_addon.model.terrain.built import TerrainFacts, terrain_summary

CORNERS = np.array([[-100, -100, 60], [100, -100, -40], [100, 100, -40], [-100, 100, 60]], float)
TWO = np.array([[0, 1, 2], [0, 2, 3]])
SLOPE = RecordedGround(Surface(TriangleMesh(CORNERS, TWO)))
"""Falls by 1 in 2 along x, and is at height 10 where x is 0."""


def shown(ground, low=-20.0, high=20.0):
    axes = plan_axes(Figure())
    axes.set(xlim=(low, high), ylim=(low, high))
    draw_ground(axes, ground)
    return axes


def test_contour_lines_run_where_the_ground_has_their_height():
    axes = shown(SLOPE)
    (lines,) = (collection for collection in axes.collections if hasattr(collection, "levels"))
    # Heights from 0 to 20 m are in the map, in round steps; which of them, matplotlib's locator chooses.
    assert len(lines.levels) >= 4 and set(np.diff(lines.levels).round(9)) <= {1.0, 2.0, 5.0}
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        np.testing.assert_allclose(path.vertices[:, 0], (10.0 - level) / 0.5, atol=1e-9)
    assert axes.get_xlim() == (-20.0, 20.0) and axes.get_ylim() == (-20.0, 20.0)


def test_flat_ground_has_none():
    assert not shown(RecordedGround()).collections
    level = RecordedGround(Surface(TriangleMesh(CORNERS * (1, 1, 0), TWO)))
    assert not shown(level).collections


def test_surfaces_are_outlined_and_named():
    square = np.array([[0, 0, 20], [8, 0, 20], [8, 8, 20], [0, 8, 20]], float)
    river = NamedSurface("river <1> $2$", "water", Surface(TriangleMesh(square, TWO)))
    axes = shown(replace(SLOPE, surfaces=(river,)))
    (outline,) = axes.patches
    assert outline.get_path().get_extents().extents == pytest.approx([0, 0, 8, 8])
    assert [text.get_text() for text in axes.texts if "river" in text.get_text()] == [r"river <1> \$2\$"]


def test_a_summary_describes_the_terrain_again():
    pier = Levelled("pier 1", 0.25, 0.125)
    facts = TerrainFacts("dtm.tif", 3000, 900, 0.4, 0.04, (3.0, -7.5), 0.02, -4.5, 6.25, 0.031, (pier,))
    words = dict(terrain_summary(facts))
    assert words["error"] == "0.040 m at most, near (3.0, -7.5) m; 95 % of the heights within 0.020 m"
    assert words["without data"].startswith("3.1 % of the site")
    assert words["under pier 1"] == "dug up to 0.25 m, filled up to 0.12 m"
    kept = asdict(facts) | {"error_place_m": [3.0, -7.5], "levelled": [asdict(pier)]}  # as JSON gives it back
    assert record_of(TerrainFacts, kept, "terrain") == facts
