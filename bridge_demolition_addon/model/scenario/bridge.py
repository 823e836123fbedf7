"""The bridge: its parts, its spans and what it weighs."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import ClassVar

from ...engineering.arithmetic import cosine, sine
from ..schema import DENSITY, SIZE, Table, given, key
from .alignment import Alignment
from .arch import Arch, RigidFrame
from .bearings import BearingOfBridge
from .bridge_checks import check_bridge
from .bridge_parts import Abutments, BoxGirder, BridgeBearings, Deck, Girders, OtherPiers, PierCaps, Piers, Voids
from .half_joints import BEHIND, HalfJoint, pinned_supports
from .haunches import Haunches
from .reinforcement import BridgeReinforcement

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
    alignment: Alignment | None = None
    deck: Deck
    girders: Girders | None = None
    box_girder: BoxGirder | None = None
    voids: Voids | None = None
    haunches: Haunches | None = None
    half_joints: tuple[HalfJoint, ...] = ()
    piers: Piers | None = None
    other_piers: tuple[OtherPiers, ...] = ()
    pier_caps: PierCaps | None = None
    abutments: Abutments | None = None
    arch: Arch | None = None
    frame: RigidFrame | None = None
    bearings: BridgeBearings | None = None
    reinforcement: BridgeReinforcement | None = None

    @property
    def lightened(self) -> "Bridge":
        """Return the bridge with the voids of its slab in the density of its deck."""
        if self.voids is None or self.density_kg_m3 is None:
            return self
        return replace(self, deck=self.voids.lightened(self.deck, self.density_kg_m3), voids=None)

    @property
    def bearing_tables(self) -> tuple[BearingOfBridge, ...]:
        """Return the bearings between each deck, or its girders, and its supports, in their order along the road."""
        if self.bearings is None:
            return ()
        above, supports = "girder" if self.girders else "deck", self._support_names()
        if self.frame:
            return tuple(self.bearings.between(above, below, is_pinned=False) for below in (supports[0], supports[-1]))
        if not self.deck.per_span or len(self.span_lengths_m) == 1:
            axes = list(accumulate(self.span_lengths_m, initial=0.0))
            pinned = pinned_supports(self.half_joints, axes, (self.bearings.pinned_at or 1) - 1)
            return (
                *(
                    self.bearings.between(above, below, is_pinned=number in pinned)
                    for number, below in enumerate(supports)
                ),
                *self._bearings_of_half_joints(axes, self.bearings),
            )
        above = "girder *" if self.girders else "deck"
        return tuple(
            self.bearings.between(f"span {span} {above}", supports[span - 1 + end], is_pinned=end == 0)
            for span in range(1, len(self.span_lengths_m) + 1)
            for end in (0, 1)
        )

    def _bearings_of_half_joints(self, axes: list[float], bearings: BridgeBearings) -> Iterator[BearingOfBridge]:
        ordered = sorted(self.half_joints, key=lambda joint: joint.position_m(axes))
        kinds = [f"girder {number}" for number in range(1, self.girders.number + 1)] if self.girders else ["deck"]
        for number, joint in enumerate(ordered, start=1):
            above, below = (number + 1, number) if joint.carried == BEHIND else (number, number + 1)
            for kind in kinds:
                yield bearings.between(f"part {above} {kind}", f"part {below} {kind}", is_pinned=joint.pinned)

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
        return f"pier {number}" if self.piers_of(number).columns == 1 else f"pier {number} column *"

    def piers_of(self, number: int) -> Piers:
        """Return what a pier is like, by its number."""
        others = (table.of(given(self.piers)) for table in self.other_piers if number in table.piers)
        return next(others, given(self.piers))

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

    def columns_half_width_m(self, piers: Piers) -> float:
        """Return how far across the road the outer faces of the outermost columns are from its middle."""
        return 0.5 * (self.carried_width_m * (1.0 - 1.0 / piers.columns) + piers.column_width_m)

    def _check_together(self) -> None:
        check_bridge(self)
