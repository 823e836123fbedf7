"""How finely an imported bridge is cut: what is long and slender gets shards by its length, not by its volume."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

import numpy as np

from ..engineering.geometry.solids import to_manifold
from ..model.bridge.member import Member
from ..model.scenario import FractureSettings
from ..model.scenario.fracture import MemberFracture
from ..model.structure.members import shards_per_member

_SLENDER = ("girder", "arch", "bracing", "parapet", "member", "pier cap")
_LONGEST = 3.0
"""Length of a shard of a slender member by the height of its section: a longer one of a curved girder would reach far
beside it, as what meets others in a run is the hull of a shard."""

_CURVED = 6.0
"""Volume of the hull by that of the member from which on its width is that of a curve: open sections have up to 4."""


def fracture_of(members: Sequence[Member], held: Collection[str], shards: int) -> FractureSettings:
    """Return how members are cut into about so many shards; those that are `held` never move, and need no more."""
    volumes = np.array([member.volume_m3 for member in members])
    by_volume = shards_per_member(volumes, max(shards, len(members)))
    rules, more = [], 0
    for member, count in zip(members, by_volume.tolist(), strict=True):
        least = 1 if member.name in held or member.kind not in _SLENDER else _least_count(member)
        if least > count:
            rules.append(MemberFracture(member=member.name, shards=least))
            more += least - count
    return FractureSettings(shards=int(by_volume.sum()) + more, members=tuple(rules))


def _least_count(member: Member) -> int:
    longest, middle, least = np.sort(np.ptp(member.solid.vertices, axis=0))[::-1].tolist()
    is_curved = to_manifold(member.solid).hull().volume() > _CURVED * member.volume_m3
    return math.ceil(longest / (_LONGEST * (least if is_curved else middle)))
