"""The bridge: its parts, its spans and what it weighs."""

import math
from dataclasses import dataclass
from itertools import accumulate
from typing import ClassVar

from ...engineering.arithmetic import cosine, sine
from ...engineering.geometry.arches import ArchAxis
from ...errors import ScenarioError
from ..schema import DENSITY, FARTHEST_M, ROUNDING, SIZE, Table, check_exactly_one, given, key
from .arch import Arch
from .bearings import PINNED, ROCKER, SLIDING, BearingOfBridge
from .frame import RigidFrame
from .reinforcement import BridgeReinforcement

_OWN_DENSITY = "Density of {}, where it is not that of the whole bridge."


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
    column_length_m: float = key("Size of a column along the road.", **SIZE)
    column_width_m: float = key("Size of a column across the road.", **SIZE)
    height_m: float = key(
        "Height of a column above the ground; where that is not flat, of its top above height 0.", **SIZE
    )
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the piers"), **DENSITY)

    def _check_together(self) -> None:
        if self.kind == "wall" and self.columns != 1:
            raise self.unexpected("columns", '1 with bridge.piers.kind "wall"')


@dataclass(frozen=True, slots=True, kw_only=True)
class PierCaps(Table):
    """The pier caps: one beam on the columns of each pier. Without them the deck lies on the columns."""

    table: ClassVar[str] = "bridge.pier_caps"

    length_m: float = key("Size along the road.", **SIZE)
    width_m: float = key("Size across the road.", **SIZE)
    height_m: float = key("Height of the beam.", **SIZE)
    density_kg_m3: float | None = key(_OWN_DENSITY.format("the pier caps"), **DENSITY)


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


