"""Damage of peak overpressures to buildings and people, and how far from the charges it is to be expected."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.blast.charge_sizing import stand_off_for_overpressure
from ...engineering.blast.pulses import BlastModel
from ...texts import Text
from .charges import Charge

CLANCEY = "Clancey, 6th International Meeting of Forensic Sciences, Edinburgh (1972)"
RICHMOND = "Richmond et al., Annals of Otology, Rhinology and Laryngology 98 (1989)"


@dataclass(frozen=True, slots=True)
class Threshold:
    """Damage to expect from a peak incident overpressure, Pa, and who published it."""

    damage: str
    overpressure_pa: float
    source: str


THRESHOLDS = (
    Threshold(Text("typical glass breakage"), 1.03e3, CLANCEY),
    Threshold(Text("safe distance: 95 % no serious damage"), 2.07e3, CLANCEY),
    Threshold(Text("windows usually shattered, from here on"), 3.4e3, CLANCEY),
    Threshold(Text("houses made uninhabitable"), 6.9e3, CLANCEY),
    Threshold(Text("lower limit of serious structural damage"), 15.8e3, CLANCEY),
    Threshold(Text("eardrum rupture, 1 %"), 34.5e3, RICHMOND),
    Threshold(Text("houses nearly destroyed, from here on"), 34.5e3, CLANCEY),
    Threshold(Text("probable total destruction of buildings"), 68.9e3, CLANCEY),
    Threshold(Text("eardrum rupture, 50 %"), 103e3, RICHMOND),
)
"""Thresholds in order of overpressure. They come from waves of large charges: those of some kilograms are shorter and
do less, so that the stand-offs are on the safe side for them. Of eardrums Richmond et al. also report rupture from some
20 kPa on."""


def distinct_thresholds() -> list[Threshold]:
    """Return the thresholds, without those of the same overpressure as one before."""
    return list({threshold.overpressure_pa: threshold for threshold in reversed(THRESHOLDS)}.values())[::-1]


def ring_radii(
    charges: Sequence[Charge],
    level_m: float = 0.0,
    thresholds: Sequence[Threshold] = THRESHOLDS,
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
    pressure_factor: float = 1.0,
) -> np.ndarray:
    """Return the radii (t, c), m, around the charges on plan at a level within which a threshold is reached, else 0.

    Each charge is taken by itself. Where waves of several meet, their pressures can add up, so that the damage reaches
    farther there than any ring. A charge above the level has smaller rings.
    """
    radii = np.zeros((len(thresholds), len(charges)))
    for row, threshold in enumerate(thresholds):
        for column, charge in enumerate(charges):
            stand_off_m = stand_off_for_overpressure(
                threshold.overpressure_pa / pressure_factor, charge.tnt_for_pressure_kg, charge.burst, model
            )
            height = charge.position_m[2] - level_m
            radii[row, column] = np.sqrt(max(stand_off_m * stand_off_m - height * height, 0.0))
    return radii
