# SPDX-License-Identifier: GPL-3.0-or-later
"""What falls on cracked parts: cracks resist contacts in the sub-step in which these push."""

from __future__ import annotations

import numpy as np
import pytest
from simulation.test_reinforced_cracks import CONCRETE, GRAVITY, reinforced
from support.blocks import Blocks

from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel

LIGHT_KG, HEAVY_KG, DROP_M = 1000.0, 10_000.0, 0.01


@pytest.mark.long
@pytest.mark.parametrize("substeps", [10, 40])
def test_a_heavy_block_does_not_press_a_light_one_into_what_it_stands_on(blender, tmp_path, substeps):
    """The light one stands on a crack, which closes by v √(m / k) at most as the other lands: by energy."""
    blocks = Blocks(substeps_per_frame=substeps, solver_iterations=20)
    base, light = blocks.block((0, 0, 0)), blocks.block((0, 0, 1), LIGHT_KG)
    blocks.block((0, 0, 2.0 + DROP_M), HEAVY_KG)
    connection = blocks.connect("FIXED", (0, 0, 0.5), base, light)
    reinforced(blocks, connection, (0.0, 0.0, 1.0), (1.0, 1.0), 1e5, 0.05, Steel())
    blocks.scene.gravity[0] = 1e-3  # shear that cracks it
    results = blocks.play(tmp_path, 30)
    assert not results.frames.intact[-1].any()
    closed_m = float((1.0 - results.frames.positions_m[:, 1, 2]).max())
    assert closed_m < np.sqrt(2.0 * GRAVITY * DROP_M) * np.sqrt(HEAVY_KG / CONCRETE.young_pa)
    made_j = float(np.nansum(results.frames.work.made_by_connections_j))
    assert made_j < 0.01 * HEAVY_KG * GRAVITY * DROP_M
