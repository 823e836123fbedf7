# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled loops judge connections, alone and in cuts, with the bits of numpy."""

from dataclasses import fields

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry import sum_loops
from bridge_demolition_addon.engineering.geometry.rotations import rotated
from bridge_demolition_addon.engineering.mechanics import carried_sections, overloads
from bridge_demolition_addon.engineering.mechanics import overload_loops as loops
from bridge_demolition_addon.engineering.mechanics.carried_sections import CarriedSections
from bridge_demolition_addon.engineering.mechanics.overloads import Overloads
from bridge_demolition_addon.engineering.mechanics.section_cuts import ConnectedFaces, ConnectionLoads
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS, rectangular_sections

CONNECTIONS, BODIES = 60, 20


@pytest.fixture(params=range(4))
def rng(request):
    return np.random.default_rng(request.param)


def values_of(record):
    return [getattr(record, item.name) for item in fields(record)]


def turned(rng, count):
    return rotated(np.tile(np.eye(3), (count, 1, 1)), rng.normal(size=(count, 3)))


def judge(rng, **further):
    pairs = np.stack([np.arange(CONNECTIONS) % BODIES, (np.arange(CONNECTIONS) + 7) % BODIES], axis=1)
    areas = rng.uniform(0.1, 2.0, CONNECTIONS)
    areas[4] = 0.0
    moments = np.repeat(np.eye(2)[None], CONNECTIONS, axis=0) * rng.uniform(0.01, 0.2, (CONNECTIONS, 1, 1))
    moments[:, 0, 1] = moments[:, 1, 0] = 0.004
    normals = np.repeat([[1.0, 0.0, 0.0]], CONNECTIONS, axis=0)
    faces = ConnectedFaces(pairs, rng.normal(size=(CONNECTIONS, 3)), normals, areas, moments)
    return pairs, Overloads(faces, np.ones(BODIES, bool), MATERIALS["concrete"], None, **further)


@pytest.mark.parametrize("counts", [{}, {"pressed", "friction"}], ids=["plain", "pressed with friction"])
def test_an_overload_is_seen_at_the_utilisation_itself(rng, monkeypatch, counts):
    """With what is left of a strength at the utilisation, nothing is overloaded; with a last bit less, it is."""
    further = {name: rng.uniform(0.5, 1.5, CONNECTIONS) for name in sorted(counts)}
    pairs, judging = judge(rng, **further)
    signs = np.where(np.arange(CONNECTIONS) % 3 > 0, 1.0, -1.0)
    sections = CarriedSections(pairs[:, 0], signs, rng.normal(size=(CONNECTIONS, 3)), turned(rng, CONNECTIONS))
    loads = rng.normal(size=(6, CONNECTIONS)) * 10.0 ** rng.uniform(3.0, 7.0, CONNECTIONS)
    places = rng.normal(size=(3, BODIES)), np.ascontiguousarray(np.moveaxis(turned(rng, BODIES), 0, -1))
    rows = np.arange(CONNECTIONS)
    used = judging.of_forces(rows, sections.forces(rows, loads, *places))
    assert np.isfinite(used).sum() == CONNECTIONS - 1
    left, intact = np.where(rows % 2, used, np.nextafter(used, 0.0)), rows % 5 > 0
    left[4] = 0.0
    compiled = judging.over_alone(intact, sections, loads, *places, left)
    monkeypatch.setattr(overloads, "overload_loops", lambda: None)
    plain = judging.over_alone(intact, sections, loads, *places, left)
    for over, alone in (compiled, plain):
        assert over.tolist() == [row for row in rows.tolist() if row % 2 == 0 and row % 5 and row != 4]
        np.testing.assert_array_equal(alone, used[over] / left[over])


@pytest.mark.parametrize("counts", [{}, {"pressed", "friction"}], ids=["plain", "pressed with friction"])
def test_cuts_are_judged_with_the_same_bits(rng, monkeypatch, counts):
    further = {name: rng.uniform(0.5, 1.5, CONNECTIONS) for name in sorted(counts)}
    _, judging = judge(rng, **further)
    sizes = 10.0 ** rng.uniform(3.0, 7.0, (2, CONNECTIONS, 1))
    loads = ConnectionLoads(*(sizes * rng.normal(size=(2, CONNECTIONS, 3))), rng.normal(size=(CONNECTIONS, 3)))
    intact = rng.uniform(size=CONNECTIONS) < 0.8
    rows = np.flatnonzero(intact & (np.arange(CONNECTIONS) != 4))
    axes = turned(rng, len(rows))
    compiled = judging.in_cuts(rows, loads, axes, intact)
    monkeypatch.setattr(overloads, "overload_loops", lambda: None)
    plain = judging.in_cuts(rows, loads, axes, intact)
    np.testing.assert_array_equal(compiled, plain)
    assert np.isfinite(plain).all() and (plain > 0.0).all()


