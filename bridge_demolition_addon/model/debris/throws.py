"""Debris: which shards came down, how far they were thrown, what they lie on, and their pile.

Columns of loose blocks that collapse are held against the laws of experiments with grains: G. Lube, H. E. Huppert,
R. S. J. Sparks and M. A. Hallworth (2004), Axisymmetric collapses of granular columns, Journal of Fluid Mechanics 508,
175-199. `scripts/validate collapsing_column` makes the figures.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from manifold3d import CrossSection

from ...engineering.arrays import Rows
from ...engineering.geometry.hulls import convex_hulls
from ...engineering.geometry.plan_areas import distances_outside
from ...engineering.geometry.vectors import dot, transformed
from ...engineering.terrain.surface import RecordedGround
from ...texts import Text
from ..results.arrays import Results
from ..results.motion import MOVED_M, relative_to_ground, throw, travel
from .footprint import corners_at, footprint, straightened

PERCENTS = (50, 75, 90, 95, 99, 100)


@dataclass(frozen=True, eq=False, slots=True)
class Debris:
    """Debris at the end of a run: d shards.

    Attributes
    ----------
    bodies, throws_m, masses_kg : (d,) int, (d,) float, (d,) float
        Indices of the shards, horizontal distances between their first and last centres of mass, and masses.
    reaches_m : (d,) float
        Debris distance of each from the bridge's first outline in plan, 0 for one that lies within it.
    area, outline
        Areas that debris covers in plan, and that all shards covered at first.
    highest_m
        Largest height of any of them above the ground below; nan without debris.
    """

    bodies: np.ndarray
    throws_m: np.ndarray
    reaches_m: np.ndarray
    masses_kg: np.ndarray
    area: CrossSection
    outline: CrossSection
    highest_m: float
    ground: RecordedGround = field(default_factory=RecordedGround)


def debris_of(results: Results) -> Debris:
    results = relative_to_ground(results)
    shards = results.inventory.of_kind("shard")
    first, last = results.frames.positions_m[0], results.frames.positions_m[-1]
    bodies = shards[travel(first[shards], last[shards]) > MOVED_M]
    outline = footprint(results, shards, 0)
    corners, ground = corners_at(results, -1, bodies), results.ground()
    return Debris(
        bodies=bodies,
        throws_m=throw(first[bodies], last[bodies]),
        reaches_m=_reaches(outline, corners),
        masses_kg=results.inventory.masses_kg[bodies],
        area=footprint(results, bodies, -1),
        outline=outline,
        highest_m=max((float(heights.max()) for heights in _above(ground, corners)), default=float("nan")),
        ground=ground,
    )


def _above(ground: RecordedGround, corners: Sequence[np.ndarray]) -> Iterator[np.ndarray]:
    """Yield the heights (v,) of corners, d times (v, 3), above the ground below each."""
    for corner in corners:
        yield corner[:, 2] if ground.is_flat else corner[:, 2] - ground.heights_at(corner[:, :2])


def _reaches(outline: CrossSection, corners: Sequence[np.ndarray]) -> np.ndarray:
    """Return the debris distances (d,) of corners, d times (v, 3), from an outline in plan."""
    if not len(corners):
        return np.zeros(0)
    distances = distances_outside(straightened(outline), np.concatenate(corners)[:, :2])
    counts = [len(corner) for corner in corners]
    return np.maximum.reduceat(distances, np.cumsum([0, *counts[:-1]]))


def percentiles_by_mass(values: np.ndarray, masses_kg: np.ndarray, percents: Sequence[float] = PERCENTS) -> np.ndarray:
    """Return the smallest of the values (d,) up to which each of the percents (p,) of the mass lies, (p,)."""
    if not len(values):
        return np.full(len(percents), np.nan)
    order = np.argsort(values, kind="stable")
    shares = np.cumsum(masses_kg[order]) / masses_kg.sum()
    rounding = 1e-12  # a sum of shares ends a little off 1
    rows = np.searchsorted(shares, np.asarray(percents) / 100.0 - rounding)
    return values[order][np.minimum(rows, len(values) - 1)]


@dataclass(frozen=True, eq=False, slots=True)
class HeightMap:
    """Heights (j, i) of a pile above the ground, over middles (i,) and (j,) of cells in plan; nan without debris."""

    xs_m: np.ndarray
    ys_m: np.ndarray
    heights_m: np.ndarray

    @property
    def volume_m3(self) -> float:
        """Return the volume between the ground and the surface of the pile, holes under it included."""
        if not len(self.xs_m):
            return 0.0
        cell = (self.xs_m[1] - self.xs_m[0]) * (self.ys_m[1] - self.ys_m[0])
        return float(cell * np.maximum(np.nan_to_num(self.heights_m), 0.0).sum())


def height_map(results: Results, bodies: np.ndarray, cells: int = 200) -> HeightMap:
    """Return the last heights of the convex hulls of bodies (d,); the longer side of their plan is cut into `cells`.

    A body whose hull is flat has no upper side, and is left out.
    """
    solid = [body for body in bodies if results.inventory.volumes_m3[body] > 0.0]
    if not solid:
        return HeightMap(np.zeros(0), np.zeros(0), np.zeros((0, 0)))
    all_corners = corners_at(results, -1, solid)
    low = np.min([corner[:, :2].min(axis=0) for corner in all_corners], axis=0)
    high = np.max([corner[:, :2].max(axis=0) for corner in all_corners], axis=0)
    size = float((high - low).max()) / cells
    counts = np.maximum(np.ceil((high - low) / size).astype(int), 2)
    xs, ys = (low[axis] + size * (np.arange(counts[axis]) + 0.5) for axis in (0, 1))
    return HeightMap(xs, ys, heights_over(results, solid, xs, ys))


def heights_over(results: Results, bodies: Rows, xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
    """Return the last heights (j, i) of the convex hulls of bodies above the ground, over positions; nan outside them.

    A body whose hull is flat has no upper side, and is left out.
    """
    solid = [body for body in bodies if results.inventory.volumes_m3[body] > 0.0]
    heights = np.full((len(ys), len(xs)), np.nan)
    if not solid:
        return heights
    all_corners = corners_at(results, -1, solid)
    own = results.inventory.vertices_by_body()
    hulls = convex_hulls([own[body] for body in solid])
    for number, (body, corners) in enumerate(zip(solid, all_corners, strict=True)):
        faces = slice(hulls.starts[number], hulls.starts[number + 1])
        normals = transformed(results.frames.rotations[-1, body], hulls.normals[faces])
        offsets = hulls.offsets[faces] + dot(normals, results.frames.positions_m[-1, body])
        columns = slice(*np.searchsorted(xs, [corners[:, 0].min(), corners[:, 0].max()]))
        rows = slice(*np.searchsorted(ys, [corners[:, 1].min(), corners[:, 1].max()]))
        upper = _upper_side(normals, offsets, xs[columns], ys[rows])
        heights[rows, columns] = np.fmax(heights[rows, columns], upper)
    ground = results.ground()
    if not ground.is_flat:
        heights -= ground.heights_at(np.stack(np.meshgrid(xs, ys), -1))
    return heights


_UPRIGHT = 1e-9
"""A face whose normal rises by less than this stands upright."""


def _upper_side(normals: np.ndarray, offsets: np.ndarray, xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
    """Return the heights (j, i) of the upper side of a convex body n·x ≤ d over a grid; nan outside it."""
    over_faces = offsets[:, None, None] - normals[:, 0, None, None] * xs - normals[:, 1, None, None] * ys[:, None]
    rising = normals[:, 2]
    up, down, upright = rising > _UPRIGHT, rising < -_UPRIGHT, abs(rising) <= _UPRIGHT
    top = (over_faces[up] / rising[up, None, None]).min(axis=0, initial=np.inf)
    bottom = (over_faces[down] / rising[down, None, None]).max(axis=0, initial=-np.inf)
    inside = (top >= bottom) & (over_faces[upright] >= 0.0).all(axis=0)
    return np.where(inside, top, np.nan)


_BELOW_M = 0.1
"""How far all of a body has to be below the ground to have gone through it, and not into a dip between two heights."""


@dataclass(frozen=True, slots=True)
class SurfaceDebris:
    """Debris on a surface: `bodies` (d,) whose centres lie over it in plan in the end, and not below it.

    `covered_m2` is the part of its area that debris covers.
    """

    name: str
    kind: str
    bodies: np.ndarray
    mass_kg: float
    covered_m2: float


def debris_on_surfaces(results: Results, debris: Debris) -> tuple[SurfaceDebris, ...]:
    """Return the debris on each surface of the ground, at the last recorded step."""
    results = relative_to_ground(results)
    positions = results.frames.positions_m[-1, debris.bodies]
    on_surfaces = []
    for surface in debris.ground.surfaces:
        level = surface.surface.heights_at(positions[:, :2])  # nan outside it
        # Water lies below the ground beyond its shores.
        on_it = (positions[:, 2] >= level - MOVED_M) & (level >= debris.ground.heights_at(positions[:, :2]))
        mass = float(debris.masses_kg[on_it].sum())
        covered = float((debris.area ^ debris.ground.shown(surface)).area())
        on_surfaces.append(SurfaceDebris(surface.name, surface.kind, debris.bodies[on_it], mass, covered))
    return tuple(on_surfaces)


def bodies_under_ground(results: Results) -> np.ndarray:
    """Return shards and balls that lie wholly below the ground in the end: they fell through it, or off its edge."""
    results = relative_to_ground(results)
    inventory, ground = results.inventory, results.ground()
    bodies = np.concatenate([inventory.of_kind("shard"), inventory.of_kind("ball")])
    positions = results.frames.positions_m[-1, bodies]
    bodies = bodies[positions[:, 2] < ground.heights_at(positions[:, :2])]  # of the others a part is above it
    under = [
        (corners[:, 2] < ground.heights_at(corners[:, :2]) - _BELOW_M).all()
        for corners in corners_at(results, -1, bodies)
    ]
    return bodies[np.array(under, bool)]


RUNOUT = 0.55, 0.73
"""Runout by that of the law, smallest and largest of eight columns, rounded down and up."""

HEIGHT = 0.89, 1.12
"""The same of the height of the pile."""

PILES_NOTE = Text(
    "Columns of loose blocks run out {} to {} times as far in this model as measured "
    "ones of grains, and their piles are {} to {} times as high: loose rubble may spread "
    "farther than is shown here",
    f"{RUNOUT[0]:g}",
    f"{RUNOUT[1]:g}",
    f"{HEIGHT[0]:g}",
    f"{HEIGHT[1]:g}",
)
"""What a report says of it."""
