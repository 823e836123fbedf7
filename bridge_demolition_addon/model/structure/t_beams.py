"""Girders that are cast with the slab above them: T-beams, each with its share of the slab and of the bars in that."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from ...engineering.reinforced_concrete.resistance import flange_width_m
from ..bridge.layout import deck_seats
from ..bridge.member import Member
from ..bridge.superstructure import cast_decks
from ..materials import BarLayer, ReinforcedSection
from ..reinforcement.concrete_members import is_concrete
from ..scenario import Bridge, Scenario
from ..schema import given
from .member_layers import LayersOfMember, layers_of_members

_BESIDE_SUPPORT = 0.15
"""Part of a span beside a support that the flange over this has, and the distance of zero moments there by both spans:
EN 1992-1-1:2004, figure 5.2."""


@dataclass(frozen=True, slots=True, eq=False)
class TBeam:
    """A girder with its bars along the road, and a part of the slab above with those in it.

    Bars of the slab belong to the whole `deck`; one of `number` girders has them in its flange, which is at most
    `beside_m` wider than the web on either side. `supports_m` are where the deck rests, along the road.
    """

    girder: LayersOfMember
    deck: LayersOfMember
    number: int
    beside_m: tuple[float, float]
    supports_m: tuple[float, ...]

    @property
    def top_m(self) -> float:
        return self.deck.highest

    @property
    def depth_m(self) -> float:
        return self.top_m - self.girder.lowest

    @property
    def middle_m(self) -> float:
        """Middle of its depth."""
        return 0.5 * (self.girder.lowest + self.top_m)

    @property
    def slab_m(self) -> float:
        """Middle of the slab."""
        return 0.5 * (self.deck.lowest + self.deck.highest)

    def flange_m(self, at_m: float) -> float:
        """Return the effective width of the flange in a section: EN 1992-1-1:2004, 5.3.2.1."""
        return flange_width_m(self.girder.width_m, self.beside_m, _between_zeros_m(at_m, self.supports_m))

    def section(self, at_m: float, compressive_pa: float, factor: float = 1.0) -> ReinforcedSection:
        """Return the section, with depths from its top, first the girder's layers, and bars stronger by a factor."""
        flange_m, parts = self.flange_m(at_m), (self.girder, self.deck)
        shares = 1.0, flange_m / self.deck.width_m
        return ReinforcedSection(
            self.depth_m,
            self.girder.width_m,
            compressive_pa,
            [self.top_m - level for part in parts for level in part.levels_m],
            [share * layer.area_m2 for part, share in zip(parts, shares, strict=True) for layer in part.layers],
            [factor * layer.yield_pa for part in parts for layer in part.layers],
            (flange_m, self.deck.highest - self.deck.lowest),
        )

    def has(self, group: LayersOfMember) -> bool:
        """Return whether layers belong to its girder or its deck."""
        return any(_key(group) == _key(part) for part in (self.girder, self.deck))

    def across_cracks_n(self, group: LayersOfMember, compressive_pa: float, factor: float) -> list[float]:
        """Return the forces at which layers of its girder or deck yield across a crack of the whole section."""
        middle_m = 0.5 * (self.supports_m[0] + self.supports_m[1])
        section = self.section(middle_m, compressive_pa, factor)
        pulls = [area * strength for area, strength in zip(section.areas_m2, section.yields_pa, strict=True)]
        shares = [force / pull for force, pull in zip(section.across_cracks_n(), pulls, strict=True)]
        first = 0 if _key(group) == _key(self.girder) else len(self.girder.layers)
        own = zip(shares[first:], group.layers, strict=False)
        return [share * factor * layer.area_m2 * layer.yield_pa for share, layer in own]


def t_beams(scenario: Scenario, layers: Sequence[BarLayer], members: Sequence[Member]) -> Iterator[TBeam]:
    """Yield the T-beams of a bridge, each for every part of its deck in which bars are the same."""
    bridge = scenario.bridge
    if bridge is None or bridge.girders is None:
        return
    groups = [group for group in layers_of_members(layers, members) if not group.layers[0].own_axes]
    along = [group for group in groups if group.axes[0] == 0]
    rows = {member.name: row for row, member in enumerate(members) if is_concrete(scenario, member)}
    seats = deck_seats(bridge)
    for supports, (deck_name, girders) in zip(seats, cast_decks(bridge), strict=True):
        of_deck = [group for group in along if group.member == rows.get(deck_name)]
        for number, name in enumerate(girders):
            of_girder = [group for group in along if group.member == rows.get(name)]
            for girder, deck in product(of_girder, of_deck):
                yield TBeam(girder, deck, len(girders), _beside_m(bridge, number), supports)


def _beside_m(bridge: Bridge, number: int) -> tuple[float, float]:
    """Half of what is clear to the next girder, or all of the overhang, on both sides."""
    girders, spacing = given(bridge.girders), bridge.girder_spacing_m
    last = girders.number - 1
    overhang = 0.5 * (bridge.deck.width_m - last * spacing - girders.width_m)
    clear = 0.5 * (spacing - girders.width_m)
    return (overhang if number == 0 else clear, overhang if number == last else clear)


def _between_zeros_m(at_m: float, supports_m: tuple[float, ...]) -> float:
    """Return the distance between points where the moment is 0, about a section: EN 1992-1-1:2004, figure 5.2."""
    spans, last = np.diff(supports_m).tolist(), len(supports_m) - 2
    for support in range(1, last + 1):
        before, behind = spans[support - 1], spans[support]
        if -_BESIDE_SUPPORT * before < at_m - supports_m[support] < _BESIDE_SUPPORT * behind:
            return float(_BESIDE_SUPPORT * (before + behind))
    span = min(max(int(np.searchsorted(supports_m, at_m)) - 1, 0), last)
    held = (span > 0) + (span < last)
    return float((1.0, 0.85, 0.7)[held] * spans[span])


def _key(group: LayersOfMember) -> tuple[int, tuple[int, int, int], tuple[float, float]]:
    return group.member, group.axes, group.between_m
