"""Terrain and surfaces on it, such as water, in the coordinates of a scenario: x along the road, z up."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.plan_areas import signed_area, united
from ...engineering.geometry.solids import from_manifold, to_manifold
from ...engineering.geometry.vectors import transformed, transformed_back, turn_in_plane
from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ..scenario import Ground, GroundSurface, Scenario
from ..schema import given
from .file_heights import FileHeights
from .files import read_surface, read_terrain

_LOWEST_M, _HIGHEST_M = -1_000.0, 9_000.0
"""Heights at which bridges are built, and some room: -9999, which often stands for no data, is none."""

_EAST_DEG = 90.0

_FAR_M = 20_000.0
"""How far a profile goes on beyond its ends and to both sides: farther than any ground that is made of it."""


@dataclass(frozen=True, eq=False, slots=True)
class Placing:
    """Where a file's coordinates are in a scenario.

    `origin` (3,) is the scenario's origin in the file's units, `turn` (2, 2) rotates easting and northing into x and y,
    and `scale` is metres in one unit of the file.
    """

    origin: np.ndarray
    turn: np.ndarray
    scale: float

    @classmethod
    def of(cls, scenario: Scenario, unit_m: float = 1.0) -> Placing:
        """Return the placing of a file in a scenario, with the metres in the unit that it says.

        That counts where the user gives no scale.
        """
        ground = scenario.ground
        bearing = ground.bearing_deg
        if bearing is None:
            bearing = scenario.site.bearing_deg if scenario.site else _EAST_DEG
        turn = np.eye(2) if bearing == _EAST_DEG else turn_in_plane(math.radians(bearing - _EAST_DEG))
        return cls(np.array(ground.origin or (0.0, 0.0, 0.0)), turn, unit_m if ground.scale == 1.0 else ground.scale)

    def to_scenario(self, points: np.ndarray) -> np.ndarray:
        """Return positions (n, 3) of the file in the scenario, m."""
        moved = (points - self.origin) * self.scale
        return np.column_stack((transformed(self.turn, moved[:, :2]), moved[:, 2]))

    def to_file(self, positions_m: np.ndarray) -> np.ndarray:
        """Return eastings and northings (n, 2) of positions (n, 2) of the scenario."""
        return transformed_back(self.turn, np.asarray(positions_m, float)) / self.scale + self.origin[:2]


AS_THE_SCENARIO = Placing(np.zeros(3), np.eye(2), 1.0)
"""The placing of heights that are in the scenario's own coordinates."""


@dataclass(frozen=True, eq=False, slots=True)
class Terrain:
    """Heights of a file or a profile, at positions of a scenario."""

    name: str
    source: Raster | Surface
    placing: Placing
    notes: tuple[str, ...] = ()

    @property
    def spacing_m(self) -> float | None:
        """Return the distance of neighbouring heights, m; None where they lie anywhere."""
        spacing = self.source.spacing
        return None if spacing is None else spacing * self.placing.scale

    def heights_at(self, positions_m: np.ndarray) -> np.ndarray:
        """Return heights (n,) at positions (n, 2), m; nan where there are no data."""
        positions_m = np.asarray(positions_m, float).reshape(-1, 2)
        heights = self.source.heights_at(self.placing.to_file(positions_m))
        return (heights - self.placing.origin[2]) * self.placing.scale

    def points_within(self, low_m: np.ndarray, high_m: np.ndarray) -> np.ndarray:
        """Return positions (n, 3) in a box (2,) (2,) in plan at which the file gives heights, m."""
        points = self.placing.to_scenario(self.source.points)
        return points[((points[:, :2] >= low_m) & (points[:, :2] <= high_m)).all(axis=1)]

    def place_text(self, position_m: np.ndarray) -> str:
        """Return easting and northing of a position (2,), as text."""
        easting, northing = self.placing.to_file(position_m)
        return f"easting {easting:.10g}, northing {northing:.10g}"


def terrain_of(scenario: Scenario) -> Terrain | None:
    """Return the terrain of a scenario; None where its ground is flat."""
    ground = scenario.ground
    if ground.profile_m is not None:
        shift = scenario.bridge.shift_across if scenario.bridge else 0.0
        terrain = Terrain("profile along the road", profile_surface(ground.profile_m, shift), AS_THE_SCENARIO)
        _check_heights(terrain)
        return terrain
    if ground.file is None:
        return None
    read = _read_once(ground.file, ground, _state_of(ground.file))
    in_unit = (f"in {read.unit}, as it says: {read.unit_m:.7g} m",) if read.unit and ground.scale == 1.0 else ()
    notes = (*in_unit, *read.notes)
    terrain = Terrain(Path(ground.file).name, read.source, Placing.of(scenario, read.unit_m), notes)
    _check_heights(terrain)
    return terrain


def profile_surface(points_m: Sequence[tuple[float, float]], shift_across: float) -> Surface:
    """Return the ground of a profile along the road, level beyond its ends and the same across the road.

    Parameters
    ----------
    points_m
        x and z of its points, in their order.
    shift_across
        How far along the road it moves for each metre across it, as skewed axes do.
    """
    along, heights = np.array(points_m, dtype=float).T
    along = np.concatenate(([along[0] - _FAR_M], along, [along[-1] + _FAR_M]))
    heights = np.concatenate((heights[:1], heights, heights[-1:]))
    rows = [
        np.column_stack((along + y * shift_across, np.full(len(along), y), heights)) for y in (-_FAR_M, 0.0, _FAR_M)
    ]
    count = len(along)
    first = np.concatenate([row * count + np.arange(count - 1) for row in range(len(rows) - 1)])
    right, left = first + 1, first + count
    triangles = np.concatenate([np.column_stack((first, right, left)), np.column_stack((right, left + 1, left))])
    return Surface(TriangleMesh(np.concatenate(rows), triangles))


