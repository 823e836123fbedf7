"""Structural members: closed solids with a name, a kind, a density, and axes of their own."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ...engineering.geometry.own_axes import OwnAxes, lying_axes, standing_axes
from ...engineering.geometry.road_lines import RoadLine
from ...engineering.geometry.vectors import transformed
from ...engineering.steelwork.bars import SteelBar
from ...engineering.units import mass_text, volume_text
from ...errors import ScenarioError
from ..actions import Fact
from ..schema import given

Rows = tuple[tuple[float, float], tuple[float, float]]
"""Rows of a matrix that positions on plan are multiplied with."""

SQUARE: Rows = ((1.0, 0.0), (0.0, 1.0))
"""Rows that leave positions on plan as they are."""


@dataclass(frozen=True, slots=True)
class Taper:
    """A column that leans across the road and is longer at its foot, by height below the middle of its top.

    Positions on plan are of the member without its turn. `lean` is how far its axis moves towards positive y, and
    `growth` by how much it gets longer, for each metre down.
    """

    middle_m: tuple[float, float]
    top_m: float
    length_m: float
    growth: float
    lean: float

    def from_world(self, points_m: np.ndarray) -> np.ndarray:
        """Return positions (..., 3) as they would be in an upright column as long as its top."""
        return self._mapped(points_m, -1.0)

    def to_world(self, own_m: np.ndarray) -> np.ndarray:
        """Return positions (..., 3) in the column of those in an upright one."""
        return self._mapped(own_m, 1.0)

    def _mapped(self, points_m: np.ndarray, sign: float) -> np.ndarray:
        mapped, down = points_m.copy(), self.top_m - points_m[..., 2]
        longer = 1.0 + self.growth / self.length_m * down
        offset = points_m[..., 0] - self.middle_m[0]
        mapped[..., 0] = self.middle_m[0] + (offset * longer if sign > 0.0 else offset / longer)
        mapped[..., 1] += sign * self.lean * down
        return mapped


@dataclass(frozen=True, slots=True, eq=False)
class SteelPart:
    """What makes a member steelwork: a bar between two nodes, or a node, which has no bar.

    Attributes
    ----------
    centre_m : (3,) float
        Position of the node, where its mass is; the middle of a bar.
    bar, nodes
        The bar, and the names of the nodes at its ends.
    """

    centre_m: np.ndarray
    bar: SteelBar | None = None
    nodes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Member:
    """A structural member.

    Its kind is ``deck``, ``girder``, ``pier cap``, ``pier``, ``abutment``, ``bridge`` for all of these in one, or a
    word of the user. Its parts are known where it is not convex itself: convex solids that touch without overlap. Cut
    within them its shards are convex. Bullet takes every shard for its convex hull, and the hull of a shard around a
    hollow overlaps its neighbours, which throws it off as soon as their connection breaks.
    """

    name: str  # no two of a model have the same
    kind: str
    solid: TriangleMesh  # closed, in m
    density_kg_m3: float | None = None  # None as long as it is not known
    parts: tuple[TriangleMesh, ...] = ()
    unskewed: Rows = SQUARE  # by which positions on plan are as they would be without skew
    line: RoadLine | None = None  # that it was made for, straight, square and level; its skew included
    taper: Taper | None = None  # of a column that leans or has batter
    steel: SteelPart | None = None  # of steelwork alone, which is cut and connected by itself
    keeps_parts: bool = False  # whether each of its parts takes a shard at least, as of a deck on pieces of girders
    is_in_pieces: bool = False  # the same of what is cut into its parts first, as an arch
    takes_all_parts: bool = False  # the same of nibs of half-joints, and of plates of a box girder with haunches
    # Of inclined parts: what each runs along, along the road and upwards, of length 1. They are cut square to it.
    directions: tuple[tuple[float, float], ...] = ()

    @property
    def volume_m3(self) -> float:
        """Volume of the solid, m³."""
        return self.solid.volume

    def without_skew(self, points_m: np.ndarray) -> np.ndarray:
        """Return positions (..., 3) as they would be in the member if it stood square to a straight, level road."""
        if self.line:
            return self.line.from_world(points_m)
        upright = self._mapped(points_m, self.unskewed)
        return self.taper.from_world(upright) if self.taper else upright

    def with_skew(self, points_m: np.ndarray) -> np.ndarray:
        """Return positions (..., 3) in the member of what `without_skew` gave."""
        if self.line:
            return self.line.to_world(points_m)
        (a, b), (c, d) = self.unskewed
        whole = a * d - b * c
        placed = self.taper.to_world(points_m) if self.taper else points_m
        return self._mapped(placed, ((d / whole, -b / whole), (-c / whole, a / whole)))

    @staticmethod
    def _mapped(points_m: np.ndarray, rows: Rows) -> np.ndarray:
        if rows == SQUARE:
            return points_m
        mapped = points_m.copy()
        mapped[..., :2] = transformed(np.array(rows), points_m[..., :2])
        return mapped

    @property
    def thickness_m(self) -> float:
        """Twice the volume by the surface, m: the thickness of a plate, the wall of a box, half the side of a bar."""
        areas, _ = triangle_areas_and_normals(self.solid.corners)
        return 2.0 * self.volume_m3 / float(areas.sum())

    @property
    def mass_kg(self) -> float:
        """Mass of the solid."""
        return self.volume_m3 * given(self.density_kg_m3)


def mean_density(members: Sequence[Member]) -> float:
    """Total mass of members over their volume, kg/m³; to the last bit their common density where they have one."""
    densities = {member.density_kg_m3 for member in members}
    if len(densities) == 1:
        return given(densities.pop())
    return math.fsum(member.mass_kg for member in members) / math.fsum(member.volume_m3 for member in members)


def member_facts(members: Sequence[Member]) -> Iterator[Fact]:
    """Yield what a planner wants to know of members before a run."""
    alike = len({member.density_kg_m3 for member in members}) == 1
    for member in members:
        is_node = member.steel is not None and member.steel.bar is None  # it may carry part of a deck
        own = "" if alike or is_node else f", {member.density_kg_m3:.0f} kg/m³"
        yield member.name, _volume_and_mass(member.volume_m3, member.mass_kg) + own
    yield "all", _together(members)
    yield "density" if alike else "mean density", f"{mean_density(members):.0f} kg/m³"


def mass_facts(members: Sequence[Member]) -> Iterator[Fact]:
    """Yield volume and mass of each kind of members, and the totals."""
    for kind in dict.fromkeys(member.kind for member in members):
        of_kind = [member for member in members if member.kind == kind]
        yield f"{len(of_kind)} × {kind}", _together(of_kind)
    yield "all", _together(members)


def _together(members: Sequence[Member]) -> str:
    volume_m3, mass_kg = (math.fsum(getattr(member, name) for member in members) for name in ("volume_m3", "mass_kg"))
    return _volume_and_mass(volume_m3, mass_kg)


def _volume_and_mass(volume_m3: float, mass_kg: float) -> str:
    return f"{volume_text(volume_m3, width=9)} {mass_text(mass_kg, width=10)}"


def members_named(name: str, members: Sequence[Member], key: str) -> list[int]:
    """Return the indices of the members of a name or kind, which stands under a key of the scenario."""
    chosen = [index for index, member in enumerate(members) if name in (member.name, member.kind)]
    if not chosen:
        known = ", ".join(sorted({member.name for member in members} | {member.kind for member in members}))
        raise ScenarioError(f'{key} is "{name}": expected the name or kind of a member, one of {known}')
    return chosen


_LYING = ("deck", "girder", "arch", "pier cap", "parapet", "bracing", "footing", "approach slab")
_STANDING = ("pier", "leg")

_ROAD = (1.0, 0.0)
_MOST_WIDE = 3.0
"""Width of a deck by its length up to which its own line is along the road."""


def own_axes(member: Member) -> OwnAxes:
    """Return the axes of a member: along the road of a deck or a whole arch, else along its longer side on plan."""
    is_along_road = member.kind == "deck" or (member.kind == "arch" and member.is_in_pieces)
    return _axes(member.solid, is_standing(member), is_along_road)


def is_standing(member: Member) -> bool:
    """Return whether a member stands: a pier, or what is higher than long and of no kind that lies."""
    if member.kind in (*_LYING, *_STANDING):
        return member.kind in _STANDING
    sizes = np.ptp(member.solid.vertices, axis=0)
    return bool(sizes[2] >= sizes[:2].max())


@lru_cache(maxsize=64)
def _axes(solid: TriangleMesh, is_upright: bool, is_along_road: bool) -> OwnAxes:
    if is_upright:
        return standing_axes(solid)
    axes = lying_axes(solid, np.array(_ROAD)) if is_along_road else lying_axes(solid)
    if is_along_road and axes.width_m > _MOST_WIDE * axes.length_m:
        return lying_axes(solid)
    return axes
