"""Bearings between members: what carries one on the other, and the motions that it leaves free."""

from dataclasses import dataclass
from fnmatch import fnmatchcase
from math import sqrt
from typing import ClassVar

from ...engineering.mechanics.strength import Joint
from ...errors import ScenarioError
from ..schema import SHORTEST_LENGTH_M, Table, key

FIXED, PINNED, ROCKER, SLIDING, ELASTOMERIC = KINDS = ("fixed", "pinned", "rocker", "sliding", "elastomeric")

_NEWTON_PER_MEGANEWTON = 1e6

UNYIELDING_MN_M = 1e5
"""Stiffness of a pad that is given none: 1 MN shortens it by 0.01 mm, which no reaction of a bridge notices."""

UNYIELDING_LINE_MN_M2 = 3e4
"""The same of each metre of a line shorter than 3.3 m: as stiff as the concrete above and below it, about its
modulus of elasticity. A web of 0.4 m that twists on a line does so by as much as in a mesh of bricks (OpenSees)."""

_FREE_WHEN_RIGID = {
    FIXED: (),
    PINNED: ("turn x", "turn y", "turn z"),
    ROCKER: ("move x", "turn x", "turn y", "turn z"),
    SLIDING: ("move x", "move y", "turn x", "turn y", "turn z"),
}
"""Motions that each pad leaves free where connections are rigid. A row of pads holds turns about other axes."""

_ONLY = {
    "friction": (SLIDING, ELASTOMERIC),
    "shear_mn_m": (ELASTOMERIC,),
    "rotation_mnm_rad": (ELASTOMERIC,),
}
"""Keys that only some kinds have."""

_NEEDED = {SLIDING: ("friction",), ELASTOMERIC: ("stiffness_mn_m", "shear_mn_m")}


def names_one(pattern: str, name: str, kind: str) -> bool:
    """Return whether a pattern is the name or the kind of a member, or stands for one of them."""
    return any(text == pattern or fnmatchcase(text, pattern) for text in (name, kind))


