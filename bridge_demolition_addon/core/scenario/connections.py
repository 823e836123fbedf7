"""Which shards are connected, how, and what breaks a connection."""

from dataclasses import dataclass
from typing import ClassVar

from ..errors import ScenarioError
from ..mechanics.joint import TYPES, Joint
from ..mechanics.strength import MATERIALS, Strength
from ..schema import LARGEST_INTEGER, check_exactly_one, key, shown
from ..units import STANDARD_GRAVITY_M_S2
from .connection_rules import ConnectionBetween
from .joint import JointSettings


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionSettings(JointSettings):
    """Which shards are connected, how, and what breaks a connection."""

    table: ClassVar[str] = "connections"

    type: str = key(
        "Kind of rigid-body constraint: `FIXED` holds everything, `POINT` a point, `HINGE` all but the rotation about "
        "the vertical, `GENERIC` all but what is `free`, and `GENERIC_SPRING` has springs in what is.",
        default="HINGE",
        choices=TYPES,
    )
    method: str = key(
        "Which shards are connected: those whose nearest vertices (`vertex`) or centres of mass (`centre`) lie within "
        "`search_radius_m`, those that share a face (`face`), or each with as many as `neighbours` says whose centres "
        "of mass are nearest to its own (`nearest`).",
        default="vertex",
        choices=("vertex", "centre", "face", "nearest"),
    )
    search_radius_m: float | None = key(
        "Distance up to which shards are connected. Needed for `vertex` and `centre`, and only for them.",
        default=None,
        unit="m",
        above=0,
    )
    neighbours: int | None = key(
        "How many of its nearest each shard is connected with; a shard may be among the nearest of more. Needed for "
        "`nearest`, and only for it.",
        default=None,
        at_least=1,
        at_most=LARGEST_INTEGER,
    )
    limit_per_shard: int = key(
        "Most connections of one shard; the nearest are kept.", default=50, at_least=1, at_most=LARGEST_INTEGER
    )
    breaking_force_n: float | None = key(
        "Force that breaks a connection. Give this or `breaking_force_kgf`.", default=None, unit="N", above=0
    )
    breaking_force_kgf: float | None = key(
        "Force that breaks a connection, 1 kgf = 9.80665 N. Give this or `breaking_force_n`.",
        default=None,
        unit="kgf",
        above=0,
    )
    material: str | None = key(
        "Material by whose strengths a connection breaks, under axial force, shear and bending together; with method "
        "`face`, as it takes the area of the shared face. Give this, `breaking_force_n` or `breaking_force_kgf`.",
        default=None,
        choices=tuple(MATERIALS),
    )
    ductile_share: float = key(
        "Part of a material's tensile strength that a connection keeps when it breaks, as reinforcement across the "
        "crack; 0 for none.",
        default=0.0,
        at_least=0,
        at_most=1,
    )
    ductile_elongation_m: float | None = key(
        "How far the crack opens before the reinforcement lets go. Needed with `ductile_share`, and only then.",
        default=None,
        unit="m",
        above=0,
    )
    warm_up_s: float = key(
        "Time from the start in which no connection breaks, so that the bridge settles under its own weight; shards "
        "that start deactivated do not settle.",
        default=0.0,
        unit="s",
        at_least=0,
    )
    warm_up_damping: float = key(
        "Share of all velocities that shards lose in one second of the warm-up besides their own damping, so that they "
        "are at rest when it ends: `0.99` or more.",
        default=0.0,
        at_least=0,
        at_most=1,
    )
    foundation: bool = key("Whether shards that stand on the ground are connected to it.", default=True)
    between: tuple[ConnectionBetween, ...] = ()

    @property
    def breaking_force_newton(self) -> float | None:
        """Return the force that breaks a connection, N; None for a material."""
        if self.material is not None:
            return None
        if self.breaking_force_n is not None:
            return self.breaking_force_n
        return self.breaking_force_kgf * STANDARD_GRAVITY_M_S2

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Return the joint of connections that follow no rule, then that of each rule."""
        own = Joint(self.type, self.free or (), self.springs, self.breaking_force_newton, _strength(self.material))
        return (own, *(_joint_between(own, rule) for rule in self.between))

    def _check_together(self) -> None:
        check_exactly_one(self, "breaking_force_n", "breaking_force_kgf", "material")
        for each in (self, *self.between):
            if each.material is not None and self.method != "face":
                raise ScenarioError(
                    f'{each.table}.material is "{each.material}": expected method "face" with it, found "{self.method}"'
                )
            if each is self or each.changes_joint:
                each.check_type(each.type or self.type)
        if self.ductile_share > 0.0 and self.material is None:
            raise ScenarioError(
                f"connections.ductile_share is {self.ductile_share}: expected 0 where connections.material is not given"
            )
        if (self.ductile_share > 0.0) != (self.ductile_elongation_m is not None):
            raise ScenarioError(
                f"connections.ductile_elongation_m is {shown(self.ductile_elongation_m)}: expected a number above 0 "
                f"(m) with a connections.ductile_share above 0, and none with {self.ductile_share}"
            )
        if self.warm_up_damping > 0.0 and self.warm_up_s == 0.0:
            raise ScenarioError(
                f"connections.warm_up_damping is {self.warm_up_damping}: expected 0 where connections.warm_up_s is 0"
            )
        self._check_method("search_radius_m", "a number above 0 (m)", ("vertex", "centre"))
        self._check_method("neighbours", "a whole number of at least 1", ("nearest",))

    def _check_method(self, name: str, wanted: str, methods: tuple[str, ...]) -> None:
        """Check that a key is given for the methods that need it, and for no others."""
        value = getattr(self, name)
        if self.method in methods and value is None:
            raise ScenarioError(f'connections.{name} is missing: expected {wanted} with method "{self.method}"')
        if self.method not in methods and value is not None:
            raise ScenarioError(f'connections.{name} is {value}: expected none with method "{self.method}"')


def _joint_between(own: Joint, rule: ConnectionBetween) -> Joint:
    kind = rule.type or own.type
    free, springs = (rule.free or (), rule.springs) if rule.changes_joint else (own.free, own.springs)
    force, strength = rule.breaking_force_newton, _strength(rule.material)
    if force is None and strength is None:
        force, strength = own.breaking_force_n, own.strength
    return Joint(kind, free, springs, force, strength)


def _strength(material: str | None) -> Strength | None:
    return None if material is None else MATERIALS[material]
