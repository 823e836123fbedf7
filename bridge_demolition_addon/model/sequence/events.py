"""Events: the shards and connections of each change of a scenario, and its time.

Members, boxes and planes refer to the bridge as it was built, wherever its shards are by then. Tendons are cut
where a change meets their lines.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.tendons import CutTendon
from ...engineering.geometry.vectors import dot, unit
from ...errors import ScenarioError
from ..loads import Part
from ..results.inventory import Inventory
from ..scenario import Change, LiftingAway, Removal, SawCut, TendonCut, Weakening, ZoneFiring
from ..structure.model import Model
from ..structure.tendons import ModelTendons
from .bare_bars import StandingBars, standing_bars
from .departures import Departure, departure_of

_ALONG = math.sqrt(0.5)
"""Cosine of the angle between a plane and a face up to which the plane runs along the face: 45°."""


@dataclass(frozen=True, eq=False, slots=True)
class Structure:
    """Bodies and connections as they were built, among which changes select theirs."""

    centres_m: np.ndarray  # (n, 3), centres of mass
    member_names: np.ndarray  # (n,), of the members that bodies were cut from; empty for one that was not
    member_kinds: np.ndarray  # (n,), as above
    is_shard: np.ndarray  # (n,), shards that can move
    held: np.ndarray  # (n,), shards that never move, as supports hold them
    pairs: np.ndarray  # (m, 2), bodies of the connections
    points_m: np.ndarray  # (m, 3), positions of the connections
    normals: np.ndarray  # (m, 3), unit vectors across their faces
    bearings: np.ndarray  # (b,), connections that are bearings
    boxes_m: np.ndarray  # (n, 2, 3), lowest and highest corners of the bodies
    tendons: ModelTendons | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Event:
    """A change as rows of bodies that it removes, and of connections."""

    time_s: float
    kind: str  # ``removal``, ``saw cut``, ``weakening``, ``blast zone`` or ``tendon cut``
    bodies: np.ndarray  # (b,), bodies that no longer carry: removed, or thrown out of their member
    connections: np.ndarray  # (c,), those that are cut or weakened
    factor: float  # on their strength; 0 for those that are cut
    zone: ZoneFiring | None = None  # of a blast zone
    departure: Departure | None = None  # how the bodies of a blast zone leave their member
    bars: StandingBars | None = None  # those that stay in it
    pressed: float = 1.0  # factor on the strength in compression, beside the factor on all strengths
    tendons: tuple[CutTendon, ...] = ()  # that are cut, and where
    lift: str = ""  # name of the lift that takes the bodies away


def model_structure(model: Model) -> Structure:
    """Return the structure of a model, where all connections to the ground end at one more body after the shards."""
    members = [model.members[member] for member in model.member_of_shard]
    count, held = len(model.shards), np.append(model.fixed, False)
    return Structure(
        centres_m=np.concatenate((model.centres_m, np.zeros((1, 3)))),
        member_names=np.array([*(member.name for member in members), ""]),
        member_kinds=np.array([*(member.kind for member in members), ""]),
        is_shard=np.append(~model.fixed, False),
        held=held,
        pairs=np.where(model.connections.pairs < 0, count, model.connections.pairs),
        points_m=model.connections.points,
        normals=model.connections.normals,
        bearings=model.bearings.springs.rows if model.bearings else np.zeros(0, int),
        boxes_m=np.concatenate((np.array([shard.bounds for shard in model.shards]), np.zeros((1, 2, 3)))),
        tendons=model.tendons,
    )


def recorded_structure(
    inventory: Inventory,
    bearings: np.ndarray,
    centres_m: np.ndarray,
    boxes_m: np.ndarray,
    tendons: ModelTendons | None = None,
) -> Structure:
    """Return the structure of bodies that are recorded, before anything moves.

    `bearings` (b,) are rows of connections, `centres_m` (n, 3) centres of mass of the bodies, `boxes_m` (n, 2, 3) the
    corners of the boxes around them.
    """
    shards = inventory.body_kinds == "shard"
    return Structure(
        centres_m=centres_m,
        member_names=inventory.body_members,
        member_kinds=inventory.body_member_kinds,
        is_shard=shards & inventory.moves,
        held=shards & ~inventory.moves,
        pairs=inventory.pairs,
        points_m=inventory.points_m,
        normals=inventory.normals,
        bearings=bearings,
        boxes_m=boxes_m,
        tendons=tendons,
    )


def schedule(changes: Sequence[Change], structure: Structure) -> tuple[Event, ...]:
    """Return changes as events, in order of time; those of the same time keep their order."""
    return tuple(sorted((_event(change, structure) for change in changes), key=lambda event: event.time_s))


def _event(change: Change, structure: Structure) -> Event:
    bodies, factor, departure = np.zeros(0, int), 0.0, None
    if isinstance(change, TendonCut):
        return Event(
            change.time_s, change.kind, bodies, bodies, 1.0, tendons=cuts_of_tendons(change, structure.tendons)
        )
    match change:
        case Removal():
            inside = in_box(change, structure.centres_m)
            bodies = np.flatnonzero(of_members(change, structure) & inside & structure.is_shard)
            connections = np.flatnonzero(np.isin(structure.pairs, bodies).any(axis=1))
        case SawCut():
            connections = np.flatnonzero(_selected(change, structure) & _sawn(change, structure))
        case Weakening():
            factor = change.factor
            connections = np.flatnonzero(_selected(change, structure))
        case ZoneFiring():
            bodies, connections = _of_zone(change, structure)
            factor = change.left
            if change.takes_away and len(bodies):
                beside = ~of_members(change, structure) & (structure.is_shard | structure.held)
                departure = departure_of(
                    change, structure.centres_m[bodies], structure.boxes_m[bodies], structure.boxes_m[beside]
                )
    if not len(bodies if isinstance(change, Removal | ZoneFiring) else connections):
        raise ScenarioError(f"{change.table} at {change.time_s:g} s: {_why_nothing(change, structure)}")
    tendons = _cut_with(structure, connections, bodies) if factor == 0.0 else ()
    if isinstance(change, ZoneFiring):
        is_in_zone = np.zeros(len(structure.centres_m), bool)
        is_in_zone[bodies] = True
        return Event(
            change.time_s,
            change.kind,
            bodies if departure else bodies[:0],
            connections,
            factor,
            change,
            departure,
            standing_bars(change, is_in_zone, structure.pairs, structure.points_m),
            change.left_by_compression,
            tendons,
        )
    lift = change.name if isinstance(change, LiftingAway) else ""
    return Event(change.time_s, change.kind, bodies, connections, factor, tendons=tendons, lift=lift)


def _cut_with(structure: Structure, connections: np.ndarray, bodies: np.ndarray) -> tuple[CutTendon, ...]:
    """Return where tendons are cut: in connections (c,) that they pass through, or beside bodies (b,) they are in."""
    return tuple(structure.tendons.passages.crossing(connections, bodies)) if structure.tendons else ()


def _of_zone(zone: ZoneFiring, structure: Structure) -> tuple[np.ndarray, np.ndarray]:
    """Return the shards of a blast zone and the connections of them; refuse one that is partly held."""
    inside = of_members(zone, structure) & in_box(zone, structure.centres_m)
    if (inside & structure.held).any():
        raise ScenarioError(
            f"blast_zones {json.dumps(zone.name, ensure_ascii=False)}: [[supports]] hold "
            f"{', '.join(zone.members or ())} there, which cannot be blasted away; move the zone, or take the member "
            "out of [[supports]] and have connections.foundation hold its foot"
        )
    bodies = np.flatnonzero(inside & structure.is_shard)
    return bodies, np.flatnonzero(np.isin(structure.pairs, bodies).any(axis=1))


def _why_nothing(change: Change, structure: Structure) -> str:
    """Return why a change concerns nothing, and what to do."""
    chosen = of_members(change, structure) & in_box(change, structure.centres_m)
    things = "shard" if isinstance(change, Removal | ZoneFiring) else "connection"
    if (chosen & structure.is_shard).any() or not (chosen & structure.held).any():
        return f"no {things} of the bridge is there; expected members, a box or a plane that meet some"
    names = ", ".join(sorted(set(structure.member_names[chosen & structure.held].tolist())))
    if isinstance(change, Removal):
        return (
            f"{names} cannot be taken away, as [[supports]] hold all of it that is meant; cut off what rests on it "
            "with [[saw_cuts]], or take it out of [[supports]] and have connections.foundation hold its foot"
        )
    return (
        f"{names} has no connection there, as [[supports]] hold all of it that is meant; expected members, a box or a "
        "plane that meet a connection to what can move"
    )


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
    return np.ones(len(positions_m), bool) if part.box is None else part.box.contains(positions_m)


def _sawn(cut: SawCut, structure: Structure) -> np.ndarray:
    """Return whether a saw cut parts each connection (m,), whose bodies lie on the two sides of its plane.

    Within the members it parts all of them. A bearing, or what joins the members to others, is parted only by a plane
    that runs along its face: a deck that is sawn lengthways stays on its bearings, wherever their middles are.
    """
    within = of_members(cut, structure)[structure.pairs].all(axis=1)
    within[structure.bearings] = False
    along = np.abs(dot(structure.normals, unit(np.array(cut.normal)))) > _ALONG
    return (within | along) & _crosses(cut, structure)


def _crosses(cut: SawCut, structure: Structure) -> np.ndarray:
    """Return whether the two bodies of each connection (m,) lie on the two sides of the plane.

    The ground has no meaningful centre: the shard's, mirrored in the connection's point, stands for it.
    """
    ends = structure.centres_m[structure.pairs]
    solid = (structure.is_shard | structure.held)[structure.pairs]
    mirrored = 2.0 * structure.points_m[:, None] - ends[:, ::-1]
    ends = np.where(solid[:, :, None], ends, mirrored)
    sides = dot(ends - np.array(cut.point_m), np.array(cut.normal)) > 0.0
    return sides[:, 0] != sides[:, 1]


def cuts_of_tendons(change: TendonCut, tendons: ModelTendons | None) -> tuple[CutTendon, ...]:
    """Return the cuts; refuse a change that meets no tendon, or a bonded one without saying where."""
    cuts = tuple(_cuts(change, tendons)) if tendons else ()
    if not cuts:
        raise ScenarioError(
            f"{change.table} at {change.time_s:g} s: no tendon is there; "
            "expected names, members or a box that meet some"
        )
    return cuts


def cut_text(cuts: tuple[CutTendon, ...], tendons: ModelTendons) -> str:
    """Return which tendons are cut, where, and which energy they let go, of tendons that were whole."""
    released_j = tendons.forces(*_anywhere(tendons)).cut(cuts)
    parts = []
    for number in sorted({cut.tendon for cut in cuts}):
        at = next(cut.distance_m for cut in cuts if cut.tendon == number)
        x, y, z = tendons.point_at(number, at).tolist()
        parts.append(
            f"{tendons.names[number]} in {tendons.members[number]} at ({x:.2f}, {y:.2f}, {z:.2f}) m, "
            f"{released_j[number] / 1000.0:.1f} kJ let go"
        )
    return "; ".join(parts)


def _cuts(change: TendonCut, tendons: ModelTendons) -> Iterator[CutTendon]:
    for number, (name, member) in enumerate(zip(tendons.names, tendons.members, strict=True)):
        if change.tendons is not None and name not in change.tendons:
            continue
        if change.members is not None and member not in change.members:
            continue
        if change.box is None:
            if tendons.steel.bonded[number]:
                raise change.unexpected(
                    "lowest_corner_m",
                    f"both corners of a box, as {json.dumps(name, ensure_ascii=False)} is bonded and lets go only near "
                    "the cut",
                )
            yield CutTendon(number, 0.0)
            continue
        at_m = tendons.within_box(number, change.box)
        if at_m is not None:
            yield CutTendon(number, at_m)


def _anywhere(tendons: ModelTendons) -> tuple[np.ndarray, np.ndarray]:
    """Positions (3, n) and rotations (3, 3, n) of as many bodies as tendons pass."""
    count = int(max(tendons.passages.first.max(), tendons.passages.second.max())) + 1
    return np.zeros((3, count)), np.repeat(np.eye(3)[:, :, None], count, axis=2)
