"""Loads: forces on parts of the bridge that grow with time, as a scenario gives them."""

import json
import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import sqrt
from typing import ClassVar, Generic, Self, TypeVar

import numpy as np

from ..engineering.geometry.turned_boxes import TurnedBox
from ..engineering.geometry.vectors import distance, length
from ..engineering.units import STANDARD_GRAVITY_M_S2, mass_text
from ..errors import ScenarioError
from .actions import Fact, Plan, PlannedAction, Point, Worksite
from .as_built import Structure
from .schema import key, shown

_UNUSUAL_WEIGHTS = 3.0
_MOST_WEIGHTS = 1e4
"""Forces over the weight of the bridge. A bar of steel of 1 m breaks at 5e3 times its weight: 360 N/mm², 7850 kg/m³."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Part(PlannedAction):
    """An action on a part of the bridge: some members, what lies in a box, or what of the members lies in the box."""

    table: ClassVar[str] = "parts"

    members: tuple[str, ...] | None = key(
        'Members that it happens to, by the names that `bda check` lists or by kind: `["pier 1", "pier cap"]`.',
        default=None,
    )
    lowest_corner_m: tuple[float, float, float] | None = key(
        "Lowest x, y and z of the box that it happens in, as the bridge was built. Give both corners or none.",
        default=None,
        unit="m",
    )
    highest_corner_m: tuple[float, float, float] | None = key("Highest x, y and z of that box.", default=None, unit="m")
    skew_deg: float = key(
        "By how much that box is turned about the vertical through its middle, as `bridge.skew_deg` says: above 0 the "
        "ends of its sides across the road, towards positive y, lie further along the road.",
        default=0.0,
        unit="°",
        at_least=-90,
        at_most=90,
    )

    @property
    def box(self) -> TurnedBox | None:
        """Return the box; None without one."""
        if self.lowest_corner_m is None or self.highest_corner_m is None:
            return None
        return TurnedBox(self.lowest_corner_m, self.highest_corner_m, self.skew_deg)

    @property
    def where(self) -> str:
        """Members and box as text; empty where there are none."""
        members = ", ".join(self.members or ())
        corners = zip(self.lowest_corner_m or (), self.highest_corner_m or (), strict=True)
        box = " by ".join(f"{low:g} to {high:g}" for low, high in corners)
        turned = f" turned by {self.skew_deg:g}°" if self.skew_deg else ""
        return " in ".join(part for part in (members, box and f"{box} m{turned}") if part)

    def of_members(self, structure: Structure) -> np.ndarray:
        """Return whether each body (n,) is of the members; all where none are named."""
        if self.members is None:
            return np.ones(len(structure.centres_m), bool)
        names, kinds = structure.member_names, structure.member_kinds
        known = sorted({*names.tolist(), *kinds.tolist()} - {""})
        for name in self.members:
            if name not in known:
                raise ScenarioError(
                    f"{self.table}.members names {json.dumps(name, ensure_ascii=False)}: "
                    f"expected names or kinds of members, which are {', '.join(known) or 'not known here'}"
                )
        return np.isin(names, self.members) | np.isin(kinds, self.members)

    def in_box(self, positions_m: np.ndarray) -> np.ndarray:
        """Return whether positions (k, 3) are in the box; all where there is none."""
        return np.ones(len(positions_m), bool) if self.box is None else self.box.contains(positions_m)

    def movable(self, structure: Structure, number: int) -> np.ndarray:
        """Return the shards (s,) of it that can move; refuse one without any."""
        chosen = self.of_members(structure) & self.in_box(structure.centres_m) & structure.is_shard
        bodies = np.flatnonzero(chosen & (structure.masses_kg > 0.0))
        if not len(bodies):
            raise ScenarioError(
                f"[[{self.table}]] number {number}: no shard that can move is there; expected members or a box with "
                "some that no support holds"
            )
        return bodies

    def _check_together(self) -> None:
        lowest, highest = self.lowest_corner_m, self.highest_corner_m
        if (lowest is None) != (highest is None):
            given, missing = ("lowest", "highest") if highest is None else ("highest", "lowest")
            raise self.unexpected(f"{missing}_corner_m", f"it with {self.table}.{given}_corner_m")
        if self.skew_deg and lowest is None:
            raise self.unexpected("skew_deg", "0 without a box, which it turns")
        for axis, (low, high) in enumerate(zip(lowest or (), highest or (), strict=True), start=1):
            if not low < high:
                raise ScenarioError(
                    f"{self.table}.highest_corner_m.{axis} is {high}: expected more than that of the lowest "
                    f"corner, {low} (m)"
                )


_Acting = TypeVar("_Acting", bound="Acting")


@dataclass(frozen=True, eq=False, slots=True)
class PlacedLoad(Generic[_Acting]):
    """Forces on bodies as they were built: of each row size by share, along a direction."""

    load: _Acting
    bodies: np.ndarray  # (f,)
    shares: np.ndarray  # (f,)
    directions: np.ndarray  # (f, 3), unit vectors
    arms_m: np.ndarray  # (f, 3), from the centres of mass to where they act; they turn with the bodies
    turns: bool = False  # whether directions turn with the bodies, too


@dataclass(frozen=True, slots=True, kw_only=True)
class Acting(Part):
    """What acts on bodies by forces in each sub-step of a run."""

    table: ClassVar[str] = "acting"

    def placed(self, structure: Structure, number: int) -> PlacedLoad[Self]:
        """Return its forces on bodies, by its number in its list; refuse what acts on nothing."""
        raise NotImplementedError

    def shards(self, structure: Structure, number: int) -> np.ndarray:
        return np.unique(self.placed(structure, number).bodies)


@dataclass(frozen=True, slots=True, kw_only=True)
class SizedLoad(Acting):
    """What acts by forces whose size follows from time alone."""

    table: ClassVar[str] = "sized_loads"
    kept_in: ClassVar[str] = "loads"

    @property
    def course(self) -> np.ndarray:
        """All numbers (k,) that its size and its directions follow from."""
        raise NotImplementedError

    def mean_size(self, start_s: float, step_s: float) -> float:
        """Return its mean size in a sub-step that begins at a time."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True, kw_only=True)
