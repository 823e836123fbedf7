"""Effects of charges near them: pressure and impulse with all delays, damage, and the vibration of the ground."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.blast import vibration
from ...engineering.blast.charge_sizing import stand_off_for_overpressure
from ...engineering.blast.pulses import BlastModel, Pulses, blast_pulses, blast_wave, charges_as_fired, pressure_at
from ...engineering.geometry.vectors import distance
from ...texts import Text
from .charges import Charge

ONE_DELAY_S = 0.008
"""Charges that detonate within this time shake the ground as one (the 8 ms of USBM Bulletin 656 and RI 8507)."""

_TIMES_PER_PULSE = 24

_NEAREST_M = 1e-3
"""At a charge itself the ground's velocity would be infinite."""


def charges_per_delay(charges: Sequence[Charge]) -> list[tuple[Charge, ...]]:
    """Group charges that shake the ground together, in order of time: each within `ONE_DELAY_S` from its first."""
    groups: list[list[Charge]] = []
    for charge in sorted(charges, key=lambda charge: charge.delay_s):
        if charge.mass_kg <= 0.0:
            continue
        if groups and charge.delay_s - groups[-1][0].delay_s < ONE_DELAY_S:
            groups[-1].append(charge)
        else:
            groups.append([charge])
    return [tuple(group) for group in groups]


@dataclass(frozen=True, eq=False, slots=True)
class PlaceLoads:
    """Loads at one position."""

    distance_m: float  # to the nearest charge
    arrival_s: float  # of the first wave, from the start of the blasting
    times_s: np.ndarray  # (t,), from the start of the blasting
    pressures_pa: np.ndarray  # (t,), incident overpressures of the charges added up
    peak_pa: float
    impulse_pa_s: float  # per area, of the charges' positive phases
    peak_velocity_m_s: float  # of the ground: the largest of any group of charges that detonates together


def loads_at(
    position_m: Sequence[float],
    charges: Sequence[Charge],
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
    pressure_factor: float = 1.0,
) -> PlaceLoads:
    """Return the loads of charges, at least one of them above 0 kg, at a position (3,), m.

    Pressures are free-field, from the explosives' TNT by pressure, impulses from that by impulse. Nothing stands
    between charge and position, and no wall sends anything back.
    """
    charges = [charge for charge in charges if charge.mass_kg > 0.0]
    sources = np.array([charge.position_m for charge in charges])
    stand_offs = distance(np.array(position_m), sources[None])
    delays = np.array([charge.delay_s for charge in charges])
    bursts = [charge.burst for charge in charges]

    def pulses_by(tnt_kg: list[float]) -> Pulses:
        together, parts = charges_as_fired(sources, tnt_kg, delays, bursts)
        return blast_pulses(stand_offs, together, delays, bursts, model=model, pressure_factor=pressure_factor * parts)

    pulses = pulses_by([charge.tnt_for_pressure_kg for charge in charges])
    times = _times(pulses)
    impulses = pulses_by([charge.tnt_kg for charge in charges]).impulses_pa_s
    pressures = pressure_at(pulses, times[:, None]).sum(axis=1)
    return PlaceLoads(
        distance_m=float(stand_offs.min()),
        arrival_s=float(pulses.arrivals_s.min()),
        times_s=times,
        pressures_pa=pressures,
        peak_pa=float(pressures.max()),
        impulse_pa_s=float(impulses.sum()),
        peak_velocity_m_s=_peak_velocity(position_m, charges),
    )


def peak_overpressures(
    points_m: np.ndarray,
    charges: Sequence[Charge],
    model: BlastModel | str = BlastModel.KINGERY_BULMASH,
    pressure_factor: float = 1.0,
) -> np.ndarray:
    """Return the largest incident overpressure (p,) at points (p, 3) that any one charge gives, Pa.

    Charges that touch and go off together are one. Where waves of several meet, their pressures can add up to more.
    """
    peaks = np.zeros(len(points_m))
    sources = np.array([charge.position_m for charge in charges]).reshape(-1, 3)
    delays = np.array([charge.delay_s for charge in charges])
    by_pressure = [charge.tnt_for_pressure_kg for charge in charges]
    together, _ = charges_as_fired(sources, by_pressure, delays, [charge.burst for charge in charges])
    for charge, tnt_kg in zip(charges, together, strict=True):
        wave = blast_wave(distance(points_m, np.array(charge.position_m)), tnt_kg, charge.burst, model)
        peaks = np.maximum(peaks, pressure_factor * wave.peak_overpressure_pa)
    return peaks


def _times(pulses: Pulses) -> np.ndarray:
    """Return times from 0 to past the last pulse, among them each front, just before it and through each pulse."""
    shares = np.linspace(0.0, 1.0, _TIMES_PER_PULSE)
    fronts, ends = pulses.arrivals_s[0], pulses.ends_s[0]
    before = np.nextafter(fronts, 0.0)
    within = (fronts + shares[:, None] * (ends - fronts)).ravel()
    return np.unique(np.concatenate([[0.0], before, within, [1.05 * ends.max()]]))


def _peak_velocity(position_m: Sequence[float], charges: Sequence[Charge]) -> float:
    """Return the largest over the groups, by the distance of the nearest charge of each, which is on the safe side."""
    velocities = []
    for group in charges_per_delay(charges):
        nearest = distance(np.array(position_m), np.array([charge.position_m for charge in group])).min()
        mass = math.fsum(charge.mass_kg for charge in group)
        velocities.append(float(vibration.peak_particle_velocity(max(nearest, _NEAREST_M), mass)))
    return max(velocities)


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
    """Return the thresholds, each overpressure only once."""
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
