"""Which connections follow rules of their own, by the members that they hold together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...errors import ScenarioError
from ..bridge.member import Member
from ..scenario.connections_between import GROUND_NAME, ConnectionBetween


def rules_of_pairs(
    rules: Sequence[ConnectionBetween], members: Sequence[Member], member_of_shard: np.ndarray, pairs: np.ndarray
) -> np.ndarray:
    """Return which rule pairs of shards follow, (k,) int: 0 for none, 1 for the first, and so on.

    The first rule counts that names both members. `member_of_shard` (n,) holds indices of members, `pairs` (k, 2) those
    of shards, or -1 for the ground.
    """
    ground = len(members)
    rule_between = np.zeros((ground + 1, ground + 1), int)
    for number, rule in reversed(list(enumerate(rules, start=1))):
        first, second = (_named(members, name, number) for name in rule.members)
        rule_between[np.ix_(first, second)] = number
        rule_between[np.ix_(second, first)] = number
    of_body = np.append(member_of_shard, ground)  # the ground is -1, the last
    return rule_between[of_body[pairs[:, 0]], of_body[pairs[:, 1]]]


def _named(members: Sequence[Member], name: str, number: int) -> list[int]:
    """Indices of the members of a name or kind."""
    chosen = [index for index, member in enumerate(members) if name in (member.name, member.kind)]
    if name == GROUND_NAME:
        chosen.append(len(members))
    if not chosen:
        kinds = ", ".join(sorted({member.kind for member in members} | {GROUND_NAME}))
        raise ScenarioError(
            f'[[connections.between]] number {number}: members has "{name}": '
            f"expected the name of a member, as bda check lists them, or one of {kinds}"
        )
    return chosen
