"""Terrain in the coordinates of a scenario: x along the road, y across it, z up from its origin."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.rotations import turn_in_plane
from ...engineering.geometry.vectors import transformed, transformed_back
from ...engineering.terrain.raster import Raster
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ..scenario import Ground, Scenario
from .file_heights import FileHeights
from .files import read_surface, read_terrain

_LOWEST_M, _HIGHEST_M = -1_000.0, 9_000.0
"""Heights at which bridges are built, and some room: -9999, which often stands for no data, is none."""

_EAST_DEG = 90.0


@dataclass(frozen=True, eq=False, slots=True)
class Placing:
    """Where a file's coordinates are in a scenario.

    `origin` (3,) is that of the scenario in the file's units, `turn` (2, 2) rotates easting and northing into x and y,
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


@dataclass(frozen=True, eq=False, slots=True)
class Terrain:
    """Heights of a file, at positions of a scenario."""

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
    if ground.file is None:
        return None
    read = _read_once(ground.file, ground, _state_of(ground.file))
    in_unit = (f"in {read.unit}, as it says: {read.unit_m:.7g} m",) if read.unit and ground.scale == 1.0 else ()
    notes = (*in_unit, *read.notes)
    terrain = Terrain(Path(ground.file).name, read.source, Placing.of(scenario, read.unit_m), notes)
    _check_heights(terrain)
    return terrain


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
