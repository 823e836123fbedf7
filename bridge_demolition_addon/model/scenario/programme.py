"""Machines next to a bridge, and the programme of works in hours: shifts, possessions, tasks and what is late."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from ...engineering.arithmetic import logarithm
from ...engineering.geometry.vectors import length
from ...engineering.timing.shifts import DAY_H, Shift, clock, worked_from
from ...texts import Quantity, Text
from ..actions import Fact, Plan, PlannedAction, PlannedStep, Worksite
from ..schema import Table, check_exactly_one, key

_USUAL_M3_H = {"breaker": (1.0, 30.0), "pulverizer": (3.0, 50.0), "shear": (1.0, 50.0), "saw": (0.1, 5.0)}
"""Output in reinforced concrete that is usual by trade; ours, as no standard has one."""

_NOISE_AT_M = (10.0, 50.0, 100.0)
_HOUR = {"unit": "h", "at_least": 0, "at_most": 10_000}


class _BesideRun(PlannedAction):
    """What is planned around a bridge and is no part of a run."""

    __slots__ = ()
    table: ClassVar[str] = "beside_run"

    def begins_s(self, plan: Plan) -> float:
        return math.inf

    def planned(self, plan: Plan) -> Iterator[PlannedStep]:
        yield from ()

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine(_BesideRun):
    """A machine beside or below the bridge, such as an excavator with a breaker: `bda check` says what of its members
    it reaches from where it stands, and how loud it is. A run does not have it; what stands on the bridge is
    `[[equipment]]`."""

    table: ClassVar[str] = "machines"
    heading: ClassVar[str] = "Machines"
    noun: ClassVar[str] = "machine"

    name: str = key("What it is called.")
    tool: str = key(
        "What it works with.",
        default="breaker",
        choices=("breaker", "pulverizer", "shear", "saw", "crane", "loader", "other"),
    )
    position_m: tuple[float, float, float] = key("Where it stands: x, y and height of the foot of its boom.", unit="m")
    reach_m: float | None = key(
        "How far its tool reaches from there, by its working range.", default=None, unit="m", above=0, at_most=200
    )
    members: tuple[str, ...] | None = key("Names or kinds of members that it works on from there.", default=None)
    output_m3_h: float | None = key(
        "Concrete that it breaks or cuts in an hour, by your own records.", default=None, unit="m³/h", above=0
    )
    sound_power_db: float | None = key(
        "Sound power level, A-weighted, as its plate says: 118 to 125 of a breaker at work.",
        default=None,
        unit="dB",
        at_least=50,
        at_most=160,
    )

    def noise_db(self, distance_m: float) -> float:
        """Return the sound pressure level at a distance over hard ground, dB: L_W - 20 lg d - 8.

        ISO 9613-2:1996, equations 3 and 7, a source in the half-space without absorption, screens or reflections.
        """
        assert self.sound_power_db is not None
        return self.sound_power_db - 20.0 * float(logarithm(distance_m) / logarithm(10.0)) - 8.0

    def facts(self, site: Worksite) -> Iterator[Fact]:
        label, parts = self.name, []
        if self.output_m3_h is not None:
            parts.append(f"{self.output_m3_h:g} m³/h")
        if self.sound_power_db is not None:
            levels = ", ".join(f"{self.noise_db(far):.0f} dB(A) at {far:g} m" for far in _NOISE_AT_M)
            parts.append(f"{levels} without screens")
        yield label, f"{self.tool}{''.join(', ' + part for part in parts)}"
        if self.members and self.reach_m is not None:
            far = self._distances_m(site)
            beyond = int((far > self.reach_m).sum())
            found = f"{beyond} of {len(far)} shards are farther away" if beyond else "all are within that"
            distances = f"its members are {far.min():.1f} to {far.max():.1f} m away"
            yield "", f"{distances}, it works up to {self.reach_m:g} m: {found}"

    def unusual(self, site: Worksite) -> Iterator[str]:
        low, high = _USUAL_M3_H.get(self.tool, (0.0, math.inf))
        if self.output_m3_h is not None and not low <= self.output_m3_h <= high:
            values = (Quantity(value, "m³/h", "g") for value in (self.output_m3_h, low, high))
            yield Text("{} takes {}, where {} to {} is usual", self.name, *values)

    def check_model(self, site: Worksite) -> None:
        if self.members:
            self._distances_m(site)

    def _distances_m(self, site: Worksite) -> np.ndarray:
        """Return the distances (s,) of the middles of its members' shards."""
        structure = site.structure
        members = self.members or ()
        chosen = np.isin(structure.member_names, members) | np.isin(structure.member_kinds, members)
        if not chosen.any():
            raise self.unexpected("members", "names or kinds of members, as bda check lists them")
        return length(structure.centres_m[chosen] - np.array(self.position_m))


