"""Parts: actions on a part of the bridge, and the ones that act on its bodies by forces."""

import json
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Generic, Self, TypeVar

import numpy as np

from ...engineering.geometry.turned_boxes import TurnedBox
from ...engineering.geometry.vectors import distance, length
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ...texts import Text
from ..actions import Fact, PlannedAction, Point, Worksite
from ..as_built import Structure
from ..schema import key

_UNUSUAL_WEIGHTS = 3.0
"""Force over the weight of the bridge."""


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

    def facts_of_held(self, structure: Structure) -> Iterator[Fact]:
        """Yield which members lie in it that supports hold, so that they stay."""
        held = self.of_members(structure) & self.in_box(structure.centres_m) & structure.held
        if held.any():
            names = ", ".join(sorted(set(structure.member_names[held].tolist())))
            yield "look at", f"{names}: [[supports]] hold what is there, and it stays; what rests on it may not"

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

    @abstractmethod
    def placed(self, structure: Structure, number: int) -> PlacedLoad[Self]:
        """Return its forces on bodies, by its number in its list; refuse what acts on nothing."""

    def shards(self, structure: Structure, number: int) -> np.ndarray:
        return np.unique(self.placed(structure, number).bodies)


@dataclass(frozen=True, slots=True, kw_only=True)
class SizedLoad(Acting):
    """What acts by forces whose size follows from time alone."""

    table: ClassVar[str] = "sized_loads"
    kept_in: ClassVar[str] = "loads"

    @property
    @abstractmethod
    def course(self) -> np.ndarray:
        """All numbers (k,) that its size and its directions follow from."""

    @abstractmethod
    def mean_size(self, start_s: float, step_s: float) -> float:
        """Return its mean size in a sub-step that begins at a time."""

    def called(self, number: int) -> str:
        """Return its name, by its number in its list."""
        return f"{self.noun} {number}"


def unusual_force(name: str, force_n: float, site: Worksite) -> Iterator[str]:
    """Yield that a force is far above the weight of the bridge, if it is."""
    weights = force_n / (site.mass_kg * STANDARD_GRAVITY_M_S2)
    if weights > _UNUSUAL_WEIGHTS:
        yield Text("{} is {} times the weight of the bridge (is it in N?)", name, f"{weights:.3g}")


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
