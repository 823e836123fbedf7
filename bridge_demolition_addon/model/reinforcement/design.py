"""The bars of a scenario: by the rule of its bridge or its `[[geometry]]`, by ratios of steel, and as it gives them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TypeVar

import numpy as np

from ...engineering.mechanics.strength import NEWTON_PER_SQUARE_MILLIMETRE
from ...engineering.reinforced_concrete.least_areas import USUAL_LARGEST_SHARE
from ...engineering.reinforced_concrete.materials import Concrete
from ...errors import ScenarioError
from ...texts import Text
from ..bridge.member import Member, members_named, own_axes
from ..materials import BarLayer, strengths
from ..scenario import Bridge, RatiosOfMember, Scenario
from ..scenario.arch import ARCH_KIND
from ..scenario.bridge_checks import arch_axis
from ..scenario.reinforcement import BarRule, BridgeReinforcement, GeometryReinforcement
from ..scenario.scenario import bars_by_rule, rules_of_bars
from ..schema import given
from .concrete_members import is_concrete, material_of, names_of_bridge
from .design_basis import BarDesign, DesignBasis
from .file_decks import file_deck_bars, file_deck_line
from .file_members import FileDesign
from .file_substructure import file_substructure_bars, loads_of_carriers
from .load_paths import Seat, contacts_of, superstructures
from .schedule import Schedule, ScheduledBars, ScheduledLinks, link_layers, row_text
from .substructure import pier_bars, support_loads
from .superstructure import deck_bars, deck_lines

_Row = TypeVar("_Row", ScheduledBars, ScheduledLinks)

_PARTS = "bars", "links", "notes"

_STRONGEST_N_MM2 = 90.0
"""Strongest concrete of EN 1992-1-1:2004, table 3.1."""

_LARGEST_SKEW_DEG = 20.0
"""Skew from which on strips along the road say too little of a slab."""


def all_layers(scenario: Scenario, members: Sequence[Member]) -> tuple[BarLayer, ...]:
    """Return the layers of bars of a scenario's members: `[[reinforcement]]`, and those by the rule of its bridge."""
    schedule = bar_schedule(scenario, members)
    return (*scenario.reinforcement, *schedule.layers, *link_layers(schedule, members))


def bar_schedule(scenario: Scenario, members: Sequence[Member]) -> Schedule:
    """Return the bars of a bridge by its rule; of no member that `[[reinforcement]]` names, nor one not of concrete."""
    schedules = [_of_bridge_by_rule(scenario, members), _of_files_by_rule(scenario, members)]
    bars, links, notes = ([row for schedule in schedules for row in getattr(schedule, name)] for name in _PARTS)
    by_hand = {name for layer in scenario.reinforcement for name in layer.members}
    left_out = {member.name for member in members if {member.name, member.kind} & by_hand}
    other = {member.name for member in members if not is_concrete(scenario, member)}
    if rules_of_bars(scenario):
        if left_out:
            notes.append(Text("[[reinforcement]] replaces the rule for {}", ", ".join(sorted(left_out))))
        if other:
            notes.append(Text("not of concrete, and without bars: {}", ", ".join(sorted(other))))
    return Schedule(tuple(bars), tuple(links), tuple(notes)).without(left_out | other)


def _of_bridge_by_rule(scenario: Scenario, members: Sequence[Member]) -> Schedule:
    rule = bars_by_rule(scenario)
    if rule is None:
        return Schedule()
    bridge = given(scenario.weighed_bridge)
    basis = DesignBasis(
        rule,
        _concrete(scenario, rule, scenario.connections.material),
        bridge,
        _of_bridge(scenario, members),
        rule.traffic(bridge.deck.width_m),
    )
    rows = [*(_designed(basis) if rule.is_designed else ()), *ratio_bars(basis)]
    bars = _merged([row for row in rows if isinstance(row, ScheduledBars)])
    links = _merged([row for row in rows if isinstance(row, ScheduledLinks)])
    return Schedule(tuple(bars), tuple(links), tuple(_notes(bridge, rule, bars)))


def _of_files_by_rule(scenario: Scenario, members: Sequence[Member]) -> Schedule:
    rule = scenario.geometry_reinforcement
    if rule is None or not rule.has_bars:
        return Schedule()
    names = {table.name for table in scenario.geometry}
    of_concrete = [
        index for index, member in enumerate(members) if member.name in names and is_concrete(scenario, member)
    ]
    if not of_concrete:
        raise ScenarioError(
            f"{rule.table} is given: expected a member of [[geometry]] of concrete, by connections.material or "
            "[[connections.between]]"
        )
    rows, notes = file_bars(
        rule,
        _concrete_of(scenario, rule, [members[index] for index in of_concrete]),
        members,
        contacts_of(scenario, members),
        frozenset(of_concrete),
    )
    bars = _merged([row for row in rows if isinstance(row, ScheduledBars)])
    links = _merged([row for row in rows if isinstance(row, ScheduledLinks)])
    return Schedule(tuple(bars), tuple(links), (*notes, *_dense(bars)))


