"""Whether a bridge stands under its own weight before anything is done to it: one verdict, with its reasons."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from ...engineering.geometry.level_contacts import level_contacts
from ...engineering.units import mass_text
from ...errors import DemolitionError
from ..actions import Fact
from ..bridge.member import Member
from ..scenario import Scenario
from ..scenario.bearings import SLIDING, Bearing
from ..structure.cracking import FALLEN_SHARE
from ..structure.model import Model, build_model
from ..structure.support_paths import SupportPaths, support_paths
from .standing import StandingBridge, made_elastic

STANDS, COMES_DOWN, UNKNOWN = VERDICTS = ("stands", "comes down", "unknown")

MOST_LOAD_FACTOR = 64.0
"""Largest load factor that is looked for; one that is given as this may be any above it."""

NARROW = 1.3
"""Load factor below which a bridge that stands by statics has come down in runs: docs/stages.md, *Limits*."""

MOST_SHARDS_WITH_FACTOR = 400
"""Shards up to which a load factor takes seconds, where neither bars nor bearings make it slow."""

MOST_SHARDS_FOLLOWED = 600
"""Shards up to which breaks are followed one after another where no load factor is asked for: of 500 in 1 s, of 1000 in
5 s, of 2000 in 18 s of processor time."""

_MOST_NAMED = 3

_FIXED, _HINGE = "FIXED", "HINGE"

AWAKE_ADVICE = "a run awake without what is done to it shows it: bda check --awake"


@dataclass(frozen=True, slots=True)
class MemberShare:
    """Shards of a member: how many, and their mass."""

    member: str
    shards: int
    mass_kg: float


@dataclass(frozen=True, slots=True)
class OverloadedMember:
    """Connections of a member with a utilisation above 1, each counted for the member of its first shard."""

    member: str
    connections: int
    utilisation: float  # largest of them


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
        Collapse load factor, at most `MOST_LOAD_FACTOR`, largest utilisation of a connection and largest deflection;
        None where statics was not asked or cannot say.
    used_most : str
        Member with the largest utilisation.
    cracked, overloaded_connections, connections : int
        Connections that crack and hold by their bars, that are overloaded, and all.
    unsupported, loose : tuple of MemberShare
        What neither a connection nor a contact holds, and what lies on others or the ground by contact alone.
    loose_on : tuple of str
        Contacts of loose members that statics takes for bearings which hold no uplift, as ``deck on pier 1 cap``.
    is_rigid, is_asleep : bool
        Whether the run has rigid connections, which share loads otherwise than elastic ones, and whether its shards
        sleep at first, so that it does not show whether the bridge stands.
    """

    verdict: str
    reason: str = ""
    load_factor: float | None = None
    utilisation: float | None = None
    used_most: str = ""
    deflection_m: float | None = None
    cracked: int = 0
    overloaded_connections: int = 0
    connections: int = 0
    overloaded: tuple[OverloadedMember, ...] = ()
    unsupported: tuple[MemberShare, ...] = ()
    loose: tuple[MemberShare, ...] = ()
    loose_on: tuple[str, ...] = field(default=())
    is_rigid: bool = False
    is_asleep: bool = False

    def stored(self) -> dict[str, Any]:
        """Return it ready for JSON."""
        return asdict(self)

    @classmethod
    def of_stored(cls, values: Mapping[str, Any]) -> Stability:
        """Return what `stored` gave, maybe after JSON."""
        tables: dict[str, Any] = {"overloaded": OverloadedMember, "unsupported": MemberShare, "loose": MemberShare}
        known: dict[str, Any] = {name: tuple(of(**row) for row in values[name]) for name, of in tables.items()}
        return cls(**{**values, **known, "loose_on": tuple(values["loose_on"])})

    @property
    def sentence(self) -> str:
        """Return the verdict in one sentence, without a full stop."""
        if self.verdict == UNKNOWN:
            return f"Whether the bridge stands cannot be known by statics: {self.reason}; {AWAKE_ADVICE}"
        under = "under its own weight, by statics"
        as_elastic = ", as if its connections were elastic" if self.is_rigid else ""
        if self.verdict == COMES_DOWN:
            factor = "" if self.load_factor is None else f"collapse load factor {_factor_text(self.load_factor)}, "
            return f"The bridge comes down {under}{as_elastic}: {factor}{self.reason}"
        return f"The bridge stands {under}{as_elastic}: {', '.join(self._resistances())}"

    def _resistances(self) -> Iterator[str]:
        if self.load_factor is not None:
            yield f"collapse load factor {_factor_text(self.load_factor)}"
        if self.utilisation is not None:
            yield f"largest utilisation {self.utilisation:.0%} ({self.used_most})"
        if self.deflection_m is not None:
            yield f"deflection {1000.0 * self.deflection_m:.2f} mm"

    @property
    def asleep_sentence(self) -> str:
        """Return that a run does not show it, without a full stop; empty where it does."""
        if not self.is_asleep:
            return ""
        return (
            "In the run all shards sleep until something hits them, so that it does not show whether the bridge stands"
        )

    def facts(self) -> Iterator[Fact]:
        """Yield the verdict and what it follows from, as `bda check` prints it."""
        yield self.verdict, self.sentence
        if self.is_rigid and self.verdict != UNKNOWN:
            yield "", "connections of the run are rigid, and share loads otherwise: only a run awake shows how"
        if self.is_asleep:
            yield "asleep", self.asleep_sentence
        for share in self.unsupported:
            yield "unsupported", f"{share.member}: {_share_text(share)}, held by nothing"
        for share in self.loose:
            yield "lies loose", f"{share.member}: {_share_text(share)}, held by contact alone"
        for contact in self.loose_on:
            yield "", f"{contact}: taken for a bearing that holds no uplift"
        if self.cracked:
            yield "cracked", f"{self.cracked} of {self.connections} connections, which hold by their bars"
        for part in self.overloaded:
            yield "above 100 %", f"{part.member}: {_overload_text(part)}"
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
    stability = Stability.of_stored(summary["stability"])
    return tuple(filter(None, (stability.sentence, stability.asleep_sentence)))


