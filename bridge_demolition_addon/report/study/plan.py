"""The plan of a study: where debris is how likely, and the limit around the bridge."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np
from manifold3d import CrossSection

from ...charts.plan_maps import map_height_mm
from ...charts.study_plan import study_plan
from ...core.debris.exclusion import widened
from ...core.study.probability_map import LEVELS
from ...core.study.statements import percent, rounded_up, shape_sentence, verified_sentence
from ...core.study.verification import zone_area
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from .study_runs import StudyRuns


def plan_section(runs: StudyRuns, files: Sequence[str]) -> Section:
    """Return the plan of a study; `files` are names of those that have it for a site plan."""
    settings, scenario = runs.study.settings, runs.study.scenario
    likely, limits = likely_areas(runs), limit_areas(runs)
    shown = [runs.bridge, *likely.values(), *limits.values()]
    bounds = np.array([area.bounds() for area in shown if not area.is_empty()])
    picture = Picture(
        partial(
            study_plan,
            bridge=runs.bridge,
            likely={f"probability above {percent(level)}": area for level, area in likely.items()},
            limits={_distance_in_words(runs, name): area for name, area in limits.items()},
            zones=scenario.zones,
            neighbours=scenario.neighbours,
        ),
        f"Where debris was at any time of a run. Shaded: where its probability may be above the one given, with "
        f"{percent(settings.confidence)} confidence for each place by itself.",
        map_height_mm((*bounds[:, :2].min(axis=0), *bounds[:, 2:].max(axis=0))),
    )
    blocks: list[Block] = [picture, *(Paragraph(text) for text in _words(runs))]
    rows = [(name, area.area(), *area.bounds()) for name, area in layers(runs).items() if not area.is_empty()]
    blocks.append(DataTable("study_areas", "Areas on the plan", _AREA_COLUMNS, rows))
    if files:
        blocks.append(Paragraph(f"For the site plan: {', '.join(files)}."))
    if scenario.charges:
        warning = (
            "Pressure of the charges is not on this plan: the report of a single run says how far people have to be."
        )
        blocks.insert(1, Paragraph(warning, is_notice=True))
    return Section("Plan", tuple(blocks))


_AREA_COLUMNS = (
    Column("area", "area"),
    Column("m²", "area_m2", ".1f"),
    Column("from x (m)", "low_x_m", ".2f"),
    Column("y (m)", "low_y_m", ".2f"),
    Column("to x (m)", "high_x_m", ".2f"),
    Column("y (m)", "high_y_m", ".2f"),
)


def layers(runs: StudyRuns) -> dict[str, CrossSection]:
    """Return all areas of a study for a site plan by their names, the largest first."""
    zones = {f"zone {zone.name}": zone_area(zone) for zone in runs.study.scenario.zones}
    likely = {f"probability above {percent(level)}": area for level, area in likely_areas(runs).items()}
    return {**dict(reversed(limit_areas(runs).items())), **likely, "bridge": runs.bridge, **zones}


def likely_areas(runs: StudyRuns) -> dict[float, CrossSection]:
    """Return where debris may be likelier than each of the levels that so many runs resolve, the largest area first."""
    found = runs.map
    if found is None:
        return {}
    resolved = sorted(level for level in LEVELS if found.resolves(level))
    return {level: found.area_above(level) for level in resolved}


def limit_areas(runs: StudyRuns) -> dict[str, CrossSection]:
    """Return the bridge's plan with the limit around it, and with the buffer around that."""
    if runs.limit is None:
        return {}
    found = {"limit": runs.limit}
    if runs.buffer_m:
        found["limit and buffer"] = widened(runs.limit, runs.buffer_m)
    return found


def _distance_in_words(runs: StudyRuns, area: str) -> str:
    """Return the name of one of the areas around the limit, and how far it is from the bridge's plan."""
    added_m = 0.0 if area == "limit" else runs.buffer_m
    return f"{area}, {rounded_up(runs.said.reach.limit_m + added_m, '0.01')} m"


def _words(runs: StudyRuns) -> Iterator[str]:
    settings, found = runs.study.settings, runs.map
    if found is None:
        yield "No run moved anything: there is no debris on the plan."
        return
    yield (
        f"The plan is cut into squares of {found.cells.side_m:g} m. For each of them the probability that a run brings "
        "debris there, even over a corner of it and only for a moment, has an upper limit after Clopper and Pearson. "
        "These limits hold for each place by itself. For all places at once there is the limit around the bridge."
    )
    for level in LEVELS:
        if not found.resolves(level):
            needed = found.runs_for(level)
            why = f"it takes {needed} runs" if found.runs < needed else f"{found.unfinished} runs did not finish"
            yield f"Where the probability is below {percent(level)} cannot be said: {why}."
    if corners := runs.hull_corners:
        yield shape_sentence(corners, settings.quantile, settings.confidence)
    if runs.said:
        yield from (verified_sentence(left, settings.quantile) for left in runs.zones_left)
