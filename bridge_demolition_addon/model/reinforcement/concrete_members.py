"""Which members are of concrete, and which of these have no bars."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from ...engineering.mechanics.strength import Strength
from ...texts import Text, joined
from ..bridge.substructure import substructure
from ..bridge.superstructure import superstructure
from ..materials import strengths
from ..scenario import Scenario
from ..scenario.scenario import bars_by_rule

_TORN_BY_CRUSHED = 0.25
"""Tensile by compressive strength from which on a material of the user is no concrete, as steel or timber."""

_OTHERS = ("masonry", "steel")


class Named(Protocol):
    """A member as far as it is named: of the model, or a table of the scenario."""

    @property
    def name(self) -> str: ...

    @property
    def kind(self) -> str: ...


def is_concrete(scenario: Scenario, member: Named) -> bool:
    """Return whether a member breaks by the strength of a concrete, or by one force, which any material can have."""
    material = material_of(scenario, member)
    if material is None:
        return True
    return material not in _OTHERS and _is_weak_in_tension(strengths(scenario.materials)[material])


def _is_weak_in_tension(strength: Strength) -> bool:
    return float(strength.tension_pa) < _TORN_BY_CRUSHED * float(strength.compression_pa)


def material_of(scenario: Scenario, member: Named) -> str | None:
    """Return the material within a member: of the first rule that names it twice, or of connections in general."""
    for rule in scenario.connections.between:
        if all(name in (member.name, member.kind) for name in rule.members):
            if rule.material is None and rule.breaking_force_newton is not None:
                return None
            return rule.material or scenario.connections.material
    return scenario.connections.material


def names_of_bridge(scenario: Scenario) -> set[str]:
    """Return the names of the members of a parametric bridge."""
    bridge = scenario.bridge
    return {member.name for member in (*superstructure(bridge), *substructure(bridge))} if bridge else set()


def named_members(scenario: Scenario) -> list[Named]:
    """Return all members of a scenario by name and kind, without reading any file."""
    bridge = scenario.bridge
    of_bridge: list[Named] = [*superstructure(bridge), *substructure(bridge)] if bridge else []
    return [*of_bridge, *scenario.geometry]


def plain_concrete_text(scenario: Scenario) -> str:
    """Return a sentence, without a full stop, on members of concrete without bars; empty where there are none, or where
    the scenario says that the bridge has no bars."""
    of_bridge = scenario.bridge.reinforcement if scenario.bridge else None
    rules = (rule for rule in (of_bridge, scenario.geometry_reinforcement) if rule)
    is_meant = any(not rule.has_bars for rule in rules)
    if is_meant or not (plain := plain_concrete(scenario)):
        return ""
    table = "bridge.reinforcement" if scenario.bridge else "geometry_reinforcement"
    return Text(
        "no reinforcing bars in {}: what cracks there falls apart, as concrete with bars "
        "does not; [{}] or [[reinforcement]] gives them",
        joined("{}, {}", plain),
        table,
    )


def plain_concrete(scenario: Scenario) -> list[str]:
    """Return kinds of concrete members without any bars, and names of members without bars in other kinds.

    Bars that are spread evenly over all faces are bars, too.
    """
    if scenario.connections.ductile_share > 0.0:
        return []
    members, with_bars = named_members(scenario), names_with_bars(scenario)
    plain = [
        member for member in members if not {member.name, member.kind} & with_bars and is_concrete(scenario, member)
    ]
    return list(dict.fromkeys(_kind_or_name(member, plain, members) for member in plain))


def _kind_or_name(member: Named, plain: Sequence[Named], members: Iterable[Named]) -> str:
    alike = [other for other in members if other.kind == member.kind]
    return member.kind if all(any(other is one for one in plain) for other in alike) else member.name


def _designed(scenario: Scenario) -> set[str]:
    """Return the names of the members that a rule designs."""
    arch = scenario.bridge.arch if scenario.bridge else None
    return names_of_bridge(scenario) - set(arch.names if arch else ())


def names_with_bars(scenario: Scenario) -> set[str]:
    """Return names and kinds of members with bars."""
    named = {name for layer in scenario.reinforcement for name in layer.members}
    if rule := bars_by_rule(scenario):
        named |= {table.member for table in rule.ratios}
        if rule.is_designed:
            named |= _designed(scenario)
    if scenario.geometry_reinforcement and scenario.geometry_reinforcement.has_bars:
        named |= {table.name for table in scenario.geometry if is_concrete(scenario, table)}
    return named