@dataclass(frozen=True, slots=True, kw_only=True)
class Possession(Table):
    """A time in which a railway, road or river is closed for the works."""

    table: ClassVar[str] = "programme.possessions"

    name: str = key("What it is called.")
    from_h: float = key("When it begins, in hours from the midnight at which the first day begins.", **_HOUR)
    to_h: float = key("When it ends: all that needs it has to be done by then.", **_HOUR)

    def _check_together(self) -> None:
        if self.to_h <= self.from_h:
            raise self.unexpected("to_h", f"more than programme.possessions.from_h, {self.from_h:g} (h)")


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkTask(Table):
    """A part of the works: by a volume and the output of its machine, or by hours."""

    table: ClassVar[str] = "programme.tasks"

    name: str = key("What is done.")
    machine: str | None = key("The machine that does it, one of `[[machines]]`; it does one at a time.", default=None)
    volume_m3: float | None = key(
        "Concrete that it takes, with the output of its machine.", default=None, unit="m³", above=0
    )
    hours_h: float | None = key(
        "How long it takes, in place of a volume.", default=None, unit="h", above=0, at_most=10_000
    )
    after: tuple[str, ...] | None = key("Tasks listed before that have to be done.", default=None)
    possession: str | None = key("The possession that it needs.", default=None)

    def _check_together(self) -> None:
        check_exactly_one(self, "volume_m3", "hours_h")


@dataclass(frozen=True, slots=True)
class ScheduledTask:
    """When a task begins and ends, h, and by how much it ends too late for its possession."""

    task: WorkTask
    begins_h: float
    ends_h: float
    late_h: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Programme(_BesideRun):
    """The programme of works in hours from the midnight at which the first day begins: each task as early as the tasks
    before it, its machine, the shifts and its possession let it. `bda check` and the report have it, with what is late;
    a run does not."""

    table: ClassVar[str] = "programme"
    heading: ClassVar[str] = "Programme of works"
    noun: ClassVar[str] = "programme"

    begins_h: float = key("When the works begin, on the first day.", default=7.0, unit="h", at_least=0, at_most=DAY_H)
    shifts_h: tuple[tuple[float, float], ...] = key(
        "From which hour to which of every day is worked, in order.",
        default=((0.0, DAY_H),),
        unit="h",
        at_least=0,
        at_most=DAY_H,
    )
    possessions: tuple[Possession, ...] = ()
    tasks: tuple[WorkTask, ...] = ()

    def scheduled(self, machines: Sequence[Machine]) -> list[ScheduledTask]:
        """Return all tasks with their times, in their order in the file."""
        outputs = {machine.name: machine.output_m3_h for machine in machines}
        possessions = {possession.name: possession for possession in self.possessions}
        done: dict[str, float] = {}
        free: dict[str, float] = {}
        rows = []
        for task in self.tasks:
            begins = [self.begins_h, *(done[name] for name in task.after or ()), free.get(task.machine or "", 0.0)]
            possession = possessions.get(task.possession or "")
            if possession:
                begins.append(possession.from_h)
            begin, end = worked_from(max(begins), _hours(task, outputs), self.shifts_h)
            late = max(end - possession.to_h, 0.0) if possession else 0.0
            rows.append(ScheduledTask(task, begin, end, late))
            done[task.name] = end
            if task.machine:
                free[task.machine] = end
        return rows

    def facts(self, site: Worksite) -> Iterator[Fact]:
        for row in self.scheduled(site.plan.machines):
            late = f"; {row.late_h:.1f} h too late for {row.task.possession}" if row.late_h > 0.0 else ""
            (day, begins), (last, ends) = clock(row.begins_h), clock(row.ends_h)
            yield row.task.name, f"day {day}, {begins} to day {last}, {ends}{late}"

    def check_plan(self, plan: Plan) -> None:
        outputs = {machine.name: machine.output_m3_h for machine in plan.machines}
        possessions, before = [possession.name for possession in self.possessions], list[str]()
        for task in self.tasks:
            if task.machine is not None and task.machine not in outputs:
                raise task.unexpected("machine", f"one of [[machines]]: {_listed(outputs)}")
            if task.volume_m3 is not None and outputs.get(task.machine or "") is None:
                raise task.unexpected("volume_m3", f"a machine of {task.name} with output_m3_h, or hours_h instead")
            if task.possession is not None and task.possession not in possessions:
                raise task.unexpected("possession", f"one of [[programme.possessions]]: {_listed(possessions)}")
            for name in task.after or ():
                if name not in before:
                    raise task.unexpected("after", f"tasks listed before {task.name}: {_listed(before)}; not {name}")
            before.append(task.name)

    def _check_together(self) -> None:
        ends = 0.0
        for shift in self.shifts_h:
            if not ends <= shift[0] < shift[1]:
                raise self.unexpected("shifts_h", f"hours in order, each shift after the one before: {_text(shift)}")
            ends = shift[1]


def _hours(task: WorkTask, outputs: Mapping[str, float | None]) -> float:
    if task.hours_h is not None:
        return task.hours_h
    output = outputs[task.machine or ""]
    assert output is not None and task.volume_m3 is not None
    return task.volume_m3 / output


def _listed(names: Sequence[str] | Mapping[str, object]) -> str:
    return ", ".join(names) or "there are none"


def _text(shift: Shift) -> str:
    return f"{shift[0]:g} to {shift[1]:g}"
