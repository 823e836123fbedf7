# SPDX-License-Identifier: GPL-3.0-or-later
"""Shards that were removed count for nothing."""

import numpy as np
import pytest
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.results.collapse import collapse_progress
from bridge_demolition_addon.model.results.energy import energy_of
from bridge_demolition_addon.model.results.motion import without_removed

PLACES = np.array([[(0, 0, 5), (3, 0, 5), (6, 0, 5)], [(0, 0, 5), (3, 0, -995), (6, 0, 2)]], float)


def test_they_are_no_debris_and_lose_no_energy():
    results, count = without_removed(moving_boxes([0, 1], [(1, 1, 1)] * 3, PLACES))
    assert count == 1
    assert results.inventory.of_kind("shard").tolist() == [0, 2]
    assert debris_of(results).bodies.tolist() == [2]
    # A cube of 1 t comes down by 3 m of the 5 m that both stand at.
    assert energy_of(results).potential_j == pytest.approx([3000 * 9.80665, 0.0])
    assert collapse_progress(results)[-1] == pytest.approx(1.5 / 5.0)


def test_without_them_nothing_changes():
    results = moving_boxes([0, 1], [(1, 1, 1)] * 3, PLACES)
    fallen = moving_boxes([0, 1], [(1, 1, 1)] * 3, np.maximum(PLACES, -20.0))
    assert without_removed(fallen) == (fallen, 0)
    assert without_removed(results)[1] == 1
