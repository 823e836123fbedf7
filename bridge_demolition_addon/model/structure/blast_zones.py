"""Blast zones as they lie in their members: volume, burden, specific charge, and what follows from it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...engineering.drilled_charges.bare_bars import slender_from_m
from ...engineering.drilled_charges.drill_holes import USUAL_DEPTH_SHARES
from ...engineering.drilled_charges.fragments import RISKY_BURIAL, mean_speed_m_s, scaled_depth_of_burial
from ...engineering.drilled_charges.specific_charge import (
    FACTOR_OF_DOUBT,
    Effect,
    LeftOfConcrete,
    Thresholds,
    breaking_range_kg_m3,
    effect_of,
    left_of_concrete,
    specific_charge_kg_m3,
)
from ...engineering.fracture.slabs import slab_between
from ...engineering.mechanics.strength import NEWTON_PER_SQUARE_MILLIMETRE
from ...texts import Quantity, Text
from ..actions import Fact
from ..blast.blast_zones import THROWN_AWAY, BlastZone, element_of, length_of_charge_m
from ..bridge.member import Member, members_named
from ..changes.zone_firings import ZoneFiring
from ..materials import BarLayer
from ..reinforcement.design import all_layers
from ..scenario import MemberCut, Scenario
from ..schema import given
from .zone_bars import ZoneBars, zone_bars

MOVES_AFTER_S = 0.001
"""The burden has begun to move after a millisecond."""

RECORDED_G_T = (3.0, 18.0)
POSSIBLE_G_T = (1.0, 90.0)
"""Explosive by the mass of the structure: of most recorded jobs, and of all but the odd one."""

POSSIBLE_KG_M3 = (0.05, 10.0)
"""Specific charges beyond which masses were probably given in another unit: a quarter of the least that breaks plain
concrete, and five times what throws it out of spirals."""

_ROUNDING = 1e-6
_KILO = 1000.0
_MM_PER_M = 1000.0
_MEGA = 1e6


@dataclass(frozen=True)
class PlacedZone:
    """A blast zone in its member; the box (2, 3) is that around the zone's concrete."""

    zone: BlastZone
    member: Member
    volume_m3: float
    box_m: np.ndarray
    bars: ZoneBars | None = None

    @property
    def thickness_m(self) -> float:
        """Size of the member along the holes."""
        return float(np.diff(self.box_m[:, self.zone.axes[1]])[0])

    @property
    def width_m(self) -> float:
        """Size of the member across the holes."""
        return float(np.diff(self.box_m[:, self.zone.axes[2]])[0])

    @property
    def row_spacing_m(self) -> float:
        zone = self.zone
        return self.width_m / zone.rows if zone.row_spacing_m is None else zone.row_spacing_m

    @property
    def burden_m(self) -> float:
        """Distance of the charges to the nearest free face at their side or behind them."""
        beside = (self.width_m - (self.zone.rows - 1) * self.row_spacing_m) / 2.0
        behind = self.thickness_m - self.zone.depth_m + length_of_charge_m(self.zone) / 2.0
        return min(beside, behind)

    @property
    def density_kg_m3(self) -> float:
        return given(self.member.density_kg_m3)

    @cached_property
    def thresholds(self) -> Thresholds:
        """Specific charges that break its concrete and throw it out."""
        zone = self.zone
        broken = math.fsum(self.table_kg_m3) / 2.0 if zone.break_kg_m3 is None else zone.break_kg_m3
        if not broken < zone.throw_kg_m3:
            raise zone.unexpected("throw_kg_m3", f"more than what breaks {zone.member}, {broken:.3g} (kg/m³)")
        return Thresholds(broken, zone.throw_kg_m3)

    @property
    def table_kg_m3(self) -> tuple[float, float]:
        """Least and largest specific charge of the table that break it."""
        return breaking_range_kg_m3(element_of(self.zone, self.member.kind), self.burden_m)

    @property
    def drops(self) -> bool:
        """Whether what is above falls: it is upright, fires, and its concrete is thrown out."""
        return self.zone.is_upright and self.zone.goes_off and self.effect == Effect.THROWN

    @property
    def specific_kg_m3(self) -> float:
        """Explosive by volume."""
        return self.zone.mass_kg / self.volume_m3

    @property
    def effective_kg_m3(self) -> float:
        """The same for an explosive with a relative strength of 100, which the thresholds are for."""
        return float(specific_charge_kg_m3(self.zone.mass_kg, self.volume_m3, self.zone.made_of.relative_strength))

    @property
    def effect(self) -> Effect:
        """What its concrete does where it fires."""
        return effect_of(self.effective_kg_m3, self.thresholds)

    @property
    def left(self) -> LeftOfConcrete:
        return left_of_concrete(self.effective_kg_m3, self.thresholds)

    @property
    def cage_n(self) -> tuple[float, float]:
        """What its bars resist in tension, and may be counted on for in compression, where all concrete is gone."""
        return self.bars.resisted_n(self.zone.height_m) if self.bars else (0.0, 0.0)

    @property
    def cage_text(self) -> str:
        """The same as text."""
        tension_n, pressed_n = self.cage_n
        return (
            f"{tension_n / _MEGA:.2f} MN in tension and {pressed_n / _MEGA:.2f} MN in compression by EN 1993-1-1, "
            f"curve c; {self.straight_cage_n / _MEGA:.2f} MN if straight, as in a run"
        )

    @property
    def straight_cage_n(self) -> float:
        """What its bars resist in compression if they have no bow at all, as in a run."""
        return self.bars.straight_n(self.zone.height_m) if self.bars else 0.0

    @property
    def scaled_burial(self) -> float:
        """Scaled depth of burial of its charges, m/kg^(1/3)."""
        zone = self.zone
        density = zone.made_of.density_kg_m3
        return float(scaled_depth_of_burial(length_of_charge_m(zone), zone.stemming_m, zone.hole_diameter_m, density))

    @property
    def fragment_speed_m_s(self) -> float:
        """Mean speed of what is thrown, after its cover."""
        return self.zone.cover_factor * float(mean_speed_m_s(self.effective_kg_m3, self.density_kg_m3))

    def loosens(self, scenario: Scenario) -> bool:
        """Return whether it fires, and does anything to its concrete."""
        return scenario.blast.explosion and self.zone.goes_off and self.effect != Effect.NOTHING

    def firing(self, scenario: Scenario) -> ZoneFiring:
        """Return it as a change to the structure."""
        zone, (tension_n, compression_n) = self.zone, self.cage_n
        after_s = zone.fired_after_s(scenario.seed) + MOVES_AFTER_S
        thrown = self.effect == Effect.THROWN and zone.debris == THROWN_AWAY
        return ZoneFiring(
            time_s=scenario.blast.start_s + after_s,
            members=(self.member.name,),
            lowest_corner_m=tuple(self.box_m[0].tolist()),
            highest_corner_m=tuple(self.box_m[1].tolist()),
            name=given(zone.name),
            along=zone.along,
            effect=self.effect.value,
            left=self.left.tension,
            left_compression=self.left.compression,
            speed_m_s=self.fragment_speed_m_s if thrown else 0.0,
            cage_tension_n=tension_n,
            cage_compression_n=compression_n,
            **(_standing_bars(self.bars) if self.bars else {}),
        )

    def warnings(self) -> Iterator[str]:
        """Yield what a blaster would ask about, a sentence without a full stop each."""
        zone, share = self.zone, self.zone.depth_m / self.thickness_m
        if zone.stemming_m < self.burden_m - _ROUNDING:
            yield Text(
                "stemming of {} is less than the burden, {}",
                Quantity(zone.stemming_m, "m", ".3g"),
                Quantity(self.burden_m, "m", ".3g"),
            )
        least, most = USUAL_DEPTH_SHARES
        if not least - _ROUNDING <= share <= most + _ROUNDING:
            shares = f"{share:.2f}", f"{least:g}", f"{most:g}"
            yield Text("holes are {} of the thickness deep: {} to {} are usual", *shares)
        lowest, highest = self.table_kg_m3[0] / FACTOR_OF_DOUBT, self.thresholds.throw_kg_m3 * FACTOR_OF_DOUBT
        if zone.mass_kg and not lowest <= self.effective_kg_m3 <= highest:
            yield Text(
                "{} are outside half to twice the table, {} to {}",
                Quantity(self.effective_kg_m3, "kg/m³", ".2f"),
                Quantity(lowest, "kg/m³", ".2f", shown=False),
                Quantity(highest, "kg/m³", ".2f"),
            )
        if bars := self.bars:
            slender_m = float(slender_from_m(bars.diameter_m, bars.yield_pa))
            if zone.height_m < slender_m:
                yield Text(
                    "bars of {} bared over {} resist {} of their yield force, and all of it if they are straight: "
                    "from {} on these buckle, too",
                    Quantity(_MM_PER_M * bars.diameter_m, "mm", ".3g"),
                    Quantity(zone.height_m, "m", ".2f"),
                    f"{self.cage_n[1] / self.cage_n[0]:.0%}",
                    Quantity(slender_m, "m", ".2f"),
                )
        if zone.mass_kg and zone.cover_factor == 1.0 and self.scaled_burial < RISKY_BURIAL:
            yield (
                Text(
                    "scaled depth of burial {} is below {}, and nothing covers the holes: fragments fly far",
                    Quantity(self.scaled_burial, "m/kg^(1/3)", ".2f"),
                    f"{RISKY_BURIAL:g}",
                )
            )

    def unusual(self) -> Iterator[str]:
        """Yield that its explosive is far from all that manuals and recorded jobs have, if it is."""
        least, most = POSSIBLE_KG_M3
        if self.zone.mass_kg and not least <= self.effective_kg_m3 <= most:
            yield (
                Text(
                    "{} has {} of explosive a m³ of concrete, blasting manuals and recorded jobs have {} "
                    "to {} (is blast_zones.charge_g in g?)",
                    self.zone.name,
                    Quantity(self.specific_kg_m3, "kg", ".3g"),
                    Quantity("0.2", "kg/m³", shown=False),
                    Quantity("2", "kg/m³"),
                )
            )

    def facts(self, scenario: Scenario) -> Iterator[Fact]:
        """Yield what a planner wants to know of it before a run."""
        zone, (begin_m, end_m) = self.zone, self.zone.ends_along_m
        holes = f"{zone.holes} holes of {zone.charge_g:g} g = {zone.mass_kg:.3g} kg of {zone.explosive}"
        begins_s = zone.begins_s(scenario)
        when = (
            Text("{} s", f"{begins_s:.3f}")
            if math.isfinite(begins_s)
            else "does not go off"
            if zone.fires
            else Text("misfires")
        )
        yield (
            given(zone.name),
            Text(
                "{}, {} {} to {}, {}, {}",
                self.member.name,
                zone.along,
                Quantity(begin_m, "m", "g", shown=False),
                Quantity(end_m, "m", "g"),
                holes,
                when,
            ),
        )
        limits = f"breaks from {self.thresholds.break_kg_m3:.2f}, is thrown out from {self.thresholds.throw_kg_m3:.2f}"
        yield (
            "",
            Text(
                "{} in {} ({}): {}",
                Quantity(self.specific_kg_m3, "kg/m³", ".2f"),
                Quantity(self.volume_m3, "m³", ".3f"),
                limits,
                self.effect,
            ),
        )
        if self.bars:
            in_run = "" if scenario.connections.is_elastic else "; rigid connections leave them out of a run"
            yield "", f"{self.bars.text} resist {self.cage_text}{in_run}"
        for warning in self.warnings():
            yield "look at", warning


