"""Connections between certain members that differ from the others."""

from dataclasses import dataclass, fields
from typing import ClassVar

from ...engineering.mechanics.strength import MATERIALS
from ...errors import ScenarioError
from ..materials.materials import MODULUS, POISSON
from ..schema import key
from .joint_settings import STRENGTH_KEYS, JointSettings

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
        """Return whether type, freedom or springs are given; then those of `[connections]` do not count."""
        return any(getattr(self, name) is not None for name in _JOINT)

    def _check_together(self) -> None:
        breaking = [name for name in STRENGTH_KEYS if getattr(self, name) is not None]
        others = breaking + [name for name in _JOINT if getattr(self, name) is not None]
        if self.none and others:
            raise ScenarioError(f"{self.table}.none is true: expected nothing else but members, found {others[0]}")
        if len(breaking) > 1:
            listed = " and ".join(f"{self.table}.{name}" for name in breaking)
            raise ScenarioError(f"{listed} are given together: expected at most one of them")
