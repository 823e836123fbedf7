"""Fall beds: what is spread below a bridge so that it lands softer."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from ...engineering.geometry.plan_areas import inside_outline
from ...engineering.mechanics.fall_beds import TESTED_KG, depth_m, friction_of, largest_force_n, radius_m
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..actions import Fact, Plan, PlannedAction, PlannedStep, Worksite
from ..schema import POSITION, SIZE, key
from .site import check_outline

_USUAL_DENSITY_KG_M3 = 2500.0
_FALL_M = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class FallBed(PlannedAction):
    """A bed of loose material that stops what falls on it, within its thickness, by the formula of ASTRA 12006 for
    cushions on galleries, from drop tests with blocks of 100 to 1000 kg: heavier shards are beyond them. What has
    stopped settles under what lies on it, down to its base, and slides with its friction. What stands in it when a run
    begins is not held. Ditches and banks beside it are ground."""

    table: ClassVar[str] = "fall_beds"
    heading: ClassVar[str] = "Fall beds"
    noun: ClassVar[str] = "fall bed"
    kept_in: ClassVar[str] = "fall_beds"

    name: str = key("What it is called in reports.")
    corners_m: tuple[tuple[float, float], ...] = key(
        "Corners of the bed in plan, x and y of each, in order around it; three or more.", unit="m"
    )
    base_m: float = key("Height of its base, on the ground or a carriageway below it.", default=0.0, **POSITION)
    thickness_m: float = key("Thickness of the bed.", **SIZE)
    modulus_kpa: float = key(
        "Modulus of its material by a plate bearing test: 3000 of loose soil to 20 000 of gravel that was driven on; "
        "for sand, tyres or mats that of a test.",
        unit="kPa",
        at_least=10,
        at_most=1_000_000,
    )
    friction_deg: float = key("Angle of friction of its material.", default=35.0, unit="°", at_least=10, at_most=50)
    vibration_factor: float = key(
        "Part of the vibration by what lands on it that is left, as measured or agreed: a quarter to a half is quoted "
        "for ditches and banks.",
        default=1.0,
        above=0,
        at_most=1,
    )

    @property
    def top_m(self) -> float:
        """Height of its top."""
        return self.base_m + self.thickness_m

    def covers(self, positions_m: np.ndarray) -> np.ndarray:
        """Return whether positions (n, 2) in plan are over it."""
        return inside_outline(np.array(self.corners_m), positions_m)

    def forces_n(self, energies_j: np.ndarray, radii_m: np.ndarray) -> np.ndarray:
        """Return its largest forces (n,) on what falls on it with energies (n,)."""
        friction = friction_of(self.friction_deg)
        own = {"thickness_m": self.thickness_m, "modulus_kpa": self.modulus_kpa, "friction": friction}
        return largest_force_n(energies_j, radii_m, **own)

    def begins_s(self, plan: Plan) -> float:
        return math.inf

    def planned(self, plan: Plan) -> Iterator[PlannedStep]:
        yield from ()

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        return ""

    def facts(self, site: Worksite) -> Iterator[Fact]:
        for mass_kg in (TESTED_KG[1], 20.0 * TESTED_KG[1]):
            energy = np.array(mass_kg * STANDARD_GRAVITY_M_S2 * _FALL_M)
            force = self.forces_n(energy, radius_m(mass_kg / _USUAL_DENSITY_KG_M3))
            sinks = float(depth_m(energy, force))
            through = "" if sinks <= self.thickness_m else ": more than its thickness, it reaches what is below"
            note = "" if mass_kg <= TESTED_KG[1] else " (beyond the tests)"
            yield (
                self.name if not note else "",
                f"stops {mass_kg / 1e3:g} t that fall {_FALL_M:g} m within {sinks:.2f} m by up to "
                f"{float(force) / 1e6:.2g} MN{note}{through}",
            )

    def _check_together(self) -> None:
        check_outline(self.corners_m, "fall_beds.corners_m")


def vibration_factors(beds: Sequence[FallBed], positions_m: np.ndarray) -> np.ndarray:
    """Return the part (n,) that is left of the vibration by what lands at positions (n, 2), the least of any bed."""
    factors = np.ones(len(positions_m))
    for bed in beds:
        factors[bed.covers(positions_m)] = np.minimum(factors[bed.covers(positions_m)], bed.vibration_factor)
    return factors
