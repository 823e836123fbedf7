"""A survey of the debris after a demolition against the forecast of a run: heights, footprints, and a limit."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import distances_outside
from ...errors import GeometryError, ScenarioError, UnreadableError
from ..mesh_reading import MESH_FILES, read_points_of_mesh
from ..results.arrays import Results
from ..results.motion import relative_to_ground
from ..terrain.file_heights import read_ascii_grid
from ..terrain.files import GRID_FILES, POINT_FILES, TIFF_FILES
from ..terrain.geotiff import read_geotiff
from ..terrain.placed import Placing
from ..terrain.point_files import CLOUD_FILES, point_rows, read_cloud
from .footprint import footprint
from .throws import debris_of, heights_over

SURVEY_FILES = (*CLOUD_FILES, *MESH_FILES, *POINT_FILES, *GRID_FILES, *TIFF_FILES)

MOST_CELLS = 4_000_000

_COMMON = 95.0


@dataclass(frozen=True, slots=True)
class SurveySettings:
    """How a survey is compared.

    Attributes
    ----------
    cell_m
        Side of the cells in plan; the median of the points in a cell is its height.
    above_m
        Height above the ground from which on a cell holds debris.
    limit_m
        Distance from the bridge's plan within which debris was to stay; the run's farthest debris unless given.
    """

    cell_m: float = 0.5
    above_m: float = 0.2
    limit_m: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class SurveyComparison:
    """A forecast against a survey, over middles (i,) and (j,) of cells in plan.

    Heights (j, i) are above the ground as the run had it: of the forecast 0 where nothing lies, of the survey nan where
    it has no points. Cells under what still stands by the forecast count as neither.
    """

    xs_m: np.ndarray
    ys_m: np.ndarray
    forecast_m: np.ndarray
    survey_m: np.ndarray
    standing: np.ndarray  # (j, i)
    distances_m: np.ndarray  # (j, i), from the bridge's plan
    above_m: float
    limit_m: float
    limit_is_given: bool
    outline: CrossSection

    @property
    def cell_m2(self) -> float:
        """Area of a cell."""
        return float((self.xs_m[1] - self.xs_m[0]) * (self.ys_m[1] - self.ys_m[0]))

    @property
    def known(self) -> np.ndarray:
        """Cells (j, i) with points of the survey, outside what stands."""
        return np.isfinite(self.survey_m) & ~self.standing

    @property
    def surveyed(self) -> np.ndarray:
        """Cells (j, i) with debris by the survey."""
        return self.known & (np.nan_to_num(self.survey_m) > self.above_m)

    @property
    def foreseen(self) -> np.ndarray:
        """Cells (j, i) with debris by the forecast, of those that the survey knows."""
        return self.known & (self.forecast_m > self.above_m)

    @property
    def difference_m(self) -> np.ndarray:
        """Survey less forecast (j, i), m; nan where neither has debris, or the survey no points."""
        return np.where(self.surveyed | self.foreseen, self.survey_m - self.forecast_m, np.nan)

    @property
    def overlap(self) -> float:
        """Area with debris by both over that with debris by either of them; nan without any."""
        either = float((self.surveyed | self.foreseen).sum())
        return float((self.surveyed & self.foreseen).sum()) / either if either else float("nan")

    @property
    def share_foreseen(self) -> float:
        """Part of the surveyed footprint that the forecast covers; nan without any."""
        surveyed = float(self.surveyed.sum())
        return float((self.surveyed & self.foreseen).sum()) / surveyed if surveyed else float("nan")

    @property
    def share_inside(self) -> float:
        """Part of the surveyed debris, by volume, that lies within the limit; nan without any."""
        volumes = np.where(self.surveyed, self.survey_m, 0.0)
        total = float(volumes.sum())
        return float(volumes[self.distances_m <= self.limit_m].sum()) / total if total else float("nan")

    def volume_m3(self, cells: np.ndarray, heights_m: np.ndarray) -> float:
        """Volume between the ground and heights (j, i) in cells (j, i)."""
        return float(heights_m[cells].sum()) * self.cell_m2

    def farthest_m(self, cells: np.ndarray) -> float:
        """Largest distance of cells (j, i) from the bridge's plan; nan without any."""
        return float(self.distances_m[cells].max()) if cells.any() else float("nan")

    @property
    def ground_m(self) -> float:
        """Median height of the survey where the forecast has no debris; nan where it has no points there."""
        heights = self.survey_m[self.known & (self.forecast_m <= self.above_m)]
        return float(np.median(heights)) if len(heights) else float("nan")

    @property
    def errors_m(self) -> tuple[float, float, float]:
        """Mean of survey less forecast, its root mean square, and what 95 % of the cells do not exceed."""
        values = self.difference_m[np.isfinite(self.difference_m)]
        if not len(values):
            return float("nan"), float("nan"), float("nan")
        squares = float(np.sqrt((values * values).mean()))
        return float(values.mean()), squares, float(np.percentile(np.abs(values), _COMMON))


