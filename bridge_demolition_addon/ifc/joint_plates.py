"""Plates and stubs at joints of bars of steel: no members, but mass on the nodes there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from .assembly import Assembly
from .contacts import NearbyMembers
from .outcome import LEFT_OUT
from .steel_elements import STEEL, SteelElement

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
