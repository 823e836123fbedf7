# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled loops add up loads and work of a frame with the bits of numpy."""

from dataclasses import fields

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.rotations import rotated
from bridge_demolition_addon.engineering.geometry.vectors import as_vectors
from bridge_demolition_addon.engineering.mechanics import compiled_mechanics, frame_loads, stress, work
from bridge_demolition_addon.engineering.mechanics.frame_loads import LoadAccumulator, SubstepLoads
from bridge_demolition_addon.engineering.mechanics.work import Motion, PairImpulses, WorkAccumulator

SUBSTEPS, BODIES, CONNECTIONS, CONTACTS = 3, 12, 40, 25


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture
def each_way(monkeypatch):
    """Return what a function gives with compiled loops, and without."""

    def both(function):
        compiled = function()
        with monkeypatch.context() as without_numba:
            for module in (frame_loads, stress, work):
                without_numba.setattr(module, "frame_loops", lambda: None)
            return compiled, function()

    return both


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


def assert_same(one, other):
    for item in fields(one):
        np.testing.assert_array_equal(getattr(one, item.name), getattr(other, item.name), err_msg=item.name)


@pytest.mark.parametrize("unknown", [False, True], ids=["known", "one unknown"])
def test_loads_of_a_frame_have_the_same_bits(rng, each_way, unknown):
    batches = [some_loads(rng) for _ in range(2)]
    batches[0].connection_forces_n[1, 5] = np.nan if unknown else 0.0
    connected, normals, volumes = pairs(rng, CONNECTIONS), vectors(rng, CONNECTIONS), rng.uniform(0.0, 2.0, BODIES)
    volumes[2] = 0.0

    def frame():
        accumulator = LoadAccumulator(connected, volumes, lambda _: normals)
        resultants = [accumulator.add(batch) for batch in batches]
        return resultants, accumulator.finish()

    (resultants, loads), (plain_resultants, plain_loads) = each_way(frame)
    np.testing.assert_array_equal(resultants, plain_resultants)
    assert_same(loads, plain_loads)
    assert np.isnan(loads.connection_peaks_n).sum() == unknown


@pytest.mark.parametrize("led", [0, 2], ids=["all free", "two are led"])
def test_work_of_a_frame_has_the_same_bits(rng, each_way, led):
    loads, masses, connected = some_loads(rng), rng.uniform(1.0, 9.0, BODIES), pairs(rng, CONNECTIONS)
    free = np.arange(BODIES) >= led
    resultants = vectors(rng, SUBSTEPS, BODIES)
    motions = [Motion(*(vectors(rng, count, BODIES) for _ in range(3))) for count in (1, SUBSTEPS)]
    of_connections = PairImpulses(
        connected,
        loads.connection_impulses_ns,
        loads.connection_points_m,
        loads.connection_angular_impulses_nms,
    )
    of_contacts = PairImpulses(
        loads.contact_pairs, loads.contact_impulses_ns, loads.contact_points_m, substeps=loads.contact_substeps
    )

    def frame():
        accumulator = WorkAccumulator(
            masses, np.full(BODIES, 0.04), np.full(BODIES, 0.1), np.array([0, 0, -9.8]), motions[0]
        )
        moves = np.tile(free, (SUBSTEPS, 1))
        accumulator.add(motions[1], moves, of_connections, of_contacts, resultants, loads.substeps_s)
        return accumulator.finish()

    compiled, plain = each_way(frame)
    assert_same(compiled, plain)
    assert compiled.made_j.any() and bool(compiled.tools_j) == bool(led)


def test_the_loops_are_used_where_numba_is_installed():
    assert compiled_mechanics.frame_loops() is not None
