"""Foundations: the soil under members, as a scenario gives it."""

from dataclasses import dataclass
from typing import ClassVar

from ..engineering.foundations import HORIZONTAL_SHARE, SOILS, Soil
from .schema import SIZE, Table, given, key

_NEWTON_PER_MEGANEWTON = 1e6
_PASCAL_PER_KILOPASCAL = 1e3


@dataclass(frozen=True, slots=True, kw_only=True)
class Foundation(Table):
    """Soil that deforms under the shards of a member that stand on the ground: a bed of springs, which do not pull,
    resist up to a pressure and settle for good beyond it, and slide where friction ends. It needs
    `connections.stiffness` `elastic`."""

    table: ClassVar[str] = "foundations"

    member: str = key("Name of a member, or a kind, such as `pier`: what of it stands on the ground.")
    soil: str | None = key(
        "Class of soil, by which the values count that are not given here. Give this, or both `stiffness_mn_m3` and "
        "`friction`.",
        default=None,
        choices=tuple(SOILS),
    )
    stiffness_mn_m3: float | None = key(
        "Pressure under a footing by its settlement (modulus of subgrade reaction).",
        default=None,
        unit="MN/m³",
        at_least=0.1,
        at_most=1e5,
    )
    capacity_kpa: float | None = key(
        "Pressure at which it settles for good; by default that of the class, or none.",
        default=None,
        unit="kPa",
        above=0,
    )
    friction: float | None = key(
        "Coefficient of friction between footing and soil; by default that of the class.", default=None, at_least=0
    )
    horizontal_share: float = key(
        "Horizontal stiffness over vertical stiffness.", default=HORIZONTAL_SHARE, above=0, at_most=10
    )
    footing_m: tuple[float, float] | None = key(
        "Length along the road and width across it of the footing under each member, where that is larger than what "
        "stands on the ground.",
        default=None,
        **SIZE,
    )

    @property
    def ground(self) -> Soil:
        """Stiffness and friction."""
        of_class = SOILS[self.soil] if self.soil else None
        stiffness = None if self.stiffness_mn_m3 is None else _NEWTON_PER_MEGANEWTON * self.stiffness_mn_m3
        return Soil(
            given(of_class).stiffness_n_m3 if stiffness is None else stiffness,
            given(of_class).friction if self.friction is None else self.friction,
        )

    @property
    def capacity_pa(self) -> float:
        """Pressure at which it settles for good; infinite where there is none."""
        if self.capacity_kpa is not None:
            return _PASCAL_PER_KILOPASCAL * self.capacity_kpa
        return float("inf") if self.soil is None else SOILS[self.soil].capacity_pa

    def _check_together(self) -> None:
        for name in ("stiffness_mn_m3", "friction"):
            if self.soil is None and getattr(self, name) is None:
                raise self.unexpected(name, f"a number, or a {self.table}.soil")
