# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of the I-235 example: masses, places and connections against hand calculations."""

from dataclasses import fields, replace
from functools import cache

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.structure.connections import GROUND
from bridge_demolition_addon.errors import GeometryError
from bridge_demolition_addon.model.scenario import ConnectionSettings
from bridge_demolition_addon.model.structure.members import shards_per_member
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

# Members by hand, m³: the deck, one pier cap, one column; 44.794 m³ together.
DECK, CAP, COLUMN = 14 * 8.5 * 0.25, 0.8 * 8.5 * 0.4, 0.7 * 0.7 * 4.9
VOLUMES = [DECK, CAP, COLUMN, COLUMN, CAP, COLUMN, COLUMN]

# The fracture promises volumes to 1e-9 of the solid's.
VOLUME_TOLERANCE = 1e-9

# Areas lack faces below 1e-10 of a shard's cross-section; a face is cut off some hundred times at most.
AREA_TOLERANCE = 1e-7


@cache
def model_of(method="face", shards=60, **settings):
    radius = None if method == "face" else 1.0
    connections = ConnectionSettings(method=method, search_radius_m=radius, breaking_force_n=1e5, **settings)
    return build_model(replace(I235, fracture=replace(I235.fracture, shards=shards), connections=connections))


@cache
def example():
    return build_model(I235)


def test_masses_of_the_example_add_up_to_107_tonnes():
    model = example()
    assert len(model.shards) == len(model.masses_kg) == 200
    assert model.masses_kg.sum() == pytest.approx(107_000, rel=VOLUME_TOLERANCE)
    assert model.density_kg_m3 == pytest.approx(107_000 / 44.794, rel=1e-12)
    assert (model.masses_kg > 0.0).all()


def test_every_member_keeps_its_mass():
    model = example()
    masses = np.bincount(model.member_of_shard, model.masses_kg)
    np.testing.assert_allclose(masses, np.array(VOLUMES) * 107_000 / 44.794, rtol=VOLUME_TOLERANCE)


def test_shards_lie_in_their_members():
    model = example()
    for shard, centre, member in zip(model.shards, model.centres_m, model.member_of_shard, strict=True):
        low, high = model.members[member].solid.bounds
        # Cuts are exact to rounding of coordinates of some ten metres.
        assert (shard.vertices >= low - 1e-9).all() and (shard.vertices <= high + 1e-9).all()
        assert (centre > low).all() and (centre < high).all()


def test_centre_of_mass_of_the_whole_bridge():
    model = example()
    centre = model.masses_kg @ model.centres_m / model.masses_kg.sum()
    # The middle of the span and of the road; deck, caps and columns at 5.425, 5.1 and 2.45 m.
    height = (DECK * 5.425 + 2 * CAP * 5.1 + 4 * COLUMN * 2.45) / 44.794
    np.testing.assert_allclose(centre, [6.5, 0.0, height], atol=1e-8)


def arrays_of(model):
    yield from (model.masses_kg, model.centres_m, model.member_of_shard)
    yield from (getattr(model.connections, item.name) for item in fields(model.connections))
    for shard in model.shards:
        yield from (shard.vertices, shard.triangles)


def test_the_same_scenario_gives_the_same_model():
    again = build_model(I235)
    assert all(np.array_equal(one, other) for one, other in zip(arrays_of(example()), arrays_of(again), strict=True))


def test_another_seed_cuts_other_shards():
    other = build_model(replace(I235, seed=236))
    assert not np.allclose(other.masses_kg, example().masses_kg, rtol=0.01)
    assert other.masses_kg.sum() == pytest.approx(107_000, rel=VOLUME_TOLERANCE)


def test_equal_members_are_cut_differently():
    model = example()
    # Two columns of one pier, of which one may get a shard more than the other.
    left, right = (model.centres_m[model.member_of_shard == member][:11] for member in (2, 3))
    assert not np.allclose(left, right - (0.0, 4.25, 0.0), atol=0.01)


@pytest.mark.parametrize(
    "volumes, shards, counts",
    [
        ([6.0, 3.0, 1.0], 13, [7, 4, 2]),  # one each, and ten more by volume
        ([1.0, 1.0, 1.0], 5, [2, 2, 1]),  # remainders are equal: the first come first
        ([8.0, 1.0, 1.0], 5, [3, 1, 1]),  # 1.6, 0.2 and 0.2 more
        ([5.0, 4.0, 1.0], 3, [1, 1, 1]),
        ([2.0], 7, [7]),
    ],
)
def test_shards_are_shared_out_by_volume(volumes, shards, counts):
    assert shards_per_member(np.array(volumes), shards).tolist() == counts


