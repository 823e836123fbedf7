"""Members that are severed by explosive: of steel, or of what was prepared for it. How is not planned here."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

from ...engineering.geometry.vectors import AXES
from ...texts import Quantity, Text
from ..actions import CutPlane, Fact, Plan, PlannedAction, Worksite
from ..changes.saw_cuts import Severing
from ..schema import POSITION, SHARE, key, shown
from .blast_zones import DETONATORS, NO_SCATTER, BlastZone, check_fires_within, scattered_time_s
from .charges import LARGEST_CHARGE_KG, MS_PER_S


@dataclass(frozen=True, slots=True, kw_only=True)
class MemberCut(PlannedAction):
    """A member that is severed across, with all its bars, at a time: one of steel, or one that was prepared for it. It
    is cut along that plane. The explosive counts for air pressure, vibration and totals alone: whether it severs the
    member is for a licensed blaster to say. See [drilled charges](drilled_charges.md#severed-members).
    """

    table: ClassVar[str] = "cuts"
    heading: ClassVar[str] = "Severed members"
    numbered: ClassVar[str] = "Cut"
    named_beside: ClassVar[str] = BlastZone.table
    noun: ClassVar[str] = "severed member"

    name: str | None = key("What it is called in plans; by default Cut and its number.", default=None)
    member: str = key("The member, by a name that `bda check` lists.")
    along: str = key("Axis of the bridge that the member is severed across.", default="z", choices=AXES)
    position_m: float = key("Where along that axis: of a column, the height above the ground.", **POSITION)
    mass_kg: float = key("Explosive.", unit="kg", at_least=0, at_most=LARGEST_CHARGE_KG)
    delay_ms: float = key("Time from `blast.start_s`.", default=0.0, unit="ms", at_least=0, at_most=1e6)
    detonator: str = key(
        "Kind of its detonator, by which its time scatters as that of a blast zone.",
        default=NO_SCATTER,
        choices=tuple(DETONATORS),
    )
    fires: bool = key("Whether it fires; `false` is a misfire.", default=True)
    probability_fires: float = key(
        "Probability that it fires, by which each run of a study samples `fires`.", default=1.0, **SHARE
    )

    @property
    def time_s(self) -> float:
        """Time after the start of the blasting, as planned."""
        return self.delay_ms / MS_PER_S

    @property
    def deviation_s(self) -> float:
        """Standard deviation of this time."""
        fixed_s, share = DETONATORS[self.detonator]
        return fixed_s + share * self.time_s

    @property
    def ends_along_m(self) -> tuple[float, float]:
        """Where it begins and ends along that axis: a cut is a plane."""
        return self.position_m, self.position_m

    @property
    def plane(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """A point of the plane and its normal."""
        point, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        point[AXES.index(self.along)], normal[AXES.index(self.along)] = self.position_m, 1.0
        return (point[0], point[1], point[2]), (normal[0], normal[1], normal[2])

    def fired_after_s(self, seed: int) -> float:
        """Return when it fires in a run with a seed, after the start of the blasting, s."""
        return scattered_time_s(self.time_s, self.deviation_s, seed, f"{self.name}")

    def begins_s(self, plan: Plan) -> float:
        return plan.detonation_s(self.time_s) if self.fires else math.inf

    @classmethod
    def run_tables(cls) -> tuple[type[PlannedAction], ...]:
        return (Severing,)

    def in_run(self, site: Worksite) -> Iterator[PlannedAction]:
        yield from self.changes(site.plan)

    def changes(self, plan: Plan) -> Iterator[Severing]:
        if self.fires and math.isfinite(plan.detonation_s(0.0)):
            yield self.severing(plan)

    def severing(self, plan: Plan) -> Severing:
        """Return it as a change to the structure, where it fires."""
        point_m, normal = self.plane
        time_s = plan.blast_start_s + self.fired_after_s(plan.seed)
        return Severing(time_s=time_s, members=(self.member,), point_m=point_m, normal=normal)

    def described(self) -> tuple[str, str]:
        return Text("{} severs a member: {}", self.name, Quantity(self.mass_kg, "kg", ".3g")), self.member

    def facts(self, site: Worksite) -> Iterator[Fact]:
        begins_s = self.begins_s(site.plan)
        when = f"{begins_s:.3f} s" if math.isfinite(begins_s) else "does not go off" if self.fires else "misfires"
        where = f"{self.member}, severed at {self.along} = {self.position_m:g} m"
        yield f"{self.name}", f"{where}, {self.mass_kg:.3g} kg, {when}"

    def cut_planes(self) -> tuple[CutPlane, ...]:
        return (CutPlane(self.member, self.along, self.position_m, self.table),)

    def check_plan(self, plan: Plan) -> None:
        """Check that it fires after the settling and before the end of the run, if at all."""
        time_s = self.begins_s(plan)
        check_fires_within(plan, time_s, time_s, f"{self.name} fires at {time_s:g} s")

    def check_model(self, site: Worksite) -> None:
        site.check_cut(self)


def check_cuts(cuts: Sequence[MemberCut], zones: Sequence[BlastZone]) -> None:
    """Refuse cuts within a blast zone or across another axis than the zones and cuts of their member."""
    others: list[BlastZone | MemberCut] = [*zones, *cuts]
    for cut in cuts:
        for other in others:
            if other.member != cut.member:
                continue
            if other.along != cut.along:
                raise cut.unexpected("along", f'"{other.along}" as {shown(other.name)} of {cut.member} has')
            if other.ends_along_m[0] < cut.position_m < other.ends_along_m[1]:
                raise cut.unexpected("position_m", f"a position outside {shown(other.name)}, a zone of that member")