@pytest.mark.parametrize("counts", [{}, {"pressed", "friction"}], ids=["plain", "pressed with friction"])
def test_the_same_connections_break(rng, monkeypatch, counts):
    """One loop judges alone and in cuts, and sees what faces carry only where it needs it."""
    further = {name: rng.uniform(0.5, 1.5, CONNECTIONS) for name in sorted(counts)}
    pairs, judging = judge(rng, **further)
    signs = np.where(np.arange(CONNECTIONS) % 3 > 0, 1.0, -1.0)
    sections = CarriedSections(pairs[:, 0], signs, rng.normal(size=(CONNECTIONS, 3)), turned(rng, CONNECTIONS))
    loads = rng.normal(size=(6, CONNECTIONS)) * 10.0 ** rng.uniform(3.0, 7.0, CONNECTIONS)
    places = rng.normal(size=(3, BODIES)), np.ascontiguousarray(np.moveaxis(turned(rng, BODIES), 0, -1))
    intact = rng.uniform(size=CONNECTIONS) < 0.8
    intact[4] = False
    rows = np.flatnonzero(intact)
    of_all, axes = sections.loads_at_once(loads, *places), sections.carried_axes(rows, places[1])
    used = judging.in_cuts(rows, of_all, axes, intact)
    left = np.ones(CONNECTIONS)
    left[rows] = np.where(rows % 2, used, np.nextafter(used, 0.0))
    compiled = judging.breaking(intact, sections, loads, *places, left)
    monkeypatch.setattr(overloads, "overload_loops", lambda: None)
    plain = judging.breaking(intact, sections, loads, *places, left)
    assert compiled.tolist() == plain.tolist() != []
    assert not (plain % 2).any()


def test_a_section_of_equal_sides_is_a_square_either_way():
    sides = np.array([[[1.0, 0.0], [0.0, 1.0]], [[2.0, 1e-12], [1e-12, 2.0]], [[1.0, 0.0], [0.0, 3.0]]])
    expected = rectangular_sections(np.full(3, 1.5), sides)
    for number, second in enumerate(sides):
        area, directions, moduli, torsion = loops.rectangle(1.5, (second[0, 0], second[0, 1], second[1, 1]))
        np.testing.assert_array_equal(directions, expected.directions[number])
        np.testing.assert_array_equal((area, *moduli), (1.5, *expected.bending_moduli_m3[number]))
        assert torsion == expected.torsion_moduli_m3[number]


def test_sums_are_those_of_numpy(rng):
    for count in range(1, loops.MOST_TERMS + 1):
        values = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-6.0, 6.0, (count, 1))
        expected = np.add.reduceat(values, [0], axis=0)[0].tolist()
        assert [sum_loops.total(column) for column in values.T] == expected
        assert [sum_loops.total_of_row(values.T.copy(), row, count) for row in range(3)] == expected


def test_loads_are_carried_with_the_same_bits(rng, monkeypatch):
    bodies = np.arange(CONNECTIONS) % BODIES
    signs = np.where(np.arange(CONNECTIONS) % 3 > 0, 1.0, -1.0)
    sections = CarriedSections(bodies, signs, rng.normal(size=(CONNECTIONS, 3)), turned(rng, CONNECTIONS))
    rotations = np.stack([np.moveaxis(turned(rng, BODIES), 0, -1) for _ in range(5)], axis=2)
    history = rng.normal(size=(6, 5, CONNECTIONS)), rng.normal(size=(3, 5, BODIES)), rotations
    compiled = sections.loads(*history)
    monkeypatch.setattr(carried_sections, "overload_loops", lambda: None)
    plain = sections.loads(*history)
    for one, other in zip(values_of(compiled), values_of(plain), strict=True):
        assert one.shape == other.shape == (5, CONNECTIONS, 3) and one.strides == other.strides
        np.testing.assert_array_equal(one, other)


def test_the_loops_are_used_where_numba_is_installed():
    assert overloads.overload_loops() is loops
