"""Bars by rule: those that members of concrete are designed with where a file has no bars in them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ..model.bridge.member import Member
from ..model.reinforcement.concrete_members import is_concrete
from ..model.reinforcement.design import bar_schedule
from ..model.scenario import GeometryReinforcement, Scenario
from ..model.scenario.reinforcement import LOAD_MODEL_1

OTHER_SHARE = 1.0
"""Strength that members of other materials keep where they break, as steel does: `connections.ductile_share`."""

OTHER_ELONGATION_M = 0.05
"""How far these deform until they rupture, which no file is known to say."""

_NOT_BUILT = ("fill",)
_HELD = ("footing", "approach slab")


def with_bars_by_rule(scenario: Scenario) -> Scenario:
    """Return a scenario whose members of concrete have bars by rule; members of other materials yield."""
    built = [table for table in scenario.geometry if table.kind not in _NOT_BUILT]
    concrete = [table for table in built if is_concrete(scenario, table)]
    if len(concrete) < len(built):
        connections = replace(scenario.connections, ductile_share=OTHER_SHARE, ductile_elongation_m=OTHER_ELONGATION_M)
        scenario = replace(scenario, connections=connections)
    if not concrete:
        return scenario
    return replace(scenario, geometry_reinforcement=GeometryReinforcement(designed_for=LOAD_MODEL_1))


def notes_on_bars(scenario: Scenario, members: Sequence[Member], added: Sequence[str]) -> Iterator[str]:
    """Yield notes on bars by rule: which members have them, how much steel that is, and what the design says.

    Supports that are `added` are no part of the file.
    """
    rule = scenario.geometry_reinforcement
    if rule is None:
        return
    schedule = bar_schedule(scenario, members)
    by_rule = {name for row in schedule.rows for name in row.members}
    found = [member for member in members if member.name in by_rule and member.name not in added]
    moving = [member for member in found if member.kind not in _HELD]
    if not found:
        return
    steel_kg = math.fsum(schedule.mass_of_kg(kind) for kind in {member.kind for member in moving})
    volume_m3 = math.fsum(member.volume_m3 for member in moving)
    kinds = ", ".join(dict.fromkeys(member.kind for member in found))
    amount = f", {steel_kg / volume_m3:.0f} kg/m³ beside footings and approach slabs" if volume_m3 else ""
    yield (
        f"the file has no bars in {len(found)} members of concrete ({kinds}): by rule they have bars for "
        f"{rule.described}{amount}; bda check lists them, and [[reinforcement]] says it better"
    )
    yield from schedule.notes
