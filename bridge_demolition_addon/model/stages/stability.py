"""Whether a bridge stands under its own weight before anything is done: one verdict by statics, with its reasons."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from ...engineering.core.library import missing_core
from ...engineering.elasticity.equations import connected_parts
from ...engineering.geometry.level_contacts import level_contacts
from ...engineering.geometry.proximity import boxes_that_meet
from ...engineering.units import mass_text
from ...errors import DemolitionError
from ...texts import Quantity, Text, joined, of_stored, stored
from ..actions import Fact
from ..bridge.member import Member
from ..scenario import Scenario
from ..scenario.bearings import SLIDING, Bearing
from ..sequence.unusual import unusual_texts
from ..structure.cracking import FALLEN_SHARE, RestingModel
from ..structure.model import Model, build_model
from ..structure.section_use import SectionsWithBars
from ..structure.zone_loads import ZoneLoad, zone_loads
from .standing import LARGEST_FACTOR, StandingBridge, made_elastic, most_used_of

STANDS, COMES_DOWN, UNKNOWN = ("stands", "comes down", "unknown")

NARROW = 1.3
"""Load factor below which a bridge that stands by statics has come down in runs: docs/stages.md, *Limits*."""


AWAKE_ADVICE = "a run awake without what is done to it shows it: bda check --awake"


@dataclass(frozen=True, slots=True)
class MemberShare:
    """Shards of a member: how many, and their mass."""

    member: str
    shards: int
    mass_kg: float

    @property
    def text(self) -> str:
        """How many, and what they weigh."""
        return f"{self.shards} shards, {mass_text(self.mass_kg)}"


@dataclass(frozen=True, slots=True)
class OverloadedMember:
    """Connections of a member with a utilisation above 1, each counted for the member of its first shard."""

    member: str
    connections: int
    utilisation: float  # largest of them

    @property
    def text(self) -> str:
        """How many connections, and how much at most."""
        at_most = f"{self.utilisation:.0%}"
        if self.connections == 1:
            return Text("1 connection at up to {}", at_most)
        return Text("{} connections at up to {}", self.connections, at_most)


@dataclass(frozen=True, slots=True, kw_only=True)
class Stability:
    """Whether a bridge stands under its own weight, by statics.

    Attributes
    ----------
    verdict : str
        One of `VERDICTS`.
    reason : str
        Why it comes down, or why this cannot be known; empty where it stands.
    load_factor, utilisation, deflection_m : float or None
        Collapse load factor, of which `LARGEST_FACTOR` stands for any above, largest utilisation of a connection and
        largest deflection; None where statics was not asked or cannot say.
    used_most, used_of : str
        Member with the largest utilisation, and what it is a part of; empty where an earlier version wrote it.
    cracked, overloaded_connections, connections : int
        Connections that crack and hold by their bars, that are overloaded, and all.
    unsupported, loose : tuple of MemberShare
        What neither a connection nor a contact holds, and what lies on others or the ground by contact alone.
    loose_on : tuple of str
        Contacts of loose members that statics takes for bearings which hold no uplift, as ``deck on pier 1 cap``.
    zones : tuple of ZoneLoad
        What blast zones carry; empty where statics was not asked or cannot say.
    unusual : tuple of str
        What of the bridge and what is done to it is far from usual, as sentences without full stops.
    is_rigid, is_asleep : bool
        Whether the run has rigid connections, which share loads otherwise than elastic ones, and whether its shards
        sleep at first, so that it does not show whether the bridge stands.
    """

    verdict: str
    reason: str = ""
    load_factor: float | None = None
    utilisation: float | None = None
    used_most: str = ""
    used_of: str = ""
    deflection_m: float | None = None
    cracked: int = 0
    overloaded_connections: int = 0
    connections: int = 0
    overloaded: tuple[OverloadedMember, ...] = ()
    unsupported: tuple[MemberShare, ...] = ()
    loose: tuple[MemberShare, ...] = ()
    loose_on: tuple[str, ...] = field(default=())
    zones: tuple[ZoneLoad, ...] = ()
    unusual: tuple[str, ...] = ()
    is_rigid: bool = False
    is_asleep: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return it ready for JSON."""
        texts = (self.reason, self.used_of, *self.unusual, *self.loose_on)
        return asdict(self) | {"texts": {text: stored(text) for text in texts if isinstance(text, Text)}}

    @classmethod
    def of_json(cls, values: Mapping[str, Any]) -> Stability:
        """Return what `stored` gave, maybe after JSON."""
        tables: dict[str, Any] = {"overloaded": OverloadedMember, "unsupported": MemberShare, "loose": MemberShare}
        tables["zones"] = ZoneLoad  # runs of before have none
        parts = values.get("texts", {})  # runs of before have none

        def text(english: str) -> str:
            return of_stored(parts[english]) if english in parts else english

        known: dict[str, Any] = {name: tuple(of(**row) for row in values.get(name, ())) for name, of in tables.items()}
        known |= {name: tuple(map(text, values.get(name, ()))) for name in ("loose_on", "unusual")}
        known |= {name: text(values[name]) for name in ("reason", "used_of") if name in values}
        return cls(**{name: value for name, value in {**values, **known}.items() if name != "texts"})

    @property
    def sentence(self) -> str:
        """Return the verdict in one sentence, without a full stop."""
        if self.verdict == UNKNOWN:
            return Text(f"Whether the bridge stands cannot be known by statics: {{}}; {AWAKE_ADVICE}", self.reason)
        as_elastic = ", as if its connections were elastic" if self.is_rigid else ""
        if self.verdict == COMES_DOWN:
            factor = (
                "" if self.load_factor is None else Text("collapse load factor {}, ", _factor_text(self.load_factor))
            )
            down = f"The bridge comes down under its own weight, by statics{as_elastic}: {{}}{{}}"
            return Text(down, factor, self.reason)
        stands = f"The bridge stands under its own weight, by statics{as_elastic}: {{}}"
        return Text(stands, joined("{}, {}", self._resistances()))

    def _resistances(self) -> Iterator[str]:
        if self.load_factor is not None:
            yield Text("collapse load factor {}", _factor_text(self.load_factor))
        if self.utilisation is not None:
            of = f" {self.used_of}" if self.used_of else ""
            yield Text(f"largest utilisation {{}}{of} ({{}})", f"{self.utilisation:.0%}", self.used_most)
        if self.deflection_m is not None:
            words = "deflection {}" if self.deflection_m >= 0.0 else "camber {}"
            yield Text(words, Quantity(1000.0 * abs(self.deflection_m), "mm", ".2f"))

    @property
    def asleep_sentence(self) -> str:
        """Return that a run does not show it, without a full stop; empty where it does."""
        if not self.is_asleep:
            return ""
        return Text(
            "In the run all shards sleep until something hits them, so that it does not show whether the bridge stands"
        )

    def facts(self) -> Iterator[Fact]:
        """Yield the verdict and what it follows from, as `bda check` prints it."""
        yield from (("unusual", text) for text in self.unusual)
        yield self.verdict, self.sentence
        if self.is_rigid and self.verdict != UNKNOWN:
            yield "", "connections of the run are rigid, and share loads otherwise: only a run awake shows how"
        if self.is_asleep:
            yield "asleep", self.asleep_sentence
        for share in self.unsupported:
            yield "unsupported", f"{share.member}: {share.text}, held by nothing"
        for share in self.loose:
            yield "lies loose", f"{share.member}: {share.text}, held by contact alone"
        for contact in self.loose_on:
            yield "", f"{contact}: taken for a bearing that holds no uplift"
        if self.cracked:
            yield "cracked", f"{self.cracked} of {self.connections} faces are cracked and held by bars"
        for part in self.overloaded:
            yield Text("above 100 %"), Text("{}: {}", part.member, part.text)
        if self.overloaded and self.verdict == STANDS:
            yield "", "these break, and others take over their loads"
        if self.verdict == STANDS and self.load_factor is not None and self.load_factor < NARROW:
            yield "narrow", f"a run lets cracks open with a jerk: with a load factor below {NARROW:g} it may come down"
        elif self.verdict == STANDS and self.load_factor is None:
            yield "", "its collapse load factor takes longer to work out: bda check --stand"


def stability_texts(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return what a run's summary says under ``stability``, as sentences without full stops; none for nothing."""
    if not summary.get("stability"):
        return ()
    stability = Stability.of_json(summary["stability"])
    return tuple(filter(None, (stability.sentence, stability.asleep_sentence)))


def _factor_text(factor: float) -> str:
    return Text("above {}", f"{LARGEST_FACTOR:g}") if factor >= LARGEST_FACTOR else f"{factor:.2f}"


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

    Statics follows elastic connections, also where those of the run are rigid or break by one force. What merely lies
    on others is held by bearings that hold no uplift, where faces are level. Without `with_factor` no load factor is
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
    """Return the members of which loose shards lie on others with level faces, and those below, without connections."""
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
