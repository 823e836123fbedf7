"""Friction and restitution of pairs of surfaces, and what bodies have so that Bullet makes these of them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, TypeVar

from ...engineering.mechanics.contact_pairs import (
    LARGEST_FRICTION,
    contact_friction,
    contact_restitution,
    other_value,
    shard_value,
)
from ...errors import ScenarioError
from ..schema import SHARE, Table, key, key_fields

_Body = TypeVar("_Body", bound="BodyInContact")

FRICTION, RESTITUTION = "friction", "restitution"
QUANTITIES = (FRICTION, RESTITUTION)

SHARDS, GROUND, BALL, TOOLS, SURFACES = "shards", "ground", "ball", "tools", "surfaces"
"""Names of pairs, each of a shard and what the name says, and of the bodies that a shard meets there."""

CONCRETE_ON_CONCRETE = 0.6
"""EN 1992-1-1:2004, 6.2.5 (2): 0.5 very smooth, 0.6 smooth, 0.7 rough, 0.9 indented. Broken faces are rough, those cast
against forms smooth; with less friction debris goes farther."""

CONCRETE_ON_SOIL = 0.5
"""NAVFAC DM-7.02 (1986), chapter 3, table 1, mass concrete: 0.45 to 0.55 on sand, 0.55 to 0.60 on gravel and coarse
sand, 0.70 on sound rock, 0.30 to 0.35 on silt and clay."""

CONCRETE_ON_STEEL = 0.57
"""B. G. Rabbat and H. G. Russell (1985), Journal of Structural Engineering 111, 505-515: 0.57 dry, 0.65 wet."""

OWN_VALUE = (
    "Value of the body itself, in older files: a contact has the product of those of both bodies. Give `contacts` in "
    "its place."
)
"""Meaning of keys that give values of single bodies."""


@dataclass(frozen=True, slots=True)
class SurfaceValues:
    """Friction and restitution: of a body by itself, or of the contact of two."""

    friction: float
    restitution: float

    def with_other(self, other: "SurfaceValues") -> "SurfaceValues":
        """Return friction and restitution of the contact of two bodies."""
        return SurfaceValues(
            contact_friction(self.friction, other.friction), contact_restitution(self.restitution, other.restitution)
        )


def _friction(default: float, source: str) -> Any:
    return key(
        f"Coefficient of friction of the two. {source}", default=default, at_least=0, at_most=int(LARGEST_FRICTION)
    )


def _restitution() -> Any:
    return key(
        "Part of the speed that the two keep in a bounce, where Bullet has one: `bda check` says above which speed.",
        default=0.0,
        **SHARE,
    )


class PairContact(Table):
    """Base of the tables of pairs."""

    __slots__ = ()
    friction: float
    restitution: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ShardContact(PairContact):
    """Shards on shards: concrete on concrete."""

    table: ClassVar[str] = "contacts.shards"

    friction: float = _friction(
        CONCRETE_ON_CONCRETE, "EN 1992-1-1, 6.2.5: 0.5 very smooth, 0.6 smooth, 0.7 rough faces."
    )
    restitution: float = _restitution()


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundContact(PairContact):
    """Shards on the ground."""

    table: ClassVar[str] = "contacts.ground"

    friction: float = _friction(
        CONCRETE_ON_SOIL,
        "NAVFAC DM-7.02, chapter 3, table 1: 0.45 to 0.6 on sand and gravel, 0.7 on rock, 0.3 on clay.",
    )
    restitution: float = _restitution()


@dataclass(frozen=True, slots=True, kw_only=True)
class BallContact(PairContact):
    """Shards on the ball: concrete on steel."""

    table: ClassVar[str] = "contacts.ball"

    friction: float = _friction(CONCRETE_ON_STEEL, "Rabbat and Russell (1985): 0.57 dry, 0.65 wet.")
    restitution: float = _restitution()


@dataclass(frozen=True, slots=True, kw_only=True)
class ToolContact(PairContact):
    """Shards on tools, such as the chisel of a jackhammer: concrete on steel."""

    table: ClassVar[str] = "contacts.tools"

    friction: float = _friction(CONCRETE_ON_STEEL, "Rabbat and Russell (1985): 0.57 dry, 0.65 wet.")
    restitution: float = _restitution()


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceContact(PairContact):
    """Shards on the surfaces of `ground.surfaces`, all alike."""

    table: ClassVar[str] = "contacts.surfaces"

    friction: float = _friction(CONCRETE_ON_SOIL, "By default as on the ground.")
    restitution: float = _restitution()


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactSettings(Table):
    """Friction and restitution of each pair of surfaces that touch. What ball and ground have with each other follows,
    and `bda check` says it. Leave out all of it where bodies have values of their own, as in older files."""

    table: ClassVar[str] = "contacts"

    shards: ShardContact = field(default_factory=ShardContact)
    ground: GroundContact = field(default_factory=GroundContact)
    ball: BallContact = field(default_factory=BallContact)
    tools: ToolContact = field(default_factory=ToolContact)
    surfaces: SurfaceContact = field(default_factory=SurfaceContact)

    def with_shard(self, name: str) -> PairContact:
        """Return the pair of a shard with what is named."""
        contact: PairContact = getattr(self, name)
        return contact

    def of_body(self, name: str) -> SurfaceValues:
        """Return the values of a body by itself, which make its pairs."""
        if name == SHARDS:
            return SurfaceValues(shard_value(self.shards.friction), shard_value(self.shards.restitution))
        pair = self.with_shard(name)
        return SurfaceValues(
            other_value(pair.friction, self.shards.friction), other_value(pair.restitution, self.shards.restitution)
        )

    @property
    def given_keys(self) -> Iterator[str]:
        """Names of the keys that are not as by default."""
        for name in (SHARDS, GROUND, BALL, TOOLS, SURFACES):
            contact = self.with_shard(name)
            for item in key_fields(type(contact)):
                if getattr(contact, item.name) != item.default:
                    yield f"{contact.table}.{item.name}"

    def check_possible(self, names: Iterable[str]) -> None:
        """Check that bodies can have values that make all pairs, of those bodies that there are."""
        others = [name for name in names if name != SHARDS]
        for quantity in QUANTITIES:
            for name in others:
                self._check_with_shard(quantity, name)
        if BALL in others:
            for name in others:
                if name != BALL:
                    self._check_bounce_of_ball(name)

    def _check_with_shard(self, quantity: str, name: str) -> None:
        of_pair, of_shards = getattr(self.with_shard(name), quantity), getattr(self.shards, quantity)
        if of_pair and not of_shards:
            raise self.with_shard(name).unexpected(
                quantity,
                f"0 where contacts.shards.{quantity} is 0, or a contacts.shards.{quantity} above 0: Bullet multiplies "
                "the values of both bodies, and that of every shard would be 0",
            )

    def _check_bounce_of_ball(self, name: str) -> None:
        """Check that the ball does not bounce higher off a body than it fell."""
        product = self.of_body(BALL).with_other(self.of_body(name)).restitution
        if product > 1.0 + _ROUNDING:
            most = self.shards.restitution / self.with_shard(name).restitution
            raise self.ball.unexpected(
                RESTITUTION,
                f"at most {most:.6g}, which is contacts.shards.restitution over contacts.{name}.restitution: by their "
                f"values the ball would leave the {name} {product:.3g} times as fast as it came",
            )


_ROUNDING = 1e-9
"""Relative slack for a product that is meant to be 1."""


class BodyInContact(Table):
    """Base of the tables of bodies. Older files give friction and restitution of the body itself there."""

    __slots__ = ()
    contact: ClassVar[str]
    """Its pair with a shard."""
    older_values: ClassVar[Mapping[str, float]]
    """Keys of its own values, and what these are where an older file does not give them."""

    @property
    def given_keys(self) -> Iterator[str]:
        """Names of its keys that give values of its own."""
        return (f"{self.table}.{name}" for name in self.older_values if getattr(self, name) is not None)

    @property
    def own_values(self) -> SurfaceValues:
        """Its own values, where it has them; a tool does not bounce."""
        return SurfaceValues(getattr(self, FRICTION), getattr(self, RESTITUTION, 0.0))


def with_own_values(body: _Body) -> _Body:
    """Return a body with values of its own: the values of older versions where it does not give them."""
    missing = {name: value for name, value in body.older_values.items() if getattr(body, name) is None}
    return replace(body, **missing)


def check_not_both(pairs: Iterable[str], of_bodies: Iterable[str]) -> None:
    """Refuse keys of pairs together with keys of single bodies."""
    pair, of_body = next(iter(pairs), None), next(iter(of_bodies), None)
    if pair and of_body:
        raise ScenarioError(
            f"{pair} and {of_body} are given together: expected friction and restitution of pairs under contacts, or "
            "of single bodies as in older files, not both"
        )
