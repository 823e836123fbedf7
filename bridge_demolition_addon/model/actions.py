"""Planned actions: what is done to a bridge at a planned time, by a tool, a charge, a load or the ground.

A scenario holds actions in fields of their own. All else asks them the same: when they begin and end, what
a camera is to see, what `bda check` and a report say of them, whether they fit the model, which shards they act on,
and what of them a scene keeps for a run. A kind of action is a subclass in one module; nothing else tells kinds apart.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, Self

import numpy as np

from ..engineering.geometry.turned_boxes import TurnedBox
from ..engineering.ground_motion import GroundRecord
from ..engineering.timing.timeline import Timeline, TimeStep
from ..texts import Text
from .as_built import Structure
from .schema import Table

Fact = tuple[str, str]
"""A label and a text, as `bda check` prints them."""

Place = tuple[float, float]
Point = tuple[float, float, float]
"""Along the road, across it, and above the ground, m."""

HeightAt = Callable[[Place], float]
"""Height of what lies under a position, m."""


class RunTime(Protocol):
    """How long a run lasts, and in which steps."""

    @property
    def duration_s(self) -> float: ...
    @property
    def step(self) -> TimeStep: ...


class Plan(Protocol):
    """The scenario, as far as an action depends on it."""

    @property
    def time(self) -> RunTime: ...
    @property
    def timeline(self) -> Timeline: ...
    @property
    def ground_record(self) -> GroundRecord | None: ...
    @property
    def warm_up_s(self) -> float: ...
    @property
    def has_flat_ground(self) -> bool: ...
    @property
    def actions(self) -> tuple[PlannedAction, ...]: ...
    @property
    def machines(self) -> Sequence[Any]: ...
    @property
    def seed(self) -> int: ...
    @property
    def blast_start_s(self) -> float: ...
    def detonation_s(self, delay_s: float) -> float: ...


@dataclass(frozen=True, slots=True)
class PlannedStep:
    """Something that is planned: when it begins and ends on the clock of the run, s, what it is, and where."""

    begins_s: float  # infinite where it is planned not to happen
    ends_s: float
    what: str
    where: str


@dataclass(frozen=True, slots=True)
class Affected:
    """Shards that an action acts on: how many, their mass, and the members that they were cut from."""

    shards: int
    mass_kg: float
    members: tuple[str, ...]


class Worksite(Protocol):
    """The bridge and its ground, as they stand before anything is done to them."""

    @property
    def plan(self) -> Plan: ...
    @property
    def mass_kg(self) -> float: ...
    @property
    def structure(self) -> Structure: ...

    def surface_height(self, position_m: Place) -> float:
        """Return the height of what a falling body meets first at a position; refuse a position outside all members."""

    def ground_height(self, position_m: Place) -> float:
        """Return the height of the ground at a position, minus infinity beyond its edge."""

    def member_within(self, centre_m: Point, radius_m: float) -> str | None:
        """Return the name of a member that overlaps a sphere, None without one."""

    def distance_to_bridge_m(self, point_m: Point) -> float:
        """Return at least how far a point is from all members, m: from the boxes around them."""

    def outer_faces(self, shard: int) -> np.ndarray:
        """Return the corners (t, 3, 3) of the triangles of a shard that lie on the surface of its member."""

    def affected_by(self, action: PlannedAction) -> Affected:
        """Return the shards that a change or a load acts on; refuse one that acts on nothing."""

    def pick_of(self, lift: Any) -> Any:
        """Return what a crane takes in a lift."""

    def taken_before(self, lift: Any) -> Iterator[tuple[str, float]]:
        """Yield the names of other lifts that take some of a lift's part no later than it, and the mass of that, kg."""

    def slings_of(self, lift: Any) -> Sequence[Any]:
        """Return the slings of a lift as cables of a run."""

    def firings_of(self, zone: Any) -> Sequence[Any]:
        """Return what a blast zone does to the structure; nothing where it does not fire, or loosens nothing."""

    def number_of(self, action: PlannedAction) -> int:
        """Return the number of an action in its list, from 1 on."""

    def facts_of_zone(self, zone: Any) -> Iterator[Fact]:
        """Yield what drilled charges do to a blast zone of the bridge."""

    def check_zone(self, zone: Any) -> None:
        """Check that a blast zone and its holes lie in their member."""

    def check_cut(self, cut: Any) -> None:
        """Check that a member can be severed where a cut is."""


@dataclass(frozen=True, slots=True)
class CutPlane:
    """A plane along which a member is cut into shards, so that an action can part it there."""

    member: str
    along: str  # the axis that it lies across
    position_m: float
    table: str  # of the action that asks for it


