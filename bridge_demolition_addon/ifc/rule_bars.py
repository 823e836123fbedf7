"""Bars by rule: usual ratios of steel for members of concrete of which a file has no bars."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..engineering.geometry.sides import AXES
from ..model.bridge.member import Member
from ..model.materials.bar_layers import BarLayer
from ..model.reinforcement.concrete_members import is_concrete
from ..model.scenario import Scenario

_PERCENT_IN_MM2_M2 = 1e4

_ALONG, _ACROSS, _UPRIGHT = "along", "across", "upright"

PERCENT = {
    "deck": {_ALONG: 1.5, _ACROSS: 0.5, _UPRIGHT: 0.15},
    "girder": {_ALONG: 2.5, _ACROSS: 0.2, _UPRIGHT: 0.4},
    "arch": {_ALONG: 1.0, _ACROSS: 0.3, _UPRIGHT: 0.6},
    "pier cap": {_ALONG: 1.5, _ACROSS: 0.2, _UPRIGHT: 0.4},
    "pier": {_ALONG: 0.3, _ACROSS: 0.3, _UPRIGHT: 1.5},
    "abutment": {_ALONG: 0.3, _ACROSS: 0.3, _UPRIGHT: 0.4},
    "wing wall": {_ALONG: 0.3, _ACROSS: 0.3, _UPRIGHT: 0.4},
    "wall": {_ALONG: 0.3, _ACROSS: 0.3, _UPRIGHT: 0.4},
    "parapet": {_ALONG: 0.6, _ACROSS: 0.15, _UPRIGHT: 0.3},
    "bracing": {_ALONG: 1.0, _ACROSS: 0.2, _UPRIGHT: 0.4},
    "member": {_ALONG: 1.0, _ACROSS: 0.5, _UPRIGHT: 0.5},
}
"""Steel by area of the section across it, both faces together, along a member, across it in plan, and upright.

Bars are spread over a section, so that they have half the lever arm of bars at its faces: a deck has as many as one
with 0.75 % at each face, 150 kg of steel in each m³ with those across. Girders have more, for the prestress that they
had. Walls have those of EN 1992-1-1:2004, 9.6, and half as many again. Footings and approach slabs never move, and have
none.
"""


def bars_by_rule(scenario: Scenario, members: Sequence[Member]) -> tuple[list[BarLayer], list[str]]:
    """Return bars by ratios for members of concrete without bars in a scenario, and a note on them."""
    given = {name for layer in scenario.reinforcement for name in layer.members}
    chosen = [
        member
        for member in members
        if member.kind in PERCENT and not {member.name, member.kind} & given and is_concrete(scenario, member)
    ]
    rows: dict[tuple[str, float], list[Member]] = {}
    for member in chosen:
        for axis, percent in _by_axis(member).items():
            rows.setdefault((axis, percent), []).append(member)
    layers = [
        BarLayer(
            members=_named(found, members),
            along=axis,
            spread_mm2_m2=round(_PERCENT_IN_MM2_M2 * percent, 1),
        )
        for (axis, percent), found in sorted(rows.items())
    ]
    return layers, [_note(chosen)] if chosen else []


def _by_axis(member: Member) -> dict[str, float]:
    percent = PERCENT[member.kind]
    size = np.ptp(member.solid.vertices, axis=0)
    along, across = (0, 1) if size[0] >= size[1] else (1, 0)
    return {AXES[along]: percent[_ALONG], AXES[across]: percent[_ACROSS], AXES[2]: percent[_UPRIGHT]}


def _named(found: Sequence[Member], members: Sequence[Member]) -> tuple[str, ...]:
    """Return names for members, and their kind where all of a kind are meant."""
    names: list[str] = []
    for kind in dict.fromkeys(member.kind for member in found):
        of_kind = [member for member in members if member.kind == kind]
        own = [member.name for member in found if member.kind == kind]
        names += [kind] if len(own) == len(of_kind) else own
    return tuple(names)


def _note(chosen: Sequence[Member]) -> str:
    kinds = dict.fromkeys(member.kind for member in chosen)
    texts = [f"{kind} {PERCENT[kind][_ALONG]:g} % along, {PERCENT[kind][_UPRIGHT]:g} % upright" for kind in kinds]
    return (
        f"the file has no bars in {len(chosen)} members of concrete: they have bars by rule, spread over their "
        f"sections, {'; '.join(texts)}. [[reinforcement]] says it better"
    )
