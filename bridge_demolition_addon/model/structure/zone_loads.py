"""What stands on blast zones: what they carry at rest, whether their bars hold that, how far it falls, and on what."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.drilled_charges.landing import LandingShaft
from ...engineering.geometry.vectors import AXES, cross, length
from ...engineering.mechanics.section_cuts import ConnectionLoads
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..actions import Fact
from ..blast.blast_zones import BlastZone
from ..materials import strengths
from ..reinforcement.concrete_members import material_of
from ..results.stability import ZoneLoad
from ..scenario import Scenario
from ..schema import given
from .blast_zones import PlacedZone
from .model import Model

_AT_PLANE = 0.02
"""Part of the height of a zone within which a connection is at one of its two planes."""

_LEAST_M = 0.01
"""What is shorter is no part of a member."""

_AT_ONCE = 2.0
"""Force by that at rest in elastic bars whose load comes upon them at once."""

_MEGA = 1e6


def zone_loads(zones: Sequence[BlastZone], model: Model, loads: ConnectionLoads) -> tuple[ZoneLoad, ...]:
    """Return what zones carry, by the connections' loads in a model at rest."""
    return tuple(_load_of(zone, model, loads) for zone in zones)


def _load_of(zone: BlastZone, model: Model, loads: ConnectionLoads) -> ZoneLoad:
    along, (begin_m, end_m) = AXES.index(zone.along), zone.ends_along_m
    names = np.array([member.name for member in model.members])[model.member_of_shard]
    places_m = model.centres_m[:, along]
    in_zone = np.append((names == zone.member) & (begin_m < places_m) & (places_m < end_m), False)
    pairs = model.connections.pairs
    leaves = np.flatnonzero(in_zone[pairs].sum(axis=1) == 1)
    ends = []
    for plane_m, outwards in ((end_m, 1.0), (begin_m, -1.0)):
        rows = leaves[abs(loads.points_m[leaves, along] - plane_m) < _AT_PLANE * zone.height_m]
        # Loads are on the first bodies: those on what lies beyond the plane.
        signs = np.where(in_zone[pairs[rows, 0]], -1.0, 1.0)[:, None]
        forces, middle_m = signs * loads.forces_n[rows], _middle_m(model, rows)
        moments = signs * loads.moments_nm[rows] + cross(loads.points_m[rows] - middle_m, forces)
        force, moment = forces.sum(axis=0), moments.sum(axis=0)
        pressed_n = outwards * float(force[along])
        force[along] = moment[along] = 0.0
        ends.append(ZoneLoad(given(zone.name), pressed_n, float(length(force)), float(length(moment))))
    return ends[0] if zone.is_upright else max(ends, key=lambda end: end.bending_nm)


def _middle_m(model: Model, rows: np.ndarray) -> np.ndarray:
    """Return the middle (3,) of the faces of connections."""
    areas = model.connections.areas[rows]
    return (areas[:, None] * model.connections.points[rows]).sum(axis=0) / (areas.sum() or 1.0)


