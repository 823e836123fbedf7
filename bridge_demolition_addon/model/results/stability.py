"""Whether a bridge stands under its own weight, by statics: the verdict, its reasons, and how a summary keeps it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from ...engineering.units import mass_text
from ...texts import Quantity, Text, joined, of_stored, stored
from ..actions import Fact
from .records import record_of

STANDS, COMES_DOWN, UNKNOWN = ("stands", "comes down", "unknown")

LARGEST_FACTOR = 64.0
"""Load factor up to which collapse is looked for."""

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


@dataclass(frozen=True, slots=True)
class ZoneLoad:
    """What the section at one end of a zone carries at rest: the upper end, or where a level member has more bending.

    `pressed_n` is the force along the member, below 0 in tension. `bending_nm` is about the middle of the section.
    """

    zone: str
    pressed_n: float
    shear_n: float
    bending_nm: float


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
        Collapse load factor (`LARGEST_FACTOR` stands for any above), largest utilisation of a connection and largest
        deflection; None where statics was not asked or cannot say.
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
    def of_json(cls, values: Mapping[str, Any], *, is_checked: bool = False) -> Stability:
        """Return what `to_json` gave, maybe after JSON; runs of before have neither texts nor zones."""
        parts = values.get("texts", {}) if isinstance(values, dict) else {}

        def text(english: str) -> str:
            return of_stored(parts[english]) if english in parts else english

        found = record_of(cls, values, "stability", is_checked=is_checked)
        return replace(
            found,
            reason=text(found.reason),
            used_of=text(found.used_of),
            loose_on=tuple(map(text, found.loose_on)),
            unusual=tuple(map(text, found.unusual)),
        )

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
    def texts(self) -> tuple[str, ...]:
        """Return its sentences, without full stops."""
        return tuple(filter(None, (self.sentence, self.asleep_sentence)))

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


def _factor_text(factor: float) -> str:
    return Text("above {}", f"{LARGEST_FACTOR:g}") if factor >= LARGEST_FACTOR else f"{factor:.2f}"
