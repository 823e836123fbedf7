"""Whether a bridge stands under its own weight before anything is done: one verdict by statics, with its reasons."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...engineering.core.library import missing_core
from ...engineering.elasticity.equations import connected_parts
from ...engineering.geometry.level_contacts import level_contacts
from ...engineering.geometry.proximity import boxes_that_meet
from ...engineering.units import mass_text
from ...errors import DemolitionError
from ...texts import Text, joined
from ..bridge.member import Member
from ..results.stability import (
    COMES_DOWN,
    LARGEST_FACTOR,
    STANDS,
    UNKNOWN,
    MemberShare,
    OverloadedMember,
    Stability,
)
from ..scenario import Scenario
from ..scenario.bearings import SLIDING, Bearing
from ..sequence.unusual import unusual_texts
from ..structure.cracking import FALLEN_SHARE, RestingModel
from ..structure.model import Model, build_model
from ..structure.section_use import SectionsWithBars
from ..structure.zone_loads import zone_loads
from .standing import StandingBridge, made_elastic, most_used_of

MOST_SHARDS_WITH_FACTOR = 400
"""Shards up to which a load factor takes seconds, where neither bars nor bearings make it slow."""

MOST_SHARDS_FOLLOWED = 600
"""Shards up to which breaks are followed one after another where no load factor is asked for: of 500 in 1 s, of 1000 in
5 s, of 2000 in 18 s of processor time."""

_MOST_NAMED = 3

_FIXED, _HINGE = "FIXED", "HINGE"


def stability_of(
    scenario: Scenario,
    model: Model | None = None,
    *,
    with_factor: bool | None = True,
    pause: Callable[[], None] = lambda: None,
    resting: RestingModel | None = None,
) -> Stability:
    """Return whether the bridge of a scenario stands under its own weight.

    Statics follows elastic connections, also where the run's are rigid or break by one force. What merely lies on
    others is held by bearings that hold no uplift, where faces are level. Without `with_factor` no load factor is
    looked for, which takes most of the time, and breaks of large models are not followed; None has one where it takes
    seconds. Calls `pause` before each solution. What `resting` has worked out is taken from there.
    """
    model = model or build_model(scenario)
    known: dict[str, Any] = {
        "is_asleep": scenario.shards.start_deactivated,
        "is_rigid": not scenario.connections.is_elastic,
        "connections": len(model.connections),
        "unusual": unusual_texts(scenario, model),
    }
    paths = support_paths(model)
    known["unsupported"] = _counted(model, _without_splinters(model, paths.falling))
    known["loose"] = _counted(model, _without_splinters(model, paths.loose))
    if known["unsupported"]:
        return Stability(verdict=COMES_DOWN, reason=Text("nothing holds {}", _named(known["unsupported"])), **known)
    if (method := scenario.connections.method) != "face":
        reason = Text('connections.method is "{}": without the faces of shards there are no stresses', method)
        if known["loose"]:
            reason = Text("{}, and {} lie loose", reason, _named(known["loose"]))
        return Stability(verdict=UNKNOWN, reason=reason, **known)
    if missing := missing_core():
        return Stability(verdict=UNKNOWN, reason=str(missing), **known)
    try:
        contacts = _loose_contacts(model, paths) if known["loose"] else []
        on_bearings = _with_bearings(scenario, model.members, contacts)
        elastic = made_elastic(_without_hinges(on_bearings))
        if elastic != scenario:
            model, resting = build_model(elastic, model.members), None
    except DemolitionError as error:
        return Stability(verdict=UNKNOWN, reason=str(error), **known)
    known["loose_on"] = tuple(
        Text("{} on {}", model.members[one].name, model.members[other].name) for one, other in contacts
    )
    paths_on_bearings = support_paths(model)
    if still := _counted(model, _without_splinters(model, paths_on_bearings.loose)):
        known["loose_on"] = ()
        reason = Text("{} lie loose, held by contact alone, which statics does not follow", _named(still))
        return Stability(verdict=UNKNOWN, reason=reason, **known)
    bridge = StandingBridge(model, on_bearings.joints, pause, resting)
    return _by_statics(bridge, elastic, paths_on_bearings, known, with_factor=with_factor)


def _by_statics(
    bridge: StandingBridge,
    scenario: Scenario,
    paths: SupportPaths,
    known: dict[str, Any],
    *,
    with_factor: bool | None,
) -> Stability:
    model = bridge.model
    if with_factor is None:
        is_simple = model.crack_bars is None and model.bearings is None
        with_factor = is_simple and len(model.shards) <= MOST_SHARDS_WITH_FACTOR
    ones, nothing = np.ones(len(model.connections)), np.zeros((6, len(model.shards)))
    standing = bridge.rest(ones > 0.0, ones, nothing)
    if turning := _counted(model, _without_splinters(model, paths.connected & ~model.fixed & ~standing.held)):
        reason = Text("nothing keeps {} from turning over or sliding off", _named(turning))
        is_on_contact = bool(known["loose_on"])  # a line of contact holds less than the area that lies there
        return Stability(verdict=UNKNOWN if is_on_contact else COMES_DOWN, reason=reason, **known)
    known["zones"] = zone_loads(scenario.blast_zones, model, standing.loads)
    used = np.where(np.isfinite(standing.used), standing.used, 0.0)
    if most := most_used_of(bridge, SectionsWithBars(scenario, model), standing):
        known["utilisation"], known["used_most"], known["used_of"] = most.used, most.between[0], most.words
    known["deflection_m"], known["cracked"] = standing.sag_m, int(standing.cracked.sum())
    known["overloaded"] = _overloaded(model, used)
    known["overloaded_connections"] = int((used > 1.0).sum())
    if known["overloaded"] and len(model.shards) > MOST_SHARDS_FOLLOWED and not with_factor:
        parts = joined("{}, {}", [part.member for part in known["overloaded"][:_MOST_NAMED]])
        reason = Text(
            "connections of {} are overloaded, and what breaks then takes long to work out (bda check --stand)", parts
        )
        return Stability(verdict=UNKNOWN, reason=reason, **known)
    fallen = bridge.comes_down(ones > 0.0, ones, nothing, 1.0)
    if with_factor:
        factor = min(bridge.collapse_factor(ones > 0.0, ones, nothing), LARGEST_FACTOR)
        known["load_factor"] = float(factor) if np.isfinite(factor) else None
    if not fallen.any():
        return Stability(verdict=STANDS, **known)
    named = [Text("{}, {}", part.member, part.text) for part in known["overloaded"][:_MOST_NAMED]]
    parts = joined("{}; {}", named)
    reason = Text("{} come down, overloaded in {}", _named(_counted(model, fallen)), parts)
    return Stability(verdict=COMES_DOWN, reason=reason, **known)


def _without_hinges(scenario: Scenario) -> Scenario:
    """Return a scenario with fixed connections for those that leave but the rotation about the vertical free.

    That carries no weight, and elastic connections have no hinges.
    """
    settings = scenario.connections
    if settings.type != _HINGE and all(table.type != _HINGE for table in settings.between):
        return scenario
    between = tuple(replace(table, type=_FIXED) if table.type == _HINGE else table for table in settings.between)
    kind = _FIXED if settings.type == _HINGE else settings.type
    return replace(scenario, connections=replace(settings, type=kind, between=between))


def _without_splinters(model: Model, shards: np.ndarray) -> np.ndarray:
    """Return shards (n,), or none where they are together but a splinter of what can move."""
    moving_kg = float(model.masses_kg[~model.fixed].sum())
    return shards & bool(model.masses_kg[shards].sum() > FALLEN_SHARE * moving_kg)


def _counted(model: Model, shards: np.ndarray) -> tuple[MemberShare, ...]:
    """Return shards (n,) by their members, the heaviest first."""
    members = model.member_of_shard[shards]
    counts = np.bincount(members, minlength=len(model.members))
    masses = np.bincount(members, model.masses_kg[shards], minlength=len(model.members))
    rows = [row for row in np.argsort(-masses, kind="stable").tolist() if counts[row]]
    return tuple(MemberShare(model.members[row].name, int(counts[row]), float(masses[row])) for row in rows)


def _overloaded(model: Model, used: np.ndarray) -> tuple[OverloadedMember, ...]:
    rows = np.flatnonzero(used > 1.0)
    by_member: dict[str, list[float]] = {}
    for row in rows.tolist():
        by_member.setdefault(_member_of(model, row), []).append(float(used[row]))
    parts = (OverloadedMember(name, len(values), max(values)) for name, values in by_member.items())
    return tuple(sorted(parts, key=lambda part: -part.utilisation))


def _member_of(model: Model, connection: int) -> str:
    return model.members[model.member_of_shard[model.connections.pairs[connection, 0]]].name


def _loose_contacts(model: Model, paths: SupportPaths) -> list[tuple[int, int]]:
    """Return members with loose shards on level faces of others, and the members below, without connections."""
    of_body = np.append(model.member_of_shard, -1)[model.connections.pairs]
    connected = {tuple(pair) for pair in np.sort(of_body, axis=1).tolist()}
    loose = np.unique(model.member_of_shard[paths.loose]).tolist()
    return [
        (above, below)
        for above in loose
        for below in range(len(model.members))
        if above != below and (min(above, below), max(above, below)) not in connected
        if level_contacts(model.members[above].solid, model.members[below].solid)
    ]


def _with_bearings(scenario: Scenario, members: Sequence[Member], contacts: Sequence[tuple[int, int]]) -> Scenario:
    """Return a scenario with a bearing without uplift for each contact, that slides where friction of shards ends."""
    if not contacts:
        return scenario
    friction = scenario.surface_of(scenario.shards).friction ** 2  # Bullet multiplies the values of both bodies
    bearings = (
        Bearing(members=(members[above].name, members[below].name), kind=SLIDING, friction=friction)
        for above, below in contacts
    )
    return replace(scenario, bearings=(*scenario.bearings, *bearings))


def _named(shares: Sequence[MemberShare]) -> str:
    """Return shards with the members that most of them are of."""
    names = joined("{}, {}", [share.member for share in shares[:_MOST_NAMED]])
    if len(shares) > _MOST_NAMED:
        names = Text("{} and more", names)
    count, mass_kg = sum(share.shards for share in shares), math.fsum(share.mass_kg for share in shares)
    return Text("{} shards of {} ({})", count, names, mass_text(mass_kg))


_TOUCHING_M = 0.005
"""Distance between the boxes of two shards, or of one and the ground, up to which they may touch: shards are cut with
gaps of about a millimetre. Boxes are larger than shards, so that what falls for certain touches nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class SupportPaths:
    """How the n shards of a model are held.

    Attributes
    ----------
    connected : (n,) bool
        Whether connections lead from a shard to the ground or to a support.
    loose : (n,) bool
        Whether none do, but it touches what is connected so or the ground, maybe by way of others.
    """

    connected: np.ndarray
    loose: np.ndarray

    @property
    def falling(self) -> np.ndarray:
        """Return which shards (n,) neither connections nor contacts hold."""
        return ~self.connected & ~self.loose


def support_paths(model: Model) -> SupportPaths:
    """Return what holds each shard of a model."""
    count = len(model.shards)
    moves = np.append(~model.fixed, False)  # the ground is the last body
    first, second = (model.connections.pairs % (count + 1)).T
    label = connected_parts(moves, first, second)
    to_support = label[np.concatenate((first[~moves[second]], second[~moves[first]]))]
    connected = model.fixed | np.isin(label[:-1], to_support[to_support >= 0])
    boxes = np.array([shard.bounds for shard in model.shards])
    meeting = boxes_that_meet(boxes[:, 0], boxes[:, 1], _TOUCHING_M)
    ground_m = model.ground.heights_at(boxes.mean(axis=1)[:, :2])
    stands = np.isfinite(ground_m) & (boxes[:, 0, 2] <= np.nan_to_num(ground_m) + _TOUCHING_M)
    on_ground = np.flatnonzero(stands)
    touching = connected_parts(
        np.ones(count + 1, bool),
        np.concatenate((meeting[:, 0], on_ground, np.flatnonzero(connected), first)),
        np.concatenate((meeting[:, 1], np.full(len(on_ground) + int(connected.sum()), count), second)),
    )
    return SupportPaths(connected, ~connected & (touching[:-1] == touching[-1]))
