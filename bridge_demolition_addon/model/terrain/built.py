"""The ground of a scenario as it is built: terrain cut to the site, and surfaces on it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.terrain.levelling import Levelled, levelled
from ...engineering.terrain.raster import nearest_known
from ...engineering.terrain.surface import NamedSurface, RecordedGround, Surface
from ...engineering.terrain.thinning import Grid, thinned
from ...errors import GeometryError
from ...texts import Quantity, Text
from ..actions import Fact
from ..scenario import Scenario
from .placed import BuiltSurface, Terrain, built_surfaces, terrain_of

COARSEST_STEP_M = 0.5
"""Steps of the ground where it is not thinned, at most, where the site allows: columns are some decimetres wide."""

LONGEST_SIDE_M = 8.0
"""Shorter sides of its triangles: Bullet finds contacts on much larger ones less well, in single precision."""

_FEWEST_HALVINGS, _MOST_HALVINGS = 5, 10
"""A side of the site has 2^5 to 2^10 cells."""

_COMMON = 95.0


@dataclass(frozen=True, slots=True)
class TerrainFacts:
    """What the ground was made of, and how exactly.

    Attributes
    ----------
    heights, triangles, step_m
        Heights of the file on the site, triangles made of them, and the side of the smallest.
    largest_error_m, error_place_m, common_error_m
        Largest distance of the ground from a height of the file, where it was not levelled, its position (2,), and the
        distance that 95 % of the heights do not exceed.
    filled_in_share
        Part of the site without data, level on from the nearest.
    levelled
        What was dug and filled for members.
    """

    name: str
    heights: int
    triangles: int
    step_m: float
    largest_error_m: float
    error_place_m: tuple[float, float]
    common_error_m: float
    lowest_m: float
    highest_m: float
    filled_in_share: float
    levelled: tuple[Levelled, ...]


@dataclass(frozen=True, slots=True)
class BuiltGround:
    """The ground of a model, how it was made, and the surfaces on it; without a terrain it is flat, at height 0."""

    terrain: Surface | None = None
    facts: TerrainFacts | None = None
    surfaces: tuple[BuiltSurface, ...] = ()

    @property
    def is_plain(self) -> bool:
        return self.terrain is None and not self.surfaces

    def recorded(self) -> RecordedGround:
        """Return the ground as the results of a run have it."""
        surfaces = (
            NamedSurface(surface.settings.name, surface.settings.kind, Surface(surface.mesh))
            for surface in self.surfaces
        )
        return RecordedGround(self.terrain, tuple(surfaces))

    def heights_at(self, positions_m: np.ndarray) -> np.ndarray:
        """Return heights (n,) of the ground at positions (n, 2), m; nan beyond its edge."""
        return np.zeros(len(positions_m)) if self.terrain is None else self.terrain.heights_at(positions_m)


def built_ground(scenario: Scenario, members: Sequence[tuple[str, TriangleMesh]], half_size_m: float) -> BuiltGround:
    """Return the ground of a scenario under members, `half_size_m` from the origin to every side."""
    terrain = terrain_of(scenario)
    if terrain is None:
        ground = BuiltGround()
    else:
        ground = BuiltGround(*_cut(terrain, members, half_size_m, scenario.ground.tolerance_m))
    return BuiltGround(ground.terrain, ground.facts, built_surfaces(scenario, members, ground.heights_at))


def check_under(terrain: Terrain, members: Sequence[tuple[str, TriangleMesh]]) -> None:
    """Check that a terrain has data somewhere under a bridge."""
    vertices = np.concatenate([solid.vertices[:, :2] for _, solid in members])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    x, y = (np.linspace(low[axis], high[axis], 33) for axis in (0, 1))
    positions = np.concatenate([vertices, np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)])
    if np.isfinite(terrain.heights_at(positions)).any():
        return
    (west, south), (east, north) = terrain.source.bounds
    raise GeometryError(
        f"{terrain.name} misses the bridge: it covers eastings {west:.10g} to {east:.10g} and northings {south:.10g} "
        f"to {north:.10g}, and the middle of the bridge is at {terrain.place_text((low + high) / 2.0)}; set "
        "ground.origin to where the scenario's origin is in the file, and ground.scale to metres in its unit."
    )


def _cut(
    terrain: Terrain, members: Sequence[tuple[str, TriangleMesh]], half_m: float, tolerance_m: float
) -> tuple[Surface, TerrainFacts]:
    check_under(terrain, members)
    grid = _sampled(terrain, half_m)
    known = np.isfinite(grid.heights)
    grid = _without_gaps(grid, known)
    try:
        ground, kept, done = levelled(grid, members, terrain.heights_at)
    except GeometryError as error:
        raise GeometryError(f"{terrain.name}: {error}; give it heights there, or move the bridge.") from error
    surface = Surface(thinned(ground, tolerance_m, kept, LONGEST_SIDE_M))
    points = terrain.points_within(grid.low, -grid.low)
    points = points[~_near(kept, grid, points)]
    errors = np.abs(surface.heights_at(points[:, :2]) - points[:, 2])
    worst = int(errors.argmax()) if len(errors) else 0
    heights = surface.mesh.vertices[:, 2]
    facts = TerrainFacts(
        name="; ".join((terrain.name, *terrain.notes)),
        heights=len(points),
        triangles=len(surface.mesh.triangles),
        step_m=grid.step_m,
        largest_error_m=float(errors.max(initial=0.0)),
        error_place_m=(float(points[worst, 0]), float(points[worst, 1])) if len(errors) else (0.0, 0.0),
        common_error_m=float(np.percentile(errors, _COMMON)) if len(errors) else 0.0,
        lowest_m=float(heights.min()),
        highest_m=float(heights.max()),
        filled_in_share=1.0 - float(known.mean()),
        levelled=done,
    )
    return surface, facts


def _sampled(terrain: Terrain, half_m: float) -> Grid:
    """Sample a terrain around the origin, as finely as its own heights where needed; nan where unknown."""
    step = min(terrain.spacing_m or COARSEST_STEP_M, COARSEST_STEP_M)
    halvings = next((k for k in range(_FEWEST_HALVINGS, _MOST_HALVINGS) if 2.0 * half_m <= step * (1 << k)), None)
    cells = 1 << (_MOST_HALVINGS if halvings is None else halvings)
    empty = Grid(np.full(2, -half_m), 2.0 * half_m / cells, np.zeros((cells + 1, cells + 1)))
    heights = terrain.heights_at(empty.places()).reshape(cells + 1, cells + 1)
    return Grid(empty.low, empty.step_m, heights)


def _without_gaps(grid: Grid, known: np.ndarray) -> Grid:
    if known.all():
        return grid
    return Grid(grid.low, grid.step_m, grid.heights[nearest_known(known)])


def _near(kept: np.ndarray, grid: Grid, points: np.ndarray) -> np.ndarray:
    """Return whether points (n, 3) lie in a cell with a node that was levelled."""
    cells = np.clip(np.floor((points[:, :2] - grid.low) / grid.step_m).astype(np.int64), 0, grid.size - 2)
    corners = [kept[cells[:, 1] + down, cells[:, 0] + right] for down in (0, 1) for right in (0, 1)]
    return np.any(corners, axis=0)


def terrain_summary(facts: TerrainFacts) -> list[tuple[str, str]]:
    """Return labels and texts: where the heights come from, the triangles made of them, and the error."""
    x, y = facts.error_place_m
    lines = [
        ("from", f"{facts.name}, {facts.heights} heights on the site"),
        ("made", f"{facts.triangles} triangles, the least with sides of {facts.step_m:.3g} m"),
        ("heights", Text("from {} to {}", Quantity(facts.lowest_m, "m", ".2f"), Quantity(facts.highest_m, "m", ".2f"))),
        (
            "error",
            f"{facts.largest_error_m:.3f} m at most, near ({x:.1f}, {y:.1f}) m; 95 % of the heights within "
            f"{facts.common_error_m:.3f} m",
        ),
    ]
    if facts.filled_in_share > 0.0:
        share = Text("{} %", f"{100.0 * facts.filled_in_share:.1f}")
        lines.append(("without data", f"{share} of the site: level on from the nearest height"))
    lines += [
        (f"under {member.name}", f"dug up to {member.dug_m:.2f} m, filled up to {member.filled_m:.2f} m")
        for member in facts.levelled
    ]
    return lines


def terrain_facts(ground: BuiltGround) -> Iterator[Fact]:
    """Yield how the terrain was made, and what lies on it."""
    if ground.facts:
        yield from terrain_summary(ground.facts)
    recorded = ground.recorded()
    for surface in recorded.surfaces:
        yield surface.name, Text("{}, {} in plan", surface.kind, Quantity(recorded.shown(surface).area(), "m²", ".1f"))
