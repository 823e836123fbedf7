"""What of a bridge, and of what is done to it, is so far from all that is usual that it is said before any result."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..scenario import Scenario
from ..structure.blast_zones import RECORDED_G_T, grams_per_tonne, placed_zones
from ..structure.model import Model
from ..structure.usual_sizes import unusual_sizes
from .checked_model import ModelWorksite

_LARGEST_G_T = 2000.0
"""Explosive by the mass of the bridge that bare charges reach where kilograms are given for grams."""

_MOST_MACHINES = 1.0
"""Mass of a machine over that of the bridge that it stands on."""


def unusual_texts(scenario: Scenario, model: Model) -> tuple[str, ...]:
    """Return it as sentences without full stops; none where nothing is."""
    site = ModelWorksite(scenario, model)
    zones = placed_zones(scenario, model.members, model.layers)
    return (
        *unusual_sizes(scenario, model.members),
        *(text for action in scenario.actions for text in action.unusual(site)),
        *(text for zone in zones for text in zone.unusual()),
        *_explosive(scenario, model),
        *_machines(scenario, site.mass_kg),
    )


def _explosive(scenario: Scenario, model: Model) -> Iterator[str]:
    masses_kg = [charge.mass_kg for charge in scenario.charges] + [cut.mass_kg for cut in scenario.cuts]
    mass_kg = math.fsum(masses_kg)
    rate = grams_per_tonne(mass_kg, model.members)
    if rate > _LARGEST_G_T:
        least, most = RECORDED_G_T
        yield (
            f"{mass_kg:.4g} kg of explosive beside drill holes are {rate:.4g} g a tonne of the bridge, recorded jobs "
            f"have {least:g} to {most:g} in holes (is it in kg?)"
        )


def _machines(scenario: Scenario, bridge_kg: float) -> Iterator[str]:
    for machine in scenario.equipment:
        if machine.mass_kg > _MOST_MACHINES * bridge_kg:
            yield f"{machine.name} is {machine.mass_kg / bridge_kg:.3g} times as heavy as the bridge (is it in kg?)"