def stability_of(
    scenario: Scenario,
    model: Model | None = None,
    *,
    with_factor: bool | None = True,
    pause: Callable[[], None] = lambda: None,
) -> Stability:
    """Return whether the bridge of a scenario stands under its own weight.

    Statics follows elastic connections, also where those of the run are rigid or break by one force. What merely lies
    on others is held by bearings that hold no uplift, where faces are level. Without `with_factor` no load factor is
    looked for, which takes most of the time, and breaks of large models are not followed; None has one where it takes
    seconds. Calls `pause` before each solution.
    """
    model = model or build_model(scenario)
    known: dict[str, Any] = {
        "is_asleep": scenario.shards.start_deactivated,
        "is_rigid": not scenario.connections.is_elastic,
        "connections": len(model.connections),
    }
    paths = support_paths(model)
    known["unsupported"] = _counted(model, _without_splinters(model, paths.falling))
    known["loose"] = _counted(model, _without_splinters(model, paths.loose))
    if known["unsupported"]:
        return Stability(verdict=COMES_DOWN, reason=f"nothing holds {_named(known['unsupported'])}", **known)
    if (method := scenario.connections.method) != "face":
        lies = f", and {_named(known['loose'])} lie loose" if known["loose"] else ""
        reason = f'connections.method is "{method}": without the faces of shards there are no stresses{lies}'
        return Stability(verdict=UNKNOWN, reason=reason, **known)
    try:
        contacts = _loose_contacts(model, paths) if known["loose"] else []
        on_bearings = _with_bearings(scenario, model.members, contacts)
        elastic = made_elastic(_without_hinges(on_bearings))
        if elastic != scenario:
            model = build_model(elastic, model.members)
    except DemolitionError as error:
        return Stability(verdict=UNKNOWN, reason=str(error), **known)
    known["loose_on"] = tuple(f"{model.members[one].name} on {model.members[other].name}" for one, other in contacts)
    paths_on_bearings = support_paths(model)
    if still := _counted(model, _without_splinters(model, paths_on_bearings.loose)):
        known["loose_on"] = ()
        reason = f"{_named(still)} lie loose, held by contact alone, which statics does not follow"
        return Stability(verdict=UNKNOWN, reason=reason, **known)
    return _by_statics(
        StandingBridge(model, on_bearings.joints, pause), paths_on_bearings, known, with_factor=with_factor
    )


