"""Heights on a regular grid, as height models have them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class Raster:
    """Heights in rows from south to north."""

    first: FloatArray  # (2,), easting and northing of the first height of the first row
    steps: FloatArray  # (2,), distances of columns and of rows, both positive
    heights: FloatArray  # (r, c), nan where there are no data

    @property
    def bounds(self) -> FloatArray:
        """Lowest and highest easting and northing of the heights, (2, 2)."""
        rows, columns = self.heights.shape
        return np.array([self.first, self.first + self.steps * (columns - 1, rows - 1)])

    @property
    def points(self) -> FloatArray:
        """Positions (n, 3) of all heights that are known."""
        rows, columns = np.nonzero(np.isfinite(self.heights))
        x, y = self.first[0] + self.steps[0] * columns, self.first[1] + self.steps[1] * rows
        return np.column_stack((x, y, self.heights[rows, columns]))

    @property
    def spacing(self) -> float | None:
        """Distance of neighbouring heights."""
        return float(self.steps.min())

    def heights_at(self, positions: FloatArray) -> FloatArray:
        """Heights (n,) at positions (n, 2), even between the four around each; nan where one of these is not known."""
        rows, columns = self.heights.shape
        x, y = ((np.asarray(positions, float) - self.first) / self.steps).T
        inside = (x >= 0.0) & (y >= 0.0) & (x <= columns - 1) & (y <= rows - 1)
        x, y = np.where(inside, x, 0.0), np.where(inside, y, 0.0)
        column = np.minimum(x.astype(np.int64), max(columns - 2, 0))
        row = np.minimum(y.astype(np.int64), max(rows - 2, 0))
        heights = np.zeros(len(x))
        for across in (0, 1):
            for along in (0, 1):
                weight = (y - row if across else 1.0 - (y - row)) * (x - column if along else 1.0 - (x - column))
                corner = self.heights[np.minimum(row + across, rows - 1), np.minimum(column + along, columns - 1)]
                heights += np.where(weight > 0.0, weight * corner, 0.0)
        return np.where(inside, heights, np.nan)
