"""What `bda check` says of the tendons of a model."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..actions import Fact
from ..scenario import Scenario
from .tendons import ModelTendons


def tendon_facts(scenario: Scenario, tendons: ModelTendons) -> Iterator[Fact]:
    """Yield force, length and energy of each tendon, and what a cut takes of it."""
    count = 1 + int(max(tendons.passages.first.max(), tendons.passages.second.max()))
    unturned = np.repeat(np.eye(3)[:, :, None], count, axis=2)
    stored_j = tendons.forces(np.zeros((3, count)), unturned).stored_j()
    steel = tendons.steel
    for number, table in enumerate(scenario.tendons):
        share = table.prestress_n_mm2 / table.strength_n_mm2
        yield (
            table.name,
            f"{table.member}: {steel.forces_n[number] / 1000.0:.0f} kN, {share:.0%} of its strength, "
            f"{steel.lengths_m[number]:.2f} m, {stored_j[number] / 1000.0:.1f} kJ",
        )
        if table.bonded:
            ends = "" if table.anchored else ", and so do its ends, without anchorages"
            yield "", f"bonded: a cut takes its force over {steel.transmission_m[number]:.2f} m to both sides{ends}"
        else:
            yield "", "not bonded: any cut takes all of its force"
    yield "", "energy of tendons hurts people: keep everybody off their lines and anchorages while they are cut"