def _by_statics(
    bridge: StandingBridge, paths: SupportPaths, known: dict[str, Any], *, with_factor: bool | None
) -> Stability:
    model = bridge.model
    if with_factor is None:
        is_simple = model.crack_bars is None and model.bearings is None
        with_factor = is_simple and len(model.shards) <= MOST_SHARDS_WITH_FACTOR
    ones, nothing = np.ones(len(model.connections)), np.zeros((6, len(model.shards)))
    standing = bridge.rest(ones > 0.0, ones, nothing)
    if turning := _counted(model, _without_splinters(model, paths.connected & ~model.fixed & ~standing.held)):
        reason = f"nothing keeps {_named(turning)} from turning over or sliding off"
        is_on_contact = bool(known["loose_on"])  # a line of contact holds less than the area that lies there
        return Stability(verdict=UNKNOWN if is_on_contact else COMES_DOWN, reason=reason, **known)
    used = np.where(np.isfinite(standing.used), standing.used, 0.0)
    if len(used):
        most = int(used.argmax())
        known["utilisation"], known["used_most"] = float(used[most]), _member_of(model, most)
    known["deflection_m"], known["cracked"] = standing.sag_m, int(standing.cracked.sum())
    known["overloaded"] = _overloaded(model, used)
    known["overloaded_connections"] = int((used > 1.0).sum())
    if known["overloaded"] and len(model.shards) > MOST_SHARDS_FOLLOWED and not with_factor:
        parts = ", ".join(part.member for part in known["overloaded"][:_MOST_NAMED])
        reason = (
            f"connections of {parts} are overloaded, and what breaks then takes long to work out (bda check --stand)"
        )
        return Stability(verdict=UNKNOWN, reason=reason, **known)
    fallen = bridge.comes_down(ones > 0.0, ones, nothing, 1.0)
    if with_factor:
        factor = min(bridge.collapse_factor(ones > 0.0, ones, nothing), MOST_LOAD_FACTOR)
        known["load_factor"] = float(factor) if np.isfinite(factor) else None
    if not fallen.any():
        return Stability(verdict=STANDS, **known)
    parts = "; ".join(f"{part.member}, {_overload_text(part)}" for part in known["overloaded"][:_MOST_NAMED])
    reason = f"{_named(_counted(model, fallen))} come down, overloaded in {parts}"
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
    names = ", ".join(share.member for share in shares[:_MOST_NAMED])
    more = " and more" if len(shares) > _MOST_NAMED else ""
    count, mass_kg = sum(share.shards for share in shares), sum(share.mass_kg for share in shares)
    return f"{count} shards of {names}{more} ({mass_text(mass_kg).strip()})"


def _overload_text(part: OverloadedMember) -> str:
    number = "1 connection" if part.connections == 1 else f"{part.connections} connections"
    return f"{number} at up to {part.utilisation:.0%}"


def _share_text(share: MemberShare) -> str:
    return f"{share.shards} shards, {mass_text(share.mass_kg).strip()}"


def _factor_text(factor: float) -> str:
    return f"above {MOST_LOAD_FACTOR:g}" if factor >= MOST_LOAD_FACTOR else f"{factor:.2f}"
