"""Connections between certain members that are others than the rest."""

from dataclasses import dataclass
from typing import ClassVar

from ..errors import ScenarioError
from ..gravity import STANDARD_GRAVITY_M_S2
from ..joint import MOTIONS, TYPES
from ..strength import MATERIALS
from .key import Table, key

GROUND_NAME = "ground"


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionBetween(Table):
    """Connections between two members, or two kinds of members, that differ from the others: bearings, joints, gaps.
    What is not given is as in `[connections]`. The first of these tables that names both members counts.
    """

    table: ClassVar[str] = "connections.between"

    members: tuple[str, str] = key(
        'The two, each by the name that `bda check` lists or by kind, or `"ground"` for the foundations: '
        '`["deck", "pier cap"]`. Twice the same for connections within a member.'
    )
    none: bool = key("Whether there are no connections between them at all; then nothing else is given.", default=False)
    type: str | None = key("Kind of rigid-body constraint, as in `[connections]`.", default=None, choices=TYPES)
    free: tuple[str, ...] | None = key(
        'What a `GENERIC` connection lets happen, along and about the axes of the bridge: `["move x", "turn y"]` for a '
        "bearing that slides along the road and turns about the axis across it.",
        default=None,
        choices=MOTIONS,
    )
    breaking_force_n: float | None = key("Force that breaks it.", default=None, unit="N", above=0)
    breaking_force_kgf: float | None = key(
        "Force that breaks it, 1 kgf = 9.80665 N.", default=None, unit="kgf", above=0
    )
    material: str | None = key(
        "Material by whose strengths it breaks; with method `face`. Give at most one of this, `breaking_force_n` and "
        "`breaking_force_kgf`.",
        default=None,
        choices=tuple(MATERIALS),
    )

    @property
    def breaking_force_newton(self) -> float | None:
        """Force that breaks it, N, whichever unit it was given in; None where none was given."""
        if self.breaking_force_kgf is not None:
            return self.breaking_force_kgf * STANDARD_GRAVITY_M_S2
        return self.breaking_force_n

    def _check_together(self) -> None:
        breaking = [
            name for name in ("breaking_force_n", "breaking_force_kgf", "material") if getattr(self, name) is not None
        ]
        others = breaking + [name for name in ("type", "free") if getattr(self, name) is not None]
        if self.none and others:
            raise ScenarioError(f"{self.table}.none is true: expected nothing else but members, found {others[0]}")
        if len(breaking) > 1:
            listed = " and ".join(f"{self.table}.{name}" for name in breaking)
            raise ScenarioError(f"{listed} are given together: expected at most one of them")
