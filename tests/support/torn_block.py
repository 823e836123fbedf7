# SPDX-License-Identifier: GPL-3.0-or-later
"""A block that hangs from a section that breaks under its weight at once, and what reinforcement makes of its fall."""

import numpy as np

from bridge_demolition_addon.engineering.elasticity.steel_bars import Steel
from bridge_demolition_addon.engineering.mechanics.strength import Ductility, Strength
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.scene.connections.constraints import Breaking, keep_breaking

GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))
RIGID_PLASTIC = Steel(yield_pa=2e6, hardening=1.0)
MASS_KG, HEIGHT_M = 100.0, 9.0


def torn_block(blocks, held_share, elongation_m):
    """The connection that it hangs from; its reinforcement yields at a share of the block's weight.

    Where connections are elastic, it yields at once and does not harden.
    """
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, HEIGHT_M), MASS_KG)
    connection, area_m2 = blocks.connect("FIXED", (0, 0, 9.5), ceiling, block), 0.04
    connection["bda_area_m2"], connection["bda_normal"] = area_m2, (0.0, 0.0, -1.0)
    strength = Strength(1e9, 0.5 * MASS_KG * GRAVITY / area_m2, 1e9, 1e9, 1e9)
    keep_breaking(blocks.scene, Breaking(strength, 0.0, Ductility(held_share / 0.5, elongation_m), 0.0, RIGID_PLASTIC))
    return connection


def check_fall(results, held_share, elongation_m):
    """It falls with what is left of gravity as far as the reinforcement stretches, and then freely."""
    fallen, speed = HEIGHT_M - results.frames.positions_m[:, 1, 2], -results.frames.velocities_m_s[:, 1, 2]
    held = np.flatnonzero((fallen > 0.05) & (fallen < elongation_m))
    free = np.flatnonzero(fallen > elongation_m + 0.1)
    assert len(held) and len(free)
    left = (1.0 - held_share) * GRAVITY
    # The section held the block for a sub-step, and the tie lets go within one: half a per cent each of the fall.
    np.testing.assert_allclose(speed[held] ** 2, 2 * left * fallen[held], rtol=0.05)
    energy = left * elongation_m + GRAVITY * (fallen[free] - elongation_m)
    np.testing.assert_allclose(speed[free] ** 2 / 2, energy, rtol=0.05)
    pull_n = results.frames.loads.connection_forces_n[held[0], 0, 2]
    np.testing.assert_allclose(pull_n, -held_share * MASS_KG * GRAVITY, rtol=1e-6)