def placed_zone(zone: BlastZone, members: Sequence[Member], layers: Sequence[BarLayer] = ()) -> PlacedZone:
    """Return a zone in its member, which may have layers of bars; refuse one that does not lie in it with its holes."""
    member = one_member(zone, members)
    if member.steel is not None:
        raise zone.unexpected("member", "a member that holes are drilled in; one of steel is severed by [[cuts]]")
    along = zone.axes[0]
    (lowest, highest), (begin_m, end_m) = member.solid.bounds[:, along].tolist(), zone.ends_along_m
    slack = _ROUNDING * (highest - lowest)
    if begin_m < lowest - slack or end_m > highest + slack:
        raise zone.unexpected(
            "middle_m",
            f"a zone of {zone.height_m:g} m within {member.name}, which is from {lowest:g} to {highest:g} (m) along "
            f"{zone.along}; this one is from {begin_m:g} to {end_m:g} m",
        )
    slab = slab_between(member.solid, along, begin_m, end_m)
    placed = PlacedZone(zone, member, slab.volume, slab.bounds, zone_bars(zone, member, slab.bounds, layers))
    _check_holes(placed)
    return placed


def one_member(action: BlastZone | MemberCut, members: Sequence[Member]) -> Member:
    """Return the member of a zone or a cut; refuse the name of a kind, and one that no member has."""
    named = [member for member in members if member.name == action.member]
    if not named:
        members_named(action.member, members, f"{action.table}.member")  # refuses what is neither
        raise action.unexpected("member", "the name of one member, not a kind")
    return named[0]


