"""Connections of a model by their source: each kind adds its own, and says what it knows better than faces of shards.

A new kind is one module with a `ConnectionSource`, named in `model.SOURCES`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from ...engineering.foundations import SoilSprings
from ...engineering.fracture.shared_faces import SharedFaces
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.structure import connections as connecting
from ...engineering.structure.connections import Connections, second_moments
from ..bridge.member import Member
from ..scenario import Scenario
from ..scenario.scenario import JointName
from ..terrain.built import BuiltGround
from .model_bearings import ModelBearings

_Part = TypeVar("_Part")


@dataclass(frozen=True, slots=True, eq=False)
class CutMembers:
    """Members, and the n shards that they were cut into.

    Attributes
    ----------
    members, member_of_shard : sequence of Member, (n,) int
        The members, and which of them each shard is of.
    shards, points_m : n TriangleMesh, (n, 3) float
        The shards, and the points from which they extend to their faces: those whose Voronoi cells they are.
    fixed : (n,) bool
        Shards that never move: like the ground, they do not deform.
    in_lattices : (k,) bool
        Members that are cut around a lattice of points.
    """

    members: Sequence[Member]
    member_of_shard: np.ndarray
    shards: Sequence[TriangleMesh]
    points_m: np.ndarray
    fixed: np.ndarray
    in_lattices: np.ndarray

    def members_of(self, pairs: np.ndarray) -> np.ndarray:
        """Return the members (k, 2) of pairs (k, 2) of shards, -1 for the ground."""
        return np.append(self.member_of_shard, -1)[pairs]


@dataclass(frozen=True, slots=True, eq=False)
class CutBridge(CutMembers):
    """A bridge in shards, on its ground, with centres of mass (n, 3) and the faces that shards share."""

    scenario: Scenario
    centres_m: np.ndarray
    faces: SharedFaces
    ground: BuiltGround
    joint_rows: dict[JointName, int]  # of the scenario's joints


@dataclass(frozen=True, slots=True, eq=False)
class ConnectionRows:
    """m connections, source after source.

    Attributes
    ----------
    joints : (m,) int
        Which of the scenario's joints each has.
    origins : (m,) str
        The source that each is from.
    moments_m4 : (m, 2, 2) float
        Second moments of area.
    bearings : ModelBearings or None
        Springs of some.
    bars : FaceBars or None
        Bars across all.
    parts : tuple
        What sources know of their own rows.
    """

    connections: Connections
    joints: np.ndarray
    origins: np.ndarray
    moments_m4: np.ndarray
    bearings: ModelBearings | None = None
    bars: FaceBars | None = None
    parts: tuple[object, ...] = ()

    @classmethod
    def none(cls) -> ConnectionRows:
        """Return no connections."""
        empty = Connections(np.zeros((0, 2), int), np.zeros((0, 3)), np.zeros(0), np.zeros((0, 3)))
        return cls(empty, np.zeros(0, int), np.zeros(0, str), np.zeros((0, 2, 2)))

    def __len__(self) -> int:
        return len(self.joints)

    @property
    def sprung(self) -> np.ndarray:
        """Rows (k,) that springs are in: of bearings, then of soil."""
        springs = [self.bearings.springs] if self.bearings else []
        return np.concatenate([np.zeros(0, int), *(part.rows for part in (*springs, self.part(SoilSprings)) if part)])

    @property
    def bars_or_none(self) -> FaceBars:
        """Return the bars across all connections, also where there are none yet."""
        return self.bars or FaceBars.none(len(self))

    def part(self, kind: type[_Part]) -> _Part | None:
        """Return what a source knows of its rows; None where there is nothing of its kind."""
        return next((part for part in self.parts if isinstance(part, kind)), None)

    def followed_by(
        self,
        cut: CutBridge,
        origin: str,
        connections: Connections,
        joints: np.ndarray,
        moments_m4: np.ndarray | None = None,
    ) -> tuple[ConnectionRows, np.ndarray]:
        """Return these connections and the moving ones among c others of a source; and which (c,) move.

        Without moments the others take their shards' faces.
        """
        moves = ~np.append(cut.fixed, True)[connections.pairs].all(axis=1)  # the ground, at index -1, is fixed as well
        kept = connections.only(moves)
        if moments_m4 is None:
            moments = second_moments(cut.shards, kept.pairs[:, 0], kept.areas, kept.points, kept.normals)
        else:
            moments = moments_m4[moves]
        joined = replace(
            self,
            connections=connecting.joined([self.connections, kept]),
            joints=np.concatenate((self.joints, joints[moves])),
            origins=np.concatenate((self.origins, np.full(len(kept), origin))),
            moments_m4=np.concatenate((self.moments_m4, moments)),
        )
        return joined, moves

    def claimed(self, mine: np.ndarray, origin: str, **columns: np.ndarray) -> ConnectionRows:
        """Return these connections where some (k,) are of another source, which knows values of some columns."""
        origins = self.origins.astype(object)
        origins[mine] = origin
        changed = {name: getattr(self, name).copy() for name in columns}
        for name, values in columns.items():
            changed[name][mine] = values
        return replace(self, origins=origins.astype(str), **changed)

    def on_bearings(self, bearings: ModelBearings) -> ConnectionRows:
        """Return these connections with bearings in some, after those that are there."""
        return replace(self, bearings=self.bearings.followed_by(bearings) if self.bearings else bearings)

    def with_part(self, part: object) -> ConnectionRows:
        """Return these connections with what a source knows of its own."""
        return replace(self, parts=(*(one for one in self.parts if type(one) is not type(part)), part))


class ConnectionSource:
    """A kind of connections of a bridge. All are asked for one thing before any is asked for the next."""

    def __init__(self, cut: CutBridge):
        self.cut = cut

    def takes(self, pairs: np.ndarray) -> np.ndarray:
        """Return which pairs (k, 2) of shards, or of one and the ground, are never connected by their faces."""
        return np.zeros(len(pairs), bool)

    def added(self, rows: ConnectionRows) -> ConnectionRows:
        """Return the connections of other kinds, and its own after them."""
        return rows

    def barred(self, rows: ConnectionRows) -> ConnectionRows:
        """Return all connections with the bars that it has across them."""
        return rows

    def stiffen(self, rows: ConnectionRows, matrices: np.ndarray) -> None:
        """Set the stiffness (m, 6, 6) of its connections, where it differs from faces."""

    def shaped(self, shards: tuple[TriangleMesh, ...]) -> tuple[TriangleMesh, ...]:
        """Return shards with gaps as bodies have them."""
        return shards
