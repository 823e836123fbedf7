"""Half-joints, by which one part of a deck lies on the next, and the parts that they divide a deck into."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from ...errors import ScenarioError
from ..schema import SIZE, Table, key

BEHIND, BEFORE = "behind", "before"


@dataclass(frozen=True, slots=True, kw_only=True)
class HalfJoint(Table):
    """A half-joint, or Gerber hinge: the part of the deck on one side lies with its upper nib on the lower nib of the
    other, on a bearing of its own. Nibs are half as deep as the slab, or as the girders, whose slab ends with the upper
    nib. Two in a span leave a drop-in span between them. Parts are called `part 1 deck`, `part 1 girder 1` and so on.
    It needs `[bridge.bearings]`."""

    table: ClassVar[str] = "bridge.half_joints"

    span: int = key("Span that it is in, from 1 at the first end.", at_least=1)
    at_m: float = key("Distance of its bearing from the axis at the begin of that span, along the road.", **SIZE)
    length_m: float = key("Length of both nibs along the road, with both gaps.", **SIZE)
    gap_m: float = key("Clear gap before either nib.", default=0.03, **SIZE)
    carried: str = key(
        "Which part lies on the other: the one behind the half-joint along the road, or the one before it.",
        default=BEHIND,
        choices=(BEHIND, BEFORE),
    )
    pinned: bool = key(
        "Whether its bearing holds along the road. Where it does not, what is beyond is pinned at its first support.",
        default=True,
    )

    def position_m(self, axes_m: Sequence[float]) -> float:
        """Return where its bearing is along the road, m."""
        return axes_m[self.span - 1] + self.at_m

    def _check_together(self) -> None:
        if 4.0 * self.gap_m > self.length_m:
            raise self.unexpected("gap_m", f"at most a fourth of bridge.half_joints.length_m, {self.length_m:g} (m)")


@dataclass(frozen=True, slots=True)
class DeckPart:
    """A part of a deck: it is whole from begin to end, with nibs beyond from one position to another, m.

    `seats_m` are the positions of supports and of half-joints at which it is carried.
    """

    begin_m: float
    end_m: float
    lower_nibs_m: tuple[tuple[float, float], ...] = ()
    upper_nibs_m: tuple[tuple[float, float], ...] = ()
    seats_m: tuple[float, ...] = ()

    @property
    def slab_m(self) -> tuple[float, float]:
        """Return from where to where its slab goes, which is on the upper nibs as well."""
        places = [place for nib in self.upper_nibs_m for place in nib]
        return min([self.begin_m, *places]), max([self.end_m, *places])

    @property
    def whole_m(self) -> tuple[float, float]:
        """Return from where to where it goes with all nibs."""
        places = [place for nib in self.lower_nibs_m for place in nib]
        return min([self.slab_m[0], *places]), max([self.slab_m[1], *places])


def deck_parts(joints: Sequence[HalfJoint], axes_m: Sequence[float], ends_m: tuple[float, float]) -> list[DeckPart]:
    """Return the parts of a deck between its ends, in their order along the road."""
    ordered = sorted(joints, key=lambda joint: joint.position_m(axes_m))
    sides = [_sides(joint, joint.position_m(axes_m)) for joint in ordered]
    # Of each part where it begins and where it ends, with the half-joint there.
    begins = [_Side(ends_m[0]), *(behind for _, behind in sides)]
    ends = [*(before for before, _ in sides), _Side(ends_m[1])]
    parts = []
    for begin, end in zip(begins, ends, strict=True):
        supports = [axis for axis in axes_m if begin.whole_m <= axis <= end.whole_m]
        seats = (*supports, *begin.seats_m, *end.seats_m)
        lower, upper = (*begin.lower_m, *end.lower_m), (*begin.upper_m, *end.upper_m)
        parts.append(DeckPart(begin.whole_m, end.whole_m, lower, upper, tuple(sorted(seats))))
    return parts


@dataclass(frozen=True, slots=True)
class _Side:
    """Where a part is whole up to a half-joint, its nibs there, and where it is carried by that."""

    whole_m: float
    lower_m: tuple[tuple[float, float], ...] = ()
    upper_m: tuple[tuple[float, float], ...] = ()
    seats_m: tuple[float, ...] = ()


def _sides(joint: HalfJoint, at_m: float) -> tuple[_Side, _Side]:
    """Return the part before a half-joint, and that behind it."""
    first, last = at_m - 0.5 * joint.length_m, at_m + 0.5 * joint.length_m
    of_first, of_last = ((first, last - joint.gap_m),), ((first + joint.gap_m, last),)
    if joint.carried == BEHIND:
        return _Side(first, lower_m=of_first), _Side(last, upper_m=of_last, seats_m=(at_m,))
    return _Side(first, upper_m=of_first, seats_m=(at_m,)), _Side(last, lower_m=of_last)


def check_half_joints(joints: Sequence[HalfJoint], axes_m: Sequence[float], half_support_m: float) -> None:
    """Check that half-joints are between supports and apart from each other, and that each part is carried.

    Raises
    ------
    ScenarioError
        They are not, or it is not.
    """
    spans = len(axes_m) - 1
    for joint in joints:
        if joint.span > spans:
            raise joint.unexpected("span", f"at most {spans}, the number of spans")
        length = axes_m[joint.span] - axes_m[joint.span - 1]
        least = half_support_m + 0.5 * joint.length_m
        if not least <= joint.at_m <= length - least:
            room = (
                f"from {least:g} to {length - least:g} (m), so that its nibs are beside supports in span {joint.span}"
            )
            raise joint.unexpected("at_m", room)
    places = sorted((joint.position_m(axes_m), joint.length_m) for joint in joints)
    for (before, one), (after, other) in pairwise(places):
        if after - before <= 0.5 * (one + other):
            raise ScenarioError(
                f"bridge.half_joints at {before:g} and {after:g} m are {after - before:g} m apart: expected more than "
                f"{0.5 * (one + other):g} (m), so that their nibs do not meet"
            )
    for number, part in enumerate(deck_parts(joints, axes_m, (axes_m[0], axes_m[-1])), start=1):
        if len(part.seats_m) < 2:
            raise ScenarioError(
                f"part {number} of the deck, from {part.begin_m:g} to {part.end_m:g} m, is carried at "
                f"{len(part.seats_m)} supports and half-joints: expected two at least; turn `carried` or move one"
            )


def pinned_supports(joints: Sequence[HalfJoint], axes_m: Sequence[float], pinned: int) -> frozenset[int]:
    """Return the supports, by number from 0, that hold the deck along the road: one of each length that moves.

    It is the one asked for, or else the first of a length between half-joints that are not pinned.

    Raises
    ------
    ScenarioError
        Such a length has no support.
    """
    moving = sorted(joint.position_m(axes_m) for joint in joints if not joint.pinned)
    found = set()
    for low, high in zip([-float("inf"), *moving], [*moving, float("inf")], strict=True):
        own = [number for number, axis in enumerate(axes_m) if low < axis < high]
        if not own:
            raise ScenarioError(
                f"bridge.half_joints at {low:g} and {high:g} m are not pinned: expected one of them to be, as the part "
                "between them has no support that holds it along the road"
            )
        found.add(pinned if pinned in own else own[0])
    return frozenset(found)
