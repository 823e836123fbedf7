# SPDX-License-Identifier: GPL-3.0-or-later
"""The core judges connections, alone and in cuts, with the bits of numpy."""

from dataclasses import fields

import numpy as np
import pytest
from reference import overloads as reference

from bridge_demolition_addon.engineering.geometry.vectors import rotated
from bridge_demolition_addon.engineering.mechanics.carried_sections import CarriedSections
from bridge_demolition_addon.engineering.mechanics.overloads import Overloads
from bridge_demolition_addon.engineering.mechanics.section_cuts import ConnectedFaces, ConnectionLoads, worst_around
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS

CONNECTIONS = 60


@pytest.fixture(params=range(20))
def rng(request):
    return np.random.default_rng(request.param)


@pytest.fixture(params=[{}, {"pressed", "friction"}], ids=["plain", "pressed with friction"])
def further(request, rng):
    return {name: rng.uniform(0.5, 1.5, CONNECTIONS) for name in sorted(request.param)}


def turned(rng, count):
    return rotated(np.tile(np.eye(3), (count, 1, 1)), rng.normal(size=(count, 3)))


class Case:
    """Connections between some bodies: the fewer, the more faces has each. One has no area, some are squares."""

    def __init__(self, rng, further, bodies=20):
        count = CONNECTIONS
        first = np.arange(count) % bodies
        self.pairs = np.stack([first, (first + rng.integers(1, bodies, count)) % bodies], axis=1)
        areas, moments = rng.uniform(0.1, 2.0, count), np.zeros((count, 2, 2))
        areas[4] = 0.0
        moments[:, [0, 1], [0, 1]] = rng.uniform(0.01, 0.2, (count, 2))
        moments[:, 0, 1] = moments[:, 1, 0] = rng.choice([0.0, 0.004, -0.009], count)
        moments[10:20] = np.eye(2) * moments[10:20, :1, :1]
        normals = rng.normal(size=(count, 3))
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        faces = ConnectedFaces(self.pairs, rng.normal(size=(count, 3)), normals, areas, moments)
        self.moves = np.ones(bodies, bool)
        given = faces, self.moves, MATERIALS["concrete"]
        self.judging, self.expected = (
            Overloads(*given, None, **further),
            reference.ReferenceOverloads(*given, **further),
        )
        signs = np.where(np.arange(count) % 3 > 0, 1.0, -1.0)
        self.sections = CarriedSections(self.pairs[:, 0], signs, rng.normal(size=(count, 3)), turned(rng, count))
        self.loads = rng.normal(size=(6, count)) * 10.0 ** rng.uniform(3.0, 7.0, count)
        self.places = rng.normal(size=(3, bodies)), np.ascontiguousarray(np.moveaxis(turned(rng, bodies), 0, -1))
        self.intact = rng.uniform(size=count) < 0.8
        self.intact[4] = False


def test_an_overload_is_seen_at_the_utilisation_itself(rng, further):
    """With what is left of a strength at the utilisation, nothing is overloaded; with a last bit less, it is."""
    case, rows = Case(rng, further), np.arange(CONNECTIONS)
    used = case.judging.of_forces(rows, reference.forces_in_sections(case.sections, case.loads, *case.places))
    assert np.isfinite(used).sum() == CONNECTIONS - 1
    left, intact = np.where(rows % 2, used, np.nextafter(used, 0.0)), rows % 5 > 0
    left[4] = 0.0
    over, alone = case.judging.over_alone(intact, case.sections, case.loads, *case.places, left)
    assert over.tolist() == [row for row in rows.tolist() if row % 2 == 0 and row % 5 and row != 4]
    np.testing.assert_array_equal(alone, used[over] / left[over])


def test_loads_that_are_not_known_overload_nothing(rng, further):
    case = Case(rng, further)
    case.loads[rng.integers(0, 6, 10), rng.integers(0, CONNECTIONS, 10)] = np.nan
    case.loads[0, 7], left = np.inf, rng.uniform(0.0, 2.0, CONNECTIONS)
    with np.errstate(invalid="ignore"):
        expected = case.expected.over_alone(case.intact, case.sections, case.loads, *case.places, left)
        found = case.judging.over_alone(case.intact, case.sections, case.loads, *case.places, left)
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)
    assert not np.isnan(case.loads[:, found[0]]).any() and len(found[0])