class Load(SizedLoad):
    """A force that grows with time, such as that of jacks in a load test, or of a machine that pushes or pulls: on
    members, on the shards whose centres of mass lie in a box, or at a point. It is distributed by mass and acts at the
    centres of mass; with a point, it acts there, on the shard that is nearest. It goes with the shards, and its
    direction stays. A run has it; `bda stages` does not.
    """

    table: ClassVar[str] = "loads"
    heading: ClassVar[str] = "Loads"
    noun: ClassVar[str] = "load"

    point_m: tuple[float, float, float] | None = key(
        "Where it acts, as the bridge was built: on one shard of the members, in the box. Of those whose outlines "
        "along x, y and z are nearest to this point, it is the one whose centre of mass is nearest.",
        default=None,
        unit="m",
    )
    direction: tuple[float, float, float] = key(
        "Where it pushes to, of any length but 0; by default down.", default=(0.0, 0.0, -1.0)
    )
    times_s: tuple[float, ...] = key(
        "Times at which it is given, each later than the one before. Before the first there is no load; after the last "
        "it stays as it is then.",
        unit="s",
        at_least=0,
    )
    forces_n: tuple[float, ...] = key(
        "How large it is at these times, and in a straight line from one to the next.", unit="N", at_least=0
    )

    @property
    def unit_direction(self) -> tuple[float, float, float]:
        """Unit vector of the direction."""
        x, y, z = self.direction
        size = sqrt(math.fsum(component * component for component in self.direction))
        return x / size, y / size, z / size

    @property
    def course(self) -> np.ndarray:
        return np.array((*self.direction, *self.times_s, *self.forces_n, *(self.point_m or ())))

    def begins_s(self, plan: Plan) -> float:
        for (time_s, force_n), (_, next_n) in pairwise([*zip(self.times_s, self.forces_n, strict=True), (0.0, 0.0)]):
            if force_n > 0.0 or next_n > 0.0:
                return time_s
        return float("inf")

    def ends_s(self, plan: Plan) -> float:
        return self.times_s[-1]

    def force_n(self, time_s: float) -> float:
        """Return how large it is at a time."""
        after = bisect_right(self.times_s, time_s)
        if after == 0:
            return 0.0
        if after == len(self.times_s):
            return self.forces_n[-1]
        (start_s, end_s), (start_n, end_n) = self.times_s[after - 1 : after + 1], self.forces_n[after - 1 : after + 1]
        return start_n + (end_n - start_n) * ((time_s - start_s) / (end_s - start_s))

    def placed(self, structure: Structure, number: int) -> PlacedLoad[Self]:
        bodies, direction = self.movable(structure, number), np.array(self.unit_direction)
        if self.point_m is None:
            shares = structure.masses_kg[bodies] / structure.masses_kg[bodies].sum()
            directions = np.tile(direction, (len(bodies), 1))
            return PlacedLoad(self, bodies, shares, directions, np.zeros((len(bodies), 3)))
        body, arm_m = nearest_of(bodies, self.point_m, structure)
        return PlacedLoad(self, np.array([body]), np.ones(1), direction[None], arm_m[None])

    def mean_size(self, start_s: float, step_s: float) -> float:
        return self.force_n(start_s + step_s / 2.0)

    def described(self) -> tuple[str, str]:
        return f"load of up to {max(self.forces_n) / 1e3:g} kN", self.where

    def facts(self, site: Worksite) -> Iterator[Fact]:
        steps = zip(self.times_s, self.forces_n, strict=True)
        course = ", ".join(f"{force_n / 1000.0:g} kN at {time_s:g} s" for time_s, force_n in steps)
        yield f"load {site.number_of(self)}", f"{course}, towards ({', '.join(f'{part:g}' for part in self.direction)})"
        point = "" if self.point_m is None else f" at ({', '.join(f'{value:g}' for value in self.point_m)}) m"
        loaded = site.affected_by(self)
        shards = f"{loaded.shards} shards" if loaded.shards > 1 else "a shard"
        yield "", f"on {shards} of {', '.join(loaded.members)}{point}, together {mass_text(loaded.mass_kg)}"

    def unusual(self, site: Worksite) -> Iterator[str]:
        return unusual_force(f"Load {site.number_of(self)}", max(self.forces_n), site)

    def check_plan(self, plan: Plan) -> None:
        if self.times_s[0] >= plan.time.duration_s:
            wanted = f"less than time.duration_s, {plan.time.duration_s} (s)"
            raise ScenarioError(f"loads.times_s.1 is {self.times_s[0]}: expected {wanted}")

    def check_model(self, site: Worksite) -> None:
        site.affected_by(self)
        most_n = _MOST_WEIGHTS * site.mass_kg * STANDARD_GRAVITY_M_S2
        for number, force_n in enumerate(self.forces_n, start=1):
            if force_n > most_n:
                weights = f"{_MOST_WEIGHTS:.0f} times the weight of the bridge"
                raise ScenarioError(
                    f"loads.forces_n.{number} is {force_n:g}: expected at most {most_n:.3g} (N), {weights}"
                )

    def _check_together(self) -> None:
        Part._check_together(self)
        if self.members is None and self.lowest_corner_m is None and self.point_m is None:
            raise self.unexpected("members", "it, the two corners of a box, or a point")
        if not any(self.direction):
            raise ScenarioError(f"{self.table}.direction is {shown(self.direction)}, all 0: expected a direction")
        if len(self.forces_n) != len(self.times_s):
            raise self.unexpected("forces_n", f"as many as loads.times_s, {len(self.times_s)}")
        for number, (before_s, time_s) in enumerate(pairwise(self.times_s), start=2):
            if not before_s < time_s:
                raise ScenarioError(
                    f"{self.table}.times_s.{number} is {time_s}: expected more than the one before, {before_s} (s)"
                )


def unusual_force(name: str, force_n: float, site: Worksite) -> Iterator[str]:
    """Yield that a force is far above the weight of the bridge, if it is."""
    weights = force_n / (site.mass_kg * STANDARD_GRAVITY_M_S2)
    if weights > _UNUSUAL_WEIGHTS:
        yield f"{name} is {weights:.3g} times the weight of the bridge (is it in N?)"


def nearest_of(bodies: np.ndarray, point_m: Point, structure: Structure) -> tuple[int, np.ndarray]:
    """Return the body nearest to a point, of some (b,), and the arm (3,) from its centre of mass to the point."""
    point, boxes_m = np.array(point_m), structure.boxes_m[bodies]
    outside_m = length(point - np.clip(point, boxes_m[:, 0], boxes_m[:, 1]))
    apart_m = distance(structure.centres_m[bodies], point)
    body = int(bodies[np.lexsort((apart_m, outside_m.round(6)))[0]])
    return body, point - structure.centres_m[body]


def placed_loads(loads: Sequence[_Acting], structure: Structure) -> tuple[PlacedLoad[_Acting], ...]:
    """Place loads on the bodies of a structure."""
    return tuple(load.placed(structure, number) for number, load in enumerate(loads, start=1))
