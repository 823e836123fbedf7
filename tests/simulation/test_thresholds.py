"""Connections hold and break at the force they are given, whatever the time step."""

import numpy as np
import pytest
from blocks import Blocks

from bridge_demolition_addon.core.gravity import STANDARD_GRAVITY_M_S2

MASS_KG = 100.0
WEIGHT_N = MASS_KG * STANDARD_GRAVITY_M_S2

STEPS = (
    {"frames_per_second": 24, "substeps_per_frame": 10},
    {"frames_per_second": 60, "substeps_per_frame": 1},
    {"frames_per_second": 30, "frames_per_second_base": 1.001, "substeps_per_frame": 7},
    {"frames_per_second": 25, "substeps_per_frame": 20, "time_scale": 0.1},
)


@pytest.mark.parametrize("step", STEPS, ids=("24 × 10", "60 × 1", "29.97 × 7", "slow motion"))
@pytest.mark.parametrize("kind", ("FIXED", "POINT", "HINGE"))
@pytest.mark.parametrize(("share", "holds"), ((0.95, False), (1.05, True)))
def test_hanging_block(blender, tmp_path, kind, step, share, holds):
    blocks = Blocks(**step)
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG)
    blocks.connect(kind, (0, 0, 9.5), ceiling, block, share * WEIGHT_N)
    results = blocks.play(tmp_path, 24)
    assert bool(results.intact[-1][0]) is holds
    sunk = 9.0 - results.places_m[-1, 1, 2]
    if holds:
        assert sunk < 1e-3
        assert results.connection_forces_n[-1][0, 2] == pytest.approx(-WEIGHT_N, rel=1e-4)
    else:
        elapsed = results.times_s[-1]
        # It falls freely from the second sub-step on at the latest; half g·t² is what an ideal fall would give.
        assert sunk == pytest.approx(STANDARD_GRAVITY_M_S2 * elapsed**2 / 2, rel=0.1)
        np.testing.assert_array_equal(results.connection_forces_n[-1], 0.0)
