# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads of the hanging chain, whose forces statics gives by hand."""

import numpy as np
import pytest
from support.sample_results import FRAME_S, G, changed, hanging_chain, without_connections

from bridge_demolition_addon.model.results.force_history import breaking_by_kind, contact_forces, most_loaded, peak_near


def test_the_ledge_carries_the_ball():
    forces = contact_forces(hanging_chain())
    # In the last frame the ledge pushes the ball with 6000 g for half of it; nothing else touches.
    assert forces.total_n == pytest.approx([0, 0, 0, 0, 3000 * G])
    assert forces.ground_n == pytest.approx([0, 0, 0, 0, 3000 * G])
    assert forces.largest_n == pytest.approx([0, 0, 0, 0, 0])  # no shard touches anything


def test_contacts_of_shards_are_told():
    results = hanging_chain()
    impulses = results.frames.loads.body_contact_impulses_ns.copy()
    impulses[2, 2] = FRAME_S * np.array([30.0, 0.0, 40.0])
    forces = contact_forces(changed(results, body_contact_impulses_ns=impulses))
    assert forces.largest_n[2] == pytest.approx(50.0)


def test_the_most_loaded_come_first():
    results = hanging_chain()
    bodies = most_loaded(results.frames.loads.body_peak_sums_n, results.inventory.of_kind("shard"))
    assert [peak.row for peak in bodies] == [1, 2]
    # 500 g from above, and 200 g with 1 kN across from below, in the fourth frame.
    assert bodies[0].force_n == pytest.approx(500 * G + np.hypot(200 * G, 1000))
    assert bodies[0].step == 3
    (one,) = most_loaded(results.frames.loads.connection_peaks_n, np.arange(2), 1)
    assert (one.row, one.force_n) == (0, pytest.approx(500 * G))


def test_what_is_not_known_is_not_the_largest():
    magnitudes = np.array([[np.nan, 3.0], [2.0, np.nan]])
    assert [(peak.row, peak.force_n) for peak in most_loaded(magnitudes, np.arange(2))] == [(1, 3.0), (0, 2.0)]
    assert most_loaded(np.full((2, 2), np.nan), np.arange(2)) == []
    assert most_loaded(np.zeros((2, 0)), np.zeros(0, int)) == []


def test_the_peak_near_a_time_is_the_largest_on_a_shard_there():
    """In the fourth frame *upper* bears 300 g and a pull of 1 kN across it, in the frames before 300 g alone."""
    results = hanging_chain()
    peak = peak_near(results, 3.0 * FRAME_S, 0.01)
    assert (peak.row, peak.step) == (1, 3) and peak.force_n == pytest.approx(np.hypot(300 * G, 1000))
    assert peak_near(results, 1.0 * FRAME_S, 2.5 * FRAME_S).step == 3  # the largest of several frames
    assert peak_near(results, 1.4 * FRAME_S, 0.0).step == 1  # the nearest frame where none is that near
    assert peak_near(results, 0.0, 0.0) is None  # nothing acts in the first frame


def test_kinds_of_connections_and_when_they_broke():
    foundation, pier = sorted(breaking_by_kind(hanging_chain()), key=lambda kind: kind.kind)
    assert (foundation.kind, foundation.count, foundation.broken.tolist()) == ("foundation", 1, [0] * 5)
    # Two piers, as they are two members.
    assert (pier.kind, pier.count, pier.broken.tolist()) == ("pier - pier", 1, [0, 0, 0, 0, 1])
    results = hanging_chain()
    members = np.array(["", "column", "column", ""])
    assert "within pier" in {kind.kind for kind in breaking_by_kind(changed(results, body_members=members))}


def test_without_connections_nothing_breaks():
    assert breaking_by_kind(without_connections(hanging_chain())) == []