def _concrete_of(scenario: Scenario, rule: BarRule, members: Sequence[Member]) -> Concrete:
    """Return the concrete of most of these members by volume."""
    volumes: dict[str | None, float] = {}
    for member in members:
        name = material_of(scenario, member)
        volumes[name] = volumes.get(name, 0.0) + member.volume_m3
    return _concrete(scenario, rule, max(volumes, key=lambda name: volumes[name]))


def _of_bridge(scenario: Scenario, members: Sequence[Member]) -> tuple[Member, ...]:
    """Return the members that are not from files."""
    names = names_of_bridge(scenario)
    return tuple(member for member in members if member.name in names)


def _concrete(scenario: Scenario, rule: BarRule, material: str | None) -> Concrete:
    """Return the concrete that the bridge is designed with."""
    if rule.concrete_n_mm2 is not None:
        return Concrete(rule.concrete_n_mm2 * NEWTON_PER_SQUARE_MILLIMETRE)
    name = given(material)
    compression_pa = float(strengths(scenario.materials)[name].compression_pa)
    if compression_pa > _STRONGEST_N_MM2 * NEWTON_PER_SQUARE_MILLIMETRE:
        raise ScenarioError(
            f'connections.material is "{name}": expected concrete with [bridge.reinforcement], or '
            "bridge.reinforcement.concrete_n_mm2"
        )
    return Concrete(compression_pa)


@lru_cache(maxsize=8)
def _designed(basis: DesignBasis) -> tuple[ScheduledBars | ScheduledLinks, ...]:
    """Return the bars of a bridge, kept: another cut of it, and its schedule, have the same."""
    lines = deck_lines(basis)
    of_decks = (row for line in lines for row in deck_bars(basis, line))
    return (*of_decks, *pier_bars(basis, support_loads(basis, lines)))


def _notes(bridge: Bridge, rule: BridgeReinforcement, bars: Sequence[ScheduledBars]) -> Iterator[str]:
    if abs(bridge.skew_deg) > _LARGEST_SKEW_DEG and rule.is_designed:
        yield (
            f"skew of {bridge.skew_deg:g}°: strips along the road are designed; bars for twisting and for the obtuse "
            "corners are not covered"
        )
    if bridge.arch and rule.is_designed:
        yield (
            "the deck is designed on rigid supports, and arch and thrust blocks are not: they have the "
            "bars of [[bridge.reinforcement.ratios]] and [[reinforcement]] alone"
        )
    yield from _dense(bars)


def _dense(bars: Sequence[ScheduledBars]) -> Iterator[str]:
    """Yield notes on sections with more bars than is usual."""
    for row in bars:
        if row.ratio > USUAL_LARGEST_SHARE:
            yield (
                f"{row.kind}, {row.where}: {row.ratio:.1%} of the section, more than the {USUAL_LARGEST_SHARE:.0%} "
                "that EN 1992-1-1 has outside of laps"
            )


def _merged(rows: Sequence[_Row]) -> list[_Row]:
    """Put members of a kind whose bars are shown alike into one row."""
    merged: dict[tuple[str, str, str], tuple[_Row, list[str]]] = {}
    for row in rows:
        alike = row.kind, row_text(row), f"{row.length_m:.3f}"
        merged.setdefault(alike, (row, []))[1].extend(row.members)
    return [row.of_members(tuple(dict.fromkeys(names))) for row, names in merged.values()]


def file_bars(
    rule: GeometryReinforcement,
    concrete: Concrete,
    members: Sequence[Member],
    contacts: Sequence[Seat],
    of_concrete: frozenset[int],
) -> tuple[list[ScheduledBars | ScheduledLinks], list[str]]:
    """Return the bars of members from files, and notes.

    Decks and girders are beams over what they rest on; what carries them has bars for the loads that come down to it;
    all else has the least that EN 1992-1-1 asks for.
    """
    basis = FileDesign(BarDesign(rule, concrete), tuple(members), tuple(contacts), of_concrete)
    parts = superstructures(basis.members, contacts)
    widest = max((part.axes.width_m for part in parts), default=None)
    if rule.carriageway_m is not None and widest is not None and rule.carriageway_m > widest:
        raise rule.unexpected("carriageway_m", f"at most the width of the widest deck, {widest:.4g} (m)")
    lines = [line for part in parts if (line := file_deck_line(basis, part))]
    rows: list[ScheduledBars | ScheduledLinks] = []
    for line in lines:
        rows += file_deck_bars(basis, line)
    for part in parts:
        if not part.supports:
            for index in (*part.decks, *part.girders):
                basis.note(basis.members[index].name, "rests on no other member, and has least bars")
    with_bars = {name for row in rows for name in row.members}
    rest = [index for index in sorted(of_concrete) if basis.members[index].name not in with_bars]
    rows += file_substructure_bars(basis, rest, loads_of_carriers(basis, lines))
    return rows, basis.sentences


