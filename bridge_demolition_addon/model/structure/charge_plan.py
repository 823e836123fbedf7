"""The charge plan: what is drilled and loaded, what fires when, and what shakes, sounds and flies around it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.blast.site_law import SiteLaw
from ...engineering.blast.vibration import peak_particle_velocity
from ...engineering.drilled_charges.fragments import HeightsAt
from ...engineering.drilled_charges.neighbours import (
    BARE_KPA,
    STEMMED_KPA,
    air_pressure_pa,
    decibels,
    fires_together,
    largest_mass_together_kg,
)
from ...engineering.geometry.vectors import AXES, distance
from ..blast.vibration_laws import OF_CHARGES
from ..bridge.member import Member
from ..bridge.preparation import room_around
from ..scenario import MemberCut, Neighbour, Scenario
from ..schema import given
from ..terrain.built import built_ground
from .blast_zones import PlacedZone, grams_per_tonne, one_member, placed_zones
from .zone_fragments import FlyrockOfZone, flyrock_of_zones

_DEVIATIONS = 2.0
"""Standard deviations by which a row may fire earlier or later."""

_LEAST_KG = 1e-9

_NEAREST_M = 1e-3
"""At a charge itself the ground's velocity would be infinite."""


@dataclass(frozen=True, slots=True)
class FiredRow:
    """A row of holes that fires, or the explosive that severs a member, which is bare."""

    name: str  # of the zone or the cut
    box_m: np.ndarray  # (2, 3), around it
    row: int  # from 1
    time_s: float  # after the start of the blasting, as planned
    spread_s: float  # how much earlier or later it may fire
    mass_kg: float
    together_kg: float  # what can fire within 8 ms from it on, itself among it
    detonator: str
    detonators: int = 1  # one in each hole, and one that severs a member
    is_bare: bool = False
    rows: int = 1  # of its zone

    @property
    def deviation_s(self) -> float:
        """Return the standard deviation of its time."""
        return self.spread_s / _DEVIATIONS


@dataclass(frozen=True, slots=True)
class Totals:
    """Totals of zones and cuts, also of the ones that are planned not to fire; volume and holes are the zones'."""

    mass_kg: float
    mass_in_holes_kg: float
    holes: int
    drilled_m: float
    volume_m3: float
    grams_per_tonne: float
    together_kg: float  # the largest mass within 8 ms
    lasts_s: float  # from the first row to the last

    @property
    def specific_kg_m3(self) -> float:
        return self.mass_in_holes_kg / self.volume_m3 if self.volume_m3 else 0.0


@dataclass(frozen=True, slots=True)
class AtNeighbour:
    """What stemmed charges do at a neighbour."""

    neighbour: Neighbour
    distance_m: float  # to the nearest zone
    velocity_m_s: float  # of the ground
    pressure_pa: float  # in the air
    at_most_m_s: float  # upper line of the site's law; without one, the velocity
    is_extrapolated: bool = False  # whether the law was measured at other scaled distances

    @property
    def level_db(self) -> float:
        return float(decibels(self.pressure_pa)) if self.pressure_pa else 0.0

    @property
    def is_above_limit(self) -> bool:
        """Return whether a limit of the neighbour is not kept."""
        velocity_mm_s, level_db = self.neighbour.limit_mm_s, self.neighbour.limit_db
        return (velocity_mm_s is not None and 1e3 * self.at_most_m_s > velocity_mm_s) or (
            level_db is not None and self.level_db > level_db
        )


@dataclass(frozen=True, slots=True)
class ChargePlan:
    """A whole charge plan; rows in order of time."""

    zones: tuple[PlacedZone, ...]
    cuts: tuple[MemberCut, ...]
    rows: tuple[FiredRow, ...]
    totals: Totals
    neighbours: tuple[AtNeighbour, ...]
    flyrock: tuple[FlyrockOfZone | None, ...]  # of each zone; None without explosive


def charge_plan(scenario: Scenario, members: Sequence[Member]) -> ChargePlan:
    """Return the plan of a scenario with blast zones or cuts, in its members."""
    zones = placed_zones(scenario, members)
    rows = fired_rows(scenario, zones, members)
    flown = iter(
        flyrock_of_zones(
            [placed for placed in zones if placed.zone.mass_kg], _heights_at(scenario, members), scenario.seed
        )
    )
    return ChargePlan(
        zones,
        scenario.cuts,
        rows,
        _totals(scenario, zones, rows, members),
        _at_neighbours(scenario, rows),
        tuple(next(flown) if placed.zone.mass_kg else None for placed in zones),
    )


def _heights_at(scenario: Scenario, members: Sequence[Member]) -> HeightsAt | None:
    """Return the heights of the ground that fragments fall on; None where it is flat."""
    if scenario.has_flat_ground:
        return None
    solids = [(member.name, member.solid) for member in members]
    return built_ground(scenario, solids, room_around(scenario, members)).heights_at


def flyrock_of_run(scenario: Scenario, members: Sequence[Member]) -> tuple[FlyrockOfZone, ...]:
    """Return how far fragments fly of the zones that fire in a run of a scenario."""
    fired = [placed for placed in placed_zones(scenario, members) if placed.zone.goes_off]
    if not fired or not scenario.blast.explosion:
        return ()
    return flyrock_of_zones(fired, _heights_at(scenario, members), scenario.seed)


def neighbours_of_zones(scenario: Scenario, members: Sequence[Member]) -> tuple[AtNeighbour, ...]:
    """Return what the zones and cuts of a scenario that fire do at its neighbours."""
    return _at_neighbours(scenario, fired_rows(scenario, placed_zones(scenario, members), members))


