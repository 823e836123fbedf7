"""The bars of a scenario: by the rule of its bridge or of its `[[geometry]]`, and as it gives them itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TypeVar

from ...engineering.mechanics.strength import NEWTON_PER_SQUARE_MILLIMETRE
from ...engineering.reinforced_concrete.least_areas import USUAL_LARGEST_SHARE
from ...engineering.reinforced_concrete.materials import Concrete
from ...errors import ScenarioError
from ...texts import Text
from ..bridge.member import Member
from ..materials import BarLayer, strengths
from ..scenario import Bridge, Scenario
from ..scenario.reinforcement import BarRule, BridgeReinforcement, GeometryReinforcement
from ..scenario.scenario import bars_by_rule, rules_of_bars
from ..schema import given
from .concrete_members import is_concrete, material_of, names_of_bridge
from .design_basis import BarDesign, DesignBasis
from .file_decks import file_deck_bars, file_deck_line
from .file_members import FileDesign
from .file_substructure import file_substructure_bars, loads_of_carriers
from .load_paths import Seat, contacts_of, superstructures
from .ratios import ratio_bars
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
