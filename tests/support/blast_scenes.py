# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks and charges, whose loads are known from tables and integrals."""

from __future__ import annotations

from collections.abc import Sequence

from support.blocks import Blocks

from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.blast.settings import BlastSettings
from bridge_demolition_addon.scene.blast.charges import create_charges, keep_blast
from bridge_demolition_addon.scene.blast.force_fields import build_force_objects
from bridge_demolition_addon.scene.bodies import bodies_of

IMPULSE_AT_5_PA_S = 40.62
"""Incident impulse of 1 kg of TNT in free air at Z = 5 m/kg^(1/3); Kingery and Bulmash (1984), as ConWep prints it."""

ARRIVAL_AT_5_S, END_AT_5_S = 8.995e-3, 8.995e-3 + 3.333e-3
"""When its pressure begins and ends; the same source."""


def charge(name: str, position_m: Sequence[float], mass_kg: float, delay_s: float = 0.0) -> Charge:
    """A charge of TNT in free air."""
    return Charge(name=name, position_m=tuple(position_m), mass_kg=mass_kg, delay_ms=1e3 * delay_s)


def set_off(blocks: Blocks, charges: Sequence[Charge], apply: str, explosion: bool = True, **options: float) -> None:
    """Place charges among blocks and have them go off."""
    create_charges(blocks.scene, charges)
    keep_blast(blocks.scene, BlastSettings(explosion=explosion, apply=apply, **({"start_s": 0.0} | options)))
    if apply == "fields":
        build_force_objects(blocks.scene, bodies_of(blocks.scene))


def weightless(**time: float) -> Blocks:
    """Blocks that nothing moves but a blast."""
    blocks = Blocks(**time)
    blocks.scene.gravity = (0.0, 0.0, 0.0)
    return blocks