def _check_holes(placed: PlacedZone) -> None:
    zone = placed.zone
    if zone.depth_m >= placed.thickness_m - _ROUNDING:
        raise zone.unexpected(
            "depth_m", f"less than the thickness of {placed.member.name} there, {placed.thickness_m:.4g} (m)"
        )
    rows_m = (zone.rows - 1) * placed.row_spacing_m
    if rows_m >= placed.width_m - _ROUNDING:
        raise zone.unexpected(
            "row_spacing_m",
            f"{zone.rows} rows within {placed.member.name}, which is {placed.width_m:.4g} (m) wide there; they take "
            f"{rows_m:.4g} m",
        )
    _ = placed.thresholds  # refuses those in the wrong order


def placed_zones(
    scenario: Scenario, members: Sequence[Member], layers: Sequence[BarLayer] | None = None
) -> tuple[PlacedZone, ...]:
    """Return all blast zones of a scenario in its members, whose layers of bars may be known."""
    if not scenario.blast_zones:
        return ()
    layers = all_layers(scenario, members) if layers is None else layers
    return tuple(placed_zone(zone, members, layers) for zone in scenario.blast_zones)


def _standing_bars(bars: ZoneBars) -> dict[str, Any]:
    """Return the keys of the bars of a zone that fires."""
    return {
        "bars": bars.count,
        "bar_diameter_mm": _MM_PER_M * bars.diameter_m,
        "bar_yield_n_mm2": bars.yield_pa / NEWTON_PER_SQUARE_MILLIMETRE,
        "bar_distances_m": bars.distances_m,
    }