_MM2 = 1e6
_PERCENT = 0.01
_SIDES = {
    "bottom_percent": ("bottom", "x"),
    "top_percent": ("top", "x"),
    "across_bottom_percent": ("bottom", "y"),
    "across_top_percent": ("top", "y"),
}
_UPRIGHT_SIDES = ("start", "end", "right", "left")
_REASON = "ratio"


def ratio_bars(basis: DesignBasis) -> Iterator[ScheduledBars | ScheduledLinks]:
    """Yield the bars and links of the members that ratios are given for; of the last that names it."""
    tables: dict[int, RatiosOfMember] = {}
    for table in basis.rule.ratios:
        for index in members_named(table.member, basis.members, f"{table.table}.member"):
            tables[index] = table
    for index, table in sorted(tables.items()):
        yield from _of_member(basis, basis.members[index], table)


def _of_member(basis: DesignBasis, member: Member, table: RatiosOfMember) -> Iterator[ScheduledBars | ScheduledLinks]:
    extents = _sizes(basis, member)
    outside = basis.rule.cover_m + basis.link_m + 0.5 * basis.bar_m
    for name, (side, along) in _SIDES.items():
        if ratio := getattr(table, name):
            inside = outside + (basis.bar_m if along == "y" else 0.0)
            yield _layer(basis, member, side, along, inside, _PERCENT * ratio, extents)
    if table.upright_percent and member.directions:
        yield _inclined(basis, member, _PERCENT * table.upright_percent, extents)
    elif table.upright_percent:
        for side in _UPRIGHT_SIDES:
            yield _layer(basis, member, side, "z", outside, 0.25 * _PERCENT * table.upright_percent, extents)
    if table.links_percent:
        yield _links(basis, member, _PERCENT * table.links_percent, extents)


def _sizes(basis: DesignBasis, member: Member) -> np.ndarray:
    """Return length, width and height (3,) of a member without skew; along its own axes of an arch and haunches."""
    if not member.is_in_pieces:
        return np.ptp(member.without_skew(member.solid.vertices), axis=0)
    axes = own_axes(member)
    length = arch_axis(basis.bridge).length_m if member.kind == ARCH_KIND else axes.length_m
    return np.array([length, axes.width_m, axes.height_m])


def _layer(
    basis: DesignBasis, member: Member, side: str, along: str, depth_m: float, ratio: float, extents: np.ndarray
) -> ScheduledBars:
    length = float(extents["xyz".index(along)])
    section = member.volume_m3 / length
    thickness = float(extents[{"bottom": 2, "top": 2, "start": 0, "end": 0}.get(side, 1)])
    if depth_m >= 0.5 * thickness:
        raise basis.rule.unexpected(
            "cover_m",
            f"less: the bars of {member.name}, {thickness:g} m thick, would be {depth_m:.3f} m below its side",
        )
    layer = BarLayer(
        members=(member.name,),
        along=along,
        side=side,
        depth_m=depth_m,
        area_mm2=ratio * section * _MM2,
        yield_n_mm2=basis.yield_pa / _MM2,
        diameter_mm=basis.rule.bar_diameter_mm,
        own_axes=member.is_in_pieces,
    )
    return ScheduledBars(layer, member.kind, None, section, ratio * section, _REASON, length)


def _inclined(basis: DesignBasis, member: Member, ratio: float, extents: np.ndarray) -> ScheduledBars:
    """Return the upright bars of an inclined leg: spread, as of both faces, and as many across its slope."""
    _, up = member.directions[0]
    height = float(extents[2])
    section = member.volume_m3 / height
    layer = BarLayer(
        members=(member.name,),
        along="z",
        spread_mm2_m2=ratio / up * _MM2,
        yield_n_mm2=basis.yield_pa / _MM2,
        diameter_mm=basis.rule.bar_diameter_mm,
    )
    return ScheduledBars(layer, member.kind, None, section, ratio / up * section, _REASON, height)


def _links(basis: DesignBasis, member: Member, ratio: float, extents: np.ndarray) -> ScheduledLinks:
    along = int(np.argmax(extents))
    width, height = sorted(np.delete(extents, along).tolist(), reverse=True)
    area = ratio * width * _MM2
    cover = basis.rule.cover_m
    return ScheduledLinks(
        members=(member.name,),
        kind=member.kind,
        link_area_mm2_per_m=area,
        required_mm2_per_m=area,
        reason=_REASON,
        legs=2,
        diameter_m=0.0,
        spacing_m=0.0,
        width_m=width,
        loop_m=2.0 * (width + height - 4.0 * cover),
        length_m=float(extents[along]),
    )
