"""The bridge: spans, deck, piers and pier caps."""

import math
from dataclasses import dataclass
from typing import ClassVar

from ..errors import ScenarioError
from .key import ROUNDING, SHORTEST_LENGTH_M, Table, check_exactly_one, key


@dataclass(frozen=True, slots=True, kw_only=True)
class Deck(Table):
    """The deck: one slab over all spans."""

    table: ClassVar[str] = "bridge.deck"

    width_m: float = key("Width across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    thickness_m: float = key("Thickness of the slab.", unit="m", at_least=SHORTEST_LENGTH_M)
    overhang_m: float = key(
        "Length of deck beyond the axes of the first and of the last pier.", default=0.0, unit="m", at_least=0
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Piers(Table):
    """The piers: one under each end of each span, made of equal columns that stand on the ground."""

    table: ClassVar[str] = "bridge.piers"

    columns: int = key("Columns of one pier, spread evenly across the road.", default=1, at_least=1, at_most=1000)
    column_length_m: float = key("Size of a column along the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    column_width_m: float = key("Size of a column across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float = key("Height of a column above the ground.", unit="m", at_least=SHORTEST_LENGTH_M)


@dataclass(frozen=True, slots=True, kw_only=True)
class PierCaps(Table):
    """The pier caps: one beam on the columns of each pier. Without them the deck lies on the columns."""

    table: ClassVar[str] = "bridge.pier_caps"

    length_m: float = key("Size along the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    width_m: float = key("Size across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float = key("Height of the beam.", unit="m", at_least=SHORTEST_LENGTH_M)


@dataclass(frozen=True, slots=True, kw_only=True)
class Bridge(Table):
    """The bridge: spans between piers, and exactly one of density and total mass."""

    table: ClassVar[str] = "bridge"

    span_lengths_m: tuple[float, ...] = key(
        "Lengths of the spans, in their order along the road, each from pier axis to pier axis.",
        unit="m",
        at_least=SHORTEST_LENGTH_M,
    )
    density_kg_m3: float | None = key(
        "Density of the whole bridge. Give this or `mass_kg`.", default=None, unit="kg/m³", above=0
    )
    mass_kg: float | None = key(
        "Mass of the whole bridge, from which one density follows. Give this or `density_kg_m3`.",
        default=None,
        unit="kg",
        above=0,
    )
    deck: Deck
    piers: Piers
    pier_caps: PierCaps | None = None

    @property
    def spans_m(self) -> float:
        """Distance from the axis of the first pier to the axis of the last, m."""
        return math.fsum(self.span_lengths_m)

    @property
    def length_m(self) -> float:
        """Length of the deck, m."""
        return self.spans_m + 2.0 * self.deck.overhang_m

    def _check_together(self) -> None:
        check_exactly_one(self, "density_kg_m3", "mass_kg")
        self._check_room_along()
        self._check_room_across()

    def _check_room_along(self) -> None:
        shortest = min(self.span_lengths_m)
        lengths = {"bridge.piers.column_length_m": self.piers.column_length_m}
        if self.pier_caps:
            lengths["bridge.pier_caps.length_m"] = self.pier_caps.length_m
        for name, length in lengths.items():
            if length >= shortest:
                raise ScenarioError(f"{name} is {length}: expected less than the shortest span, {shortest} (m)")

    def _check_room_across(self) -> None:
        carried = self.pier_caps or self.deck
        widest = carried.width_m / self.piers.columns
        if self.piers.column_width_m > widest * (1.0 + ROUNDING):
            raise ScenarioError(
                f"bridge.piers.column_width_m is {self.piers.column_width_m}: expected at most {widest:.6g} (m), "
                f"so that the columns fit into {carried.table}.width_m"
            )
