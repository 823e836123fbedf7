"""Pulls: a winch or a machine on the ground pulls a part of the bridge over by a cable, as a scenario gives them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from ..engineering.geometry.vectors import unit
from ..engineering.mechanics.slings import rope_stiffness_n, stored_j
from ..errors import ScenarioError
from ..texts import Quantity, Text, point_text
from .actions import Fact, HeightAt, Plan, Point, Worksite
from .as_built import Structure
from .loads.part import Acting, Part, PlacedLoad, nearest_of, unusual_force
from .schema import POSITION, check_exactly_one, given, key

_SHORTEST_M = 0.5

_FALLS_TOWARDS = 1.5
"""Length of a cable by the height of the point it is fixed to, below which what it pulls over may reach the anchor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pull(Acting):
    """A cable from a point of the bridge to an anchor, which a winch reels in: it only pulls, and goes with the body.
    It collides with nothing, has no weight, and is straight. Of the members or the box, the shard nearest to the point
    carries it. A run has it; `bda stages` has it as a force as large as it can be.
    """

    table: ClassVar[str] = "pulls"
    heading: ClassVar[str] = "Pulls"
    noun: ClassVar[str] = "pull"
    kept_in: ClassVar[str] = "pulls"

    name: str = key("Name of the cable.")
    point_m: tuple[float, float, float] = key(
        "Where the cable is fixed, as the bridge was built: to one shard, chosen as that of `loads.point_m`.", unit="m"
    )
    anchor_m: tuple[float, float, float] = key(
        "Where its other end is: a winch, or a machine. It stays there.", **POSITION
    )
    start_s: float = key("When the winch starts; the cable has no force before.", unit="s", at_least=0)
    speed_m_s: float | None = key(
        "Speed at which it is reeled in, or `growth_n_s` instead.", default=None, unit="m/s", above=0, at_most=20
    )
    growth_n_s: float | None = key(
        "Growth of its force, by as much reeling as that takes, up to the largest.", default=None, unit="N/s", above=0
    )
    largest_force_n: float = key(
        "Force at which the winch holds and then pays out, or the machine slips.", unit="N", above=0
    )
    breaking_force_n: float = key("Force at which the cable breaks.", unit="N", above=0)
    diameter_mm: float | None = key(
        "Diameter of the cable, a wire rope of usual stiffness, or `stiffness_n` instead.",
        default=None,
        unit="mm",
        above=0,
        at_most=200,
    )
    stiffness_n: float | None = key(
        "Stiffness EA of the cable: modulus of elasticity by metallic area.", default=None, unit="N", above=0
    )
    free_length_m: float | None = key(
        "Length of the cable without force at the start; by default it is just taut then.",
        default=None,
        unit="m",
        at_least=_SHORTEST_M,
    )

    @property
    def elastic_n(self) -> float:
        """Stiffness EA."""
        return rope_stiffness_n(1e-3 * given(self.diameter_mm)) if self.stiffness_n is None else self.stiffness_n

    @property
    def keeps_its_length(self) -> bool:
        """Whether it has its largest force once, and keeps its length from then on, whatever its force."""
        return False

    @property
    def hangs_on(self) -> tuple[str, float, float] | None:
        """Name of the lift whose hook it ends in, masses of its part by shards and by volume; None without one."""
        return None

    @property
    def built_length_m(self) -> float:
        """Distance of its ends as the bridge was built."""
        return math.dist(self.point_m, self.anchor_m)

    @property
    def most_n(self) -> float:
        """Force that it comes to at most."""
        return min(self.largest_force_n, self.breaking_force_n)

    @property
    def stored_at_most_j(self) -> float:
        """Energy in it at that force."""
        return stored_j(self.elastic_n, self.most_n, self.built_length_m)

    def begins_s(self, plan: Plan) -> float:
        return self.start_s

    def points_of_interest(self, height_at: HeightAt) -> Iterator[Point]:
        yield self.point_m
        yield self.anchor_m

    def placed(self, structure: Structure, number: int) -> PlacedLoad[Self]:
        body, arm_m = nearest_of(self.movable(structure, number), self.point_m, structure)
        towards = unit(np.array(self.anchor_m) - np.array(self.point_m))
        return PlacedLoad(self, np.array([body]), np.ones(1), towards[None], arm_m[None])

    def described(self) -> tuple[str, str]:
        what = Text("{} pulls with up to {}", self.name, Quantity(self.most_n / 1e3, "kN", "g"))
        return what, Text("from {}", point_text(self.anchor_m))

    def facts(self, site: Worksite) -> Iterator[Fact]:
        how = f"{self.speed_m_s:g} m/s" if self.speed_m_s is not None else f"{given(self.growth_n_s) / 1e3:g} kN/s"
        (member,) = site.affected_by(self).members
        higher_m = self.point_m[2] - self.anchor_m[2]
        anchor = ", ".join(f"{value:g}" for value in self.anchor_m)
        yield (
            self.name,
            f"from {self.start_s:g} s, {how}, up to {self.largest_force_n / 1e3:g} kN, {self.built_length_m:.1f} m "
            f"from {member} to ({anchor}) m; breaks at {self.breaking_force_n / 1e3:g} kN",
        )
        yield (
            "",
            f"holds {self.stored_at_most_j / 1e3:.1f} kJ at {self.most_n / 1e3:g} kN, and whips back where it breaks: "
            "keep everybody off its line, and farther away than it is long",
        )
        if self.breaking_force_n <= self.largest_force_n:
            yield "", "breaks before the winch pays out: choose a stronger cable or a smaller largest_force_n"
        if self.built_length_m < _FALLS_TOWARDS * higher_m:
            yield (
                "",
                f"its anchor is {self.built_length_m:.1f} m from a point that is {higher_m:.1f} m higher: what is "
                f"pulled over may reach it within {_FALLS_TOWARDS:g} times that height",
            )

    def unusual(self, site: Worksite) -> Iterator[str]:
        return unusual_force(self.name, self.most_n, site)

    def check_plan(self, plan: Plan) -> None:
        if self.start_s >= plan.time.duration_s:
            raise self.unexpected("start_s", f"less than time.duration_s, {plan.time.duration_s} (s)")

    def check_model(self, site: Worksite) -> None:
        site.affected_by(self)

    def _check_together(self) -> None:
        Part._check_together(self)
        check_exactly_one(self, "speed_m_s", "growth_n_s")
        check_exactly_one(self, "diameter_mm", "stiffness_n")
        if self.built_length_m < _SHORTEST_M:
            raise self.unexpected("anchor_m", f"a point {_SHORTEST_M} m or more from pulls.point_m")
        if self.most_n > 0.5 * self.elastic_n:
            name = "diameter_mm" if self.stiffness_n is None else "stiffness_n"
            raise ScenarioError(
                f"pulls.{name} is {getattr(self, name):g}: expected a cable that its force of {self.most_n / 1e3:g} kN "
                "stretches by less than half of its length"
            )
