# SPDX-License-Identifier: GPL-3.0-or-later
"""The core adds up loads and work of a frame with the bits of numpy."""

from dataclasses import replace

import numpy as np
import pytest
from reference import frames as reference

from bridge_demolition_addon.engineering.geometry.vectors import as_vectors, rotated
from bridge_demolition_addon.engineering.mechanics.frame_loads import LoadAccumulator, SubstepLoads
from bridge_demolition_addon.engineering.mechanics.stress import average_stress
from bridge_demolition_addon.engineering.mechanics.work import PairImpulses, shared_work, works_on_bodies

SUBSTEPS, BODIES, CONNECTIONS, CONTACTS = 3, 12, 40, 25


@pytest.fixture(params=range(20))
def rng(request):
    return np.random.default_rng(request.param)


def vectors(rng, *shape):
    return as_vectors(rng.normal(size=(3, *shape)) * 10.0 ** rng.uniform(-3.0, 6.0, shape))


def pairs(rng, count):
    first = rng.integers(0, BODIES, count)
    return np.column_stack((first, (first + rng.integers(1, BODIES, count)) % BODIES))


def some_loads(rng):
    turns = rotated(np.tile(np.eye(3), (SUBSTEPS, BODIES, 1, 1)), rng.normal(size=(SUBSTEPS, BODIES, 3)))
    return SubstepLoads(
        substeps_s=rng.uniform(1e-3, 1e-2, SUBSTEPS),
        connection_forces_n=vectors(rng, SUBSTEPS, CONNECTIONS),
        connection_moments_nm=vectors(rng, SUBSTEPS, CONNECTIONS),
        connection_points_m=vectors(rng, SUBSTEPS, CONNECTIONS),
        signed_2019_ns=rng.normal(size=(SUBSTEPS, CONNECTIONS)),
        contact_substeps=np.sort(rng.integers(0, SUBSTEPS, CONTACTS)),
        contact_pairs=pairs(rng, CONTACTS),
        contact_impulses_ns=vectors(rng, CONTACTS),
        contact_points_m=vectors(rng, CONTACTS),
        centres_m=vectors(rng, SUBSTEPS, BODIES),
        rotations=turns,
    )


def without_contacts(loads):
    nothing = np.zeros((0, 3))
    return replace(
        loads,
        contact_substeps=np.zeros(0, int),
        contact_pairs=np.zeros((0, 2), int),
        contact_impulses_ns=nothing,
        contact_points_m=nothing,
    )


@pytest.mark.parametrize("unknown", [False, True], ids=["known", "one unknown"])
def test_sums_over_connections(rng, unknown):
    batches = [without_contacts(some_loads(rng)) for _ in range(2)]
    batches[0].connection_forces_n[1, 5] = np.nan if unknown else 0.0
    batches[1].connection_forces_n[:, 6:9] = 0.0
    connected, impulses, peaks = pairs(rng, CONNECTIONS), np.zeros((6, CONNECTIONS)), np.zeros((7, CONNECTIONS))
    accumulator = LoadAccumulator(connected, np.zeros(BODIES), lambda _: vectors(rng, CONNECTIONS))
    for batch in batches:
        resultants, _, _ = reference.of_connections(connected, batch, BODIES, impulses, peaks)
        np.testing.assert_array_equal(accumulator.add(batch), resultants)
    loads, per_second = accumulator.finish(), 1.0 / sum(float(of) for batch in batches for of in batch.substeps_s)
    np.testing.assert_allclose(loads.connection_forces_n, per_second * impulses[:3].T, rtol=1e-15)
    np.testing.assert_allclose(loads.connection_moments_nm, per_second * impulses[3:].T, rtol=1e-15)
    np.testing.assert_array_equal(loads.connection_peaks_n, peaks[0])
    np.testing.assert_array_equal(loads.connection_peak_forces_n, peaks[1:4].T)
    np.testing.assert_array_equal(loads.connection_peak_moments_nm, peaks[4:].T)
    assert np.isnan(loads.connection_peaks_n).sum() == unknown


@pytest.mark.parametrize("of_faces", [True, False], ids=["with moments", "forces alone"])
def test_stresses(rng, of_faces):
    volumes = rng.uniform(0.0, 2.0, BODIES) * (rng.uniform(size=BODIES) < 0.8)
    loads = [vectors(rng, CONTACTS) for _ in range(4)]
    loads[0][3] = np.nan
    given = (pairs(rng, CONTACTS), *loads[:2], vectors(rng, BODIES), volumes, *(loads[2:] if of_faces else ()))
    found = average_stress(*given)
    np.testing.assert_array_equal(found, reference.average_stress(*given))
    assert not found[volumes == 0.0].any()


@pytest.mark.parametrize("of_faces", [True, False], ids=["with moments", "forces alone"])
def test_works_and_what_they_do(rng, of_faces):
    first, second = pairs(rng, CONTACTS).T
    angular = vectors(rng, CONTACTS) if of_faces else None
    between = PairImpulses(np.zeros((0, 2), int), vectors(rng, CONTACTS), vectors(rng, CONTACTS), angular)
    motion, is_free = rng.normal(size=(6, BODIES)), rng.uniform(size=BODIES) < 0.8
    motion[:, 3] = 0.0
    on_first, on_second = works = works_on_bodies(between, motion, first, second)
    np.testing.assert_array_equal(works, reference.works(between, motion, first, second))
    total = on_first - on_second
    total[4] = np.nan
    returned = np.zeros(0) if of_faces else rng.uniform(size=CONTACTS) * np.maximum(total, 0.0)
    found = shared_work(total, returned, on_first, on_second, first, second, is_free)
    expected = reference.shared(total, returned, on_first, on_second, first, second, is_free)
    names = ("taken_j", "rows", "made_j", "by_first_j", "by_second_j")
    for name, numbers in zip(names, expected, strict=True):
        np.testing.assert_array_equal(getattr(found, name), numbers, err_msg=name)
    assert len(found.rows)


def test_bodies_that_there_are_not_are_not_read():
    rng = np.random.default_rng(1)
    loads, connected = some_loads(rng), pairs(rng, CONNECTIONS)
    connected[3, 1] = BODIES
    with pytest.raises(ValueError, match="rows that there are not"):
        LoadAccumulator(connected, np.ones(BODIES), lambda _: vectors(rng, CONNECTIONS)).add(loads)
    points = vectors(rng, CONNECTIONS)
    with pytest.raises(ValueError, match="rows that there are not"):
        average_stress(-1 - pairs(rng, CONNECTIONS), points, points, vectors(rng, BODIES), np.ones(BODIES))
    with pytest.raises(ValueError, match="volumes has numbers of type int64"):
        average_stress(pairs(rng, CONNECTIONS), points, points, vectors(rng, BODIES), np.ones(BODIES, int))
    with pytest.raises(ValueError, match="forces has 117 numbers: expected 120"):
        average_stress(pairs(rng, CONNECTIONS), points[1:], points, vectors(rng, BODIES), np.ones(BODIES))
    between = PairImpulses(connected, points, points)
    with pytest.raises(ValueError, match="rows that there are not"):
        works_on_bodies(between, rng.normal(size=(6, BODIES)), *np.ascontiguousarray(connected.T))
