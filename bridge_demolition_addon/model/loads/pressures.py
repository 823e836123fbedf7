"""Pressures that change with time: wind, water or a hydraulic jack on faces of the bridge, as a scenario gives them."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, Self

import numpy as np

from ...engineering.geometry.mesh import triangle_areas_and_normals
from ...engineering.geometry.vectors import distance, dot, unit
from ...engineering.units import STANDARD_GRAVITY_M_S2, mass_text
from ...errors import ScenarioError
from ...texts import Quantity, Text, point_text
from ..actions import Fact, Plan, PlannedAction, Worksite
from ..as_built import Structure
from ..schema import key, shown
from .part import Part, PlacedLoad, SizedLoad, unusual_force

_PA_PER_KPA = 1000.0

_DIGITS = 5
"""Of unit normals that count as one."""

_SAME_M = 1e-3
"""Distance up to which a centre of mass is that of a shard: a scene keeps positions in single precision."""

_TIMES = {"times_s": (0.0, 5.0), "pressures_kpa": (0.0, 20.0)}


def _times() -> tuple[float, ...]:
    return key(
        "Times at which it is given, each later than the one before. Before the first there is no load; after the last "
        "it stays as it is then.",
        unit="s",
        at_least=0,
        typical=_TIMES["times_s"],
    )


def _pressures() -> tuple[float, ...]:
    return key(
        "How large it is at these times, and in a straight line from one to the next: above 0 towards the faces, below "
        "0 away from them.",
        unit="kPa",
        at_least=-1e5,
        at_most=1e5,
        typical=_TIMES["pressures_kpa"],
    )


def _begins_s(times_s: Sequence[float], pressures_kpa: Sequence[float]) -> float:
    """When a pressure begins; infinite where there is none."""
    for (time_s, kpa), (_, next_kpa) in pairwise([*zip(times_s, pressures_kpa, strict=True), (0.0, 0.0)]):
        if kpa or next_kpa:
            return time_s
    return math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Pressure(Part):
    """A pressure that changes with time, such as that of wind, of water or of a hydraulic jack: on the faces of shards
    that lie on the surface of their member and look against a direction. It stands across each face, and turns with its
    shard. What leans on another member is not taken out. A run has it; `bda stages` does not. See
    [pressures](sequences.md#pressures).
    """

    table: ClassVar[str] = "pressures"
    heading: ClassVar[str] = "Pressures"
    noun: ClassVar[str] = "pressure"

    name: str = key("Name of the pressure.")
    direction: tuple[float, float, float] = key(
        "Where it pushes to, of any length but 0: on faces that look the other way.", typical=(0.0, 1.0, 0.0)
    )
    within_deg: float = key(
        "Largest angle between that and the normal of such a face, as the bridge was built: with 45 each side of a box "
        "has its own direction, with 90 all of a round column that looks there counts.",
        default=45.0,
        unit="°",
        above=0,
        at_most=90,
    )
    times_s: tuple[float, ...] = _times()
    pressures_kpa: tuple[float, ...] = _pressures()

    @property
    def largest_kpa(self) -> float:
        """Pressure that is farthest from 0."""
        return max(self.pressures_kpa, key=abs)

    def begins_s(self, plan: Plan) -> float:
        return _begins_s(self.times_s, self.pressures_kpa)

    def ends_s(self, plan: Plan) -> float:
        return self.times_s[-1]

    @classmethod
    def run_tables(cls) -> tuple[type[PlannedAction], ...]:
        return (PressedFaces,)

    def in_run(self, site: Worksite) -> Iterator[PlannedAction]:
        yield self.faces(site)

    def shards(self, structure: Structure, number: int) -> np.ndarray:
        return self.movable(structure, number)

    def faces(self, site: Worksite) -> "PressedFaces":
        """Return it on faces; refuse one that no face looks against."""
        structure, least_cosine = site.structure, math.cos(math.radians(self.within_deg)) - 1e-9
        against = -unit(np.array(self.direction))
        centres, points, normals, areas = [], [], [], []
        for shard in self.movable(structure, site.number_of(self)).tolist():
            corners = site.outer_faces(shard)
            sizes, outwards = triangle_areas_and_normals(corners)
            chosen = (sizes > 0.0) & (dot(outwards, np.broadcast_to(against, outwards.shape)) >= least_cosine)
            corners, sizes, outwards = corners[chosen], sizes[chosen], outwards[chosen]
            _, first, which = np.unique(outwards.round(_DIGITS), axis=0, return_index=True, return_inverse=True)
            for row, normal in enumerate(outwards[first]):
                alike = which.ravel() == row
                area = math.fsum(sizes[alike].tolist())
                points.append(tuple((sizes[alike, None] * corners[alike].mean(axis=1)).sum(axis=0) / area))
                centres.append(tuple(structure.centres_m[shard]))
                normals.append(tuple(normal))
                areas.append(area)
        if not areas:
            wanted = "a direction that a face on the surface of the members looks against"
            raise self.unexpected("direction", f"{wanted}, within pressures.within_deg, {self.within_deg:g}°")
        return PressedFaces(
            name=self.name,
            centres_m=tuple(centres),
            points_m=tuple(points),
            normals=tuple(normals),
            areas_m2=tuple(areas),
            times_s=self.times_s,
            pressures_kpa=self.pressures_kpa,
        )

    def described(self) -> tuple[str, str]:
        return Text("{}: pressure of up to {}", self.name, Quantity(self.largest_kpa, "kPa", "g")), self.where

    def facts(self, site: Worksite) -> Iterator[Fact]:
        pressed, faces = site.affected_by(self), self.faces(site)
        steps = zip(self.times_s, self.pressures_kpa, strict=True)
        course = ", ".join(f"{kpa:g} kPa at {time_s:g} s" for time_s, kpa in steps)
        yield self.name, f"{course}, towards ({', '.join(f'{part:g}' for part in self.direction)})"
        force_n, point_m = faces.resultant(_PA_PER_KPA * self.largest_kpa)
        size_n = float(np.sqrt(dot(force_n, force_n)))
        share = size_n / (pressed.mass_kg * STANDARD_GRAVITY_M_S2)
        yield (
            "",
            f"on {math.fsum(faces.areas_m2):.2f} m² of {', '.join(pressed.members)}: up to {size_n / 1e3:.1f} kN at "
            f"{point_text([round(value, 2) for value in point_m.tolist()])}, {share:.0%} of their weight of "
            f"{mass_text(pressed.mass_kg)}",
        )

    def unusual(self, site: Worksite) -> Iterator[str]:
        force_n, _ = self.faces(site).resultant(_PA_PER_KPA * self.largest_kpa)
        return unusual_force(self.name, float(np.sqrt(dot(force_n, force_n))), site)

    def check_plan(self, plan: Plan) -> None:
        if self.times_s[0] >= plan.time.duration_s:
            wanted = f"less than time.duration_s, {plan.time.duration_s} (s)"
            raise ScenarioError(f"pressures.times_s.1 is {self.times_s[0]}: expected {wanted}")

    def check_model(self, site: Worksite) -> None:
        self.faces(site)

    def _check_together(self) -> None:
        Part._check_together(self)
        if not any(self.direction):
            raise ScenarioError(f"{self.table}.direction is {shown(self.direction)}, all 0: expected a direction")
        if len(self.pressures_kpa) != len(self.times_s):
            raise self.unexpected("pressures_kpa", f"as many as pressures.times_s, {len(self.times_s)}")
        for number, (before_s, time_s) in enumerate(pairwise(self.times_s), start=2):
            if not before_s < time_s:
                raise ScenarioError(
                    f"{self.table}.times_s.{number} is {time_s}: expected more than the one before, {before_s} (s)"
                )


@dataclass(frozen=True, slots=True, kw_only=True)
class PressedFaces(SizedLoad):
    """A pressure on faces of shards. It follows from a table of `[[pressures]]` and the model, and is no table of a
    scenario; a scene keeps it.
    """

    table: ClassVar[str] = "pressed_faces"

    name: str = key("Name of the pressure.")
    centres_m: tuple[tuple[float, float, float], ...] = key("Centre of mass of the shard of each face.", unit="m")
    points_m: tuple[tuple[float, float, float], ...] = key("Middle of each face.", unit="m")
    normals: tuple[tuple[float, float, float], ...] = key("Unit vector outwards of each face.")
    areas_m2: tuple[float, ...] = key("Area of each face.", unit="m²", above=0)
    times_s: tuple[float, ...] = _times()
    pressures_kpa: tuple[float, ...] = _pressures()

    def begins_s(self, plan: Plan) -> float:
        return _begins_s(self.times_s, self.pressures_kpa)

    @property
    def course(self) -> np.ndarray:
        return np.array((*self.times_s, *self.pressures_kpa))

    def called(self, number: int) -> str:
        return self.name

    def placed(self, structure: Structure, number: int) -> PlacedLoad[Self]:
        bodies = np.array([self._shard_at(centre, structure) for centre in self.centres_m])
        moves = structure.masses_kg[bodies] > 0.0
        arms_m = np.array(self.points_m) - np.array(self.centres_m)
        shares, inwards = np.array(self.areas_m2), -np.array(self.normals)
        return PlacedLoad(self, bodies[moves], shares[moves], inwards[moves], arms_m[moves], turns=True)

    def _shard_at(self, centre_m: tuple[float, float, float], structure: Structure) -> int:
        apart_m = distance(structure.centres_m, np.array(centre_m))
        apart_m[~(structure.is_shard | structure.held)] = math.inf
        nearest = int(apart_m.argmin())
        if apart_m[nearest] > _SAME_M:
            raise ScenarioError(
                f"{self.name} presses on a shard with its centre of mass at {point_text(centre_m)}, which is gone or "
                "was moved: put it back, or build the scene again from its scenario"
            )
        return nearest

    def mean_size(self, start_s: float, step_s: float) -> float:
        """Return its exact mean in Pa: it is a straight line between the times that are given."""
        return _PA_PER_KPA * (self._impulse(start_s + step_s) - self._impulse(start_s)) / step_s

    def _impulse(self, time_s: float) -> float:
        """Return the integral of the pressure from the first time on, kPa s."""
        after = bisect_right(self.times_s, time_s)
        times, values = [*self.times_s[:after]], [*self.pressures_kpa[:after]]
        if not times:
            return 0.0
        last_kpa = values[-1]
        if after < len(self.times_s):
            share = (time_s - times[-1]) / (self.times_s[after] - times[-1])
            last_kpa += share * (self.pressures_kpa[after] - last_kpa)
        corners = pairwise([*zip(times, values, strict=True), (time_s, last_kpa)])
        return math.fsum(0.5 * (kpa + next_kpa) * (end_s - begin_s) for (begin_s, kpa), (end_s, next_kpa) in corners)

    def resultant(self, pressure_pa: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the force (3,) of a pressure on all faces, and the middle (3,) of what is pressed."""
        areas = np.array(self.areas_m2)
        force_n = -pressure_pa * (areas[:, None] * np.array(self.normals)).sum(axis=0)
        return force_n, (areas[:, None] * np.array(self.points_m)).sum(axis=0) / areas.sum()
