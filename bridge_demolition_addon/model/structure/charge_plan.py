"""The charge plan: what is drilled and loaded, what fires when, and what shakes, sounds and flies around it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.blast.vibration import peak_particle_velocity
from ...engineering.drilled_charges.neighbours import (
    air_pressure_pa,
    decibels,
    fires_together,
    largest_mass_together_kg,
)
from ...engineering.geometry.vectors import distance
from ..bridge.extent import room_around
from ..bridge.member import Member
from ..scenario import Neighbour, Scenario
from ..schema import given
from ..terrain.built import built_ground
from .blast_zones import PlacedZone, grams_per_tonne, placed_zones
from .zone_fragments import FlyrockOfZone, flyrock_of

_NEAREST_M = 1e-3
"""At a charge itself the ground's velocity would be infinite."""


@dataclass(frozen=True, slots=True)
class FiredRow:
    """A row of holes that fires."""

    placed: PlacedZone
    row: int  # from 1
    time_s: float  # after the start of the blasting, as planned
    spread_s: float  # how much earlier or later it may fire
    mass_kg: float
    together_kg: float  # what can fire within 8 ms from it on, itself among it

    @property
    def detonators(self) -> int:
        """One in each hole."""
        return self.placed.zone.holes_a_row


@dataclass(frozen=True, slots=True)
class Totals:
    """Totals of all zones, also of those that are planned not to fire."""

    mass_kg: float
    holes: int
    drilled_m: float
    volume_m3: float
    grams_per_tonne: float
    together_kg: float  # the largest mass within 8 ms
    lasts_s: float  # from the first row to the last

    @property
    def specific_kg_m3(self) -> float:
        return self.mass_kg / self.volume_m3


@dataclass(frozen=True, slots=True)
class AtNeighbour:
    """What stemmed charges do at a neighbour."""

    neighbour: Neighbour
    distance_m: float  # to the nearest zone
    velocity_m_s: float  # of the ground
    pressure_pa: float  # in the air

    @property
    def level_db(self) -> float:
        return float(decibels(self.pressure_pa)) if self.pressure_pa else 0.0

    @property
    def is_above_limit(self) -> bool:
        """Return whether a limit of the neighbour is not kept."""
        velocity_mm_s, level_db = self.neighbour.limit_mm_s, self.neighbour.limit_db
        return (velocity_mm_s is not None and 1e3 * self.velocity_m_s > velocity_mm_s) or (
            level_db is not None and self.level_db > level_db
        )


@dataclass(frozen=True, slots=True)
class ChargePlan:
    """A whole charge plan; rows in order of time."""

    zones: tuple[PlacedZone, ...]
    rows: tuple[FiredRow, ...]
    totals: Totals
    neighbours: tuple[AtNeighbour, ...]
    flyrock: tuple[FlyrockOfZone | None, ...]  # of each zone; None without explosive


def charge_plan(scenario: Scenario, members: Sequence[Member]) -> ChargePlan:
    """Return the plan of a scenario with blast zones, in its members."""
    zones = placed_zones(scenario, members)
    rows = _rows(zones)
    heights_at = None
    if not scenario.has_flat_ground:
        solids = [(member.name, member.solid) for member in members]
        heights_at = built_ground(scenario, solids, room_around(scenario, members)).heights_at
    return ChargePlan(
        zones,
        rows,
        _totals(zones, rows, members),
        _at_neighbours(scenario, rows),
        tuple(flyrock_of(placed, heights_at, scenario.seed) if placed.zone.mass_kg else None for placed in zones),
    )


def neighbours_of_zones(scenario: Scenario, members: Sequence[Member]) -> tuple[AtNeighbour, ...]:
    """Return what the zones of a scenario that fire do at its neighbours."""
    return _at_neighbours(scenario, _rows(placed_zones(scenario, members)))


def _at_neighbours(scenario: Scenario, rows: Sequence[FiredRow]) -> tuple[AtNeighbour, ...]:
    return tuple(_at_neighbour(neighbour, rows) for neighbour in scenario.neighbours)


def _rows(zones: Sequence[PlacedZone]) -> tuple[FiredRow, ...]:
    planned = [
        (time_s, 2.0 * deviation_s, placed, row)
        for placed in zones
        if placed.zone.goes_off
        for row, (time_s, deviation_s) in enumerate(
            zip(placed.zone.row_times_s(), placed.zone.deviations_s(), strict=True), start=1
        )
    ]
    planned.sort(key=lambda item: item[0])
    masses = np.array([placed.zone.holes_a_row * placed.zone.charge_kg for _, _, placed, _ in planned])
    times_s, spreads_s = (np.array([item[column] for item in planned], float) for column in (0, 1))
    together = fires_together(times_s, spreads_s)
    return tuple(
        FiredRow(placed, row, time_s, spread_s, float(masses[number]), float(masses[together[number]].sum()))
        for number, (time_s, spread_s, placed, row) in enumerate(planned)
    )


def _totals(zones: Sequence[PlacedZone], rows: Sequence[FiredRow], members: Sequence[Member]) -> Totals:
    times, masses, spreads = ([getattr(row, name) for row in rows] for name in ("time_s", "mass_kg", "spread_s"))
    return Totals(
        mass_kg=sum(placed.zone.mass_kg for placed in zones),
        holes=sum(placed.zone.holes for placed in zones),
        drilled_m=sum(placed.zone.drilled_m for placed in zones),
        volume_m3=sum(placed.volume_m3 for placed in zones),
        grams_per_tonne=grams_per_tonne(zones, members),
        together_kg=largest_mass_together_kg(times, masses, spreads),
        lasts_s=max(times, default=0.0) - min(times, default=0.0),
    )


def _at_neighbour(neighbour: Neighbour, rows: Sequence[FiredRow]) -> AtNeighbour:
    """Return the largest effects of all that can fire together, as if it all were where its nearest part is."""
    if not rows:
        return AtNeighbour(neighbour, np.inf, 0.0, 0.0)
    place = np.array(neighbour.place_m)
    distances = np.array([_distance(place, row.placed.box_m) for row in rows])
    together = fires_together(np.array([row.time_s for row in rows]), np.array([row.spread_s for row in rows]))
    nearest = np.maximum([distances[group].min() for group in together], _NEAREST_M)
    masses = np.array([row.together_kg for row in rows])
    return AtNeighbour(
        neighbour,
        float(distances.min()),
        float(peak_particle_velocity(nearest, masses).max()),
        float(air_pressure_pa(nearest, masses).max()),
    )


def _distance(place: np.ndarray, box_m: np.ndarray) -> float:
    """Return the distance of a position from a box."""
    return float(distance(place, np.clip(place, box_m[0], box_m[1])))


def zone_name(placed: PlacedZone) -> str:
    """Return what a zone is called in the plan."""
    return given(placed.zone.name)
