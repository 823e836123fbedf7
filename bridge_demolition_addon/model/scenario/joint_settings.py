"""The type of a connection, what is free in it, its springs, what breaks it; and where certain members differ."""

from dataclasses import dataclass, fields
from typing import ClassVar

from ...engineering.mechanics.strength import MATERIALS, MOTIONS, TYPES, Springs
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..materials import MODULUS, POISSON
from ..schema import Table, key

STRENGTH_KEYS = ("breaking_force_n", "breaking_force_kgf", "material")
"""Keys of which one says what breaks a connection."""

ELASTIC_TYPES = ("FIXED", "GENERIC", "GENERIC_SPRING")
"""Kinds of connections that can be elastic: those whose rows Bullet lets be changed."""

STEEL_KEYS = ("ductile_yield_n_mm2", "ductile_hardening", "ductile_rupture_strain")
"""Keys of the steel of reinforcement that is smeared over sections."""

_SPRINGS = {
    "move": ("stiffness_n_m", "damping_ns_m"),
    "turn": ("turning_stiffness_nm_rad", "turning_damping_nms_rad"),
}
"""Keys of the springs, stiffness and damping, in each kind of motion."""

_SPRING_KEYS = (*_SPRINGS["move"], *_SPRINGS["turn"])

_STIFFENED = "Bullet softens what is stiffer than a 16th of the body's {} by the square of the sub-step."


class BreakingForce(Table):
    """Base of the tables of connections that break by a force."""

    __slots__ = ()
    breaking_force_n: float | None
    breaking_force_kgf: float | None

    @property
    def breaking_force_newton(self) -> float | None:
        """Return the force that breaks it, N; None where none was given."""
        if self.breaking_force_kgf is not None:
            return self.breaking_force_kgf * STANDARD_GRAVITY_M_S2
        return self.breaking_force_n


@dataclass(frozen=True, slots=True, kw_only=True)
class JointSettings(BreakingForce):
    """The type of a connection, what is free in it, and its springs; each table of these also has a breaking force."""

    type: str | None = key(
        "Kind of rigid-body constraint, as in `[connections]`.", default=None, choices=TYPES, label="Joint Model"
    )
    free: tuple[str, ...] | None = key(
        "Motions that a `GENERIC` or `GENERIC_SPRING` connection allows, along and about the axes of the bridge: "
        '`["move x", "turn y"]` for a bearing that slides along the road and turns about the axis across it.',
        default=None,
        choices=MOTIONS,
    )
    stiffness_n_m: float | None = key(
        f"Stiffness of a `GENERIC_SPRING` along its free axes. {_STIFFENED.format('mass')}",
        default=None,
        unit="N/m",
        above=0,
    )
    damping_ns_m: float | None = key("Damping with it.", default=None, unit="N·s/m", at_least=0)
    turning_stiffness_nm_rad: float | None = key(
        f"Stiffness of a `GENERIC_SPRING` about its free axes. {_STIFFENED.format('moment of inertia')}",
        default=None,
        unit="N·m/rad",
        above=0,
    )
    turning_damping_nms_rad: float | None = key("Damping with it.", default=None, unit="N·m·s/rad", at_least=0)

    @property
    def springs(self) -> Springs:
        return Springs(**{name: getattr(self, name) or 0.0 for name in _SPRING_KEYS})

    def check_type(self, kind: str) -> None:
        """Check that what is free and the springs go with the type of the connection."""
        wrong = {"free": kind not in ("GENERIC", "GENERIC_SPRING")}
        wrong |= {name: kind != "GENERIC_SPRING" for name in _SPRING_KEYS}
        for name, is_wrong in wrong.items():
            if is_wrong and getattr(self, name) is not None:
                raise self.unexpected(name, f'none with type "{kind}"')
        if kind != "GENERIC_SPRING":
            return
        free = " ".join(self.free or ())
        for motion, (stiffness, damping) in _SPRINGS.items():
            if getattr(self, stiffness) is not None and motion not in free:
                raise ScenarioError(f'{self.table}.{stiffness} is given: expected a "{motion}" in {self.table}.free')
            if getattr(self, damping) is not None and getattr(self, stiffness) is None:
                raise ScenarioError(f"{self.table}.{damping} is given: expected {self.table}.{stiffness} with it")
        if not any(getattr(self, name) for name in _SPRING_KEYS):
            raise ScenarioError(
                f"{self.table}.stiffness_n_m is missing: expected it or {self.table}.turning_stiffness_nm_rad "
                'with type "GENERIC_SPRING"'
            )


GROUND_NAME = "ground"

OWN_MATERIAL = "the name of one of `[[materials]]`"

_JOINT = tuple(item.name for item in fields(JointSettings))


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionBetween(JointSettings):
    """Connections between two members, or two kinds of members, that differ from the others: bearings, joints, gaps.
    Keys that are left out are as in `[connections]`, with one exception: once `type`, `free` or a spring is given here,
    `free` and the springs of `[connections]` do not count. The first of these tables that names both members counts.
    """

    table: ClassVar[str] = "connections.between"

    members: tuple[str, str] = key(
        'The two members, each by the name that `bda check` lists or by kind, or `"ground"` for the foundations: '
        '`["deck", "pier cap"]`. Give the same twice for connections within a member.'
    )
    none: bool = key("Whether there are no connections between them at all; then give nothing else.", default=False)
    breaking_force_n: float | None = key("Force that breaks it.", default=None, unit="N", above=0)
    breaking_force_kgf: float | None = key(
        "Force that breaks it, 1 kgf = 9.80665 N.", default=None, unit="kgf", above=0
    )
    material: str | None = key(
        "Material by whose strengths it breaks; with method `face`. Give at most one of this, `breaking_force_n` and "
        "`breaking_force_kgf`.",
        default=None,
        choices=tuple(MATERIALS),
        or_else=OWN_MATERIAL,
    )
    elastic_modulus_n_mm2: float | None = key(
        "Modulus of elasticity, where connections are elastic, if it is not the material's.", default=None, **MODULUS
    )
    poisson_ratio: float | None = key(
        "Poisson's ratio, where connections are elastic, if it is not the material's.", default=None, **POISSON
    )

    @property
    def changes_joint(self) -> bool:
        """Return whether type, freedom or springs are given; then the keys of `[connections]` do not count."""
        return any(getattr(self, name) is not None for name in _JOINT)

    def _check_together(self) -> None:
        breaking = [name for name in STRENGTH_KEYS if getattr(self, name) is not None]
        others = breaking + [name for name in _JOINT if getattr(self, name) is not None]
        if self.none and others:
            raise ScenarioError(f"{self.table}.none is true: expected nothing else but members, found {others[0]}")
        if len(breaking) > 1:
            listed = " and ".join(f"{self.table}.{name}" for name in breaking)
            raise ScenarioError(f"{listed} are given together: expected at most one of them")
