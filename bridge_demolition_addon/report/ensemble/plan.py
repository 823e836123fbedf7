"""The plan of a study: where debris is how likely, the limit around the bridge, small fragments, and the neighbours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np
from manifold3d import CrossSection

from ...charts.ensemble_charts import study_plan
from ...charts.plan_maps import map_height_mm
from ...engineering.statistics.probability_map import LEVELS
from ...engineering.units import rounded_up
from ...model.schema import given
from ...model.structure.zone_fragments import DOUBT
from ...model.study.conclusions import FragmentLimits, zone_area
from ...model.study.shown_names import shown
from ...texts import Text, Unit, distance_to_keep, joined
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from ..site_plan import areas_of_fragments, cordon_area
from ..wording.numbers import percent
from ..wording.study import fragments_sentence, shape_sentence, verified_sentence
from .reported_ensemble import StudyRuns

_HIGHEST_MM = 112.0
"""Of the plan, so that verdict and limit stand on the same page."""


def plan_section(runs: StudyRuns, files: Sequence[str]) -> Section:
    """Return the plan of a study; `files` are names of those that have it for a site plan."""
    if runs.bridge.is_empty():
        return Section("Plan", (Paragraph("No run finished: there is nothing to draw.", is_notice=True),))
    scenario = runs.ensemble.scenario
    blocks: list[Block] = [Paragraph("The plan is drawn on the first page.")]
    if scenario.charges:
        warning = Text(
            "Pressure of the charges is not on this plan: the report of one run says how far people have to be."
        )
        blocks.append(Paragraph(warning, is_notice=True))
    blocks += [Paragraph(text) for text in _words(runs)]
    rows = [(name, area.area(), *area.bounds()) for name, area in layers(runs).items() if not area.is_empty()]
    blocks.append(DataTable("study_areas", "Areas on the plan", _AREA_COLUMNS, rows))
    blocks += [Paragraph(Text("For the site plan: {}.", joined("{}, {}", files)))] if files else []
    return Section("Plan", tuple(blocks))


def layers(runs: StudyRuns) -> dict[str, CrossSection]:
    """Return all areas of a study for a site plan by their names, the largest first."""
    limits = {name: area for name, (_, area) in reversed(runs.limits.items())}
    zones: dict[str, CrossSection] = {
        Text("zone {}", zone.name): zone_area(zone) for zone in runs.ensemble.scenario.zones
    }
    cordon = cordon_area(runs.ensemble.scenario, runs.bridge)
    return {
        **areas_of_fragments_in(runs),
        **cordon,
        **limits,
        **_likely_by_words(runs),
        Text("bridge"): runs.bridge,
        **zones,
    }


def areas_of_fragments_in(runs: StudyRuns) -> dict[str, CrossSection]:
    """Return areas that fragments stay within: by the limits of the study, or where there are none of its scenario."""
    said = runs.conclusions.fragments if runs.conclusions else None
    return areas_of_fragments(runs.ensemble.scenario, said.ranges if said and said.are_known else None)


def plan_picture(runs: StudyRuns) -> Picture:
    """Return the plan of a study with a finished run."""
    settings, scenario = runs.ensemble.settings, runs.ensemble.scenario
    likely = _likely_by_words(runs)
    limits: dict[str, CrossSection] = {
        Text("{}, {}", name, distance_to_keep(rounded_up(far_m, "0.01"))): area
        for name, (far_m, area) in runs.limits.items()
    }
    areas = [area for area in (runs.bridge, *likely.values(), *limits.values()) if not area.is_empty()]
    bounds = np.array([area.bounds() for area in areas])
    return Picture(
        partial(
            study_plan,
            bridge=runs.bridge,
            likely=likely,
            limits=limits,
            zones=scenario.zones,
            neighbours=scenario.neighbours,
        ),
        Text(
            "Where debris was at any time of a run. Shaded: where its probability may be above the one given, "
            "with {} confidence for each position by itself.",
            percent(settings.confidence),
        ),
        min(map_height_mm((*bounds[:, :2].min(axis=0), *bounds[:, 2:].max(axis=0))), _HIGHEST_MM),
    )


_AREA_COLUMNS = (
    Column("area", "area"),
    Column(Unit("m²"), "area_m2", ".1f", unit=""),
    Column("from x", "low_x_m", ".2f", is_reach=True),
    Column("y", "low_y_m", ".2f", is_reach=True),
    Column("to x", "high_x_m", ".2f", is_reach=True),
    Column("y", "high_y_m", ".2f", is_reach=True),
)


def _likely_by_words(runs: StudyRuns) -> dict[str, CrossSection]:
    return {Text("probability above {}", percent(level)): area for level, area in runs.likely.items()}


def _words(runs: StudyRuns) -> Iterator[str]:
    settings, likely = runs.ensemble.settings, given(runs.map)
    yield (
        Text(
            "The plan is cut into squares of {}. For each the probability that a run brings debris there, even "
            "over a corner of it and only for a moment, has an upper limit after Clopper and Pearson. These "
            "limits hold for each position by itself. For all positions at once there is the limit around the "
            "bridge.",
            distance_to_keep(likely.cells.side_m, "g"),
        )
    )
    for level in LEVELS:
        if not likely.resolves(level):
            needed = likely.runs_for(level)
            why = (
                Text("it takes {} runs", needed)
                if likely.runs < needed
                else Text("{} runs did not finish", likely.unfinished)
            )
            yield Text("Where the probability is below {} cannot be stated: {}.", percent(level), why)
    if corners := runs.hull_corners:
        yield shape_sentence(corners, settings.quantile, settings.confidence)
    if runs.conclusions:
        yield from (verified_sentence(left, settings.quantile) for left in runs.zones_left)


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


_OF_NEIGHBOURS = "neighbours."
_NEIGHBOUR_COLUMNS = (
    Column("neighbour and quantity", "quantity"),
    Column("median", "median", ".3g", of_row=True),
    Column("largest", "largest", ".3g", of_row=True),
    Column("of runs", "runs", "d"),
)


def neighbours_section(runs: StudyRuns) -> Section | None:
    """Return what runs do at the neighbours; None where nothing is known of them."""
    rows = []
    for name in runs.table.outputs:
        values = runs.table.output(name)
        if not name.startswith(_OF_NEIGHBOURS) or values.dtype != float:
            continue
        known = values[np.isfinite(values)]
        if len(known):
            label = shown(name.removeprefix(_OF_NEIGHBOURS))
            rows.append((label, float(np.median(known)), float(known.max()), len(known)))
    if not rows:
        return None
    words = Text(
        "The largest of these runs is no limit: other runs may have more. Criteria of the study say how often."
    )
    table = DataTable("neighbours_of_runs", "At the neighbours, of the runs that finished", _NEIGHBOUR_COLUMNS, rows)
    return Section("Neighbours", (Paragraph(words), table))
