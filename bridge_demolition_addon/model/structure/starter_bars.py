"""Bars across faces between members that are of one piece: links of girders in slabs, bars of columns in caps and
footings, of legs in decks, and all those between members from files that have bars by a rule.

What a member rests on by a bearing, or merely lies on, has none. The ground below members of `[bridge]` stands for
their footings.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.elasticity.steel_bars import Steel, mean_strain_at_rupture, tensile_strength_pa
from ...engineering.geometry.vectors import AXES, dot
from ...engineering.reinforced_concrete.least_areas import of_links_m2_m
from ...engineering.reinforced_concrete.materials import Concrete
from ..bridge.member import Member, own_axes
from ..materials import BarLayer
from ..reinforcement.concrete_members import is_concrete, names_of_bridge
from ..scenario import Bridge, Scenario
from .connection_source import ConnectionRows, CutBridge
from .member_layers import layers_of_members

_LEAST_RATIO = 0.002
"""As of the bars along columns and the upright ones of walls: EN 1992-1-1:2004, 9.5.2 (2) and 9.6.2 (1)."""

_LEAST_LINK_M, _LEAST_BAR_M = 0.010, 0.016
"""Their diameters."""

_BOND_ENDS = 200.0
"""Length by diameter that holds all of a bar, on both sides of a crack, whose stress differs as it ruptures there."""

GIRDER = "girder"
ON_GIRDERS = frozenset(("deck", GIRDER))
"""Kinds of members between which links hold."""


@dataclass(frozen=True, slots=True, eq=False)
class StarterBars:
    """Forces (m,) at which starter bars across m connections yield, 0 without any, and openings (m,) of rupture."""

    yield_n: np.ndarray
    openings_m: np.ndarray


def starter_bars(cut: CutBridge, layers: Sequence[BarLayer], rows: ConnectionRows) -> StarterBars | None:
    """Return the bars between members of one piece; None where there are none.

    Either member's bars that run across the face go on into the other: as many as the one with more has, and the least
    that EN 1992-1-1 asks for where either has bars. Layers yield as across a crack of their own member, whose section
    they turn about its pressed edge with its moment of resistance. Bearings and soil have none, nor have connections
    that leave something free.
    """
    scenario, members, connections, joints = cut.scenario, cut.members, rows.connections, cut.scenario.joints
    yield_n, openings = np.zeros((2, len(connections)))
    factor, opening_m = scenario.connections.strength_factor, scenario.connections.ductile_elongation_m
    own = _BarsOfMembers(layers, members)
    of_pair, sprung = cut.members_of(connections.pairs), rows.sprung
    for piece in _pieces(scenario, members):
        meets = (of_pair[:, 0] != of_pair[:, 1]) & piece[of_pair].all(axis=1) & (connections.areas > 0.0)
        meets[sprung] = False
        for row in np.flatnonzero(meets).tolist():
            pair, joint = of_pair[row].tolist(), joints[rows.joints[row]]
            if joint.free or joint.strength is None:
                continue
            compression_pa = float(joint.strength.compression_pa) / factor
            bars_of = {index: own.by_area(index, compression_pa) for index in pair if index >= 0}
            if not any(bars_of.values()):
                continue
            point, normal = connections.points[row], connections.normals[row]
            crossing = [tuple(_crossing(bars, members[index], point, normal)) for index, bars in bars_of.items()]
            kinds = frozenset(members[index].kind for index in bars_of)
            bars = max(crossing, key=_pull_pa)
            if kinds != ON_GIRDERS or not _pull_pa(bars):  # a girder's own links are as they are given
                bars = max((bars, (_least(kinds, compression_pa, scenario.steel),)), key=_pull_pa)
            yield_n[row] = factor * _pull_pa(bars) * connections.areas[row]
            openings[row] = _opening_m(bars, compression_pa, scenario.steel) if opening_m is None else opening_m
    return StarterBars(yield_n, openings) if yield_n.any() else None


@dataclass(frozen=True, slots=True)
class _Crossing:
    """Bars by the area that they cross, all that run the same way."""

    ratio: float
    yield_pa: float
    diameter_m: float
    along: tuple[bool, int] = (False, 0)  # in the axes of the member or of the bridge, and which
    ends_m: tuple[float, float] = (-np.inf, np.inf)


def _pull_pa(bars: Sequence[_Crossing]) -> float:
    return math.fsum(bar.ratio * bar.yield_pa for bar in bars)


def _pieces(scenario: Scenario, members: Sequence[Member]) -> Iterator[np.ndarray]:
    """Yield which members, and last the ground, (k + 1,) are of one piece."""
    rule, concrete = scenario.geometry_reinforcement, [is_concrete(scenario, member) for member in members]
    if rule and rule.has_bars:
        names = {table.name for table in scenario.geometry}
        of_files = [member.name in names and member.kind != "fill" for member in members]
        yield np.append(np.array(of_files) & concrete, False)
    names = names_of_bridge(scenario)
    for kinds, on_ground in _kinds_of_one_piece(scenario.bridge) if scenario.bridge else ():
        of_bridge = [member.name in names and (kinds is None or member.kind in kinds) for member in members]
        yield np.append(np.array(of_bridge) & concrete, on_ground)


def _kinds_of_one_piece(bridge: Bridge) -> Iterator[tuple[frozenset[str] | None, bool]]:
    """Yield kinds of members, None for all, and whether footings below them are of the same piece."""
    if bridge.arch or bridge.frame:
        yield None, True
        return
    yield ON_GIRDERS, False
    yield frozenset(("pier cap", "pier", "abutment")), True


class _BarsOfMembers:
    """The bars of members by the area across them, layers as they pull across a crack of their section."""

    def __init__(self, layers: Sequence[BarLayer], members: Sequence[Member]):
        self._layers, self._members = layers, members
        self._groups = tuple(layers_of_members(layers, members))
        self._found: dict[tuple[int, float], list[_Crossing]] = {}

    def by_area(self, index: int, compressive_pa: float) -> list[_Crossing]:
        """Return the bars of a member of such concrete."""
        key = index, compressive_pa
        if key not in self._found:
            self._found[key] = [*self._spread(self._members[index]), *self._in_layers(index, compressive_pa)]
        return self._found[key]

    def _spread(self, member: Member) -> Iterator[_Crossing]:
        for layer in self._layers:
            if layer.is_spread and layer.is_in(member.name, member.kind):
                along = layer.own_axes, AXES.index(layer.along)
                yield _Crossing(layer.ratio, layer.yield_pa, layer.diameter_m, along, layer.ends_m)

    def _in_layers(self, index: int, compressive_pa: float) -> Iterator[_Crossing]:
        member = self._members[index]
        for group in (group for group in self._groups if group.member == index):
            axis, between = group.axes[0], group.between_m
            corners = member.without_skew(member.solid.vertices) if member.line else member.solid.vertices
            ends_m = own_axes(member).ends_m(axis) if group.own else (corners[:, axis].min(), corners[:, axis].max())
            forces_n = group.section(compressive_pa, 1.0).across_cracks_n()
            for layer, force_n in zip(group.layers, forces_n, strict=True):
                ratio = force_n / layer.yield_pa * float(ends_m[1] - ends_m[0]) / member.volume_m3
                ends = max(layer.ends_m[0], between[0]), min(layer.ends_m[1], between[1])
                yield _Crossing(ratio, layer.yield_pa, layer.diameter_m, (layer.own_axes, axis), ends)


def _crossing(
    bars: Sequence[_Crossing], member: Member, point_m: np.ndarray, normal: np.ndarray
) -> Iterator[_Crossing]:
    """Yield the bars of a member across a plane at a point, by its area."""
    for bar in bars:
        (is_own, axis), along, place = bar.along, np.eye(3)[bar.along[1]], point_m
        if is_own:
            axes = own_axes(member)
            place = axes.from_world(point_m[None])[0]
            along = axes.directions(place[None], axis)[0]
        elif member.line:
            place = member.line.from_world(point_m)
            along = member.line.directions(place[None], axis)[0]
        if bar.ends_m[0] <= place[axis] <= bar.ends_m[1]:
            yield replace(bar, ratio=bar.ratio * abs(float(dot(along, normal))))


def _least(kinds: frozenset[str], compression_pa: float, steel: Steel) -> _Crossing:
    """Return the least bars: links of girders, EN 1992-1-1:2004, 9.2.2 (5), or bars of columns and walls."""
    if kinds != ON_GIRDERS:
        return _Crossing(_LEAST_RATIO, steel.yield_pa, _LEAST_BAR_M)
    ratio = of_links_m2_m(1.0, Concrete(compression_pa), steel.yield_pa)
    return _Crossing(ratio, steel.yield_pa, _LEAST_LINK_M)


def _opening_m(bars: Sequence[_Crossing], compression_pa: float, steel: Steel) -> float:
    """Return the opening of one crack at which bars rupture that are anchored on both of its sides, in the mean.

    They slip out of both sides as far as bond lets them: Marti et al. (1998), as in `steel_bars`. By the bond of
    H. Sezen and E. J. Setzler (2008), Reinforcement slip in reinforced concrete columns, ACI Structural Journal 105,
    280-289, it is up to 15 % more in concrete up to C50/60.
    """
    tensile_pa, by_pull = tensile_strength_pa(compression_pa), 0.0
    for bar in bars:
        own, long_m = replace(steel, yield_pa=bar.yield_pa), _BOND_ENDS * bar.diameter_m
        strain = mean_strain_at_rupture(own, bar.diameter_m, long_m, tensile_pa)
        by_pull += strain * long_m * bar.ratio * bar.yield_pa
    return by_pull / _pull_pa(bars)
