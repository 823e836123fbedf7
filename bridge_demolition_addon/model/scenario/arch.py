"""What carries the deck in place of piers: an arch, or a frame of one piece with it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ...engineering.geometry.arches import ArchAxis
from ...errors import ScenarioError
from ..schema import DENSITY, FARTHEST_M, ROUNDING, SIZE, Table, key

SHORTEST_COLUMN_M = 0.1
"""Least height of a column on an arch, and of the thrust blocks below it."""

ARCH_KIND, BLOCK_KIND = "arch", "thrust block"
PARABOLA, CIRCLE = "parabola", "circle"

_STEEPEST = 0.45
"""Most rise by span of a circle: of a half circle the sections at the springings are level."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Arch(Table):
    """An arch of concrete under the deck, in the middle between two supports, fixed in thrust blocks on the ground.
    The piers between these supports stand on it, those of the supports themselves on the blocks. It is built of
    straight pieces, level below each column. A bridge with an arch has no skew."""

    table: ClassVar[str] = "bridge.arch"

    span_m: float = key("Span of its axis, from springing to springing.", **SIZE)
    rise_m: float = key("Rise of its axis, from the springings to the crown.", **SIZE)
    axis: str = key("Shape of its axis.", default=PARABOLA, choices=(PARABOLA, CIRCLE))
    springing_m: float = key("Height of its axis above the ground at the springings.", **SIZE)
    thickness_m: float = key("Thickness, square to its axis.", **SIZE)
    width_m: float = key("Width across the road, of one rib where there are several.", **SIZE)
    ribs: int = key(
        "Ribs side by side: one, or as many as a pier has columns, one below each of them.", default=1, at_least=1
    )
    from_support: int = key("Support that it begins at, from 1 at the first end.", default=1, at_least=1)
    to_support: int | None = key(
        "Support that it ends at; by default the last. At least one is between the two.", default=None, at_least=3
    )
    block_length_m: float = key("Length of each thrust block along the road, at the ground.", **SIZE)
    density_kg_m3: float | None = key(
        "Density of arch and thrust blocks, where it is not that of the whole bridge.", **DENSITY
    )

    @property
    def names(self) -> tuple[str, ...]:
        """Return names and kinds of its members, which no design gives bars."""
        ribs = tuple(f"{ARCH_KIND} rib {number + 1}" for number in range(self.ribs)) if self.ribs > 1 else ()
        return (ARCH_KIND, *ribs, BLOCK_KIND, f"{BLOCK_KIND} 1", f"{BLOCK_KIND} 2")

    @property
    def is_circle(self) -> bool:
        return self.axis == CIRCLE

    def last_support(self, supports: int) -> int:
        """Return the number of the support that it ends at."""
        return self.to_support or supports

    def axis_between(self, begin_m: float, end_m: float) -> ArchAxis:
        """Return its axis in the middle between supports at two positions along the road."""
        beside = 0.5 * (end_m - begin_m - self.span_m)
        return ArchAxis(
            begin_m + beside, end_m - beside, self.springing_m, self.rise_m, self.thickness_m, self.is_circle
        )

    def check_supports(self, supports: int, columns: int) -> None:
        """Check that it ends at a support of the bridge, with one between at least, and that its ribs carry columns."""
        last = self.last_support(supports)
        if last > supports:
            raise self.unexpected("to_support", f"at most {supports}, the number of supports of the bridge")
        if self.from_support > last - 2:
            raise self.unexpected(
                "from_support", f"at most {last - 2}, so that a pier between it and support {last} stands on the arch"
            )
        if self.ribs not in (1, columns):
            raise self.unexpected("ribs", f"1, or as many as bridge.piers.columns, {columns}")

    def check_room(self, axis: ArchAxis, columns_m: Sequence[float], length_m: float, top_m: float) -> None:
        """Check that an arch leaves the ground, and fits under columns of a length whose tops are at a height."""
        ends = np.array([axis.begin_m, axis.end_m])
        (first, last), (lowest, _) = axis.points_m(ends, 1.0)[:, 0], axis.points_m(ends, -1.0)[:, 1]
        if columns_m[0] - 0.5 * length_m <= first or columns_m[-1] + 0.5 * length_m >= last:
            raise self.unexpected("span_m", "more, so that the arch begins and ends beside the piers on it")
        if lowest < SHORTEST_COLUMN_M - ROUNDING:
            least = self.springing_m + SHORTEST_COLUMN_M - lowest
            raise self.unexpected("springing_m", f"at least {least:.6g} (m), so that its underside clears the ground")
        seats = max(axis.seat_m(column, length_m) for column in columns_m)
        over = max(seats + SHORTEST_COLUMN_M, float(axis.profile(columns_m, length_m).tops_m[:, 1].max())) - top_m
        if over > ROUNDING:
            room = f"columns of {SHORTEST_COLUMN_M} m are left on it below bridge.piers.height_m, {top_m:g} (m)"
            raise self.unexpected("rise_m", f"less by {over:.6g} (m), so that {room}")

    def check_blocks(self, axis: ArchAxis, support_m: float, length_m: float) -> None:
        """Check that what stands on the first thrust block, of a length about an axis, is wholly on it."""
        ends = np.array([axis.begin_m])
        top, inside = float(axis.points_m(ends, 1.0)[0, 0]), float(axis.points_m(ends, -1.0)[0, 0])
        if support_m + 0.5 * length_m > top + ROUNDING:
            most = self.span_m - 2.0 * (support_m + 0.5 * length_m - top)
            raise self.unexpected("span_m", f"at most {most:.6g} (m), so that piers stand beside it on its blocks")
        if support_m - 0.5 * length_m < inside - self.block_length_m - ROUNDING:
            least = inside - support_m + 0.5 * length_m
            raise self.unexpected("block_length_m", f"at least {least:.6g} (m), so that piers stand on the blocks")

    def check_width(self, apart_m: float, columns: int, column_m: float) -> None:
        """Check that the columns of a width all stand on it, with their number and distance of axes."""
        over = column_m if self.ribs > 1 else (columns - 1) * apart_m + column_m
        if over > self.width_m * (1.0 + ROUNDING):
            raise self.unexpected("width_m", f"at least {over:.6g} (m), over what stands on it")
        if self.ribs > 1 and self.width_m > apart_m * (1.0 + ROUNDING):
            raise self.unexpected("width_m", f"at most {apart_m:.6g} (m), so that ribs do not overlap")

    def _check_together(self) -> None:
        if self.is_circle and self.rise_m > _STEEPEST * self.span_m:
            raise self.unexpected("rise_m", f"at most {_STEEPEST:g} times bridge.arch.span_m of a circle")
        radius = self.axis_between(0.0, self.span_m).radius_m
        if self.thickness_m >= radius:
            raise self.unexpected("thickness_m", f"less than the radius of its axis, {radius:.6g} (m)")
        if self.to_support is not None and self.to_support < self.from_support:
            raise ScenarioError("bridge.arch.to_support is below from_support: expected a support after it")


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
