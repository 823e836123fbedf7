"""Loads: forces on parts of the bridge that grow with time, as a scenario gives them."""

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import sqrt
from typing import ClassVar, Self

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2, mass_text
from ...errors import ScenarioError
from ...texts import Quantity, Text
from ..actions import Fact, Plan, Worksite
from ..as_built import Structure
from ..schema import key, shown
from .part import Part, PlacedLoad, SizedLoad, nearest_of, unusual_force

_MOST_WEIGHTS = 1e4
"""Forces over the weight of the bridge. A bar of steel of 1 m breaks at 5e3 times its weight: 360 N/mm², 7850 kg/m³."""


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
        return Text("load of up to {}", Quantity(max(self.forces_n) / 1e3, "kN", "g")), self.where

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
