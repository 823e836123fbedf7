"""A frame: legs that are of one piece with the deck, upright or inclined, and haunches of the deck at them."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from ..schema import DENSITY, FARTHEST_M, ROUNDING, SIZE, Table, key

_SHORTEST_LEG_M = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class RigidFrame(Table):
    """A frame of concrete: legs on the ground that are of one piece with the deck, a slab, instead of piers. There is
    one at each support, or one at each inner support with abutments. Spans are measured between the axes of legs where
    they meet the deck. Where members have bars, those of a leg go on into the deck. A frame has no skew."""

    table: ClassVar[str] = "bridge.frame"

    clear_height_m: float = key(
        "Height of the deck's underside above the ground, between haunches; where the ground is not flat, above height "
        "0.",
        **SIZE,
    )
    leg_thickness_m: float = key("Thickness of a leg, level along the road.", **SIZE)
    leg_width_m: float = key("Width of a leg across the road.", **SIZE)
    legs: int = key("Legs side by side at each support, spread evenly across the road.", default=1, at_least=1)
    lean_m: float = key(
        "How far along the road the feet of the first and of the last legs are outside of their tops. Inner legs are "
        "upright.",
        default=0.0,
        unit="m",
        at_least=0,
        at_most=FARTHEST_M,
    )
    haunch_length_m: float = key(
        "Length of the haunches of the deck, from the face of a leg.",
        default=0.0,
        unit="m",
        at_least=0,
        at_most=FARTHEST_M,
    )
    haunch_depth_m: float = key(
        "How much deeper the deck is at a leg. It falls evenly over the length of the haunch.",
        default=0.0,
        unit="m",
        at_least=0,
        at_most=FARTHEST_M,
    )
    density_kg_m3: float | None = key("Density of the legs, where it is not that of the whole bridge.", **DENSITY)

    @property
    def leg_top_m(self) -> float:
        """Height of the top of a leg above the ground, at the underside of haunches."""
        return self.clear_height_m - self.haunch_depth_m

    @property
    def is_haunched(self) -> bool:
        return self.haunch_depth_m > 0.0

    def leans_m(self, legs: int) -> list[float]:
        """Return how far along the road the foot of each leg is from its top."""
        if legs == 1:
            return [0.0]
        return [-self.lean_m, *[0.0] * (legs - 2), self.lean_m]

    def check_room(self, axes_m: Sequence[float], ends_m: tuple[float, float], *, ends_on_legs: bool) -> None:
        """Check that legs at axes stand below the deck between its ends, with haunches that do not overlap."""
        half = 0.5 * self.leg_thickness_m
        if self.lean_m and len(axes_m) == 1:
            raise self.unexpected("lean_m", "0 with one leg along the road, which is upright")
        first, last = axes_m[0] - half, axes_m[-1] + half
        short = max(ends_m[0] - first, last - ends_m[1])
        if ends_on_legs and short > ROUNDING:
            raise self.unexpected(
                "leg_thickness_m", f"at most 2 × bridge.deck.overhang_m, {2.0 * (half - short):.6g} (m), below the deck"
            )
        clear = min((after - before for before, after in pairwise(axes_m)), default=FARTHEST_M)
        room = clear - self.leg_thickness_m
        if room < 2.0 * self.haunch_length_m + ROUNDING:
            raise self.unexpected(
                "haunch_length_m", f"less than half of the least distance between legs, {0.5 * room:.6g} (m)"
            )

    def check_width(self, deck_m: float) -> None:
        """Check that legs fit under the deck."""
        widest = deck_m / self.legs
        if self.leg_width_m > widest * (1.0 + ROUNDING):
            raise self.unexpected(
                "leg_width_m", f"at most {widest:.6g} (m), so that the legs fit into bridge.deck.width_m"
            )

    def _check_together(self) -> None:
        if (self.haunch_depth_m > 0.0) != (self.haunch_length_m > 0.0):
            name = "haunch_depth_m" if self.haunch_length_m > 0.0 else "haunch_length_m"
            raise self.unexpected(name, "more than 0, as both sizes of haunches go together")
        if self.leg_top_m < _SHORTEST_LEG_M:
            wanted = (
                f"at most {self.clear_height_m - _SHORTEST_LEG_M:g} (m), so that {_SHORTEST_LEG_M} m of legs is left"
            )
            raise self.unexpected("haunch_depth_m", wanted)
