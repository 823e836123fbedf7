"""Changes to the structure at given times: removals, saw cuts, weakenings, and blast zones that fire."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.drilled_charges.specific_charge import Effect
from ...engineering.geometry.vectors import AXES
from ...errors import ScenarioError
from ..actions import CutBox, CutThrough, Fact, Plan, Worksite
from ..blast.cuts import MemberCut
from ..lifts import Lift
from ..loads import Part
from ..schema import key, shown


@dataclass(frozen=True, slots=True, kw_only=True)
class Change(Part):
    """A change at a time to a part of the bridge: to some members, to what lies in a box, or to both at once."""

    table: ClassVar[str] = "changes"
    kind: ClassVar[str] = "change"

    time_s: float = key("When it happens.", unit="s", at_least=0)

    def begins_s(self, plan: Plan) -> float:
        return self.time_s

    def facts(self, site: Worksite) -> Iterator[Fact]:
        yield f"{self.time_s:.3f} s", f"{self.kind}, {self.where or 'everywhere'}"

    def check_plan(self, plan: Plan) -> None:
        """Check that it happens between the end of the settling and the end of the run."""
        latest_s = plan.time.duration_s - plan.time.step.frame_s
        if not plan.warm_up_s <= self.time_s < latest_s:
            latest = f"less than {latest_s:.6g} (s), a frame before time.duration_s is over"
            raise self.unexpected("time_s", f"at least connections.warm_up_s, {plan.warm_up_s} (s), and {latest}")

    def check_model(self, site: Worksite) -> None:
        site.affected_by(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Removal(Change):
    """Shards that are taken away in one moment, such as a pier that is kicked out: all of the members, or what of them
    lies in the box. The members are cut along the sides of the box before they are made into shards, so that what goes
    weighs what the box holds. Connections of what goes are cut, it collides with nothing any more, and what slept wakes
    up. It is put out of sight, 1000 m below its position.
    """

    table: ClassVar[str] = "removals"
    kind: ClassVar[str] = "removal"

    along: str = key(
        "What ends at the box: `box` cuts shards apart along its sides; `faces` takes whole shards, those whose "
        "centres of mass lie in it, and so do all removals of steelwork and of members with `fracture.points`.",
        default="box",
        choices=("box", "faces"),
    )

    def cut_planes(self) -> tuple[CutBox, ...]:
        return (CutBox(self.members, self.box),) if self.box and self.along == "box" else ()

    def _check_together(self) -> None:
        Change._check_together(self)
        if self.members is None and self.lowest_corner_m is None:
            raise self.unexpected("members", "it, or the two corners of a box")


@dataclass(frozen=True, slots=True, kw_only=True)
class LiftingAway(Removal):
    """A part that a crane lifts away: it is taken out in one moment. It follows from a table of `[[lifts]]`, and is no
    table of a scenario; a scene keeps it.
    """

    table: ClassVar[str] = "liftings_away"
    kind: ClassVar[str] = "lifting away"

    name: str = key("Name of the lift.")


def lifting_away(lift: Lift) -> LiftingAway:
    """Return the end of a lift as a change to the structure."""
    return LiftingAway(
        time_s=lift.lift_s,
        name=lift.name,
        members=lift.members,
        lowest_corner_m=lift.lowest_corner_m,
        highest_corner_m=lift.highest_corner_m,
        skew_deg=lift.skew_deg,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class SawCut(Change):
    """A saw cut through a plane: in one moment it cuts the connections between shards on its two sides, of the members
    and in the box, or everywhere. The members are cut along the plane before they are made into shards, so that each
    side weighs what the plane leaves it, and lies on its own bearings. A box chooses faces by their middles.
    """

    table: ClassVar[str] = "saw_cuts"
    kind: ClassVar[str] = "saw cut"

    point_m: tuple[float, float, float] = key("A point of the plane.", unit="m")
    normal: tuple[float, float, float] = key("Direction across the plane, of any length but 0.")
    along: str = key(
        "What the cut follows: `plane` cuts shards apart along it; `faces` goes around shards, in steps, and so do all "
        "cuts through steelwork and members with `fracture.points`.",
        default="plane",
        choices=("plane", "faces"),
    )

    def _check_together(self) -> None:
        Change._check_together(self)
        if not any(self.normal):
            raise ScenarioError(f"{self.table}.normal is {shown(self.normal)}, all 0: expected a direction")

    def cut_planes(self) -> tuple[CutThrough, ...]:
        if self.along == "faces":
            return ()
        return (CutThrough(self.members, self.point_m, self.normal, self.box),)


@dataclass(frozen=True, slots=True, kw_only=True)
class Severing(SawCut):
    """A member that explosive severs along a plane. It follows from a table of `[[cuts]]`, and is no table of a
    scenario; a scene keeps it.
    """

    table: ClassVar[str] = "severings"
    kind: ClassVar[str] = "severed member"


def severing(cut: MemberCut, start_s: float, seed: int) -> Severing:
    """Return a member that explosive severs as a change to the structure, in a run with a seed and a start."""
    point_m, normal = cut.plane
    return Severing(time_s=start_s + cut.fired_after_s(seed), members=(cut.member,), point_m=point_m, normal=normal)


@dataclass(frozen=True, slots=True, kw_only=True)
class Weakening(Change):
    """A loss of strength in one moment, such as by cut reinforcement: of all connections of the members' shards, of
    those in the box, or of all. What slept among them wakes up, so that they carry their load at once. Several at the
    same position multiply.
    """

    table: ClassVar[str] = "weakenings"
    kind: ClassVar[str] = "weakening"

    factor: float = key("Part of the strength, or of the breaking force, that is left.", above=0, at_most=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class TendonCut(Change):
    """A cut of tendons in one moment, without the concrete around them: of those named, of those in some members, or
    of all, where they run through the box. Without a box an unbonded tendon lets go at its anchorages. Saw cuts,
    removals, severed members and zones that are blasted away cut the tendons that cross them as well.
    """

    table: ClassVar[str] = "tendon_cuts"
    kind: ClassVar[str] = "tendon cut"

    tendons: tuple[str, ...] | None = key("Names of the tendons; by default all.", default=None)

    def facts(self, site: Worksite) -> Iterator[Fact]:
        yield f"{self.time_s:.3f} s", f"{self.kind}, {site.cut_tendons_text(self)}"

    def check_model(self, site: Worksite) -> None:
        site.cut_tendons_text(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class ZoneFiring(Change):
    """What drilled charges do to a blast zone, the box of a member, when its last row fires. It follows from the zone
    and the model, and is no table of a scenario; a scene keeps it.
    """

    table: ClassVar[str] = "zone_firings"
    kind: ClassVar[str] = "blast zone"

    name: str = key("Name of the zone.")
    along: str = key("Axis that its member runs along.", choices=AXES)
    effect: str = key("What its concrete does.", choices=tuple(effect.value for effect in Effect))
    left: float = key("Part of the strength that its connections have left.", at_least=0, at_most=1)
    left_compression: float | None = key(
        "The same in compression; by default as much.", default=None, at_least=0, at_most=1
    )
    speed_m_s: float = key(
        "Mean speed of shards that are thrown; 0 where they fall as rubble at the foot.", unit="m/s", at_least=0
    )
    cage_tension_n: float = key("What its bars resist in tension.", unit="N", at_least=0)
    cage_compression_n: float = key("What its bars resist in compression.", unit="N", at_least=0)
    bars: float = key("Bars that stand bare once its concrete is gone.", default=0.0, at_least=0)
    bar_diameter_mm: float = key("Their diameter.", default=20.0, unit="mm", above=0, at_most=100)
    bar_yield_n_mm2: float = key("Their yield strength.", default=500.0, unit="N/mm²", above=0, at_most=5000)
    bar_distances_m: tuple[float, float] = key(
        "Distances of the bars from the middle of the section along its two axes, root mean squares.",
        default=(0.0, 0.0),
        unit="m",
        at_least=0,
    )

    @property
    def left_by_compression(self) -> float:
        """Return by how much more strength its connections have left in compression."""
        if self.left_compression is None or not self.left:
            return 1.0
        return max(self.left_compression / self.left, 1.0)

    @property
    def takes_away(self) -> bool:
        """Return whether its shards no longer carry, not even where they touch others."""
        return self.effect == Effect.THROWN
