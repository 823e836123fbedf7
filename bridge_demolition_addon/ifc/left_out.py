"""Elements that are no members: light bracing and plates at joints, whose mass is on what they join, and approach slabs
that would hold down what moves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..model.bridge.member import Member
from .assembly import Assembly
from .contacts import NearbyMembers
from .outcome import LEFT_OUT
from .steel_elements import STEEL, SteelElement

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


_LONGEST, _MASS = 2.5, 0.5
"""Longest extent of a plate at a joint by the size of the bar that it touches, and its mass by that of the bar."""

JOINT_GAP_M = 0.003
"""Gap up to which a plate belongs to a bar, or a bearing lies on it."""


@dataclass(frozen=True, slots=True)
class JointPlate:
    """A plate at a joint of bars: where it is (3,), and its mass."""

    position_m: np.ndarray
    mass_kg: float


def leave_out_plates(assembly: Assembly, bars: Mapping[int, SteelElement]) -> list[JointPlate]:
    """Leave out plates and stubs of steel at joints of bars, and return them: their mass goes to the nodes."""
    members = assembly.members()
    own = [(number, member) for number, member in members if number in bars]
    contacts = NearbyMembers([member.solid for _, member in own])
    plates = []
    for number, member in members:
        substance = assembly.outcomes[number].substance
        if number in bars or substance is None or substance.row.strength_name != STEEL:
            continue
        longest = float(np.ptp(member.solid.vertices, axis=0).max())
        for gap, row in contacts.near_to(member.solid):
            bar = bars[own[row][0]]
            is_small = longest <= _LONGEST * float(bar.steel_section.size_m.max())
            if gap <= JOINT_GAP_M and is_small and member.mass_kg <= _MASS * own[row][1].mass_kg:
                plates.append(JointPlate(member.solid.bounds.mean(axis=0), member.mass_kg))
                outcome = assembly.outcomes[number]
                why = "a plate or stub at a joint of bars: its mass is on the node that is nearest to it"
                assembly.outcomes[number] = replace(outcome, member=None, substance=None, became=LEFT_OUT, why=why)
                break
    return plates


_UNDER_M = 0.02
"""How far below a slab a member may end that it lies on."""

_MOVING = ("deck", "girder")


def leave_out_clamping_slabs(assembly: Assembly) -> None:
    """Leave out approach slabs that lie on decks, girders or what else is carried by bearings.

    Soil under a slab holds it from below alone. As a member that never moves it would hold the end of a deck down, too.
    """
    members = assembly.members()
    contacts = NearbyMembers([member.solid for _, member in members])
    on_bearings = {table.members[0] for table in assembly.bearing_tables().bearings}
    for number, member in members:
        if member.kind != "approach slab":
            continue
        below = [members[row][1] for row in contacts.reached(member.solid, -_UNDER_M)]
        moving = [other.name for other in below if other.kind in _MOVING or other.name in on_bearings]
        if moving:
            assembly.leave_out(
                number, f"it lies on {' and '.join(moving)}, which it would hold down as it never moves itself"
            )