@pytest.mark.parametrize("bodies", [20, 3, 2], ids=["few faces", "many", "all in one"])
def test_cuts_are_those_of_the_reference(rng, further, bodies):
    case = Case(rng, further, bodies)
    sizes = 10.0 ** rng.uniform(3.0, 7.0, (2, CONNECTIONS, 1))
    loads = ConnectionLoads(*(sizes * rng.normal(size=(2, CONNECTIONS, 3))), rng.normal(size=(CONNECTIONS, 3)))
    rows = np.flatnonzero(case.intact)
    axes = turned(rng, len(rows))
    found = case.judging.in_cuts(rows, loads, axes, case.intact)
    np.testing.assert_array_equal(found, case.expected.in_cuts(rows, loads, axes, case.intact))
    assert np.isfinite(found).all() and (found > 0.0).all()


@pytest.mark.parametrize("bodies", [20, 3], ids=["few faces", "many"])
def test_the_same_connections_break(rng, further, bodies):
    case = Case(rng, further, bodies)
    rows, left = np.flatnonzero(case.intact), np.ones(CONNECTIONS)
    of_all = reference.loads_at_once(case.sections, case.loads, *case.places)
    axes = reference.section_axes_of(case.sections, rows, case.places[1])
    used = case.expected.in_cuts(rows, of_all, axes, case.intact)
    left[rows] = np.where(rows % 2, used, np.nextafter(used, 0.0))
    given = case.intact, case.sections, case.loads, *case.places, left
    over, by = case.expected.over_in_cuts(*given)
    assert len(over) and not (over % 2).any()
    found = case.judging.breaking(*given)
    assert found.tolist() == over[worst_around(case.pairs[over], by, case.moves)].tolist() != []


@pytest.mark.parametrize("count", [129, 300])
def test_a_cut_through_more_faces_than_numpy_adds_in_one_go(count):
    rng = np.random.default_rng(count)
    pairs = np.column_stack((np.zeros(count, int), np.ones(count, int)))
    normals, areas = np.tile([1.0, 0.0, 0.0], (count, 1)), rng.uniform(0.1, 2.0, count)
    moments = np.eye(2) * rng.uniform(0.01, 0.2, (count, 1, 1))
    faces = ConnectedFaces(pairs, rng.normal(size=(count, 3)), normals, areas, moments)
    given, intact = (faces, np.ones(2, bool), MATERIALS["steel"]), rng.uniform(size=count) < 0.99
    loads = ConnectionLoads(*(1e6 * rng.normal(size=(2, count, 3))), faces.points_m)
    rows = np.flatnonzero(intact)[::17]
    axes = turned(rng, len(rows))
    expected = reference.ReferenceOverloads(*given).in_cuts(rows, loads, axes, intact)
    np.testing.assert_array_equal(Overloads(*given, None).in_cuts(rows, loads, axes, intact), expected)


def test_loads_are_carried_with_the_same_bits(rng):
    case, bodies = Case(rng, {}), 20
    rotations = np.stack([np.moveaxis(turned(rng, bodies), 0, -1) for _ in range(5)], axis=2)
    history = rng.normal(size=(6, 5, CONNECTIONS)), rng.normal(size=(3, 5, bodies)), rotations
    found, expected = case.sections.loads(*history), reference.carried_loads(case.sections, *history)
    for item in fields(ConnectionLoads):
        one, other = getattr(found, item.name), getattr(expected, item.name)
        assert one.shape == (5, CONNECTIONS, 3) and one[..., 0].flags.c_contiguous
        np.testing.assert_array_equal(one, other)


def test_what_does_not_fit_is_not_read():
    case = Case(np.random.default_rng(1), {})
    loads, axes = ConnectionLoads(*np.zeros((3, CONNECTIONS, 3))), np.zeros((1, 3, 3))
    left, places = np.ones(CONNECTIONS), case.places
    few = tuple(np.ascontiguousarray(each[..., :5]) for each in places)
    with pytest.raises(ValueError, match="connections are known on bodies 0 to 19 of 5"):
        case.judging.over_alone(case.intact, case.sections, case.loads, *few, left)
    with pytest.raises(ValueError, match="rotations has 45 numbers: expected 180"):
        case.judging.over_alone(case.intact, case.sections, case.loads, places[0], few[1], left)
    with pytest.raises(ValueError, match="loads has 354 numbers: expected 360"):
        case.judging.over_alone(case.intact, case.sections, case.loads[:, 1:], *places, left)
    with pytest.raises(ValueError, match="intact has numbers of type int64: expected bool"):
        case.judging.over_alone(case.intact.astype(int), case.sections, case.loads, *places, left)
    with pytest.raises(ValueError, match="rows are 60 to 60 of 60 connections"):
        case.judging.in_cuts(np.array([CONNECTIONS]), loads, axes, case.intact)
    with pytest.raises(ValueError, match="axes has 9 numbers: expected 18"):
        case.judging.in_cuts(np.array([1, 2]), loads, axes, case.intact)