def test_members_need_a_shard_each():
    with pytest.raises(GeometryError, match=r"fracture.shards is 6: expected at least 7, one for each member"):
        model_of(shards=6)


def test_uncut_members_are_shards_themselves():
    model = model_of(shards=7)
    np.testing.assert_allclose(model.masses_kg, np.array(VOLUMES) * 107_000 / 44.794, rtol=VOLUME_TOLERANCE)
    # Each cap carries the deck and stands on two columns, each of which stands on the ground.
    pairs = [[0, 1], [0, 4], [1, 2], [1, 3], [4, 5], [4, 6]] + [[column, GROUND] for column in (2, 3, 5, 6)]
    assert model.connections.pairs.tolist() == pairs
    areas = [0.8 * 8.5] * 2 + [0.7 * 0.7] * 8
    np.testing.assert_allclose(model.connections.areas, areas, rtol=AREA_TOLERANCE)
    np.testing.assert_allclose(model.connections.points[0], [0.0, 0.0, 5.3], atol=1e-9)
    np.testing.assert_allclose(model.connections.points[6], [0.0, -2.125, 0.0], atol=1e-9)
    np.testing.assert_allclose(model.connections.normals, [[0.0, 0.0, -1.0]] * 10, atol=1e-9)


def test_members_rest_on_each_other_with_their_whole_area():
    model = model_of()
    between = model.connections.pairs[:, 1] != GROUND
    kinds = np.array([model.members[member].kind for member in model.member_of_shard])
    met = [" on ".join(sorted(kind)) for kind in kinds[model.connections.pairs[between]]]
    areas = {name: model.connections.areas[between][np.array(met) == name].sum() for name in set(met)}
    assert areas["deck on pier cap"] == pytest.approx(2 * 0.8 * 8.5, rel=AREA_TOLERANCE)
    assert areas["pier on pier cap"] == pytest.approx(4 * 0.7 * 0.7, rel=AREA_TOLERANCE)
    assert "deck on pier" not in areas


def test_foundations_take_the_whole_underside_of_the_columns():
    connections = model_of().connections
    on_ground = connections.pairs[:, 1] == GROUND
    assert connections.areas[on_ground].sum() == pytest.approx(4 * 0.7 * 0.7, rel=AREA_TOLERANCE)
    np.testing.assert_allclose(connections.points[on_ground, 2], 0.0, atol=1e-9)


def test_head_and_foot_of_a_column_look_opposite_ways():
    # Summed over a column, faces shared inside it cancel; what remains is 0.49 m² up and 0.49 m² down.
    model = model_of(shards=40)
    connections = model.connections
    vectors = connections.normals * connections.areas[:, None]
    column = np.flatnonzero(model.member_of_shard == 2)
    flux = np.zeros(3)
    for side, sign in ((0, 1.0), (1, -1.0)):
        flux += sign * vectors[np.isin(connections.pairs[:, side], column)].sum(axis=0)
    np.testing.assert_allclose(flux, 0.0, atol=AREA_TOLERANCE)


@pytest.mark.parametrize("method", ["face", "centre", "vertex"])
def test_every_method_connects_the_bridge_and_counts_its_neighbours(method):
    model = model_of(method, foundation=False)
    pairs = model.connections.pairs
    assert len(pairs) and (pairs[:, 0] < pairs[:, 1]).all() and (pairs >= 0).all()
    assert len(np.unique(pairs, axis=0)) == len(pairs)
    if method == "face":
        assert (model.connections.areas > 0.0).all()
    if method == "centre":
        apart = np.linalg.norm(np.diff(model.centres_m[pairs], axis=1)[:, 0], axis=1)
        assert apart.max() <= 1.0
    np.testing.assert_allclose(np.linalg.norm(model.connections.normals, axis=1), 1.0, rtol=1e-12)


def test_limit_counts_shards_but_not_foundations():
    limited = model_of("vertex", limit_per_shard=3).connections
    between = limited.pairs[limited.pairs[:, 1] != GROUND]
    assert np.bincount(between.ravel()).max() == 3
    everything = model_of("vertex").connections
    foundations = (limited.pairs[:, 1] == GROUND).sum()
    assert 4 <= foundations == (everything.pairs[:, 1] == GROUND).sum()
