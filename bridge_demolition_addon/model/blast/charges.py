"""Charges, the TNT equivalents of explosives, and where a new charge is put at a pier."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from manifold3d import CrossSection

from ...engineering.arithmetic import cube_root
from ...engineering.blast.wave import Burst
from ...engineering.geometry.mesh import TriangleMesh, plane_cuts
from ...engineering.geometry.vectors import distance
from ...errors import BlastError, ScenarioError
from ...texts import Quantity, Text, point_text
from ..actions import Fact, Plan, PlannedAction, Worksite
from ..schema import POSITION, given, key

SWISDAK = "air blast; Swisdak, NSWC/WOL/TR 75-116 (1975), as in TM 5-855-1 and UFC 3-340-02"
SWISDAK_PRESSURE = "air blast, pressure only; Swisdak, NSWC/WOL/TR 75-116 (1975), as in TM 5-855-1 and UFC 3-340-02"
BAKER = "heat of detonation over that of TNT, 4520 kJ/kg; Baker et al., Explosion Hazards and Evaluation (1983)"

MS_PER_S = 1000.0

_POINT_M = 1e-3
"""Radius of the sphere that is looked for in members, to find whether a charge lies in one."""

_FARTHEST_SCALED_M = 40.0
"""Scaled distance (m/kg^⅓) up to which the curves of Kingery and Bulmash go: 1.8 kPa, below any threshold of damage to
what is not glass."""

_DEEPEST_M = 1.0
"""Depth in the ground up to which a charge may lie on ground that is not where its file has it."""

LARGEST_CHARGE_KG = 1_000_000


@dataclass(frozen=True, slots=True)
class Explosive:
    """An explosive, and how much TNT a unit of its mass is worth.

    Where only one equivalent is known, or the heat of detonation, it stands for both.
    """

    name: str
    tnt_by_pressure: float  # mass of TNT with the same peak overpressure
    tnt_by_impulse: float  # mass of TNT with the same impulse
    source: str  # what was measured, and who published it


EXPLOSIVES = {
    explosive.name: explosive
    for explosive in (
        Explosive("TNT", 1.0, 1.0, "the reference"),
        Explosive("ANFO", 0.82, 0.82, SWISDAK_PRESSURE),
        Explosive("C-4", 1.37, 1.19, SWISDAK),
        Explosive("Composition B", 1.11, 0.98, SWISDAK),
        Explosive("Pentolite", 1.42, 1.00, SWISDAK),
        Explosive("PETN", 1.27, 1.27, SWISDAK_PRESSURE),
        Explosive("RDX", 1.185, 1.185, BAKER),
        Explosive("HMX", 1.256, 1.256, BAKER),
        Explosive("Semtex", 1.250, 1.250, BAKER),
        Explosive("Nitroglycerin", 1.481, 1.481, BAKER),
        Explosive("Dynamite 60 %", 0.600, 0.600, BAKER),
    )
}
"""Explosives by name. One number stands for what varies by some 20 % with distance and confinement."""


def explosive_named(name: str) -> Explosive:
    """Return the explosive of a name, in capitals or not."""
    for known, explosive in EXPLOSIVES.items():
        if isinstance(name, str) and known.casefold() == name.strip().casefold():
            return explosive
    raise BlastError(f"explosive is {name!r}: expected one of {', '.join(EXPLOSIVES)}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Charge(PlannedAction):
    """A bare charge. One of 0 kg does nothing."""

    table: ClassVar[str] = "charges"
    heading: ClassVar[str] = "Charges"
    numbered: ClassVar[str] = "Charge"
    noun: ClassVar[str] = "bare charge"
    is_object: ClassVar[bool] = True

    name: str | None = key("What it is called in the logs; by default Charge and its number.", default=None)
    position_m: tuple[float, float, float] = key(
        "Position: along the road, across it, and above the ground.", **POSITION
    )
    mass_kg: float = key("Mass of the explosive itself.", unit="kg", at_least=0, at_most=LARGEST_CHARGE_KG)
    explosive: str = key("What it is made of.", default="TNT", choices=tuple(EXPLOSIVES))
    delay_ms: float = key(
        "Time from `blast.start_s` to its detonation.", default=0.0, unit="ms", at_least=0, at_most=1e6
    )
    burst: str = key(
        "Whether it detonates in the `air` or on the `surface` of the ground, which throws the wave back.",
        default=Burst.AIR.value,
        choices=tuple(burst.value for burst in Burst),
    )

    @property
    def delay_s(self) -> float:
        """Time from the start of the blasting to its detonation, s."""
        return self.delay_ms / MS_PER_S

    @property
    def tnt_kg(self) -> float:
        """Mass of TNT with the same impulse, kg: what moves bodies."""
        return self.mass_kg * EXPLOSIVES[self.explosive].tnt_by_impulse

    @property
    def tnt_for_pressure_kg(self) -> float:
        """Mass of TNT with the same peak overpressure, kg: what damage depends on."""
        return self.mass_kg * EXPLOSIVES[self.explosive].tnt_by_pressure

    def begins_s(self, plan: Plan) -> float:
        return plan.detonation_s(self.delay_s) if self.mass_kg > 0.0 else math.inf

    def ends_s(self, plan: Plan) -> float:
        return plan.detonation_s(self.delay_s)

    def described(self) -> tuple[str, str]:
        charge = self.name, Quantity(self.mass_kg, "kg", ".3g"), Text(self.explosive)
        return Text("{} detonates: {} of {}, bare", *charge), point_text(self.position_m)

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        charges = [charge for charge in actions if charge.mass_kg > 0.0]
        mass_kg = math.fsum(charge.mass_kg for charge in charges)
        pattern = "{} bare charge with {}" if len(charges) == 1 else "{} bare charges with {}"
        return Text(pattern, len(charges), Quantity(mass_kg, "kg", ".3g")) if charges else ""

    def facts(self, site: Worksite) -> Iterator[Fact]:
        position = ", ".join(f"{value:g}" for value in self.position_m)
        worth = "" if self.explosive == "TNT" else f" = {self.tnt_kg:.3g} kg of TNT"
        detonation_s = site.plan.detonation_s(self.delay_s)
        when = f", {detonation_s:.4g} s" if math.isfinite(detonation_s) else ""
        yield given(self.name), f"{self.mass_kg:g} kg of {self.explosive}{worth} at ({position}) m{when}"

    def unusual(self, site: Worksite) -> Iterator[str]:
        if self.mass_kg == 0.0:
            return
        if inside := site.member_within(self.position_m, _POINT_M):
            in_air = "{} lies in {}: it counts as a bare charge in air; [[blast_zones]] have drill holes"
            yield Text(in_air, self.name, inside)
        away_m, curves_m = (
            site.distance_to_bridge_m(self.position_m),
            _FARTHEST_SCALED_M * float(cube_root(self.tnt_kg)),
        )
        if away_m > curves_m:
            yield Text(
                "{} is {} from the bridge: beyond {} its blast hardly loads anything",
                self.name,
                Quantity(away_m, "m", ".0f"),
                Quantity(curves_m, "m", ".0f"),
            )
        if (deep_m := self._depth_m(site)) > _POINT_M:
            depth = Quantity(deep_m, "m", ".3g")
            yield Text("{} lies {} below the ground: it counts as a bare charge in air", self.name, depth)

    def _depth_m(self, site: Worksite) -> float:
        """Return how far it lies below the ground, which may be none."""
        return site.ground_height(self.position_m[:2]) - self.position_m[2]

    def check_model(self, site: Worksite) -> None:
        """Check that it does not lie deep in the ground, whose soil would hold its wave."""
        if (deep_m := self._depth_m(site)) > _DEEPEST_M:
            wanted = f"a charge in air, this one lies {deep_m:.4g} m below the ground"
            raise ScenarioError(f"charges.position_m.3 of {self.name} is {self.position_m[2]:g}: expected {wanted}")

    def check_plan(self, plan: Plan) -> None:
        """Check that it detonates within the run, if at all."""
        detonation_s = plan.detonation_s(self.delay_s)
        if plan.time.duration_s <= detonation_s < math.inf:
            raise ScenarioError(
                f"{self.name} detonates at {detonation_s:g} s (blast.start_s and its charges.delay_ms): "
                f"expected less than time.duration_s, {plan.time.duration_s:g} (s)"
            )


ABOVE_FOOT_M = 1.0
"""Height of a new charge above the foot of its pier: where a person can fix it, and where columns are cut."""

_MOST_OF_HEIGHT = 0.5
"""Share of the height of a low pier that it is put at instead."""

_ON_BRIDGE_M = 0.05
"""Who clicks on a face puts the 3D cursor no further from it."""

_SAME_M = 1e-4
"""Corners of cuts through several shards that are nearer to a straight side are no corners of the pier."""

_UP = 2


def is_on_bridge(position_m: np.ndarray, boxes_m: np.ndarray) -> bool:
    """Return whether a position (3,), m, is in or on one of the boxes (n, 2, 3) around pieces of a bridge."""
    inside = (position_m >= boxes_m[:, 0] - _ON_BRIDGE_M) & (position_m <= boxes_m[:, 1] + _ON_BRIDGE_M)
    return bool(inside.all(axis=1).any())


def place_at_pier(piers: Sequence[TriangleMesh], near_m: np.ndarray) -> tuple[float, float, float] | None:
    """Return the middle of that face of the piers, 1 m above its foot, which is nearest on plan to a position (3,), m.

    None where there is no pier.
    """
    places = [place for pier in piers for place in _faces(pier)]
    if not places:
        return None
    away_m = [distance(place[:_UP], near_m[:_UP]) for place in places]
    x, y, z = places[int(np.argmin(away_m))].tolist()
    return x, y, z


def _faces(pier: TriangleMesh) -> list[np.ndarray]:
    """Return the middles (3,) of the sides of a pier at the height of a charge."""
    foot, top = pier.vertices[:, _UP].min(), pier.vertices[:, _UP].max()
    height = min(foot + ABOVE_FOOT_M, foot + _MOST_OF_HEIGHT * (top - foot))
    _, ends = plane_cuts(pier.vertices[pier.triangles], _UP, height)
    if not len(ends):
        return []
    return [
        np.array((*middle, height))
        for outline in CrossSection.hull_points(ends.reshape(-1, 3)[:, :_UP]).simplify(_SAME_M).to_polygons()
        for middle in (outline + np.roll(outline, -1, axis=0)) / 2.0
    ]
