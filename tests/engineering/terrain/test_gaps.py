# SPDX-License-Identifier: GPL-3.0-or-later
"""Nearest nodes with a height, against scipy's distances."""

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from bridge_demolition_addon.engineering.terrain.raster import nearest_known


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (33, 33), (40, 65), (64, 17)])
@pytest.mark.parametrize("share", [0.0, 0.003, 0.03, 0.5, 1.0])
def test_no_known_node_is_nearer(shape, share):
    rng = np.random.default_rng(3)
    for _ in range(20):
        known = rng.random(shape) < share
        known[rng.integers(shape[0]), rng.integers(shape[1])] = True
        row, column = nearest_known(known)
        assert known[row, column].all()
        here = np.indices(shape)
        assert np.hypot(row - here[0], column - here[1]) == pytest.approx(distance_transform_edt(~known), abs=1e-12)


def test_gaps_on_one_side_continue_the_nearest_column():
    known = np.zeros((50, 50), bool)
    known[:, 20:23] = True
    _, column = nearest_known(known)
    assert (column == np.clip(np.arange(50), 20, 22)).all()
