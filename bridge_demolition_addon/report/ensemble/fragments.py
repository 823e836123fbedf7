"""How far fragments that are smaller than shards fly, in the report of a study."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from ...charts.plan_maps import map_height_mm
from ...charts.study_plan import study_plan
from ...model.structure.zone_fragments import DOUBT
from ...model.study.fragments import FragmentLimits
from ...texts import Text
from ..charge_areas import cordon_area
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from ..wording.numbers import percent
from ..wording.study import fragments_sentence
from .plan import areas_of_fragments_in
from .study_runs import StudyRuns

_COLUMNS = (
    Column("", "what"),
    Column("distance", "distance_m", ".0f", is_reach=True),
    Column("confidence", "confidence", ".2%"),
)


def fragments_section(runs: StudyRuns) -> Section | None:
    """Return how far fragments fly; None without blast zones, and before all runs are there."""
    limits = runs.conclusions.fragments if runs.conclusions else None
    if limits is None:
        return None
    exclusion = runs.ensemble.scenario.exclusion
    cordon_m = exclusion.cordon_m if exclusion else None
    words = Paragraph(fragments_sentence(limits, cordon_m), is_notice=True)
    return Section("How far fragments fly", (words, _table(limits, cordon_m), *_picture(runs)))


def _table(limits: FragmentLimits, cordon_m: float | None) -> DataTable:
    of_runs = Text("limit for {} of runs", percent(limits.quantile))
    sure = limits.achieved_confidence
    rows: list[tuple[str, float | None, float | None]] = [
        (Text("50 % of their mass, {}", of_runs), limits.half_m, sure),
        (Text("99 % of their mass, {}", of_runs), limits.most_m, sure),
        (Text("99.9 % of their mass, {}", of_runs), limits.nearly_all_m, sure),
        (Text("farthest fragment, {}", of_runs), limits.largest_m, sure),
        (Text("Lundborg, without a cover"), limits.lundborg_m, None),
        (Text("McKenzie, without a cover"), limits.mckenzie_m, None),
        (Text("cordon around the bridge's plan"), cordon_m, None),
    ]
    known = [row for row in rows if row[1] is not None and np.isfinite(row[1])]
    return DataTable("fragment_limits", Text("Distances from the blast zone: {}", DOUBT), _COLUMNS, known)


def _picture(runs: StudyRuns) -> Iterator[Block]:
    scenario, areas = runs.ensemble.scenario, areas_of_fragments_in(runs)
    if not areas or runs.bridge.is_empty():
        return
    cordon = cordon_area(scenario, runs.bridge)
    bounds = np.array([area.bounds() for area in (*areas.values(), *cordon.values())])
    yield Picture(
        partial(
            study_plan,
            bridge=runs.bridge,
            likely=areas,
            limits=cordon,
            zones=scenario.zones,
            neighbours=scenario.neighbours,
        ),
        Text("Circles around the blast zones that parts of the mass in fragments stay within: {}.", DOUBT),
        map_height_mm((*bounds[:, :2].min(axis=0), *bounds[:, 2:].max(axis=0))),
    )