LARGEST_SKEW_DEG = 75.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Bridge(Table):
    """The bridge: spans between piers, and exactly one of density and total mass."""

    table: ClassVar[str] = "bridge"

    span_lengths_m: tuple[float, ...] = key(
        "Lengths of the spans, in their order along the road, each from pier axis to pier axis.", **SIZE
    )
    density_kg_m3: float | None = key(
        "Density of all members that have none of their own. Give this or `mass_kg`, or neither where the material of "
        "your own that `connections.material` names has a density.",
        **DENSITY,
    )
    mass_kg: float | None = key(
        "Mass of the whole bridge, from which one density follows for all members that have none of their own. Give "
        "this or `density_kg_m3`.",
        default=None,
        unit="kg",
        above=0,
    )
    skew_deg: float = key(
        "Angle by which the axes of piers and abutments and the ends of the deck are turned about the vertical, away "
        "from square to the road; above 0 their left ends, towards positive y, lie further along the road. Sizes "
        "along and across the road stay what they are; only columns are turned with their axis.",
        default=0.0,
        unit="°",
        at_least=-LARGEST_SKEW_DEG,
        at_most=LARGEST_SKEW_DEG,
    )
    merge: bool = key(
        "Whether all members are one solid, cut as a whole, instead of members that are connected where they touch.",
        default=False,
        label="Merge Touching Members",
    )
    deck: Deck
    girders: Girders | None = None
    box_girder: BoxGirder | None = None
    piers: Piers | None = None
    pier_caps: PierCaps | None = None
    abutments: Abutments | None = None
    arch: Arch | None = None
    frame: RigidFrame | None = None
    bearings: BridgeBearings | None = None
    reinforcement: BridgeReinforcement | None = None

    @property
    def bearing_tables(self) -> tuple[BearingOfBridge, ...]:
        """Return the bearings between each deck, or its girders, and its supports, in their order along the road."""
        if self.bearings is None:
            return ()
        above, supports = "girder" if self.girders else "deck", self._support_names()
        if self.frame:
            return tuple(self.bearings.between(above, below, is_pinned=False) for below in (supports[0], supports[-1]))
        if not self.deck.per_span or len(self.span_lengths_m) == 1:
            pinned = (self.bearings.pinned_at or 1) - 1
            return tuple(
                self.bearings.between(above, below, is_pinned=number == pinned) for number, below in enumerate(supports)
            )
        above = "girder *" if self.girders else "deck"
        return tuple(
            self.bearings.between(f"span {span} {above}", supports[span - 1 + end], is_pinned=end == 0)
            for span in range(1, len(self.span_lengths_m) + 1)
            for end in (0, 1)
        )

    def _support_names(self) -> list[str]:
        """Names of what carries the deck at each axis, from the first end on."""
        count = len(self.span_lengths_m) + 1
        if self.abutments:
            return ["abutment 1", *(self._pier_name(number) for number in range(1, count - 1)), "abutment 2"]
        return [self._pier_name(number) for number in range(1, count + 1)]

    def _pier_name(self, number: int) -> str:
        if self.frame:
            return f"leg {number}"
        if self.pier_caps:
            return f"pier {number} cap"
        return f"pier {number}" if given(self.piers).columns == 1 else f"pier {number} column *"

    @property
    def spans_m(self) -> float:
        """Return the distance from the axis of the first pier to the axis of the last."""
        return math.fsum(self.span_lengths_m)

    @property
    def length_m(self) -> float:
        return self.spans_m + 2.0 * self.deck.overhang_m

    @property
    def shift_across(self) -> float:
        """Return how far along the road a skewed axis moves for each metre across it."""
        skew = math.radians(self.skew_deg)
        return float(sine(skew) / cosine(skew))

    @property
    def girder_spacing_m(self) -> float:
        girders = given(self.girders)
        return girders.spacing_m or self.deck.width_m / girders.number

    @property
    def carried_width_m(self) -> float:
        """Return the width of what lies on the columns, over which they are spread."""
        if self.pier_caps:
            return self.pier_caps.width_m
        if self.box_girder:
            return self.box_girder.width_m
        return self.girders.number * self.girder_spacing_m if self.girders else self.deck.width_m

    def _check_together(self) -> None:
        if self.density_kg_m3 is not None and self.mass_kg is not None:
            check_exactly_one(self, "density_kg_m3", "mass_kg")
        if self.spans_m > FARTHEST_M:
            raise ScenarioError(
                f"bridge.span_lengths_m add up to {self.spans_m:g}: expected at most {FARTHEST_M:g} (m)"
            )
        self._check_parts()
        self._check_superstructure()
        self._check_room_along()
        self._check_joints()
        if self.piers:
            self._check_room_across(self.piers)
        if self.merge:
            self._check_one_density()
        if self.arch:
            _check_arch(self, self.arch)
        if self.frame:
            _check_frame(self, self.frame)
        if self.bearings:
            self._check_bearings(self.bearings)
        if self.reinforcement:
            self._check_reinforcement(self.reinforcement)

    def _check_reinforcement(self, reinforcement: BridgeReinforcement) -> None:
        if self.merge and reinforcement.has_bars:
            raise ScenarioError(
                "bridge.reinforcement is given: expected none with bridge.merge, where no member is left"
            )
        reinforcement.check_deck(self.deck.width_m)
        reinforcement.check_ratios(self.arch.names if self.arch else ())
        if self.frame:
            reinforcement.check_frame()

    def _check_bearings(self, bearings: BridgeBearings) -> None:
        if self.merge:
            raise ScenarioError("bridge.bearings is given: expected none with bridge.merge, where no member is left")
        supports, spans = len(self.span_lengths_m) + 1, len(self.span_lengths_m)
        if self.frame and self.abutments is None:
            raise ScenarioError("bridge.bearings is given: expected none with bridge.frame without abutments")
        if bearings.pinned_at is None:
            return
        if self.frame:
            raise bearings.unexpected("pinned_at", "none with bridge.frame, whose legs hold the deck along the road")
        if self.deck.per_span and spans > 1:
            raise bearings.unexpected(
                "pinned_at", "none with bridge.deck.per_span: each deck is pinned at its first end"
            )
        if bearings.pinned_at > supports:
            raise bearings.unexpected("pinned_at", f"at most {supports}, the number of supports of the bridge")

    def _check_parts(self) -> None:
        if self.girders and self.box_girder:
            raise ScenarioError("bridge.girders and bridge.box_girder are given together: expected at most one")
        between_abutments = self.abutments is not None and len(self.span_lengths_m) == 1
        if self.frame:
            between_abutments = False
        elif not between_abutments and self.piers is None:
            raise ScenarioError("bridge.piers is missing: expected a table")
        for name in ("piers", "pier_caps"):
            if between_abutments and getattr(self, name):
                raise ScenarioError(
                    f"bridge.{name} is given: expected none with bridge.abutments and one span, which has no piers"
                )
        if self.abutments and between_abutments != (self.abutments.height_m is not None):
            carrying = "bridge.frame" if self.frame else "piers"
            wanted = "a number (m) with one span" if between_abutments else f"none with {carrying}, which give it"
            raise self.abutments.unexpected("height_m", wanted)

    def _check_superstructure(self) -> None:
        if self.box_girder and self.box_girder.width_m > self.deck.width_m * (1.0 + ROUNDING):
            raise self.box_girder.unexpected("width_m", f"at most bridge.deck.width_m, {self.deck.width_m} (m)")
        if not self.girders:
            return
        spacing, width = self.girder_spacing_m, self.girders.width_m
        if self.girders.number > 1 and width > spacing * (1.0 + ROUNDING):
            wanted = f"at most their spacing, {spacing:.6g} (m), so that girders do not overlap"
            raise self.girders.unexpected("width_m", wanted)
        over_all = (self.girders.number - 1) * spacing + width
        if over_all > self.deck.width_m * (1.0 + ROUNDING):
            room = f"bridge.deck.width_m, {self.deck.width_m} (m)"
            raise self.girders.unexpected(
                "number", f"girders that fit under {room}, found {over_all:.6g} over all of them"
            )

    @property
    def _column_turn(self) -> float:
        """Return a column's length along the road over the room it takes there once it is turned."""
        return float(cosine(math.radians(self.skew_deg))) if given(self.piers).kind == "columns" else 1.0

    def _check_room_along(self) -> None:
        shortest = min(self.span_lengths_m)
        supports: list[tuple[Table, str, float]] = []
        if self.piers:
            supports.append((self.piers, "column_length_m", self._column_turn))
        if self.pier_caps:
            supports.append((self.pier_caps, "length_m", 1.0))
        for part, name, turn in supports:
            if getattr(part, name) >= shortest * turn:
                limit = f"the shortest span, {shortest} (m)" if turn == 1.0 else f"{shortest * turn:.6g} (m), turned"
                raise part.unexpected(name, f"less than {limit}")
        if self.abutments:
            lengths = [getattr(part, name) / turn for part, name, turn in supports]
            self._check_room_beside_abutments(self.abutments, max(lengths, default=self.abutments.length_m))

    def _check_room_beside_abutments(self, abutments: Abutments, next_length: float) -> None:
        shortest = min(self.span_lengths_m[0], self.span_lengths_m[-1])
        if (abutments.length_m + next_length) / 2.0 >= shortest:
            wanted = f"less, so that the abutments do not overlap the next support in a span of {shortest} (m)"
            raise abutments.unexpected("length_m", wanted)

    def _check_joints(self) -> None:
        """Check that both decks at a joint lie on the pier under it."""
        if self.deck.joint_gap_m <= 0.0 or len(self.span_lengths_m) == 1:
            return
        support = self.pier_caps.length_m if self.pier_caps else given(self.piers).column_length_m
        if self.deck.joint_gap_m >= support:
            wanted = f"less than {support} (m), the length of the pier or pier cap that carries both decks"
            raise self.deck.unexpected("joint_gap_m", wanted)

    def _check_room_across(self, piers: Piers) -> None:
        carried = self.pier_caps or self.box_girder or self.deck
        widest = self.carried_width_m / piers.columns
        if piers.kind == "columns" and piers.column_width_m > widest * (1.0 + ROUNDING):
            wanted = f"at most {widest:.6g} (m), so that the columns fit into {carried.table}.width_m"
            raise piers.unexpected("column_width_m", wanted)
        if self.girders and not self.pier_caps:
            self._check_columns_under_girders(piers, self.girders, widest)

    def _check_columns_under_girders(self, piers: Piers, girders: Girders, column_spacing: float) -> None:
        """Check that no column, without pier caps, stands between two girders and carries nothing."""
        columns, number = piers.columns, girders.number
        reach = (piers.column_width_m + girders.width_m) / 2.0
        for column in range(columns):
            position = (column - (columns - 1) / 2.0) * column_spacing
            apart = [abs(position - (girder - (number - 1) / 2.0) * self.girder_spacing_m) for girder in range(number)]
            if min(apart) >= reach * (1.0 - ROUNDING):
                wanted = f"as many as bridge.girders.number, {number}, or bridge.pier_caps"
                raise piers.unexpected(
                    "columns", f"{wanted}, as a column stands between two girders and carries nothing"
                )

    def _check_one_density(self) -> None:
        for part in (self.deck, self.girders, self.piers, self.pier_caps, self.abutments):
            if part and part.density_kg_m3 is not None:
                raise part.unexpected("density_kg_m3", "none where bridge.merge is true, as one solid has one density")


