"""Lifts: a crane holds a part of the bridge by slings while it is cut free, and lifts it away."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..engineering.mechanics.slings import rope_stiffness_n
from ..engineering.units import mass_text
from ..errors import ScenarioError
from ..texts import Text
from .actions import CutBox, Fact, HeightAt, Plan, PlannedAction, Point, Worksite
from .as_built import Structure
from .changes.removals import LiftingAway
from .loads.part import Part
from .pulls import Pull
from .schema import POSITION, key, shown

_TAKES_UP_S = 1.0
"""Slings take up their share of the weight within this time, or half of the time until the part is lifted away."""

_LEAST_N = 1.0
"""Force of a sling that is just taut."""

_MOST_OFF = 0.02
"""Part of its mass by which the shards of a pick may be lighter or heavier without a word."""


@dataclass(frozen=True, slots=True)
class Pick:
    """What a crane takes: the mass of its shards, which run and stages move, and of its volume, which the crane lifts.

    They differ where shards end outside its box: in steelwork, and in members with points of their own.
    """

    lift: str
    shards_kg: float
    volume_kg: float
    centre_m: Point | None = None  # of gravity, as the bridge was built
    slings_n: tuple[float, ...] = ()  # what each carries once it hangs, by the larger mass

    @property
    def heavier_by(self) -> float:
        """Return by how much the larger of both is heavier than the shards, as a factor: the crane is judged by it."""
        return max(self.volume_kg / self.shards_kg, 1.0)

    @property
    def masses(self) -> str:
        """Return both masses, to as many digits as they are worth."""
        return f"{mass_text(self.volume_kg, 1)} by volume, {mass_text(self.shards_kg, 1)} in shards"

    @property
    def warning(self) -> str:
        """Return that they differ, without a full stop; empty where they hardly do."""
        if abs(self.shards_kg - self.volume_kg) <= _MOST_OFF * self.volume_kg:
            return ""
        return Text(
            "{} weighs {} by the volume in its box, but {} by the shards with their centres in it, which runs and "
            "stages lift: order no crane by the smaller one. Members with fracture.points and steelwork are not "
            "cut along a box: take these points out, or more pieces of steelwork",
            self.lift,
            mass_text(self.volume_kg, 1),
            mass_text(self.shards_kg, 1),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Lift(Part):
    """A part of the bridge that a crane takes away: slings hold it, saw cuts or removals set it free, it hangs, and is
    lifted away. The part is chosen as that of `[[removals]]`. Slings only pull, and end in one hook, which stays where
    it is. `bda stages` says the load on the hook and what stands meanwhile; in a run slings are cables, and the part is
    taken out when it is lifted away.
    """

    table: ClassVar[str] = "lifts"
    heading: ClassVar[str] = "Lifts"
    noun: ClassVar[str] = "lift"

    name: str = key("Name of the lift.")
    from_s: float = key("When slings hold the part, and begin to take up its weight.", unit="s", at_least=0)
    lift_s: float = key("When it is lifted away; it has to be cut free before.", unit="s", above=0)
    capacity_kg: float = key(
        "What the crane lifts at this radius, by its load chart, less hook block and slings.", unit="kg", above=0
    )
    pretension: float = key(
        "Share of the weight of the part that slings take up before it is cut free.", default=1.0, at_least=0, at_most=1
    )
    sling_points_m: tuple[tuple[float, float, float], ...] | None = key(
        "Where slings hold it, as the bridge was built; by default one above its centre of gravity, at its top.",
        default=None,
        unit="m",
    )
    hook_m: tuple[float, float, float] | None = key(
        "Where the hook is; by default above its centre of gravity, so high that slings are at least as steep as 60°.",
        default=None,
        **POSITION,
    )
    crane_m: tuple[float, float] | None = key(
        "Where the crane turns: x, y. Then its radius is reported.", default=None, unit="m"
    )
    diameter_mm: float = key(
        "Diameter of each sling, a wire rope of usual stiffness.", default=40.0, unit="mm", above=0, at_most=200
    )

    @property
    def elastic_n(self) -> float:
        """Stiffness EA of each sling."""
        return rope_stiffness_n(1e-3 * self.diameter_mm)

    @property
    def taken_up_s(self) -> float:
        """Time within which slings take up the weight."""
        return min(_TAKES_UP_S, 0.5 * (self.lift_s - self.from_s))

    def begins_s(self, plan: Plan) -> float:
        return self.from_s

    def ends_s(self, plan: Plan) -> float:
        return self.lift_s

    def points_of_interest(self, height_at: HeightAt) -> Iterator[Point]:
        yield from self.sling_points_m or ()
        if self.hook_m is not None:
            yield self.hook_m

    def cut_planes(self) -> tuple[CutBox, ...]:
        return (CutBox(self.members, self.box),) if self.box else ()

    def shards(self, structure: Structure, number: int) -> np.ndarray:
        inside = self.of_members(structure) & self.in_box(structure.centres_m) & structure.is_shard
        if not inside.any():
            raise ScenarioError(
                f"lifts {self.name!r}: no shard that can move is there; expected members or a box with some that no "
                "support holds"
            )
        return np.flatnonzero(inside)

    @classmethod
    def run_tables(cls) -> tuple[type[PlannedAction], ...]:
        return Sling, LiftingAway

    def in_run(self, site: Worksite) -> Iterator[PlannedAction]:
        yield from site.slings_of(self)
        yield self.lifting_away()

    def changes(self, plan: Plan) -> Iterator[LiftingAway]:
        yield self.lifting_away()

    def lifting_away(self) -> LiftingAway:
        """Return its end as a change to the structure."""
        return LiftingAway(
            time_s=self.lift_s,
            name=self.name,
            members=self.members,
            lowest_corner_m=self.lowest_corner_m,
            highest_corner_m=self.highest_corner_m,
            skew_deg=self.skew_deg,
        )

    def described(self) -> tuple[str, str]:
        what = Text("{}: slings hold with {}, then it is lifted away", self.name, f"{self.pretension:.0%}")
        return what, self.where

    def facts(self, site: Worksite) -> Iterator[Fact]:
        part, pick = site.affected_by(self), site.pick_of(self)
        used = pick.heavier_by * pick.shards_kg / self.capacity_kg
        reach_m = radius_m(self, self.hook_m or pick.centre_m)
        at_m = "" if reach_m is None else f" at {reach_m:.1f} m"
        yield (
            self.name,
            f"{pick.masses}, of {', '.join(part.members)}, {used:.0%} of the {mass_text(self.capacity_kg, 1)} that the "
            f"crane lifts{at_m}; slings hold from {self.from_s:g} s with {self.pretension:.0%} of it, lifted away at "
            f"{self.lift_s:g} s",
        )
        place = ", ".join(f"{value:.2f}" for value in pick.centre_m)
        forces = ", ".join(f"{force_n / 1e3:.1f}" for force_n in pick.slings_n)
        yield "", f"centre of gravity at {place} m; once it hangs, slings carry {forces} kN"
        if used > 1.0:
            yield "", "heavier than the crane lifts: cut it into smaller parts, or choose a larger crane"
        if pick.warning:
            yield "", pick.warning
        yield from self.facts_of_held(site.structure)
        for name, shared_kg in site.taken_before(self):
            yield "look at", f"{mass_text(shared_kg, 1)} of it are in {name} as well: take the boxes apart"

    def check_plan(self, plan: Plan) -> None:
        latest_s = plan.time.duration_s - plan.time.step.frame_s
        if not plan.warm_up_s <= self.lift_s < latest_s:
            latest = f"less than {latest_s:.6g} (s), a frame before time.duration_s is over"
            raise self.unexpected("lift_s", f"at least connections.warm_up_s, {plan.warm_up_s} (s), and {latest}")

    def check_model(self, site: Worksite) -> None:
        site.affected_by(self)

    def _check_together(self) -> None:
        Part._check_together(self)
        if self.members is None and self.lowest_corner_m is None:
            raise self.unexpected("members", "it, or the two corners of a box")
        if not self.from_s < self.lift_s:
            raise self.unexpected("lift_s", f"more than lifts.from_s, {self.from_s:g} (s)")
        if self.hook_m is not None:
            for number, point in enumerate(self.sling_points_m or (), start=1):
                if not point[2] < self.hook_m[2]:
                    raise ScenarioError(
                        f"lifts.sling_points_m.{number} is {shown(point)}: expected a point below the hook, "
                        f"lifts.hook_m {shown(self.hook_m)}"
                    )
        if self.box is not None:
            middle_m = 0.5 * (self.box.lowest_m[2] + self.box.highest_m[2])
            for number, (x, y, z) in enumerate(self.sling_points_m or (), start=1):
                if not self.in_box(np.array([[x, y, middle_m]])).any():
                    raise ScenarioError(
                        f"lifts.sling_points_m.{number} is [{x:g}, {y:g}, {z:g}]: expected a point above or in the box "
                        f"of the part, {self.where}"
                    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Sling(Pull):
    """A sling of a lift, as a cable of a run: it takes up a force, and keeps its length from then on. It follows from
    a table of `[[lifts]]`, and is no table of a scenario; a scene keeps it.
    """

    table: ClassVar[str] = "slings"

    lift: str = key("Name of its lift.")
    part_kg: float = key("Mass of the part.", unit="kg", above=0)
    volume_kg: float | None = key("Mass of the volume in its box.", default=None, unit="kg", at_least=0)

    @property
    def keeps_its_length(self) -> bool:
        return True

    @property
    def hangs_on(self) -> tuple[str, float, float]:
        return self.lift, self.part_kg, self.volume_kg or self.part_kg

    def _check_together(self) -> None:
        Part._check_together(self)


def sling_of(lift: Lift, number: int, point_m: Point, hook_m: Point, force_n: float, pick: Pick) -> Sling:
    """Return a sling of a lift, counted from 1, with the force that it takes up."""
    taken_up_n = max(force_n, _LEAST_N)
    return Sling(
        name=f"{lift.name}, sling {number}",
        members=lift.members,
        lowest_corner_m=lift.lowest_corner_m,
        highest_corner_m=lift.highest_corner_m,
        skew_deg=lift.skew_deg,
        point_m=point_m,
        anchor_m=hook_m,
        start_s=lift.from_s,
        growth_n_s=taken_up_n / lift.taken_up_s,
        largest_force_n=taken_up_n,
        breaking_force_n=lift.elastic_n,  # never
        stiffness_n=lift.elastic_n,
        lift=lift.name,
        part_kg=pick.shards_kg,
        volume_kg=pick.volume_kg,
    )


def radius_m(lift: Lift, hook_m: Sequence[float]) -> float | None:
    """Return the distance on plan of the hook from where the crane turns; None where that is not given."""
    return None if lift.crane_m is None else math.dist(lift.crane_m, hook_m[:2])