@dataclass(frozen=True, slots=True)
class CutOfMembers:
    """What members are cut along before they are made into shards."""

    members: tuple[str, ...] | None  # names or kinds; None for all

    def cuts(self, names: tuple[str, str]) -> bool:
        """Return whether it is for a member with this name and kind."""
        return self.members is None or not set(names).isdisjoint(self.members)


@dataclass(frozen=True, slots=True)
class CutBox(CutOfMembers):
    """A box whose sides members are cut along, so that an action can take what of them is in it."""

    box: TurnedBox


@dataclass(frozen=True, slots=True)
class CutThrough(CutOfMembers):
    """A plane in any direction that members are cut along, or those that it meets in a box."""

    point_m: Point
    normal: Point
    box: TurnedBox | None


class PlannedAction(Table):
    """Base of the tables of what is done to a bridge."""

    __slots__ = ()
    heading: ClassVar[str] = "Sequence"
    """Section of `bda check` that describes it. Under this one, actions are in order of time."""
    noun: ClassVar[str] = "action"
    """What one of them is called where they are counted."""
    kept_in: ClassVar[str] = ""
    """Under what name a scene keeps it for a run; empty for what has bodies or objects of its own."""

    @property
    def held_by_machine(self) -> str | None:
        """Return the key of what a machine holds, which would not move with a ground that shakes; None without one."""
        return None

    @abstractmethod
    def begins_s(self, plan: Plan) -> float:
        """Return from when on it acts on the bridge, s; infinite where it never does."""

    def ends_s(self, plan: Plan) -> float:
        """Return when it is over, s; infinite where it never acts."""
        return self.begins_s(plan)

    def scaled_in_time(self, factor: float) -> Self:
        """Scale the times of animated motion by a factor, as in slow motion; physical times stay."""
        return self

    def targets(self) -> Iterator[tuple[str, Place]]:
        """Yield the keys and values of positions that have to be on the deck."""
        yield from ()

    def cut_planes(self) -> tuple[CutPlane | CutOfMembers, ...]:
        """Return the planes and boxes that shards end at: all that a model takes of what is done to its bridge."""
        return ()

    def starts_above(self) -> tuple[Place, ...]:
        """Return the positions at which a member has to be below it."""
        return ()

    def points_of_interest(self, height_at: HeightAt) -> Iterator[Point]:
        """Yield points that a camera is to see."""
        yield from ()

    def shards(self, structure: Structure, number: int) -> np.ndarray:
        """Return the rows (s,) of the bodies that it acts on, as they were built; refuse one that acts on nothing.

        `number` is its own in its list, from 1 on.
        """
        return np.zeros(0, int)

    @classmethod
    def run_tables(cls) -> tuple[type[PlannedAction], ...]:
        """Return the kinds of tables by which a run does it: its own, or what follows from it and the model."""
        return (cls,) if cls.kept_in else ()

    def in_run(self, site: Worksite) -> Iterator[PlannedAction]:
        """Yield the tables by which a run does it, which its scene keeps."""
        if self.kept_in:
            yield self

    def changes(self, plan: Plan) -> Iterator[Any]:
        """Yield the changes to the structure that follow from it, whatever the model."""
        yield from ()

    def described(self) -> tuple[str, str]:
        """Return what it does and where, for the planned sequence of a report."""
        return Text(self.heading.lower()), ""

    def planned(self, plan: Plan) -> Iterator[PlannedStep]:
        """Yield its steps in the planned sequence."""
        yield PlannedStep(self.begins_s(plan), self.ends_s(plan), *self.described())

    @classmethod
    def means(cls, actions: Sequence[Self]) -> str:
        """Return all actions of this kind as a means of demolition, in a few words; empty for none that counts."""
        return counted(len(actions), cls.noun)

    def facts(self, site: Worksite) -> Iterator[Fact]:
        """Yield what a planner wants to know of it before a run."""
        yield from ()

    def unusual(self, site: Worksite) -> Iterator[str]:
        """Yield what of it is far from all that is usual, as sentences without full stops."""
        yield from ()

    def check_plan(self, plan: Plan) -> None:
        """Check it against the other tables of its scenario."""

    def check_model(self, site: Worksite) -> None:
        """Check it against the model that was built of its scenario."""


def counted(number: int, noun: str) -> Text:
    """Return a number with a noun."""
    return Text(f"{{}} {noun}{'' if number == 1 else 's'}", number)
