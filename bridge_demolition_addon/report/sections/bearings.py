"""Bearings in a report of a run: what each carried, and whether it opened or slid."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from ...charts.histories import compared_histories
from ...engineering.geometry.vectors import length
from ...model.results.bearings import BearingHistory, bearing_histories
from ...model.scenario.scenario import bearing_tables
from ...model.structure.bearing_ranges import ONE_CUT
from ...texts import Text, Unit
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture
from ..run_folder import ReportedRun

_MOST_LINES = 8

_NOTES = Text(
    "At rest: mean over the first frame after any warm-up. Least and largest are those of single sub-steps, as "
    "long as the bearing was there; below 0 it held against uplift or, without tension, Bullet's constraint "
    "answered to contacts, which a bearing cannot. Opened: largest part of its area that lifted off. "
    "Displacement: largest horizontal one of what lies above against what lies below, from where they were built, "
    "and the part of it that slid. Moments are about the axis across the road. Every frame is in bearing_log.csv."
)


def bearing_blocks(run: ReportedRun) -> list[Block]:
    """Return a table and a chart of all bearings of a run; none without `[[bearings]]`."""
    of_all = bearing_histories(run.recorded, bearing_tables(run.scenario) if run.scenario else ())
    histories = [bearing for bearing in of_all if np.isfinite(bearing.forces_n[1:]).any()]
    extremes = run.summary.bearings if run.summary else []
    blocks: list[Block] = []
    if extremes:
        blocks += [_extremes(extremes), Paragraph(_NOTES), Paragraph(ONE_CUT)]
    elif histories:
        blocks += [_means(histories), Paragraph(ONE_CUT)]
    if histories:
        largest = sorted(histories, key=lambda bearing: -float(np.nanmax(bearing.forces_n[1:, 2], initial=-np.inf)))
        shown = [bearing for bearing in histories if bearing in largest[:_MOST_LINES]]
        times_s = run.recorded.frames.time_s[1:]
        lines = [(bearing.name, times_s, bearing.forces_n[1:, 2] / 1e3) for bearing in shown]
        caption = Text("Vertical forces of bearings on what lies above them, each the mean over a frame.")
        if len(histories) > len(shown):
            caption = Text("{} The {} with the largest are shown.", caption, _MOST_LINES)
        blocks.append(
            Picture(
                partial(compared_histories, label=Text("vertical force ({})", Unit("kN")), histories=lines), caption
            )
        )
    return blocks


def _extremes(bearings: Sequence[Mapping[str, Any]]) -> DataTable:
    def scaled(key: str, factor: float) -> Callable[[Mapping[str, Any]], float | None]:
        return lambda bearing: None if bearing.get(key) is None else factor * bearing[key]

    columns = (
        Column("bearing", "bearing", "", lambda bearing: bearing["name"]),
        Column("up at rest", "at_rest_up_kN", ".1f", scaled("at_rest_up_N", 1e-3)),
        Column("least", "least_up_kN", ".1f", scaled("least_up_N", 1e-3)),
        Column(Text("largest", context="force"), "largest_up_kN", ".1f", scaled("largest_up_N", 1e-3)),
        Column("at", "largest_up_s", ".3f", scaled("largest_up_s", 1.0)),
        Column("largest horizontal", "largest_horizontal_kN", ".1f", scaled("largest_horizontal_N", 1e-3)),
        Column("largest moment", "largest_moment_y_kNm", ".1f", scaled("largest_moment_y_Nm", 1e-3)),
        Column("opened", "largest_open_percent", ".0f", scaled("largest_open_share", 100.0)),
        Column("displacement", "largest_displacement_mm", ".1f", scaled("largest_displacement_m", 1e3)),
        Column("slid", "slip_mm", ".1f", scaled("slip_m", 1e3)),
        Column("left at the end", "left_percent", ".0f", scaled("left_share", 100.0)),
    )
    return DataTable.of("bearings", "Bearings", columns, bearings)


def _means(histories: Sequence[BearingHistory]) -> DataTable:
    """Return the table of a run whose summary has no bearings: one that was recorded before, or was killed."""

    def upwards(choose: Callable[[np.ndarray], Any]) -> Callable[[BearingHistory], float]:
        return lambda bearing: float(choose(bearing.forces_n[1:, 2])) / 1e3

    columns = (
        Column("bearing", "bearing", "", lambda bearing: bearing.name),
        Column("up at first", "first_up_kN", ".1f", upwards(lambda forces: forces[0])),
        Column("least", "least_up_kN", ".1f", upwards(np.nanmin)),
        Column(Text("largest", context="force"), "largest_up_kN", ".1f", upwards(np.nanmax)),
        Column(
            "largest horizontal",
            "largest_horizontal_kN",
            ".1f",
            lambda bearing: float(np.nanmax(length(bearing.forces_n[1:, :2]))) / 1e3,
        ),
        Column("left at the end", "left_percent", ".0f", lambda bearing: 100.0 * float(bearing.intact[-1])),
    )
    return DataTable.of("bearings", "Forces of bearings, each the mean over a frame", columns, histories)
