"""Bracing that is much lighter than a shard: no member, but mass on what it braces."""

from __future__ import annotations

import math
from dataclasses import replace

from ..model.bridge.member import Member
from .assembly import Assembly
from .outcome import LEFT_OUT

_BRACED = ("girder", "arch", "deck")

_LIGHT = 0.25
"""Mass of bracing by that of a mean shard up to which it is no member."""


def leave_out_light_bracing(assembly: Assembly, shards: int) -> None:
    """Leave out bracing that is much lighter than a mean shard, and put its mass on what it braces.

    Bracing far lighter than its neighbours only adds noise to the solver.
    """
    members, outcomes = [one for one in assembly.members() if one[0] not in assembly.bars], assembly.outcomes
    limit_kg = _LIGHT * math.fsum(member.mass_kg for _, member in members) / shards
    light = [(number, member) for number, member in members if _is_light_bracing(member, limit_kg)]
    of_kinds = ([one for one in members if one[1].kind == kind] for kind in _BRACED)
    braced = next(filter(None, of_kinds), [])
    if not light or not braced:
        return
    mass_kg = math.fsum(member.mass_kg for _, member in light)
    share = 1.0 + mass_kg / math.fsum(member.mass_kg for _, member in braced)
    for number, member in braced:
        heavier = replace(member, density_kg_m3=share * member.mass_kg / member.volume_m3)
        outcomes[number] = replace(outcomes[number], member=heavier)
    why = "bracing that is much lighter than a shard: its mass is on what it braces"
    for number, _ in light:
        outcomes[number] = replace(outcomes[number], member=None, substance=None, became=LEFT_OUT, why=why)
    assembly.notes.append(
        f"{len(light)} parts of bracing, each lighter than {limit_kg:.0f} kg, are left out: their "
        f"{mass_kg / 1e3:.1f} t are on members of the kind {braced[0][1].kind}, which are "
        f"{100.0 * (share - 1.0):.1f} % denser"
    )


def _is_light_bracing(member: Member, limit_kg: float) -> bool:
    return member.kind == "bracing" and member.mass_kg < limit_kg