@dataclass(frozen=True, slots=True, kw_only=True)
class Bearing(Table):
    """A bearing between two members, one above the other. It takes the place of all connections between them: only its
    pads carry, on a line across the road or side by side on it. The first of these tables that names both members
    counts, before `[[connections.between]]`."""

    table: ClassVar[str] = "bearings"

    members: tuple[str, str] = key(
        "The member above and the one below it, each by the name that `bda check` lists or by kind, with `*` for any "
        'letters: `["deck", "pier * cap"]`. Each two of them that touch have a bearing.'
    )
    kind: str = key(
        "`fixed` holds displacements and rotations, `pinned` displacements alone; `rocker` moves along the road as "
        "well, without friction; `sliding` moves along and across it where `friction` ends; `elastomeric` deforms by "
        "its stiffness.",
        choices=KINDS,
    )
    tension: bool = key("Whether it holds what is lifted; otherwise that lifts off.", default=False)
    offset_m: float = key(
        "Distance of its axis from the middle of the area where the members touch, along the road.",
        default=0.0,
        unit="m",
        at_least=-1000,
        at_most=1000,
    )
    pads: int | None = key(
        "Number of pads in a row across the road, in each area where the members touch; without it the bearing is one "
        "line across all of that.",
        default=None,
        at_least=1,
        at_most=100,
    )
    spacing_m: float | None = key(
        "Distance of pads from each other; by default they share the width evenly.", default=None, unit="m", above=0
    )
    positions_m: tuple[float, ...] | None = key(
        "Positions of pads across the road, from the middle of the area, in place of `pads` and `spacing_m`.",
        default=None,
        unit="m",
        at_least=-1000,
        at_most=1000,
    )
    pad_m: tuple[float, float] | None = key(
        "Length of a pad along the road and its width across it; by default pads are points, and a `fixed` bearing is "
        "as long as the area.",
        default=None,
        unit="m",
        at_least=SHORTEST_LENGTH_M,
        at_most=100,
    )
    friction: float | None = key(
        "Coefficient of friction. Needed for `sliding`, 0.03 to 0.08 with PTFE; an `elastomeric` one slides only where "
        "it is given.",
        default=None,
        at_least=0,
        at_most=10,
    )
    stiffness_mn_m: float | None = key(
        "Vertical stiffness of each pad, or of the line; by default 100 000, or 30 000 for each metre of a shorter "
        "line. Needed for `elastomeric`.",
        default=None,
        unit="MN/m",
        above=0,
        at_most=1e6,
    )
    shear_mn_m: float | None = key(
        "Horizontal stiffness of each pad, or of the line; needed for `elastomeric`, and only for it.",
        default=None,
        unit="MN/m",
        above=0,
        at_most=1e6,
    )
    rotation_mnm_rad: float | None = key(
        "Stiffness of each pad, or of the line, against rotation about its axis; by default none. Only for "
        "`elastomeric`.",
        default=None,
        unit="MN·m/rad",
        above=0,
        at_most=1e6,
    )
    breaking_force_n: float | None = key(
        "Horizontal force, or uplift where it has `tension`, at which the whole bearing breaks; by default none. Where "
        "connections are rigid each part of it breaks at this force, and without it by their strength.",
        default=None,
        unit="N",
        above=0,
    )
    travel_m: float = key(
        "Displacement at which what lies above a pad has left it for good, where connections are elastic.",
        default=0.2,
        unit="m",
        at_least=SHORTEST_LENGTH_M,
        at_most=100,
    )
    height_m: float = key(
        "Height by which it keeps the two members apart: shards above it are cut off so far, but keep their mass, and "
        "fall by it once the bearing has broken.",
        default=0.01,
        unit="m",
        at_least=0.001,
        at_most=1,
    )

    def joins(self, above: tuple[str, str], below: tuple[str, str]) -> bool:
        """Return whether it is between two members, each with its name and kind."""
        return all(names_one(pattern, *member) for pattern, member in zip(self.members, (above, below), strict=True))

    @property
    def described(self) -> str:
        """Kind and pads, for a reader."""
        count = self.pads if self.positions_m is None else len(self.positions_m)
        pads = "in a line" if count is None else f"on {count} pads"
        friction = "" if self.friction is None else f" with a friction of {self.friction:g}"
        return f"{self.kind}{friction}, {pads}{', holds against uplift' if self.tension else ''}"

    @property
    def vertical_n_m(self) -> float:
        """Vertical stiffness of a pad, N/m."""
        given = UNYIELDING_MN_M if self.stiffness_mn_m is None else self.stiffness_mn_m
        return _NEWTON_PER_MEGANEWTON * given

    def line_n_m(self, length_m: float) -> float:
        """Return the vertical stiffness of a line that is so long across the road, N/m."""
        if self.stiffness_mn_m is not None:
            return self.vertical_n_m
        return min(self.vertical_n_m, _NEWTON_PER_MEGANEWTON * UNYIELDING_LINE_MN_M2 * length_m)

    @property
    def sideways_n_m(self) -> tuple[float, float]:
        """Stiffness of a pad along the road and across it, N/m."""
        across = _NEWTON_PER_MEGANEWTON * (UNYIELDING_MN_M if self.shear_mn_m is None else self.shear_mn_m)
        return (0.0 if self.kind == ROCKER else across), across

    @property
    def slides_at(self) -> float:
        """Friction; infinite where it does not slide."""
        return float("inf") if self.friction is None else self.friction

    def arm_m(self, length_m: float) -> float:
        """Return the distance, along the road, of its springs from its axis; `length_m` is the contact's length."""
        if self.kind == FIXED:
            # Two rows resist turning as an even bed does: L² / 12 = a².
            length = self.pad_m[0] if self.pad_m else length_m
            return length / sqrt(12.0)
        if self.rotation_mnm_rad is None:
            return 0.0
        return sqrt(_NEWTON_PER_MEGANEWTON * self.rotation_mnm_rad / self.vertical_n_m)

    def joint(self, own: Joint, strength_factor: float, *, is_elastic: bool) -> Joint:
        """Return the joint of its pads, from the joint of connections that follow no rule."""
        if is_elastic:
            return Joint("GENERIC", strength=own.strength, moduli=own.moduli)
        force, strength = own.breaking_force_n, own.strength
        if self.breaking_force_n is not None:
            force, strength = strength_factor * self.breaking_force_n, None
        return Joint("GENERIC", _FREE_WHEN_RIGID[self.kind], breaking_force_n=force, strength=strength)

    def check_rigid(self) -> None:
        """Check that it can be between rigid members."""
        for name in ("stiffness_mn_m", "shear_mn_m", "rotation_mnm_rad"):
            if getattr(self, name) is not None:
                raise self.unexpected(name, 'none where connections.stiffness is "rigid"')
        if self.kind == ELASTOMERIC:
            raise self.unexpected("kind", f'one of {", ".join(KINDS[:-1])} where connections.stiffness is "rigid"')

    def _check_together(self) -> None:
        for name, kinds in _ONLY.items():
            if getattr(self, name) is not None and self.kind not in kinds:
                raise self.unexpected(name, f'none with kind "{self.kind}"')
        for name in _NEEDED.get(self.kind, ()):
            if getattr(self, name) is None:
                raise ScenarioError(f'{self.table}.{name} is missing: expected it with kind "{self.kind}"')
        if self.positions_m is not None:
            for name in ("pads", "spacing_m"):
                if getattr(self, name) is not None:
                    raise self.unexpected(name, f"none with {self.table}.positions_m")
        if self.spacing_m is not None and (self.pads or 1) < 2:
            raise self.unexpected("spacing_m", f"none without two or more {self.table}.pads")
        if self.pad_m is not None and self.pads is None and self.positions_m is None:
            raise ScenarioError(f"{self.table}.pads is missing: expected it with {self.table}.pad_m")


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingOfBridge(Bearing):
    """A bearing that follows from `[bridge.bearings]`."""

    table: ClassVar[str] = "bridge.bearings"

    @property
    def source(self) -> str:
        """Where the scenario says it, for a message."""
        return f"[{self.table}]"