def _at_neighbours(scenario: Scenario, rows: Sequence[FiredRow]) -> tuple[AtNeighbour, ...]:
    law = scenario.site_law(OF_CHARGES)
    return tuple(_at_neighbour(neighbour, rows, law) for neighbour in scenario.neighbours)


def fired_rows(scenario: Scenario, zones: Sequence[PlacedZone], members: Sequence[Member]) -> tuple[FiredRow, ...]:
    """Return all rows that fire, in order of time."""
    planned = [*_rows_of_zones(zones), *_rows_of_cuts(scenario.cuts, members)]
    planned.sort(key=lambda row: row.time_s)
    masses = np.array([row.mass_kg for row in planned])
    times_s, spreads_s = (np.array([getattr(row, name) for row in planned]) for name in ("time_s", "spread_s"))
    together = fires_together(times_s, spreads_s)
    return tuple(
        replace(row, together_kg=float(masses[group].sum())) for row, group in zip(planned, together, strict=True)
    )


def _rows_of_zones(zones: Sequence[PlacedZone]) -> Iterator[FiredRow]:
    for placed in zones:
        if not placed.zone.goes_off:
            continue
        mass_kg = placed.zone.holes_a_row * placed.zone.charge_kg
        times = zip(placed.zone.row_times_s(), placed.zone.deviations_s(), strict=True)
        for number, (time_s, deviation_s) in enumerate(times, start=1):
            spread_s = _DEVIATIONS * deviation_s
            zone, name = placed.zone, zone_name(placed)
            yield FiredRow(
                name,
                placed.box_m,
                number,
                time_s,
                spread_s,
                mass_kg,
                mass_kg,
                zone.detonator,
                zone.holes_a_row,
                rows=zone.rows,
            )


def _rows_of_cuts(cuts: Sequence[MemberCut], members: Sequence[Member]) -> Iterator[FiredRow]:
    for cut in cuts:
        if not (cut.fires and cut.mass_kg):
            continue
        box_m = one_member(cut, members).solid.bounds.copy()
        box_m[:, AXES.index(cut.along)] = cut.position_m
        spread_s, mass_kg = _DEVIATIONS * cut.deviation_s, cut.mass_kg
        yield FiredRow(given(cut.name), box_m, 1, cut.time_s, spread_s, mass_kg, mass_kg, cut.detonator, is_bare=True)


def _totals(
    scenario: Scenario, zones: Sequence[PlacedZone], rows: Sequence[FiredRow], members: Sequence[Member]
) -> Totals:
    times, masses, spreads = ([getattr(row, name) for row in rows] for name in ("time_s", "mass_kg", "spread_s"))
    in_holes_kg = math.fsum(placed.zone.mass_kg for placed in zones)
    mass_kg = in_holes_kg + math.fsum(cut.mass_kg for cut in scenario.cuts)
    return Totals(
        mass_kg=mass_kg,
        mass_in_holes_kg=in_holes_kg,
        holes=sum(placed.zone.holes for placed in zones),
        drilled_m=math.fsum(placed.zone.drilled_m for placed in zones),
        volume_m3=math.fsum(placed.volume_m3 for placed in zones),
        grams_per_tonne=grams_per_tonne(mass_kg, members),
        together_kg=largest_mass_together_kg(times, masses, spreads),
        lasts_s=max(times, default=0.0) - min(times, default=0.0),
    )


def _at_neighbour(neighbour: Neighbour, rows: Sequence[FiredRow], law: SiteLaw | None) -> AtNeighbour:
    """Return the largest effects of what can fire together, as if it all were where its nearest part is.

    Pressures of what is stemmed and of what is bare add up.
    """
    if not rows:
        return AtNeighbour(neighbour, np.inf, 0.0, 0.0, 0.0)
    place = np.array(neighbour.position_m)
    distances = np.array([_distance(place, row.box_m) for row in rows])
    together = fires_together(np.array([row.time_s for row in rows]), np.array([row.spread_s for row in rows]))
    nearest = np.maximum([distances[group].min() for group in together], _NEAREST_M)
    masses, bare = np.array([row.mass_kg for row in rows]), np.array([row.is_bare for row in rows])
    of_groups = [np.array([masses[group & kind].sum() for group in together]) for kind in (~bare, bare)]
    pressures = sum(
        np.where(of_group > 0.0, air_pressure_pa(nearest, np.maximum(of_group, _LEAST_KG), site_kpa), 0.0)
        for of_group, site_kpa in zip(of_groups, (STEMMED_KPA, BARE_KPA), strict=True)
    )
    velocities, at_most, is_extrapolated = _velocities(nearest, of_groups[0] + of_groups[1], law)
    return AtNeighbour(
        neighbour, float(distances.min()), velocities, float(np.max(pressures)), at_most, is_extrapolated
    )


def _velocities(distances_m: np.ndarray, masses_kg: np.ndarray, law: SiteLaw | None) -> tuple[float, float, bool]:
    """Return the largest velocity of groups (k,), the most that it may be, and whether that is extrapolated."""
    if law is None:
        velocity = float(peak_particle_velocity(distances_m, masses_kg).max())
        return velocity, velocity, False
    at_most = law.at_most(distances_m, masses_kg)
    worst = int(at_most.argmax())
    covered = law.covers(float(distances_m[worst]), float(masses_kg[worst]))
    return float(law.velocity(distances_m, masses_kg).max()), float(at_most[worst]), not covered


def _distance(place: np.ndarray, box_m: np.ndarray) -> float:
    """Return the distance of a position from a box."""
    return float(distance(place, np.clip(place, box_m[0], box_m[1])))


def zone_name(placed: PlacedZone) -> str:
    """Return what a zone is called in the plan."""
    return given(placed.zone.name)
