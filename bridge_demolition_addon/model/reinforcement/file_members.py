"""What the design of members from files has in common: their sections as boxes, and bars as many as fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

from ...engineering.geometry.own_axes import OwnAxes
from ...engineering.geometry.vectors import AXES
from ...engineering.reinforced_concrete.resistance import PressedShape
from ...errors import ScenarioError
from ..bridge.member import Member, own_axes
from ..materials import BarLayer
from ..scenario.reinforcement import USUAL_COVER_M
from .design_basis import LEAST, BarDesign
from .load_paths import Seat
from .schedule import ScheduledBars, ScheduledLinks

Rows = Iterator[ScheduledBars | ScheduledLinks]

ADVICE = "say what it was built for"
_HALVINGS = 24
_TWENTIETH = 0.05
_KILO = 1e3
_PER_SQUARE_METRE = 1e6
_MM = 1e3
LEAST_RATIO = 0.002
"""Steel along each axis, by volume, of members of which nothing is designed."""

_AS_SLAB = 0.6
"""Width of a deck's underside by that of its top from which on its bars lie in one row, as those of a slab."""

_Found = TypeVar("_Found")


@dataclass(frozen=True, slots=True, eq=False)
class FileDesign:
    """Members from files, where they touch, what their bars are designed by, and what there is to say of it."""

    design: BarDesign
    members: tuple[Member, ...]
    contacts: tuple[Seat, ...]
    concrete: frozenset[int]
    notes: dict[str, list[str]] = field(default_factory=dict)

    def weight_n(self, indices: Sequence[int]) -> float:
        """Return the weight of members together."""
        return math.fsum(self.design.weight_n(self.members[index]) for index in indices)

    def as_much_as_fits(self, name: str, what: str, wanted: float, design: Callable[[float], _Found]) -> _Found:
        """Return the bars for a moment or force, or those for the most that the section carries, with a note."""
        try:
            return design(wanted)
        except ScenarioError as error:
            try:
                found = design(0.0)
            except ScenarioError:
                raise error from None
        low, high = 0.0, 1.0
        for _ in range(_HALVINGS):
            share = 0.5 * (low + high)
            try:
                found, low = design(share * wanted), share
            except ScenarioError:
                high = share
        unit = "kN·m" if "moment" in what else "kN"
        self.note(
            name,
            f"with as many bars as there is room for, about {_TWENTIETH * round(low / _TWENTIETH):.0%} of {what}, "
            f"{wanted / _KILO:.0f} {unit}, is carried: prestressed, or built for less",
        )
        return found

    def rows_or_least(self, index: int, rows: Rows) -> Rows:
        """Yield the rows of a member, or least bars that are spread over it where its section has no room for them.

        A cover that the user gives is refused instead.
        """
        member = self.members[index]
        try:
            made = list(rows)
        except ScenarioError as error:
            if self.design.rule.cover_m != USUAL_COVER_M:
                raise
            self.note(member.name, f"least bars, spread over it, as no others fit ({error})")
            made = list(spread_rows(self.design, member, dict.fromkeys("xyz", LEAST_RATIO)))
        yield from made

    def note(self, name: str, text: str) -> None:
        """Note something of a member, together with others that it is true of."""
        names = self.notes.setdefault(text, [])
        if name not in names:
            names.append(name)

    @property
    def sentences(self) -> list[str]:
        """Return all notes, each with the members that it is on."""
        return [f"{', '.join(names)}: {text}" for text, names in self.notes.items()]


@dataclass(frozen=True, slots=True, eq=False)
class LyingSection:
    """The section of what lies, as boxes: a web, and a flange at its top where that is wider."""

    axes: OwnAxes
    bottom_m: float  # width of the underside
    sagging: PressedShape
    hogging: PressedShape

    @classmethod
    def of(cls, member: Member, slab_m: float = 0.0, flange_m: float = 0.0) -> LyingSection:
        """Return the section of a member below a slab of a thickness, with a width of it as its flange."""
        axes = own_axes(member)
        height, web = axes.height_m, axes.web_m
        bottom, top = (axes.width_at_m(share * height) for share in (0.1, 0.9))
        area = member.volume_m3 / axes.length_m
        if slab_m:
            flange, depth = max(flange_m, web), slab_m
        elif top > 1.05 * web:
            flange, depth = top, min(max((area - web * height) / (top - web), 0.1 * height), height)
        else:
            flange, depth = web, height
        whole = height + slab_m
        return cls(axes, bottom, PressedShape(whole, web, flange, depth), PressedShape.rectangle(whole, bottom))

    @property
    def is_slab(self) -> bool:
        return self.bottom_m >= _AS_SLAB * self.axes.width_m


def in_own_axes(rows: Rows) -> Rows:
    """Yield rows of a schedule with layers that follow their members."""
    for row in rows:
        yield replace(row, layer=replace(row.layer, own_axes=True)) if isinstance(row, ScheduledBars) else row


def spread_rows(design: BarDesign, member: Member, ratios: dict[str, float], reason: str = LEAST) -> Rows:
    """Yield bars that are spread over a member, both faces together, by their ratios along the axes of the bridge."""
    low, high = member.solid.bounds
    for along, ratio in ratios.items():
        length = float((high - low)[AXES.index(along)])
        layer = BarLayer(
            members=(member.name,),
            along=along,
            spread_mm2_m2=_PER_SQUARE_METRE * ratio,
            yield_n_mm2=design.yield_pa / _PER_SQUARE_METRE,
            diameter_mm=_MM * design.secondary_m,
        )
        section = member.volume_m3 / length
        yield ScheduledBars(layer, member.kind, None, section, ratio * section, reason, length)