def read_survey(path: Path, placing: Placing) -> np.ndarray:
    """Return the points (n, 3) of a survey in the coordinates of the scenario, m."""
    suffix = path.suffix.lower()
    if suffix not in SURVEY_FILES:
        raise ScenarioError(f"{path}: expected a survey that ends in one of {', '.join(SURVEY_FILES)}")
    try:
        if suffix in CLOUD_FILES:
            points = read_cloud(path)[0]
        elif suffix in MESH_FILES:
            points = read_points_of_mesh(path)
        elif suffix in GRID_FILES:
            points = read_ascii_grid(path, None).points
        elif suffix in TIFF_FILES:
            points = read_geotiff(path, None, placing.scale).source.points
        else:
            points = point_rows(path)
    except (GeometryError, UnreadableError) as error:
        raise ScenarioError(f"{path}: {str(error).removeprefix(f'{path}: ')}") from error
    return placing.to_scenario(points)


def compared(results: Results, points: np.ndarray, settings: SurveySettings) -> SurveyComparison:
    """Compare a run with the points (n, 3) of a survey, in the coordinates of its scenario."""
    results = relative_to_ground(results)
    debris, shards = debris_of(results), results.inventory.of_kind("shard")
    limit_m = settings.limit_m
    if limit_m is None:
        limit_m = float(debris.reaches_m.max(initial=0.0))
    low, high = _extent(debris.outline, debris.area, points, limit_m)
    counts = np.maximum(np.ceil((high - low) / settings.cell_m).astype(int), 2)
    if counts.prod() > MOST_CELLS:
        raise ScenarioError(f"the survey covers {counts.prod()} cells: expected at most {MOST_CELLS}; take larger ones")
    xs, ys = (low[axis] + settings.cell_m * (np.arange(counts[axis]) + 0.5) for axis in (0, 1))
    places = np.stack(np.meshgrid(xs, ys), -1)
    surveyed = _medians(points, low, settings.cell_m, counts)
    ground = results.ground()
    if not ground.is_flat:
        surveyed = surveyed - ground.heights_at(places)
    if not np.isfinite(surveyed).any():
        (west, south), (east, north) = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        raise ScenarioError(
            f"the survey has no point near the bridge: it goes from x = {west:.0f} m to {east:.0f} m and from y = "
            f"{south:.0f} m to {north:.0f} m in the scenario; say by --origin and --bearing where the scenario begins "
            "in it, and by --scale how many metres its unit has"
        )
    unmoved = np.setdiff1d(shards, debris.bodies)
    standing = _within(footprint(results, unmoved, -1), places)
    distances = distances_outside(debris.outline, places.reshape(-1, 2)).reshape(len(ys), len(xs))
    forecast = np.nan_to_num(heights_over(results, debris.bodies, xs, ys))
    return SurveyComparison(
        xs_m=xs,
        ys_m=ys,
        forecast_m=forecast,
        survey_m=surveyed,
        standing=standing,
        distances_m=distances,
        above_m=settings.above_m,
        limit_m=limit_m,
        limit_is_given=settings.limit_m is not None,
        outline=debris.outline,
    )


_ROOM = 2.0
"""How far around the limit debris is looked for, by the limit; at least 10 m."""

_LEAST_ROOM_M = 10.0


def _extent(
    outline: CrossSection, area: CrossSection, points: np.ndarray, limit_m: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return lowest and highest position (2,) of what is compared: all points near the bridge and its debris."""
    covered = outline if area.is_empty() else outline + area
    low, high = np.array(covered.bounds()).reshape(2, 2)
    room = max(_ROOM * limit_m, _LEAST_ROOM_M)
    near = points[((points[:, :2] >= low - room) & (points[:, :2] <= high + room)).all(axis=1), :2]
    if len(near):
        low, high = np.minimum(low, near.min(axis=0)), np.maximum(high, near.max(axis=0))
    return low, high


def _medians(points: np.ndarray, low: np.ndarray, cell_m: float, counts: np.ndarray) -> np.ndarray:
    """Return the median heights (j, i) of the points (n, 3) in each cell; nan without any."""
    cells = np.floor((points[:, :2] - low) / cell_m).astype(np.int64)
    inside = ((cells >= 0) & (cells < counts)).all(axis=1)
    rows = cells[inside, 1] * counts[0] + cells[inside, 0]
    heights = points[inside, 2]
    order = np.lexsort((heights, rows))
    rows, heights = rows[order], heights[order]
    found, first, number = np.unique(rows, return_index=True, return_counts=True)
    medians = np.full(int(counts.prod()), np.nan)
    medians[found] = (heights[first + (number - 1) // 2] + heights[first + number // 2]) / 2.0
    return medians.reshape(counts[1], counts[0])


def _within(area: CrossSection, places: np.ndarray) -> np.ndarray:
    if area.is_empty():
        return np.zeros(places.shape[:2], bool)
    outside: np.ndarray = distances_outside(area, places.reshape(-1, 2))
    return (outside <= 0.0).reshape(places.shape[:2])