@dataclass(frozen=True, slots=True)
class ZoneFall:
    """How far what stands on an upright zone falls once its concrete is thrown out, and on what.

    Attributes
    ----------
    falls_m : float
        Height of the zone.
    fallen_m : float
        Heights of this zone and those below it: what is above lands with the speed of that at most.
    above_m, below_m : float
        Lengths of its member above it and below it, each up to the next zone that is thrown out.
    all_m : float
        Heights of the member's zones that are thrown out.
    zones : int
        How many these are.
    shaft : LandingShaft or None
        The piece above it, under all that this carries, where its load and strength are known.
    can_stand : bool
        Whether all pieces of the member can land on each other, and stand.
    """

    falls_m: float
    fallen_m: float
    above_m: float
    below_m: float
    all_m: float
    zones: int
    shaft: LandingShaft | None = None
    can_stand: bool = True

    @property
    def lands_m_s(self) -> float:
        """Largest speed as it lands, of a free fall."""
        return math.sqrt(2.0 * STANDARD_GRAVITY_M_S2 * self.fallen_m)

    @property
    def crushed_m(self) -> float | None:
        """What is crushed at most as it lands, after all falls of the member; None where that is not known."""
        return self.shaft.crushed_m(self.all_m)[1] if self.shaft else None

    @property
    def is_crushed(self) -> bool:
        """Whether all of both pieces is crushed as it lands, at least with what explosive leaves of its strength."""
        return self.crushed_m is not None and self.crushed_m >= self.above_m + self.below_m

    @property
    def tips(self) -> bool:
        """Whether the piece above it tips over where it lands on an edge, and nothing holds its head."""
        return self.shaft is not None and self.fallen_m >= self.shaft.tips_from_m

    @property
    def lets_fold(self) -> bool:
        """Whether its piece does not stand: over an only zone the stub may guide it, between zones it tips."""
        if self.shaft is None:
            return self.zones > 1 and self.above_m > _LEAST_M
        return self.is_crushed or self.shaft.buckles or (self.zones > 1 and self.tips)

    @property
    def text(self) -> str:
        """What is to be expected, without a full stop."""
        falls = f"what is above falls by {self.falls_m:.2f} m"
        if self.zones > 1:
            falls += (
                f" (lands with up to {self.lands_m_s:.1f} m/s), {self.all_m:.2f} m by {self.zones} zones of the member"
            )
            if self.can_stand:
                return f"{falls}: its pieces can land on each other and stand, as none tips over after its fall"
            return f"{falls}, between which it can fold"
        falls += f" (lands with {self.lands_m_s:.1f} m/s)"
        onto = f"its stub of {self.below_m:.2f} m" if self.below_m > _LEAST_M else "what the member stands on"
        if not self.can_stand:
            return f"{falls} on {onto}"
        return f"{falls}, can land upright on {onto} and stand: a second zone of the member lets it fold"

    def landing_texts(self) -> Iterator[str]:
        """Yield what its landing does to the piece above it by energy, a sentence without a full stop each."""
        if (shaft := self.shaft) is None:
            return
        least_n, most_n = (force / _MEGA for force in shaft.crushing_n)
        forces = f"{least_n:.1f} to {most_n:.1f} MN crush its end"
        if self.is_crushed:
            yield f"by energy it can be crushed from end to end: {forces}, by what explosive leaves of its strength"
        elif shaft.buckles:
            yield f"its landing can buckle it: {forces}"
        else:
            least_m, most_m = shaft.crushed_m(self.falls_m)[0], given(self.crushed_m)
            yield (
                f"by energy {least_m:.2f} to {most_m:.2f} m of its {shaft.length_m:.2f} m are crushed ({forces}), and "
                f"it stands on what is left if its head is within {shaft.lean_m:.2f} m of its foot"
            )
            over = "can tip over" if self.tips else "rocks and stands"
            yield (
                f"where it lands on an edge and nothing holds its head it {over}: that takes a fall of "
                f"{shaft.tips_from_m:.2f} m"
            )


def zone_falls(
    zones: Sequence[PlacedZone], scenario: Scenario, loads: Mapping[str, ZoneLoad] | None = None
) -> dict[str, ZoneFall]:
    """Return the falls of upright zones that fire and are thrown out, by their names; `loads` are what zones carry."""
    thrown = [placed for placed in zones if placed.drops]
    falls: dict[str, list[tuple[str, ZoneFall]]] = {}
    for placed in thrown:
        name, fall = given(placed.zone.name), _fall_of(placed, thrown)
        load = (loads or {}).get(name)
        shaft = _shaft_of(placed, fall, load, scenario) if load else None
        falls.setdefault(placed.member.name, []).append((name, replace(fall, shaft=shaft)))
    return {
        name: replace(fall, can_stand=not any(other.lets_fold for _, other in of_member))
        for of_member in falls.values()
        for name, fall in of_member
    }


