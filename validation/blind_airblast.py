# SPDX-License-Identifier: GPL-3.0-or-later
"""A charge of 200 g and sensors 2, 4 and 6 m away from it: the waves that they measured, foreseen."""

from collections.abc import Sequence
from pathlib import Path

from blind import BlindCase, Foreseen

from bridge_demolition_addon.engineering.blast.pulses import blast_wave
from bridge_demolition_addon.engineering.blast.wave import Burst

MASS_KG = 0.2
LIKELY, LEAST, MOST = (Burst.AIR, 1.2), (Burst.AIR, 0.8), (Burst.SURFACE, 1.4)
"""Where the charge is, and how much TNT a unit of its mass is worth: the forecast, and the ends of its range."""

SCATTER = 1.15
"""What the ends of the range are divided and multiplied by, as sensors scatter."""

DISTANCES_M = (2.0, 4.0, 6.0)


def peak_kpa(distance_m: float, charge: tuple[Burst, float]) -> float:
    """Incident overpressure of a charge."""
    burst, tnt = charge
    return 1e-3 * float(blast_wave(distance_m, tnt * MASS_KG, burst).peak_overpressure_pa)


def foresee(folder: Path) -> Sequence[Foreseen]:
    """Foresee the overpressure at each distance."""
    return [
        Foreseen(
            f"incident overpressure at {distance_m:g} m",
            "kPa",
            round(peak_kpa(distance_m, LIKELY), 2),
            round(peak_kpa(distance_m, LEAST) / SCATTER, 2),
            round(peak_kpa(distance_m, MOST) * SCATTER, 2),
        )
        for distance_m in DISTANCES_M
    ]


CASE = BlindCase(
    name="blind_airblast",
    title="A charge of 200 g",
    asked="A charge of 200 g goes off; sensors 2, 4 and 6 m away measure the incident pressure. Which peaks?",
    known="The mass, the distances, and that six sensors measure incident pressure, two at each: the first lines of a "
    "page on how such records are read. What it makes of them stands further down on the same page, and was not opened "
    "before.",
    assumed="Which explosive it is, and how high above the ground: neither is said in those lines. The forecast is for "
    "1.2 times as much TNT in the air; the range is from 0.8 times in the air to 1.4 times on the ground, as the "
    f"explosives of `bda charge` go, and a factor of {SCATTER:g} more to both sides.",
    source="Analysis of Incident Overpressure Using Python, 23 September 2017, on the site of its author, "
    "lightsquared.github.io.",
    foresee=foresee,
)
