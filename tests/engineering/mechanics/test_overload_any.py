# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a connection is overloaded alone is found with the bits of the utilisations that decide what breaks."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.rotations import rotated
from bridge_demolition_addon.engineering.mechanics import overloads
from bridge_demolition_addon.engineering.mechanics.carried_sections import CarriedSections
from bridge_demolition_addon.engineering.mechanics.overloads import Overloads
from bridge_demolition_addon.engineering.mechanics.section_cuts import ConnectedFaces
from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS

CONNECTIONS, BODIES = 60, 20


@pytest.fixture(params=range(4))
def rng(request):
    return np.random.default_rng(request.param)


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
    rows = np.flatnonzero(np.arange(CONNECTIONS) != 4)
    used = judging.of_forces(rows, sections.forces(rows, loads, *places))
    assert np.isfinite(used).all()
    for numba in (True, False):
        if not numba:
            monkeypatch.setattr(overloads, "overload_loops", lambda: None)
        for row, share in zip(rows, used, strict=True):
            left = np.full(CONNECTIONS, share)
            one = np.array([row])
            assert not judging.overload_any(one, sections, loads, *places, left)
            assert judging.overload_any(one, sections, loads, *places, np.nextafter(left, 0.0))
        assert not judging.overload_any(np.array([4]), sections, loads, *places, np.zeros(CONNECTIONS))


def test_the_loop_is_used_where_numba_is_installed():
    assert overloads.overload_loops() is not None
