"""Events: which shards and connections each change of a scenario concerns, and when.

Members, boxes and planes mean the bridge as it was built, wherever its shards are by then.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import dot
from ...errors import ScenarioError
from ..loads.part import Part
from ..results.inventory import Inventory
from ..scenario import Change, Removal, SawCut, Weakening
from ..structure.model import Model


@dataclass(frozen=True, eq=False, slots=True)
class Structure:
    """Bodies and connections as they were built, among which those are found that a change concerns.

    Attributes
    ----------
    centres_m : (n, 3) float
        Centres of mass.
    member_names, member_kinds : (n,) str
        Name and kind of the member that each body was cut from; empty for one that was not.
    is_shard : (n,) bool
        Whether each body is a shard that can move.
    pairs : (m, 2) int
        Bodies of the connections.
    points_m : (m, 3) float
        Where the connections are.
    """

    centres_m: np.ndarray
    member_names: np.ndarray
    member_kinds: np.ndarray
    is_shard: np.ndarray
    pairs: np.ndarray
    points_m: np.ndarray


@dataclass(frozen=True, eq=False, slots=True)
class Event:
    """A change as rows of bodies that it removes, and of connections.

    Attributes
    ----------
    time_s : float
        When it happens.
    kind : str
        ``removal``, ``saw cut`` or ``weakening``.
    bodies : (b,) int
        Bodies that are removed.
    connections : (c,) int
        Connections that are cut or weakened.
    factor : float
        Part of the strength of these that is left: 0 for those that are cut.
    """

    time_s: float
    kind: str
    bodies: np.ndarray
    connections: np.ndarray
    factor: float


def model_structure(model: Model) -> Structure:
    """Return the structure of a model, where all connections to the ground end at one more body after the shards."""
    members = [model.members[member] for member in model.member_of_shard]
    count = len(model.shards)
    return Structure(
        centres_m=np.concatenate((model.centres_m, np.zeros((1, 3)))),
        member_names=np.array([*(member.name for member in members), ""]),
        member_kinds=np.array([*(member.kind for member in members), ""]),
        is_shard=np.arange(count + 1) < count,
        pairs=np.where(model.connections.pairs < 0, count, model.connections.pairs),
        points_m=model.connections.points,
    )


def recorded_structure(inventory: Inventory, centres_m: np.ndarray) -> Structure:
    """Return the structure of bodies that are recorded, with their centres of mass (n, 3) before anything moves."""
    return Structure(
        centres_m=centres_m,
        member_names=inventory.body_members,
        member_kinds=inventory.body_member_kinds,
        is_shard=(inventory.body_kinds == "shard") & inventory.moves,
        pairs=inventory.pairs,
        points_m=inventory.points_m,
    )


def schedule(changes: Sequence[Change], structure: Structure) -> tuple[Event, ...]:
    """Return changes as events, in order of time; those of the same time in the order in which they are given."""
    return tuple(sorted((_event(change, structure) for change in changes), key=lambda event: event.time_s))


def _event(change: Change, structure: Structure) -> Event:
    nothing = np.zeros(0, int)
    bodies = nothing
    factor = 0.0
    match change:
        case Removal():
            inside = in_box(change, structure.centres_m)
            bodies = np.flatnonzero(of_members(change, structure) & inside & structure.is_shard)
            connections = np.flatnonzero(np.isin(structure.pairs, bodies).any(axis=1))
        case SawCut():
            connections = np.flatnonzero(_selected(change, structure) & _crosses(change, structure))
        case Weakening():
            factor = change.factor
            connections = np.flatnonzero(_selected(change, structure))
    if not len(bodies if isinstance(change, Removal) else connections):
        things = "shard" if isinstance(change, Removal) else "connection"
        raise ScenarioError(
            f"{change.table} at {change.time_s:g} s: no {things} of the bridge is there; "
            "expected members, a box or a plane that meet some"
        )
    return Event(change.time_s, change.kind, bodies, connections, factor)


def _selected(change: Change, structure: Structure) -> np.ndarray:
    """Return whether each connection (m,) has a shard of the members and is in the box."""
    return of_members(change, structure)[structure.pairs].any(axis=1) & in_box(change, structure.points_m)


def of_members(part: Part, structure: Structure) -> np.ndarray:
    """Return whether each body (n,) is of the members; all where none are named."""
    if part.members is None:
        return np.ones(len(structure.centres_m), bool)
    names, kinds = structure.member_names, structure.member_kinds
    known = sorted({*names.tolist(), *kinds.tolist()} - {""})
    for name in part.members:
        if name not in known:
            raise ScenarioError(
                f"{part.table}.members names {json.dumps(name, ensure_ascii=False)}: "
                f"expected names or kinds of members, which are {', '.join(known) or 'not known here'}"
            )
    return np.isin(names, part.members) | np.isin(kinds, part.members)


def in_box(part: Part, positions_m: np.ndarray) -> np.ndarray:
    """Return whether positions (k, 3) are in the box; all where there is none."""
    if part.lowest_corner_m is None:
        return np.ones(len(positions_m), bool)
    return ((positions_m >= part.lowest_corner_m) & (positions_m <= part.highest_corner_m)).all(axis=1)


def _crosses(cut: SawCut, structure: Structure) -> np.ndarray:
    """Return whether the two bodies of each connection (m,) lie on the two sides of the plane.

    The ground has no centre that means anything: on its side stands the shard's, mirrored in the connection's point.
    """
    ends = structure.centres_m[structure.pairs]
    solid = structure.is_shard[structure.pairs]
    mirrored = 2.0 * structure.points_m[:, None] - ends[:, ::-1]
    ends = np.where(solid[:, :, None], ends, mirrored)
    sides = dot(ends - np.array(cut.point_m), np.array(cut.normal)) > 0.0
    return sides[:, 0] != sides[:, 1]
