"""Specific charge of a zone: explosive in drill holes by the volume of concrete that they have to break, kg/m³.

Two thresholds of the material decide the effect on a zone. Where they lie is known within a factor of 2, and is found
by test shots. Those here are to begin with: blasting manuals for the breaking of plain and reinforced concrete, and
what columns took in recorded jobs for throwing it out of its reinforcement.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from ...errors import BlastError
from ..arrays import FloatArray

THROW_KG_M3 = 1.0
"""Specific charge that throws concrete out of its reinforcement; 0.6 to 1.5 in columns, up to 2 inside spirals."""

FACTOR_OF_DOUBT = 2.0
"""A specific charge beyond this factor of the table's is worth a question."""

_ROUNDING = 1e-9
"""A charge of exactly a threshold, up to rounding, has its effect."""

_REFERENCE_RWS = 100.0
"""Relative weight strength of ANFO, which stands for the explosives of the table."""


class DrilledElement(StrEnum):
    """What is drilled."""

    PLAIN = "plain concrete"
    MASONRY = "masonry"
    BEAM_OR_COLUMN = "reinforced beam or column"
    CAP_BEAM = "reinforced cap beam"
    SLAB = "reinforced slab"


_BREAKING_KG_M3 = {
    DrilledElement.PLAIN: (0.20, 0.30),
    DrilledElement.MASONRY: (0.40, 0.50),
    DrilledElement.CAP_BEAM: (0.44, 0.50),
    DrilledElement.SLAB: (0.48, 0.55),
}
"""Least and largest specific charges that break what does not depend on the burden."""

_BURDENS_M = np.array([0.15, 0.20, 0.30, 0.40])
_LEAST_BY_BURDEN = np.array([0.50, 0.38, 0.30, 0.26])
_MOST_BY_BURDEN = np.array([0.56, 0.42, 0.34, 0.28])
"""Those of reinforced beams and columns, by their burden."""


@dataclass(frozen=True, slots=True)
class Thresholds:
    """Specific charges from which on the concrete of a zone breaks, and is thrown out of its reinforcement, kg/m³."""

    break_kg_m3: float
    throw_kg_m3: float = THROW_KG_M3

    def __post_init__(self) -> None:
        if not 0.0 < self.break_kg_m3 < self.throw_kg_m3 < np.inf:
            raise BlastError(
                f"thresholds are {self.break_kg_m3:g} and {self.throw_kg_m3:g} kg/m³: expected two numbers above 0, "
                "the second above the first"
            )


class Effect(StrEnum):
    """What drill holes do to the concrete of their zone."""

    NOTHING = "nothing"
    LOOSENED = "loosened"
    RUBBLE = "rubble in the cage"
    THROWN = "thrown out"


@dataclass(frozen=True, slots=True)
class LeftOfConcrete:
    """Parts of its strength that the concrete of a zone has left."""

    tension: float
    compression: float


def breaking_range_kg_m3(element: DrilledElement, burden_m: float) -> tuple[float, float]:
    """Return the least and the largest specific charge of the table that break an element.

    Only for reinforced beams and columns it depends on the burden: linear between the burdens of the table, constant
    beyond them.
    """
    if element in _BREAKING_KG_M3:
        return _BREAKING_KG_M3[element]
    least, most = (np.interp(burden_m, _BURDENS_M, column) for column in (_LEAST_BY_BURDEN, _MOST_BY_BURDEN))
    return float(least), float(most)


def specific_charge_kg_m3(mass_kg: ArrayLike, volume_m3: ArrayLike, relative_strength: ArrayLike = 100.0) -> FloatArray:
    """Return the specific charge of masses in volumes, converted to an explosive of relative weight strength 100."""
    strength = np.asarray(relative_strength, float) / _REFERENCE_RWS
    specific: FloatArray = np.asarray(mass_kg, float) * strength / np.asarray(volume_m3, float)
    return specific


def charge_a_hole_kg(
    specific_kg_m3: ArrayLike, volume_m3: ArrayLike, holes: ArrayLike, relative_strength: ArrayLike = 100.0
) -> FloatArray:
    """Return the explosive in each hole that gives a zone a specific charge: Q = q V over the number of holes."""
    strength = np.asarray(relative_strength, float) / _REFERENCE_RWS
    charge: FloatArray = np.asarray(specific_kg_m3, float) * np.asarray(volume_m3, float) / strength / np.asarray(holes)
    return charge


def effect_of(specific_kg_m3: float, thresholds: Thresholds) -> Effect:
    """Return the effect of a specific charge: less than half of what breaks does nothing that counts."""
    specific_kg_m3 *= 1.0 + _ROUNDING
    if specific_kg_m3 >= thresholds.throw_kg_m3:
        return Effect.THROWN
    if specific_kg_m3 >= thresholds.break_kg_m3:
        return Effect.RUBBLE
    return Effect.LOOSENED if specific_kg_m3 >= 0.5 * thresholds.break_kg_m3 else Effect.NOTHING


def left_of_concrete(specific_kg_m3: float, thresholds: Thresholds) -> LeftOfConcrete:
    """Return what the concrete of a zone has left.

    Loosened, its strength in tension falls in a straight line to 0, and half of that in compression is left.
    """
    match effect_of(specific_kg_m3, thresholds):
        case Effect.NOTHING:
            return LeftOfConcrete(1.0, 1.0)
        case Effect.LOOSENED:
            return LeftOfConcrete(2.0 - 2.0 * specific_kg_m3 / thresholds.break_kg_m3, 0.5)
    return LeftOfConcrete(0.0, 0.0)
