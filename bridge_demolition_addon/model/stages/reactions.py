"""Reactions: force and moment of each support on the bridge."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import cross
from ...engineering.mechanics.section_cuts import ConnectionLoads
from ...engineering.structure.connections import GROUND
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..structure.model import Model

KINDS = SUPPORT, FOUNDATION = "support", "foundation"
"""A part of a member that `[[supports]]` hold, and a member that stands on the ground by `connections.foundation`."""


@dataclass(frozen=True, slots=True, eq=False)
class SupportPoint:
    """A part of the bridge that does not move, and the connections through which it carries the rest.

    Attributes
    ----------
    name, kind : str
        Member, with the held face where several of its faces are held by themselves, and one of `KINDS`.
    rows, signs : (c,) int, (c,) float
        Connections between it and what moves, and 1 where their first body moves, -1 where it is the second.
    point_m : (3,) float
        Middle of the held face, or of what stands on the ground; of a member that is held as a whole, the middle of its
        faces with what moves.
    own_weight_n : float
        Weight of the shards that are held: no connection carries it, and it is no part of the reaction.
    """

    name: str
    kind: str
    rows: np.ndarray
    signs: np.ndarray
    point_m: np.ndarray
    own_weight_n: float

    def reaction(self, loads: ConnectionLoads) -> tuple[np.ndarray, np.ndarray]:
        """Return force (3,), N, and moment (3,) about its point, N·m, on the bridge, by loads of connections (m,)."""
        forces = self.signs[:, None] * loads.forces_n[self.rows]
        moments = self.signs[:, None] * loads.moments_nm[self.rows]
        levers = loads.points_m[self.rows] - self.point_m
        return forces.sum(axis=0), (moments + cross(levers, forces)).sum(axis=0)


def supports_of(model: Model) -> tuple[SupportPoint, ...]:
    """Return the supports of a model that carry something: first what `[[supports]]` hold, then what stands."""
    return (*_held(model), *_standing(model))


def _held(model: Model) -> list[SupportPoint]:
    faces_of = Counter(part.member for part in model.held_parts)
    supports = []
    for part in model.held_parts:
        ours = np.zeros(len(model.shards) + 1, bool)
        ours[part.shards] = True
        first, second = ours[model.connections.pairs].T
        rows = np.flatnonzero(first != second)
        if not len(rows):
            continue
        name = model.members[part.member].name
        supports.append(
            SupportPoint(
                name=f"{name}, {part.face}" if faces_of[part.member] > 1 else name,
                kind=SUPPORT,
                rows=rows,
                signs=np.where(second[rows], 1.0, -1.0),
                point_m=_middle(model, rows) if part.centre_m is None else part.centre_m,
                own_weight_n=STANDARD_GRAVITY_M_S2 * float(model.masses_kg[part.shards].sum()),
            )
        )
    return supports


def _standing(model: Model) -> list[SupportPoint]:
    first, second = model.connections.pairs.T
    on_ground = np.flatnonzero(second == GROUND)
    members = model.member_of_shard[first[on_ground]]
    supports = []
    for member in dict.fromkeys(members.tolist()):
        rows = on_ground[members == member]
        name, point_m = model.members[member].name, _middle(model, rows)
        supports.append(SupportPoint(name, FOUNDATION, rows, np.ones(len(rows)), point_m, 0.0))
    return supports


def _middle(model: Model, rows: np.ndarray) -> np.ndarray:
    """Middle (3,) of the faces of connections (c,); where they have no area, the mean of their points."""
    points, areas = model.connections.points[rows], model.connections.areas[rows]
    return np.average(points, axis=0, weights=areas if areas.sum() > 0.0 else None)