def axes_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the axes of all supports, in the middle of the road."""
    return list(accumulate(bridge.span_lengths_m, initial=0.0))


def arch_axis(bridge: Bridge) -> ArchAxis:
    """Return the axis of the arch."""
    return given(bridge.arch).axis_between(*springing_axes_m(bridge))


def rib_axes_m(bridge: Bridge) -> list[float]:
    """Return the positions across the road of the ribs of the arch."""
    ribs = given(bridge.arch).ribs
    return [bridge.carried_width_m * ((rib + 0.5) / ribs - 0.5) for rib in range(ribs)]


def leg_axes_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the legs of the frame, where they meet the deck."""
    return axes_m(bridge)[1:-1] if bridge.abutments else axes_m(bridge)


def axes_on_arch_m(bridge: Bridge) -> list[float]:
    """Return the positions along the road of the piers that stand on the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support : arch.last_support(len(axes)) - 1]


def springing_axes_m(bridge: Bridge) -> tuple[float, float]:
    """Return the positions along the road of the piers on the thrust blocks of the arch."""
    arch, axes = given(bridge.arch), axes_m(bridge)
    return axes[arch.from_support - 1], axes[arch.last_support(len(axes)) - 1]


def _check_arch(bridge: Bridge, arch: Arch) -> None:
    if bridge.merge:
        raise ScenarioError("bridge.arch is given: expected none with bridge.merge, where no member is left")
    if bridge.skew_deg != 0.0:
        raise ScenarioError(f"bridge.skew_deg is {bridge.skew_deg:g}: expected 0 with bridge.arch")
    if len(axes_m(bridge)) < 3:
        raise ScenarioError("bridge.span_lengths_m has one span: expected two spans at least with bridge.arch")
    arch.check_supports(len(axes_m(bridge)), given(bridge.piers).columns)
    piers, axis = given(bridge.piers), arch_axis(bridge)
    arch.check_room(axis, axes_on_arch_m(bridge), piers.column_length_m, piers.height_m)
    arch.check_width(bridge.carried_width_m / piers.columns, piers.columns, piers.column_width_m)
    lengths = [piers.column_length_m]
    if bridge.abutments and set(springing_axes_m(bridge)) & {axes_m(bridge)[0], axes_m(bridge)[-1]}:
        lengths.append(bridge.abutments.length_m)
    arch.check_blocks(axis, springing_axes_m(bridge)[0], max(lengths))


def _check_frame(bridge: Bridge, frame: RigidFrame) -> None:
    for name in ("piers", "pier_caps", "girders", "box_girder", "arch"):
        if getattr(bridge, name):
            raise ScenarioError(f"bridge.{name} is given: expected none with bridge.frame, of a slab on legs")
    if bridge.deck.per_span:
        raise bridge.deck.unexpected("per_span", "false with bridge.frame, whose deck is of one piece with all legs")
    if bridge.merge:
        raise ScenarioError("bridge.frame is given: expected none with bridge.merge, where no member is left")
    if bridge.skew_deg != 0.0:
        raise ScenarioError(f"bridge.skew_deg is {bridge.skew_deg:g}: expected 0 with bridge.frame")
    if not leg_axes_m(bridge):
        raise ScenarioError(
            "bridge.abutments are given: expected none with bridge.frame and one span, or no leg is left"
        )
    ends = -bridge.deck.overhang_m, bridge.spans_m + bridge.deck.overhang_m
    frame.check_room(leg_axes_m(bridge), ends, ends_on_legs=bridge.abutments is None)
    frame.check_width(bridge.deck.width_m)
