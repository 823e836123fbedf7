"""The table of bearings: a row for each bearing in each stage, with its force on what lies above it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..structure.model import Model
from .stages import Stage

BEARINGS_FILE = "bearings.csv"

BEARING_COLUMNS = (
    "stage",
    "time_s",
    "step",
    "bearing",
    "axis_x_m",
    "axis_y_m",
    "axis_z_m",
    "force_x_kN",
    "force_y_kN",
    "force_z_kN",
    "moment_x_kNm",
    "moment_y_kNm",
    "moment_z_kNm",
    "left_share",
)

_KILO = 1000.0


def bearing_rows(stages: Sequence[Stage], model: Model) -> Iterator[dict[str, Any]]:
    """Yield the rows of all bearings in all stages; none without `[[bearings]]`.

    Moments are about the middle of the axis. What has lifted off has no force, and what is gone no `left_share`.
    """
    if model.bearings is None:
        return
    for number, stage in enumerate(stages, start=1):
        for index, bearing in enumerate(model.bearings.forces(stage.standing.loads)):
            left = np.isfinite(stage.standing.used[model.bearings.rows_of(index)])
            values = *(bearing.force_n / _KILO).tolist(), *(bearing.moment_nm / _KILO).tolist()
            of_stage = number, stage.time_s, stage.step
            row = *of_stage, bearing.name, *bearing.axis_m.tolist(), *values, float(left.mean()) if len(left) else 0.0
            yield dict(zip(BEARING_COLUMNS, row, strict=True))
