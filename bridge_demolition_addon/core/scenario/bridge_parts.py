"""The parts of a bridge: deck, girders or box girder, piers, pier caps and abutments."""

from dataclasses import dataclass
from typing import ClassVar

from ..errors import ScenarioError
from ..schema import ROUNDING, SHORTEST_LENGTH_M, Table, key

_OWN_DENSITY = "Density of {}, where it is not that of the whole bridge."


@dataclass(frozen=True, slots=True, kw_only=True)
class Deck(Table):
    """The deck: a slab over all spans, or one for each. With girders or a box girder, the slab lies on top of them."""

    table: ClassVar[str] = "bridge.deck"

    width_m: float = key("Width across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    thickness_m: float = key("Thickness of the slab.", unit="m", at_least=SHORTEST_LENGTH_M)
    overhang_m: float = key(
        "Length of deck beyond the axes of the first and of the last pier.", default=0.0, unit="m", at_least=0
    )
    per_span: bool = key(
        "Whether each span has a deck, and girders, of its own, which end at the pier axes.", default=False
    )
    joint_gap_m: float = key(
        "Clear gap along the road between the decks of two spans; with 0 they touch and are connected. Needs "
        "`per_span`.",
        default=0.0,
        unit="m",
        at_least=0,
    )
    density_kg_m3: float | None = key(
        _OWN_DENSITY.format("the deck, box girder included"), default=None, unit="kg/m³", above=0
    )

    def _check_together(self) -> None:
        if self.joint_gap_m > 0.0 and not self.per_span:
            raise ScenarioError(
                f"bridge.deck.joint_gap_m is {self.joint_gap_m}: expected 0 where bridge.deck.per_span is false"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Girders(Table):
    """Girders: equal beams along the road under the deck's slab, spread evenly across the road."""

    table: ClassVar[str] = "bridge.girders"

    number: int = key("How many.", at_least=1, at_most=1000)
    width_m: float = key("Width of one girder across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    depth_m: float = key("Height of a girder below the slab.", unit="m", at_least=SHORTEST_LENGTH_M)
    spacing_m: float | None = key(
        "Distance from axis to axis; by default the deck's width divided by their number.",
        default=None,
        unit="m",
        at_least=SHORTEST_LENGTH_M,
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the girders"), default=None, unit="kg/m³", above=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class BoxGirder(Table):
    """A box girder: hollow cells under the deck's slab, open at the ends of the deck, of one piece with the slab."""

    table: ClassVar[str] = "bridge.box_girder"

    width_m: float = key("Width of the box across the road, over its outer webs.", unit="m", at_least=SHORTEST_LENGTH_M)
    depth_m: float = key("Height below the deck's slab, bottom slab included.", unit="m", at_least=SHORTEST_LENGTH_M)
    web_thickness_m: float = key("Thickness of every web.", unit="m", at_least=SHORTEST_LENGTH_M)
    bottom_thickness_m: float = key("Thickness of the bottom slab.", unit="m", at_least=SHORTEST_LENGTH_M)
    cells: int = key("Hollow cells side by side, with a web between each two.", default=1, at_least=1, at_most=100)

    @property
    def cell_width_m(self) -> float:
        """Clear width of one cell, m."""
        return (self.width_m - (self.cells + 1) * self.web_thickness_m) / self.cells

    def _check_together(self) -> None:
        webs = (self.cells + 1) * self.web_thickness_m
        if webs >= self.width_m * (1.0 - ROUNDING):
            raise ScenarioError(
                f"bridge.box_girder.web_thickness_m is {self.web_thickness_m}: expected {self.cells + 1} webs that "
                f"leave room for cells in bridge.box_girder.width_m, {self.width_m} (m)"
            )
        if self.bottom_thickness_m >= self.depth_m * (1.0 - ROUNDING):
            raise ScenarioError(
                f"bridge.box_girder.bottom_thickness_m is {self.bottom_thickness_m}: expected less than "
                f"bridge.box_girder.depth_m, {self.depth_m} (m)"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Piers(Table):
    """The piers: one under each end of each span, on the ground, of equal columns or a wall. Abutments take the place
    of the first and the last pier; a bridge of one span between abutments has none."""

    table: ClassVar[str] = "bridge.piers"

    kind: str = key(
        "Columns, or one wall across the road. The keys of a column give the size of the wall.",
        default="columns",
        choices=("columns", "wall"),
    )
    columns: int = key("Columns of one pier, spread evenly across the road.", default=1, at_least=1, at_most=1000)
    column_length_m: float = key("Size of a column along the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    column_width_m: float = key("Size of a column across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float = key("Height of a column above the ground.", unit="m", at_least=SHORTEST_LENGTH_M)
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the piers"), default=None, unit="kg/m³", above=0)

    def _check_together(self) -> None:
        if self.kind == "wall" and self.columns != 1:
            raise ScenarioError(f'bridge.piers.columns is {self.columns}: expected 1 with bridge.piers.kind "wall"')


@dataclass(frozen=True, slots=True, kw_only=True)
class PierCaps(Table):
    """The pier caps: one beam on the columns of each pier. Without them the deck lies on the columns."""

    table: ClassVar[str] = "bridge.pier_caps"

    length_m: float = key("Size along the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    width_m: float = key("Size across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float = key("Height of the beam.", unit="m", at_least=SHORTEST_LENGTH_M)
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the pier caps"), default=None, unit="kg/m³", above=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Abutments(Table):
    """The abutments: a block on the ground under either end of the bridge, in place of the first and the last pier,
    as high as the deck's underside."""

    table: ClassVar[str] = "bridge.abutments"

    length_m: float = key(
        "Size along the road, half of it to either side of the axis that the span is measured from.",
        unit="m",
        at_least=SHORTEST_LENGTH_M,
    )
    width_m: float = key("Size across the road.", unit="m", at_least=SHORTEST_LENGTH_M)
    height_m: float | None = key(
        "Height above the ground. Needed where there are no piers, that is with one span. Elsewhere it follows from "
        "the piers: leave it out.",
        default=None,
        unit="m",
        at_least=SHORTEST_LENGTH_M,
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the abutments"), default=None, unit="kg/m³", above=0)
