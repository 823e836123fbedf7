"""Tendons: prestressing steel along a line in a member, as a scenario gives them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from ...engineering.elasticity.tendons import MODULUS_PA, RUPTURE_STRAIN
from ...engineering.mechanics.strength import NEWTON_PER_SQUARE_MILLIMETRE
from ...errors import ScenarioError
from ..changes.saw_cuts import TendonCut
from ..schema import SHORTEST_LENGTH_M, Table, check_exactly_one, key, shown
from .connections import ConnectionSettings

_SQUARE_METRE_PER_SQUARE_MILLIMETRE = 1e-6

_FROM_MIDDLE = {"at_least": -100, "at_most": 100}


@dataclass(frozen=True, slots=True, kw_only=True)
class Tendon(Table):
    """A tendon in a member, from one anchorage to the other. It presses the member by its prestress, holds cracks as
    far as it is bonded, and lets go where it is cut. It needs elastic connections and `connections.material`.
    """

    table: ClassVar[str] = "tendons"

    name: str = key("Name of the tendon.")
    member: str = key("Member that it is in, by the name that `bda check` lists.")
    points_m: tuple[tuple[float, float, float], ...] | None = key(
        "Points `[x, y, z]` of its line, from one anchorage to the other, in straight lines, as the bridge was built: "
        "two or more, or `eccentricities_m` instead.",
        default=None,
        unit="m",
        at_least=-10_000,
        at_most=10_000,
    )
    eccentricities_m: tuple[float, float, float] | None = key(
        "How far below the middle of a straight, level member the tendon is at its start, in the middle and at its "
        "end, above it where negative: a parabola over the whole length along the road, in the middle of its width.",
        default=None,
        unit="m",
        **_FROM_MIDDLE,
    )
    beside_m: float = key(
        "How far to the left of the middle of the width such a parabola lies.", default=0.0, unit="m", **_FROM_MIDDLE
    )
    area_mm2: float = key("Area of its steel.", unit="mm²", above=0)
    prestress_n_mm2: float = key("Stress in it at rest, after all losses.", unit="N/mm²", above=0)
    strength_n_mm2: float = key(
        "Tensile strength of its steel: at this stress it ruptures.",
        default=1860.0,
        unit="N/mm²",
        above=0,
        at_most=5000,
    )
    bonded: bool = key(
        "Whether it is bonded to the concrete, by grout or cast in. A cut then takes its force over the transmission "
        "length alone, without bond all of it.",
        default=True,
    )
    anchored: bool = key(
        "Whether it has anchorages at its ends. Without them, as of a pretensioned girder, bond builds up its force "
        "over the transmission length.",
        default=True,
    )
    diameter_mm: float = key(
        "Diameter of one of its strands, which decides the transmission length.",
        default=15.7,
        unit="mm",
        above=0,
        at_most=100,
    )

    @property
    def force_n(self) -> float:
        return self.area_mm2 * self.prestress_n_mm2

    @property
    def rupture_n(self) -> float:
        return self.area_mm2 * self.strength_n_mm2

    @property
    def area_m2(self) -> float:
        return _SQUARE_METRE_PER_SQUARE_MILLIMETRE * self.area_mm2

    @property
    def prestress_pa(self) -> float:
        return NEWTON_PER_SQUARE_MILLIMETRE * self.prestress_n_mm2

    @property
    def strength_pa(self) -> float:
        return NEWTON_PER_SQUARE_MILLIMETRE * self.strength_n_mm2

    @property
    def diameter_m(self) -> float:
        return 1e-3 * self.diameter_mm

    def _check_together(self) -> None:
        check_exactly_one(self, "points_m", "eccentricities_m")
        if self.prestress_n_mm2 >= self.strength_n_mm2:
            raise self.unexpected(
                "prestress_n_mm2", f"less than tendons.strength_n_mm2, {self.strength_n_mm2:g} (N/mm²)"
            )
        if self.prestress_pa / MODULUS_PA >= RUPTURE_STRAIN:
            most = RUPTURE_STRAIN * MODULUS_PA / NEWTON_PER_SQUARE_MILLIMETRE
            raise self.unexpected("prestress_n_mm2", f"less than {most:g} (N/mm²), at which it ruptures")
        if not self.bonded and not self.anchored:
            raise self.unexpected("anchored", "true without bond: nothing else would hold its force")
        if self.beside_m and self.eccentricities_m is None:
            raise self.unexpected("beside_m", "none without tendons.eccentricities_m: points say where they are")
        self._check_points()

    def _check_points(self) -> None:
        if self.points_m is None:
            return
        if len(self.points_m) < 2:
            raise self.unexpected("points_m", "two points or more")
        for number, (before, after) in enumerate(pairwise(self.points_m), start=2):
            if math.dist(before, after) < SHORTEST_LENGTH_M:
                raise ScenarioError(
                    f"{self.table}.points_m.{number} is where the one before is: expected it {SHORTEST_LENGTH_M} m "
                    "away or more"
                )


def check_tendons(tendons: Sequence[Tendon], cuts: Sequence[TendonCut], connections: ConnectionSettings) -> None:
    """Check that cuts name tendons, and connections can be pressed."""
    if not tendons:
        if cuts:
            raise ScenarioError("tendon_cuts is given: expected none without [[tendons]]")
        return
    known = [tendon.name for tendon in tendons]
    if connections.material is None:
        raise ScenarioError("connections.material is missing: expected it with [[tendons]]")
    if not connections.is_elastic:
        raise connections.unexpected("stiffness", '"elastic" with [[tendons]]: their prestress deforms what it presses')
    for cut in cuts:
        for name in cut.tendons or ():
            if name not in known:
                raise ScenarioError(
                    f"tendon_cuts.tendons has {shown(name)}: expected names of [[tendons]], which are "
                    f"{', '.join(known)}"
                )
