"""The report of a survey of the debris against the forecast of a run."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from ..charts.pile import difference_map, footprints_map
from ..charts.plan_maps import map_height_mm
from ..model.debris.survey import SurveyComparison
from ..texts import Quantity, Text, distance_to_keep
from .document.blocks import Block, Column, DataTable, Document, Paragraph, Picture, Report, Section, facts

_WORDS = (
    "The survey is what a scan of the site showed after the demolition; the forecast is the end of this one run, which "
    "is one of many. Heights are above the ground as the run had it. A cell holds debris where it is higher than "
    "{}; cells that the survey has no points in, and those under what still stands by the forecast, are left "
    "out. What lay on the ground before, vehicles and spoil count as debris of the survey."
)


def survey_report(comparison: SurveyComparison, run: str, survey: Path) -> Report:
    """Return the report of a comparison of a run of that name with a survey."""
    bounds = (comparison.xs_m[0], comparison.ys_m[0], comparison.xs_m[-1], comparison.ys_m[-1])
    height_mm = map_height_mm([float(bound) for bound in bounds])
    blocks: list[Block] = [
        Paragraph(Text(_WORDS, Quantity(comparison.above_m, "m", "g"))),
        facts("Forecast and survey", survey_rows(comparison), "survey"),
        Picture(partial(footprints_map, comparison=comparison), "Where debris lies, in plan.", height_mm),
        Picture(partial(difference_map, comparison=comparison), "Survey less forecast, in plan.", height_mm),
    ]
    section = Section("Survey of the debris", tuple(blocks))
    title = Text("Survey beside the forecast: {}", survey.name)
    return Report(Document(title, run, (section,)), (_cells(comparison),))


def survey_rows(comparison: SurveyComparison) -> list[tuple[str, str]]:
    """Return what is said of a comparison: names and values."""
    surveyed, foreseen = comparison.surveyed, comparison.foreseen
    mean, squares, common = comparison.errors_m
    limit = Text("as given") if comparison.limit_is_given else Text("of the farthest debris of the run")
    area = comparison.cell_m2
    return [
        (Text("debris by the forecast"), _amount(comparison, foreseen, comparison.forecast_m)),
        (Text("debris by the survey"), _amount(comparison, surveyed, comparison.survey_m)),
        (Text("footprint by both"), Quantity(float((surveyed & foreseen).sum()) * area, "m²", ".1f")),
        (
            Text("overlap of the footprints"),
            Text("{} of the area that either of them covers", _percent(comparison.overlap)),
        ),
        (Text("surveyed footprint foreseen"), _percent(comparison.share_foreseen)),
        (Text("limit"), Text("{} from the bridge's plan, {}", distance_to_keep(comparison.limit_m, ".2f"), limit)),
        (Text("debris inside the limit"), Text("{} of its volume by the survey", _percent(comparison.share_inside))),
        (Text("farthest by the forecast"), _metres(comparison.farthest_m(foreseen))),
        (Text("farthest by the survey"), _metres(comparison.farthest_m(surveyed))),
        (Text("survey less forecast"), Text("{} in the mean, {} as root mean square", _metres(mean), _metres(squares))),
        ("", Text("95 % of the cells within {}", _metres(common))),
        (Text("known by the survey"), Quantity(float(comparison.known.sum()) * area, "m²", ".1f")),
        (Text("ground by the survey"), _ground(comparison)),
    ]


def _ground(comparison: SurveyComparison) -> str:
    ground_m = comparison.ground_m
    text = Text("{} above that of the run, as median where the forecast has no debris", _metres(ground_m))
    if not abs(ground_m) > comparison.above_m:
        return text
    return Text("{}: say by --origin which height the scenario's 0 has in it", text)


def _amount(comparison: SurveyComparison, cells: np.ndarray, heights_m: np.ndarray) -> str:
    volume_m3 = comparison.volume_m3(cells, heights_m)
    return Text(
        "{} in plan, {} down to the ground",
        Quantity(float(cells.sum()) * comparison.cell_m2, "m²", ".1f"),
        Quantity(volume_m3, "m³", ".1f"),
    )


def _percent(share: float) -> str:
    return Text("{} %", f"{100.0 * share:.1f}") if np.isfinite(share) else Text("not known")


def _metres(value: float) -> str:
    return Quantity(value, "m", ".2f") if np.isfinite(value) else Text("not known")


def _cells(comparison: SurveyComparison) -> DataTable:
    """Return all cells with debris, for a CSV file."""
    columns = (
        Column("x", "x_m", ".3f"),
        Column("y", "y_m", ".3f"),
        Column("forecast", "forecast_m", ".3f"),
        Column("survey", "survey_m", ".3f"),
        Column("from the bridge", "distance_m", ".3f"),
    )
    rows, cols = np.nonzero(comparison.surveyed | comparison.foreseen)
    values = zip(
        comparison.xs_m[cols].tolist(),
        comparison.ys_m[rows].tolist(),
        comparison.forecast_m[rows, cols].tolist(),
        comparison.survey_m[rows, cols].tolist(),
        comparison.distances_m[rows, cols].tolist(),
        strict=True,
    )
    return DataTable("survey_cells", "Cells with debris", columns, [tuple(round(v, 4) for v in row) for row in values])
