"""Bars by rule: steel that members of concrete are taken to have where a file has no bars in them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..engineering.elasticity.steel_bars import YIELD_PA
from ..model.bridge.member import Member
from ..model.materials.materials import strengths
from ..model.reinforcement.concrete_members import is_concrete
from ..model.scenario import Scenario

SHARE = 1.0
"""Yield force of the steel across a face by the tensile strength of its concrete: `connections.ductile_share`."""

_HELD = ("footing", "approach slab")


def notes_on_bars(scenario: Scenario, members: Sequence[Member]) -> Iterator[str]:
    """Yield a note for each material of members of concrete without bars in the file: how much steel these are to have.

    Steel that yields as its concrete tears is the least with which a section that cracks still carries (EN 1992-1-1,
    7.3.2 and 9.2.1.1), spread over each face and across it. Layers lie level, and imported members are inclined.
    """
    given = {name for layer in scenario.reinforcement for name in layer.members}
    by_material: dict[str, list[Member]] = {}
    for member in members:
        if member.kind in _HELD or {member.name, member.kind} & given or not is_concrete(scenario, member):
            continue
        by_material.setdefault(_material(scenario, member), []).append(member)
    known = strengths(scenario.materials)
    for name, found in by_material.items():
        percent = 100.0 * SHARE * float(known[name].tension_pa) / YIELD_PA
        kinds = ", ".join(dict.fromkeys(member.kind for member in found))
        yield (
            f"the file has no bars in {len(found)} members of {name} ({kinds}): by rule {percent:.2g} % of each "
            "section is steel, across every crack, with the force at which the concrete tears; [[reinforcement]] "
            "says it better"
        )


def _material(scenario: Scenario, member: Member) -> str:
    for rule in scenario.connections.between:
        if rule.material and all(name in (member.name, member.kind) for name in rule.members):
            return rule.material
    return scenario.connections.material or ""
