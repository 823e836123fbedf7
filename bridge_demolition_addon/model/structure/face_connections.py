"""Connections of shards that are neighbours, and of those that stand on the ground, by the rules of their members."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.structure import connections as connecting
from ...engineering.structure.connections import Connections
from ...errors import ScenarioError
from ..bridge.member import Member
from ..scenario.joint_settings import GROUND_NAME, ConnectionBetween
from ..scenario.scenario import JointName
from ..schema import given
from .connection_source import ConnectionRows, ConnectionSource, CutBridge


class FaceConnections(ConnectionSource):
    """Connections of the pairs that no other source takes."""

    def __init__(self, cut: CutBridge, others: Sequence[ConnectionSource]):
        super().__init__(cut)
        self._others = others

    def takes(self, pairs: np.ndarray) -> np.ndarray:
        """Return which pairs (k, 2) have no connection by their rule."""
        return np.array([False, *(rule.none for rule in self.cut.scenario.connections.between)])[self._rules_of(pairs)]

    def added(self, rows: ConnectionRows) -> ConnectionRows:
        """Return connections of neighbours as the scenario has them, and of what stands on the ground."""
        connections = self._between_shards()
        if self.cut.scenario.connections.foundation:
            terrain = self.cut.ground.terrain
            standing = connecting.foundations(self.cut.shards, None if terrain is None else terrain.heights_at)
            connections = connecting.joined([connections, standing.only(self._are_free(standing.pairs))])
        rules = range(1 + len(self.cut.scenario.connections.between))
        joints = [self.cut.joint_rows[JointName("rule", number)] for number in rules]
        return rows.followed_by(self.cut, "faces", connections, np.array(joints)[self._rules_of(connections.pairs)])[0]

    def _rules_of(self, pairs: np.ndarray) -> np.ndarray:
        cut = self.cut
        return rules_of_pairs(cut.scenario.connections.between, cut.members, cut.member_of_shard, pairs)

    def _are_free(self, pairs: np.ndarray) -> np.ndarray:
        return ~np.any([source.takes(pairs) for source in (self, *self._others)], axis=0)

    def _between_shards(self) -> Connections:
        settings, cut = self.cut.scenario.connections, self.cut
        match settings.method:
            case "face":
                pairs, distances = connecting.neighbours_by_face(cut.faces)
            case "centre":
                pairs, distances = connecting.neighbours_by_centre(cut.centres_m, given(settings.search_radius_m))
            case "vertex":
                pairs, distances = connecting.neighbours_by_vertex(cut.shards, given(settings.search_radius_m))
            case "nearest":
                pairs, distances = connecting.neighbours_by_count(cut.centres_m, given(settings.neighbours))
        free = self._are_free(pairs)
        return connecting.connect(cut.centres_m, cut.faces, pairs[free], distances[free], settings.limit_per_shard)


def rules_of_pairs(
    rules: Sequence[ConnectionBetween], members: Sequence[Member], member_of_shard: np.ndarray, pairs: np.ndarray
) -> np.ndarray:
    """Return which rule pairs of shards follow, (k,) int: 0 for none, 1 for the first, and so on.

    The first rule counts that names both members. `member_of_shard` (n,) holds indices of members, `pairs` (k, 2)
    indices of shards, or -1 for the ground.
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