def _fall_of(placed: PlacedZone, thrown: Sequence[PlacedZone]) -> ZoneFall:
    begin_m, end_m = placed.zone.ends_along_m
    alike = [other.zone for other in thrown if other.member.name == placed.member.name]
    lowest_m, highest_m = placed.member.solid.bounds[:, 2].tolist()
    above = [zone for zone in alike if zone.middle_m > end_m]
    next_m = min((zone.ends_along_m[0] for zone in above), default=highest_m)
    last_m = max((zone.ends_along_m[1] for zone in alike if zone.middle_m < begin_m), default=lowest_m)
    all_m = math.fsum(zone.height_m for zone in alike)
    fallen_m = all_m - math.fsum(zone.height_m for zone in above)
    return ZoneFall(placed.zone.height_m, fallen_m, next_m - end_m, begin_m - last_m, all_m, len(alike))


def _shaft_of(placed: PlacedZone, fall: ZoneFall, load: ZoneLoad, scenario: Scenario) -> LandingShaft | None:
    """Return the piece above a zone; None without one or a load, and where its strength is not known."""
    material = material_of(scenario, placed.member)
    if fall.above_m <= _LEAST_M or load.pressed_n <= 0.0 or material is None:
        return None
    area_m2, side_m = placed.volume_m3 / placed.zone.height_m, min(placed.thickness_m, placed.width_m)
    own_n = area_m2 * fall.above_m * placed.density_kg_m3 * STANDARD_GRAVITY_M_S2
    strength_pa = scenario.connections.strength_factor * float(strengths(scenario.materials)[material].compression_pa)
    return LandingShaft(fall.above_m, side_m, area_m2 / side_m, load.pressed_n, min(own_n, load.pressed_n), strength_pa)


def load_facts(placed: PlacedZone, load: ZoneLoad) -> Iterator[Fact]:
    """Yield what a zone carries at rest, and whether its bars hold that where its concrete is gone."""
    if not placed.zone.is_upright:
        yield "", f"carries {load.bending_nm / _MEGA:.2f} MN·m, and {load.shear_n / _MEGA:.2f} MN across it, at rest"
        return
    how = "pressed" if load.pressed_n >= 0.0 else "pulled"
    carries = f"{how} with {abs(load.pressed_n) / _MEGA:.2f} MN at rest"
    if not placed.drops:
        yield "", carries
    elif not placed.bars:
        yield "", f"{carries}, and no bars are left to carry it"
    else:
        share = bars_used(placed, load)
        yield "", f"{carries}, {share:.2f} times what bars may be counted on for: {_outcome(placed, load)}"
        if _may_hold(placed, load):
            yield "look at", "its bars may hold what stands on it, which then does not come down: bare a greater height"


def bars_used(placed: PlacedZone, load: ZoneLoad) -> float:
    """Return what a zone carries by what its bars may be counted on for, that way; infinite without bars."""
    tension_n, pressed_n = placed.cage_n
    resisted_n = pressed_n if load.pressed_n >= 0.0 else tension_n
    return abs(load.pressed_n) / resisted_n if resisted_n else math.inf


def _may_hold(placed: PlacedZone, load: ZoneLoad) -> bool:
    most_n = placed.straight_cage_n if load.pressed_n >= 0.0 else placed.cage_n[0]
    return _AT_ONCE * abs(load.pressed_n) <= most_n


def _outcome(placed: PlacedZone, load: ZoneLoad) -> str:
    """Return what bars do that stand bare at once, by their least and their largest resistance."""
    used, gives_way = bars_used(placed, load), "fold" if load.pressed_n >= 0.0 else "tear or stretch"
    if _AT_ONCE * used <= 1.0:
        return "they hold it"
    if _may_hold(placed, load):
        return "they hold it if they are straight"
    if used <= 1.0:
        return f"they hold it at rest, but {gives_way} as it comes upon them at once, up to twice"
    return f"they {gives_way}"


def facts_of_zones(placed: PlacedZone, loads: Mapping[str, ZoneLoad], falls: Mapping[str, ZoneFall]) -> Iterator[Fact]:
    """Yield what stands on a zone, as far as its load is known, and how it comes down."""
    name = given(placed.zone.name)
    if name in loads:
        yield from load_facts(placed, loads[name])
    else:
        yield "", "what it carries at rest is not known by statics"
    if name in falls:
        yield "", falls[name].text
        yield from (("", text) for text in falls[name].landing_texts())