def zone_firings(scenario: Scenario, members: Sequence[Member]) -> tuple[ZoneFiring, ...]:
    """Return what the zones do that fire, and that do anything to their concrete."""
    if not scenario.blast.explosion:
        return ()
    placed = placed_zones(scenario, members)
    return tuple(zone.firing(scenario) for zone in placed if zone.loosens(scenario))


def grams_per_tonne(explosive_kg: float, members: Sequence[Member]) -> float:
    """Return explosive by the mass of the structure, g/t."""
    mass_t = math.fsum(member.mass_kg for member in members) / _KILO
    return _KILO * explosive_kg / mass_t


def zone_totals(zones: Sequence[PlacedZone], members: Sequence[Member]) -> Iterator[Fact]:
    """Yield totals of the zones, next to what is recorded of other jobs."""
    mass_kg = math.fsum(placed.zone.mass_kg for placed in zones)
    volume_m3 = math.fsum(placed.volume_m3 for placed in zones)
    holes, drilled_m = sum(placed.zone.holes for placed in zones), math.fsum(placed.zone.drilled_m for placed in zones)
    specific, rate = mass_kg / volume_m3, grams_per_tonne(mass_kg, members)
    yield "all zones", f"{mass_kg:.3g} kg in {holes} holes, {drilled_m:.1f} m drilled, {specific:.2f} kg/m³"
    (least, most), (lowest, highest) = RECORDED_G_T, POSSIBLE_G_T
    yield "", f"{rate:.1f} g a tonne of the bridge; recorded jobs have {least:g} to {most:g}"
    if not lowest <= rate <= highest:
        yield "look at", f"{rate:.1f} g/t are outside {lowest:g} to {highest:g}, which all recorded jobs are within"
    yield "", "charges are fixed by test shots and a licensed blaster"
    if any(placed.drops for placed in zones):
        yield (
            "look at",
            "what lands is by energy of one shaft with flat ends, and no test of a blasted column confirms it;",
        )
        yield "", "a run can bring down what stands by that, as a shaft breaks there wherever its shards meet"