def surface_mesh(scenario: Scenario, name: str) -> TriangleMesh:
    """Return the mesh of a surface's file in the scenario."""
    mesh, unit_m = read_surface(name, scenario.ground)
    return TriangleMesh(Placing.of(scenario, unit_m).to_scenario(mesh.vertices), mesh.triangles)


@lru_cache(maxsize=1)
def _read_once(name: str, ground: Ground, _state: tuple[int, int]) -> FileHeights:
    """Read a file once until it changes, as the piers, the ground and the view all ask for it."""
    return read_terrain(name, ground)


def _state_of(name: str) -> tuple[int, int]:
    try:
        state = Path(name).stat()
    except (OSError, ValueError):  # said by its reader
        return 0, 0
    return state.st_mtime_ns, state.st_size


def _check_heights(terrain: Terrain) -> None:
    heights = terrain.source.points[:, 2]
    if not len(heights):
        raise GeometryError(f"{terrain.name}: has no data at all; ground.no_data says which height stands for none.")
    scale = terrain.placing.scale
    for height in (float(heights.min()), float(heights.max())):
        if not _LOWEST_M <= height * scale <= _HIGHEST_M:
            raise GeometryError(
                f"{terrain.name}: has a height of {height:g}, which is nowhere on earth; set ground.no_data to it if "
                "it stands for no data, or ground.scale if the file is not in metres."
            )


THICKNESS_M = 1.0
"""Depth of a level surface: a solid, so that nothing small falls through it in a sub-step."""

_GAP_M = 0.05
"""Gap around members that stand in a level surface: Bullet would press the two apart."""

_WITHIN_M = 1e-3


@dataclass(frozen=True, slots=True)
class BuiltSurface:
    """A surface as it is built, with its triangles in the scenario's coordinates."""

    settings: GroundSurface
    mesh: TriangleMesh


def built_surfaces(
    scenario: Scenario,
    members: Sequence[tuple[str, TriangleMesh]],
    ground_at: Callable[[np.ndarray], np.ndarray],
) -> tuple[BuiltSurface, ...]:
    """Return all surfaces of a scenario, on ground with heights (n,) at positions (n, 2); level ones spare members."""
    surfaces = []
    for settings in scenario.ground.surfaces:
        if settings.file is None:
            mesh = _level(settings, members)
        else:
            mesh = surface_mesh(scenario, settings.file)
            _check_through(settings, mesh, members)
        _check_above(settings, mesh, ground_at)
        surfaces.append(BuiltSurface(settings, mesh))
    return tuple(surfaces)


def _level(settings: GroundSurface, members: Sequence[tuple[str, TriangleMesh]]) -> TriangleMesh:
    corners = np.array(settings.corners_m)
    area = CrossSection([corners if signed_area(corners) > 0.0 else corners[::-1]])
    height = given(settings.height_m)
    bottom = height - THICKNESS_M
    standing = [_plan_between(solid, name, bottom, height) for name, solid in members]
    room = [plan.offset(_GAP_M, JoinType.Miter) for plan in standing if not plan.is_empty()]
    area -= united(room)
    if area.is_empty():
        raise GeometryError(f"Surface {settings.name!r}: members take all of its room; give it a larger outline.")
    return from_manifold(Manifold.extrude(area, THICKNESS_M).translate((0.0, 0.0, bottom)))


def _plan_between(solid: TriangleMesh, name: str, bottom: float, top: float) -> CrossSection:
    """Return the area that a solid covers in plan between two heights."""
    low, high = solid.bounds[:, 2]
    if low >= top or high <= bottom:
        return CrossSection()
    part = to_manifold(solid, name).trim_by_plane((0.0, 0.0, 1.0), bottom).trim_by_plane((0.0, 0.0, -1.0), -top)
    return part.project()


def _check_through(settings: GroundSurface, mesh: TriangleMesh, members: Sequence[tuple[str, TriangleMesh]]) -> None:
    surface = Surface(mesh)
    for name, solid in members:
        heights = surface.heights_at(solid.vertices[:, :2])
        below = solid.vertices[:, 2] < heights - _WITHIN_M
        if below.any():
            x, y, z = solid.vertices[below.argmax()]
            raise GeometryError(
                f"Surface {settings.name!r}: {name} reaches through it, at ({x:.2f}, {y:.2f}, {z:.2f}) m; leave a hole "
                "in the mesh around it."
            )


def _check_above(settings: GroundSurface, mesh: TriangleMesh, ground_at: Callable[[np.ndarray], np.ndarray]) -> None:
    low, high = mesh.bounds[:, :2]
    x, y = (np.linspace(low[axis], high[axis], 65) for axis in (0, 1))
    positions = np.concatenate([mesh.vertices[:, :2], np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)])
    over = Surface(mesh).heights_at(positions) - ground_at(positions)
    if np.isnan(over).all():
        raise GeometryError(
            f"Surface {settings.name!r} lies beside the ground: bring it to the bridge by its corners_m, or by "
            "ground.origin and ground.scale."
        )
    if np.nanmax(over) < 0.0:
        raise GeometryError(
            f"Surface {settings.name!r} lies {-np.nanmax(over):.3g} m or more under the ground: nothing reaches it; "
            "raise it."
        )
