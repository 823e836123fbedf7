"""The parts of a bridge: deck, girders, piers, abutments and bearings."""

import math
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar

from ..schema import DENSITY, FARTHEST_M, ROUNDING, SIZE, Table, key
from .bearings import PINNED, ROCKER, SLIDING, BearingOfBridge

_OWN_DENSITY = "Density of {}, where it is not that of the whole bridge."

PIER_KINDS = ("columns", "round columns", "wall")
_KIND = (
    "Columns of rectangular section, round ones, or one wall across the road. The keys of a column give the size of "
    "the wall; both sizes of a round one are its diameter."
)
_COLUMNS = "Columns of one pier, spread evenly across the road."
_COUNT: dict[str, Any] = {"at_least": 1, "at_most": 1000}
_LENGTH = "Size of a column along the road."
_WIDTH = "Size of a column across the road."
_BATTER = (
    "By how much the two faces of a wall or column that look along the road lean, in percent of the height: 5 is 1 to "
    "20. Sizes are those at the top."
)
_SLOPE: dict[str, Any] = {"unit": "%", "at_least": 0, "at_most": 50}
_FEET = (
    "Distance across the road between the axes of the outermost columns at their feet, where it is not that at their "
    "tops: less for a V, more for legs that spread."
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Deck(Table):
    """The deck: a slab over all spans, or one for each. With girders or a box girder, the slab lies on top of them."""

    table: ClassVar[str] = "bridge.deck"

    width_m: float = key("Width across the road.", **SIZE)
    thickness_m: float = key("Thickness of the slab.", **SIZE)
    overhang_m: float = key(
        "Length of deck beyond the axes of the first and of the last pier.",
        default=0.0,
        unit="m",
        at_least=0,
        at_most=FARTHEST_M,
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
        at_most=FARTHEST_M,
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the deck, box girder included"), **DENSITY)

    def _check_together(self) -> None:
        if self.joint_gap_m > 0.0 and not self.per_span:
            raise self.unexpected("joint_gap_m", "0 where bridge.deck.per_span is false")


@dataclass(frozen=True, slots=True, kw_only=True)
class Girders(Table):
    """Girders: equal beams along the road under the deck's slab, spread evenly across the road."""

    table: ClassVar[str] = "bridge.girders"

    number: int = key("How many.", at_least=1, at_most=1000)
    width_m: float = key("Width of one girder across the road.", **SIZE)
    depth_m: float = key("Height of a girder below the slab.", **SIZE)
    spacing_m: float | None = key(
        "Distance from axis to axis; by default the deck's width divided by their number.", default=None, **SIZE
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the girders"), **DENSITY)


@dataclass(frozen=True, slots=True, kw_only=True)
class BoxGirder(Table):
    """A box girder: hollow cells under the deck's slab, open at the ends of the deck, of one piece with the slab."""

    table: ClassVar[str] = "bridge.box_girder"

    width_m: float = key("Width of the box across the road, over its outer webs.", **SIZE)
    depth_m: float = key("Height below the deck's slab, bottom slab included.", **SIZE)
    web_thickness_m: float = key("Thickness of every web.", **SIZE)
    bottom_thickness_m: float = key("Thickness of the bottom slab.", **SIZE)
    cells: int = key("Hollow cells side by side, with a web between each two.", default=1, at_least=1, at_most=100)

    @property
    def cell_width_m(self) -> float:
        """Return the clear width of one cell."""
        return (self.width_m - (self.cells + 1) * self.web_thickness_m) / self.cells

    def _check_together(self) -> None:
        webs = (self.cells + 1) * self.web_thickness_m
        if webs >= self.width_m * (1.0 - ROUNDING):
            room = f"room for cells in bridge.box_girder.width_m, {self.width_m} (m)"
            raise self.unexpected("web_thickness_m", f"{self.cells + 1} webs that leave {room}")
        if self.bottom_thickness_m >= self.depth_m * (1.0 - ROUNDING):
            raise self.unexpected("bottom_thickness_m", f"less than bridge.box_girder.depth_m, {self.depth_m} (m)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Voids(Table):
    """Voids of a slab: equal tubes along all of it, spread evenly across the road. They make it lighter; stiffness and
    strength are those of the solid slab, whose second moment of area is larger by 5 to 15 %."""

    table: ClassVar[str] = "bridge.voids"

    number: int = key("How many.", at_least=1, at_most=100)
    diameter_m: float = key("Diameter of a tube.", **SIZE)

    def lightened(self, deck: Deck, density_kg_m3: float) -> Deck:
        """Return a deck with the mean density of its concrete and its voids."""
        hollow_m2 = 0.25 * math.pi * self.number * self.diameter_m * self.diameter_m
        solid = 1.0 - hollow_m2 / (deck.width_m * deck.thickness_m)
        return replace(deck, density_kg_m3=solid * (deck.density_kg_m3 or density_kg_m3))

    def check_in(self, deck: Deck) -> None:
        """Check that the tubes have room in a deck.

        Raises
        ------
        ScenarioError
            They come out of it, or cut each other.
        """
        if self.diameter_m >= deck.thickness_m * (1.0 - ROUNDING):
            raise self.unexpected("diameter_m", f"less than bridge.deck.thickness_m, {deck.thickness_m:g} (m)")
        if self.number * self.diameter_m >= deck.width_m * (1.0 - ROUNDING):
            over_all = f"{self.number} tubes of {self.diameter_m:g} m take {self.number * self.diameter_m:g} m"
            room = f"bridge.deck.width_m, {deck.width_m:g} (m)"
            raise self.unexpected("number", f"tubes that leave concrete between them in {room}; {over_all}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Piers(Table):
    """The piers: one under each end of each span, on the ground, of equal columns or a wall. Abutments take the place
    of the first and the last pier; a bridge of one span between abutments has none."""

    table: ClassVar[str] = "bridge.piers"

    kind: str = key(_KIND, default="columns", choices=PIER_KINDS)
    columns: int = key(_COLUMNS, default=1, **_COUNT)
    column_length_m: float = key(_LENGTH, **SIZE)
    column_width_m: float = key(_WIDTH, **SIZE)
    height_m: float = key(
        "Height of a column above the ground; where that is not flat, of its top above height 0.", **SIZE
    )
    batter_percent: float = key(_BATTER, default=0.0, **_SLOPE)
    feet_apart_m: float | None = key(_FEET, default=None, **SIZE)
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the piers"), **DENSITY)

    @property
    def is_wall(self) -> bool:
        """Whether each is one wall, which skew shears, and not columns, which it turns."""
        return self.kind == "wall"

    @property
    def is_round(self) -> bool:
        return self.kind == "round columns"

    def _check_together(self) -> None:
        if self.is_wall and self.columns != 1:
            raise self.unexpected("columns", '1 with bridge.piers.kind "wall"')
        if self.is_round and abs(self.column_width_m - self.column_length_m) > ROUNDING * self.column_length_m:
            same = f"{self.column_length_m:g} (m) as bridge.piers.column_length_m"
            raise self.unexpected("column_width_m", f"{same}: both are the diameter of round columns")
        if self.is_round and self.batter_percent:
            raise self.unexpected("batter_percent", "0 with round columns")
        self._check_feet()

    def foot_length_m(self) -> float:
        """Return the size of a column along the road at a foot as far down as the height says."""
        return self.column_length_m + 0.02 * self.batter_percent * self.height_m

    def _check_feet(self) -> None:
        if self.feet_apart_m is None:
            return
        if self.columns == 1:
            raise self.unexpected("feet_apart_m", f"none with {self.table}.columns = 1")
        least = (self.columns - 1) * self.column_width_m
        if self.feet_apart_m < least * (1.0 - ROUNDING):
            raise self.unexpected("feet_apart_m", f"at least {least:g} (m), so that feet of columns do not overlap")


@dataclass(frozen=True, slots=True, kw_only=True)
class _OtherKindOfPiers(Piers):
    """Piers with what is their own; messages name the table that says it."""

    table: ClassVar[str] = "bridge.other_piers"


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherPiers(Table):
    """Piers that differ from the others: what is left out is as in `[bridge.piers]`."""

    table: ClassVar[str] = "bridge.other_piers"

    piers: tuple[int, ...] = key("Which piers, by the numbers that `bda check` lists.", at_least=1)
    kind: str | None = key(_KIND, default=None, choices=PIER_KINDS)
    columns: int | None = key(_COLUMNS, default=None, **_COUNT)
    column_length_m: float | None = key(_LENGTH, default=None, **SIZE)
    column_width_m: float | None = key(_WIDTH, default=None, **SIZE)
    batter_percent: float | None = key(_BATTER, default=None, **_SLOPE)
    feet_apart_m: float | None = key(_FEET, default=None, **SIZE)

    def of(self, piers: Piers) -> Piers:
        """Return the other piers with what these have of their own."""
        held = {item.name: getattr(piers, item.name) for item in fields(piers)}
        own = {item.name: getattr(self, item.name) for item in fields(self) if item.name in held}
        return _OtherKindOfPiers(**held | {name: value for name, value in own.items() if value is not None})


@dataclass(frozen=True, slots=True, kw_only=True)
class PierCaps(Table):
    """The pier caps: one beam on the columns of each pier. Without them the deck lies on the columns."""

    table: ClassVar[str] = "bridge.pier_caps"

    length_m: float = key("Size along the road.", **SIZE)
    width_m: float = key("Size across the road.", **SIZE)
    height_m: float = key("Height of the beam.", **SIZE)
    end_height_m: float | None = key(
        "Height at either end across the road of a hammerhead, whose underside rises from the outer faces of the "
        "outermost columns; by default the beam is as high everywhere.",
        default=None,
        **SIZE,
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the pier caps"), **DENSITY)

    def _check_together(self) -> None:
        if self.end_height_m is not None and self.end_height_m > self.height_m * (1.0 + ROUNDING):
            raise self.unexpected("end_height_m", f"at most bridge.pier_caps.height_m, {self.height_m:g} (m)")


@dataclass(frozen=True, slots=True, kw_only=True)
class Abutments(Table):
    """The abutments: a block on the ground under either end of the bridge, in place of the first and the last pier,
    as high as the deck's underside."""

    table: ClassVar[str] = "bridge.abutments"

    length_m: float = key(
        "Size along the road, half of it to either side of the axis that the span is measured from.", **SIZE
    )
    width_m: float = key("Size across the road.", **SIZE)
    height_m: float | None = key(
        "Height above the ground. Needed where there are no piers, that is with one span. Elsewhere it follows from "
        "the piers: leave it out.",
        default=None,
        **SIZE,
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the abutments"), **DENSITY)


@dataclass(frozen=True, slots=True, kw_only=True)
class BridgeBearings(Table):
    """The bearings: one between whatever lies on a pier cap, column, wall or abutment and that, at the axis of each.
    `[[bearings]]` come before these, for those that differ."""

    table: ClassVar[str] = "bridge.bearings"

    pinned_at: int | None = key(
        "Number of the support, from 1 at the first end, whose bearings are `pinned`; those of all others move along "
        "the road. By default the first; with `deck.per_span` each deck has pinned ones at its own first end.",
        default=None,
        at_least=1,
    )
    friction: float | None = key(
        "Coefficient of friction of those that move: they are `sliding` with it, and `rocker` without it.",
        default=None,
        at_least=0,
        at_most=10,
    )
    pads: int | None = key(
        "Number of pads in a row across the road, under the deck or under each girder; without it each bearing is one "
        "line.",
        default=None,
        at_least=1,
        at_most=100,
    )
    tension: bool = key("Whether they hold what is lifted; otherwise that lifts off.", default=False)

    def between(self, above: str, below: str, *, is_pinned: bool) -> BearingOfBridge:
        """Return the bearing between members, by their names or kinds."""
        kind = PINNED if is_pinned else ROCKER if self.friction is None else SLIDING
        friction = self.friction if kind == SLIDING else None
        return BearingOfBridge(
            members=(above, below), kind=kind, friction=friction, pads=self.pads, tension=self.tension
        )
