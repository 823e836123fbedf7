# SPDX-License-Identifier: GPL-3.0-or-later
"""Banks stand on the ground that a run was on: their road is nowhere below it, and their slopes end in it."""

import numpy as np
import pytest

from bridge_demolition_addon.display.approaches import LENGTH_M, bank
from bridge_demolition_addon.display.dressing import Stuff
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.terrain.surface import RecordedGround, Surface

EDGES_M, TOP_M = (-3.5, 3.5), 5.0


def ground_of(height):
    """A ground whose height at x and y is given, in squares of 2 m."""
    numbers = np.arange(-120.0, 121.0, 2.0)
    x, y = np.meshgrid(numbers, numbers, indexing="ij")
    count = len(numbers)
    first = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    triangles = np.concatenate([first[:, None] + (0, count, 1), first[:, None] + (1, count, count + 1)])
    vertices = np.column_stack((x.ravel(), y.ravel(), np.broadcast_to(height(x, y), x.shape).ravel()))
    return RecordedGround(Surface(TriangleMesh(vertices, triangles)))


HILLS = ground_of(lambda x, y: 1.5 + 2.0 * np.sin(x / 9.0) * np.cos(y / 13.0) + 0.08 * y)
RISING = ground_of(lambda x, y: 4.6 + 0.05 * np.maximum(x - 10.0, 0.0))


@pytest.mark.parametrize("ground", [RecordedGround(), HILLS, RISING], ids=["flat", "hills", "rising"])
@pytest.mark.parametrize("away", [-1.0, 1.0])
def test_its_road_is_above_the_ground_and_its_slopes_end_below_it(ground, away):
    begun = bank(away * 10.0, away, EDGES_M, TOP_M, ground)
    assert begun.length_m == pytest.approx(LENGTH_M)
    assert begun.stations_m[0] == away * 10.0 and begun.away == away
    across = np.linspace(*EDGES_M, 9)
    there = ground.heights_at(np.stack(np.broadcast_arrays(begun.stations_m[:, None], across), axis=-1))
    assert (begun.road_m[:, None] >= there).all()
    for side in (0, 1):
        y, z = begun.feet_m[:, side].T
        assert (z < ground.heights_at(np.column_stack((begun.stations_m, y)))).all()


def test_on_flat_ground_its_road_is_level_and_on_rising_ground_it_climbs_by_8_percent_at_most():
    assert set(bank(10.0, 1.0, EDGES_M, TOP_M, RecordedGround()).road_m) == {TOP_M}
    climbing = bank(10.0, 1.0, EDGES_M, TOP_M, RISING)
    gradients = np.diff(climbing.road_m) / np.diff(climbing.stations_m)
    assert climbing.road_m[-1] > TOP_M + 2.0 and gradients.min() >= 0.0 and gradients.max() <= 0.08 + 1e-9


def test_it_ends_before_a_hillside_and_is_none_where_the_ground_is_above_the_deck():
    wall = ground_of(lambda x, _: np.where(x > 40.0, 20.0, 0.0))
    assert bank(10.0, 1.0, EDGES_M, TOP_M, wall).stations_m[-1] <= 40.0
    assert bank(10.0, 1.0, EDGES_M, TOP_M, ground_of(lambda x, _: 0.0 * x + TOP_M + 1.0)) is None


def test_all_its_parts_are_closed_solids_behind_its_wall():
    parts = bank(10.0, 1.0, EDGES_M, TOP_M, HILLS).parts()
    assert {part.stuff for part in parts} == {Stuff.SOIL, Stuff.CONCRETE, Stuff.ASPHALT, Stuff.WHITE, Stuff.STEEL}
    for part in parts:
        edges = np.sort(part.solid.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
        assert part.solid.volume > 0.0
        assert part.solid.vertices[:, 0].min() >= 10.0 - 0.03
