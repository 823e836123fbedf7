"""The report of a study."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from ...charts.study_charts import limit_over_runs, reach_distribution
from ...engineering.statistics.order_limits import limits_by_runs
from ...engineering.units import rounded_up
from ...model.scenario import Scenario
from ...model.structure.charge_plan import ChargePlan
from ...model.study.conclusions import SimultaneousLimits
from ...model.study.files import PLAN_DXF, PLAN_GEOJSON
from ...model.study.shown_names import shown
from ...system.progress import Progress
from ...version import VERSION
from ..document.blocks import Block, Column, DataTable, Document, Paragraph, Picture, Report, Section
from ..sections.charge_plan import charge_plan_section, flyrock_of, known_plan
from ..sections.cover import TRUST_TITLE
from ..sections.plan_contents import with_plan_contents
from ..sections.planned_sequence import sequence_section
from ..single_pages import single_pages
from ..site_plan import write_areas
from ..wording.numbers import ordinal, percent
from ..wording.study import study_sentences
from .document import ensemble_document, statement_section, unfinished_sentence
from .fragments import fragments_section
from .influence import correlation_table
from .neighbours import neighbours_section
from .plan import layers, plan_section
from .reported_ensemble import names_of_runs
from .runs import extremes_section, runs_section
from .study_runs import StudyRuns
from .summary import study_summary

_STATISTICS = (
    "All statements hold for independent runs, whose number and whose rank were fixed beforehand: limits by rank after "
    "Wilks (1941), of several outputs at once after Guba, Makai and Pál (2003), probabilities after Clopper and "
    "Pearson (1934). They ask nothing of the form of a distribution."
)


def study_report(runs: StudyRuns, target: Path, progress: Progress) -> Report:
    """Return the report of a study, and write its site plans."""
    progress.stage("evaluating the runs")
    plans = write_areas(layers(runs), runs.ensemble.scenario.site, target / PLAN_DXF, target / PLAN_GEOJSON)
    document = study_document(runs, VERSION, [path.name for path in plans])
    pages = single_pages(document, runs.ensemble.scenario)
    settings = runs.ensemble.scenario.report
    return Report(document, (correlation_table(runs),), tuple(plans), pages, names_of_runs(runs), settings)


def study_document(runs: StudyRuns, version: str, files: Sequence[str] = ()) -> Document:
    """Return the page of a study, of which one run at least is there.

    Parameters
    ----------
    runs, version
        The study and its runs, and the version of this program.
    files
        Names of those that have the plan for a site plan.
    """
    sentences = [unfinished_sentence(runs, runs.ensemble.settings.runs)]
    if runs.conclusions:
        sentences = list(study_sentences(runs.ensemble, runs.conclusions))
    scenario = runs.ensemble.scenario
    plan = known_plan(scenario)
    pictures = (
        plan_section(runs, files),
        distance_section(runs),
        fragments_section(runs),
        neighbours_section(runs),
        sequence_section(scenario),
        _charges_section(scenario, plan),
    )
    document = ensemble_document(
        runs,
        version,
        statement_section(runs, sentences),
        filter(None, pictures),
        (extremes_section(runs), runs_section(runs)),
        _STATISTICS,
        _asked(runs),
        study_summary(runs, flyrock_of(plan)),
    )
    return with_plan_contents(document, scenario, TRUST_TITLE)


def _asked(runs: StudyRuns) -> Iterator[tuple[str, str]]:
    settings = runs.ensemble.settings
    yield "Runs", f"{len(runs.table)} of {settings.runs}, {int(runs.table.done.sum())} of them finished"
    yield (
        "Asked",
        (
            f"the limit that {percent(settings.quantile)} of runs stay within, with {percent(settings.confidence)} "
            f"confidence, from the {ordinal(settings.rank)} debris distance"
        ),
    )
    if runs.conclusions is None:
        return
    limit = runs.conclusions.reach
    if limit.is_known:
        yield "Limit of the debris distance", f"{rounded_up(limit.limit_m, '0.01')} m"
    if limit.has_enough_runs:
        yield (
            "So many runs allow",
            (
                f"{percent(settings.quantile)} of runs with {100.0 * limit.achieved_confidence:.2f} % confidence, or "
                f"{100.0 * limit.coverage:.2f} % of runs with {percent(settings.confidence)} confidence"
            ),
        )
    else:
        yield "Runs that a limit needs", str(limit.runs_needed)


def _charges_section(scenario: Scenario, plan: ChargePlan | str | None) -> Section | None:
    """Return the charge plan of the scenario itself; None without charges in drill holes."""
    section = charge_plan_section(scenario, plan)
    words = Paragraph("As the scenario has it: runs differ from it in what varied.")
    return section and replace(section, blocks=(words, *section.blocks))


def distance_section(runs: StudyRuns) -> Section:
    """Return the debris distances of the runs, and how their limit settled."""
    settings, distances_m = runs.ensemble.settings, runs.distances_m
    limit_m = runs.limits["limit"][0] if runs.limits else None
    limit = None if limit_m is None else (limit_m, f"{rounded_up(limit_m, '0.01')} m")
    words = (
        "The debris distance of a run is the smallest distance from the bridge's first outline in plan that all of its "
        "debris, and every ball, stayed within at all recorded times, in the air included. A run that did not finish "
        "counts as one of unlimited debris distance."
    )
    counts, limits_m = limits_by_runs(distances_m, settings.quantile, settings.confidence, settings.rank)
    blocks: list[Block] = [Paragraph(words)]
    if runs.table.done.any():
        blocks.append(
            Picture(
                partial(reach_distribution, reaches_m=distances_m, limit=limit, quantile=settings.quantile),
                f"Debris distances of the runs, and which share of {len(distances_m)} runs stays within it.",
                95.0,
            )
        )
        blocks.append(
            Picture(
                partial(limit_over_runs, reaches_m=distances_m, runs=counts, limits_m=limits_m),
                "How the limit settled: at each number of runs the highest rank that they allow is taken, up to the "
                f"{ordinal(settings.rank)} distance, which was fixed beforehand. Only the last limit is a statement.",
                80.0,
            )
        )
    if runs.conclusions and runs.conclusions.at_once:
        blocks += _limits_at_once(runs.conclusions.at_once)
    return Section("How far debris gets", tuple(blocks))


def _limits_at_once(at_once: SimultaneousLimits) -> list[Block]:
    if not all(map(math.isfinite, at_once.limits.values())):
        return [Paragraph("Several limits that hold at once are not known, because of runs that did not finish.")]
    words = (
        f"With {percent(at_once.confidence)} confidence at least {percent(at_once.quantile)} of such runs stay below "
        "all of these limits at once (Guba, Makai and Pál 2003). Each is at least as large as a limit of its own."
    )
    columns = (
        Column("output", "output"),
        Column("limit", "limit", ".4g", of_row=True),
        Column("rank from the largest", "rank", "d"),
    )
    rows = [(shown(name), limit, at_once.ranks[name]) for name, limit in at_once.limits.items()]
    return [Paragraph(words), DataTable("limits_at_once", "Limits that hold together", columns, rows)]
