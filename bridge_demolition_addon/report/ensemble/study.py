"""The report of a study, with its first page: plan, verdict, the limit and its basis, and what to doubt."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from ...charts.ensemble_charts import limit_over_runs, reach_distribution
from ...engineering.statistics.order_limits import limits_by_runs
from ...engineering.units import rounded_up
from ...model.scenario import Scenario
from ...model.structure.charge_plan import ChargePlan
from ...model.study.conclusions import SimultaneousLimits
from ...model.study.file import PLAN_DXF, PLAN_GEOJSON
from ...model.study.shown_names import shown
from ...system.progress import Progress
from ...texts import Text, distance_to_keep
from ...version import VERSION
from ..document.blocks import Block, Column, DataTable, Document, Paragraph, Picture, Report, Section, facts
from ..sections.charge_plan import charge_plan_section, flyrock_of, known_plan
from ..sections.cover import TRUST_TITLE
from ..sections.plan_contents import with_plan_contents
from ..sections.planned_sequence import means_text, sequence_section
from ..single_pages import single_pages
from ..site_plan import write_areas
from ..wording.numbers import listed, ordinal, percent, percent_down
from ..wording.study import input_names, standing_text, study_sentences
from ..wording.verdict import Flyrock, clearance_rows, flyrock_of_runs, study_verdict, with_what_is_added
from .document import doubts_of, ensemble_document, statement_section, unfinished_sentence
from .influence import correlation_table
from .plan import fragments_section, layers, neighbours_section, plan_picture, plan_section
from .reported_ensemble import StudyRuns
from .runs import extremes_section, runs_section


def study_summary(runs: StudyRuns, flyrock: Flyrock | str | None = None) -> tuple[Block, ...]:
    """Return what stands on the first page, what makes runs doubtful first; `flyrock` is the scenario's."""
    picture = () if runs.bridge.is_empty() else (plan_picture(runs),)
    verdict = unfinished_sentence(runs, runs.ensemble.settings.runs)
    if runs.conclusions:
        verdict = study_verdict(runs.conclusions.reach, runs.buffer_m, is_final=not runs.conclusions.still_moving)
    doubts = (Paragraph(text, is_notice=True) for text in doubts_of(runs))
    plan = facts("The plan", list(_plan(runs, flyrock)), "plan")
    return (*doubts, *picture, Paragraph(verdict, is_notice=True), plan)


def _plan(runs: StudyRuns, flyrock: Flyrock | str | None) -> Iterator[tuple[str, str]]:
    scenario, conclusions = runs.ensemble.scenario, runs.conclusions
    yield Text("Done to the bridge"), means_text(scenario)
    for criterion in conclusions.criteria if conclusions else ():
        at_least = Text("at least {} of such runs do", percent_down(criterion.at_least))
        yield Text("Outcome"), Text("{} of {} runs {}; {}", criterion.count, criterion.runs, criterion.what, at_least)
    if conclusions and conclusions.standing:
        yield Text("May stand"), standing_text(conclusions.standing)
    yield Text("Limit"), _limit_text(runs)
    if conclusions and conclusions.fragments:
        flyrock = flyrock_of_runs(conclusions.fragments)
    debris = None
    if runs.to_keep is not None:
        debris = float(rounded_up(runs.to_keep[0], "1")), "{} to keep from debris by this study"
    yield from clearance_rows(scenario, flyrock, debris)
    yield Text("Rests on"), _basis_text(runs)


def _limit_text(runs: StudyRuns) -> str:
    if runs.conclusions is None or not runs.limits:
        return Text("none yet")
    reach = runs.conclusions.reach
    around = Text("{} around the bridge's plan", distance_to_keep(rounded_up(reach.limit_m, "0.1")))
    around = with_what_is_added(around, reach, runs.buffer_m)
    return around if runs.buffer_m else Text("{}; a buffer has to be added", around)


def _basis_text(runs: StudyRuns) -> str:
    settings, names = runs.ensemble.settings, input_names(runs.ensemble)
    was = "{} of {} independent runs, in which {} was sampled; asked are {} of runs with {} confidence"
    were = "{} of {} independent runs, in which {} were sampled; asked are {} of runs with {} confidence"
    asked = percent(settings.quantile), percent(settings.confidence)
    return Text(was if len(names) == 1 else were, len(runs.table), settings.runs, listed(names), *asked)


_STATISTICS = Text(
    "All statements hold for independent runs, whose number and whose rank were fixed beforehand: limits by rank "
    "after Wilks (1941), of several outputs at once after Guba, Makai and Pál (2003), probabilities after Clopper "
    "and Pearson (1934). They ask nothing of the form of a distribution."
)


def study_report(runs: StudyRuns, target: Path, progress: Progress) -> Report:
    """Return the report of a study, and write its site plans."""
    progress.stage("evaluating the runs")
    plans = write_areas(layers(runs), runs.ensemble.scenario.site, target / PLAN_DXF, target / PLAN_GEOJSON)
    document = study_document(runs, VERSION, [path.name for path in plans])
    pages = single_pages(document, runs.ensemble.scenario)
    settings = runs.ensemble.scenario.report
    return Report(document, (correlation_table(runs),), tuple(plans), pages, settings)


def study_document(runs: StudyRuns, version: str, files: Sequence[str] = ()) -> Document:
    """Return the page of a study with one run at least.

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
    yield (
        Text("Runs"),
        Text("{} of {}, {} of them finished", len(runs.table), settings.runs, int(runs.table.done.sum())),
    )
    yield (
        Text("Asked"),
        (
            Text(
                "the limit that {} of runs stay within, with {} confidence, from the {} debris distance",
                percent(settings.quantile),
                percent(settings.confidence),
                ordinal(settings.rank),
            )
        ),
    )
    if runs.conclusions is None:
        return
    limit = runs.conclusions.reach
    if limit.is_known:
        yield Text("Limit of the debris distance"), distance_to_keep(rounded_up(limit.limit_m, "0.01"))
        kept = distance_to_keep(rounded_up(limit.to_keep_m(runs.buffer_m), "0.01"))
        yield Text("Distance to keep, with factor for runout and buffer"), kept
    if limit.has_enough_runs:
        yield (
            Text("So many runs allow"),
            (
                Text(
                    "{} of runs with {} % confidence, or {} % of runs with {} confidence",
                    percent(settings.quantile),
                    f"{100.0 * limit.achieved_confidence:.2f}",
                    f"{100.0 * limit.coverage:.2f}",
                    percent(settings.confidence),
                )
            ),
        )
    else:
        yield Text("Runs that a limit needs"), str(limit.runs_needed)


def _charges_section(scenario: Scenario, plan: ChargePlan | str | None) -> Section | None:
    """Return the charge plan of the scenario itself; None without charges in drill holes."""
    section = charge_plan_section(scenario, plan)
    words = Paragraph("As the scenario has it: runs differ from it in what varied.")
    return section and replace(section, blocks=(words, *section.blocks))


def distance_section(runs: StudyRuns) -> Section:
    """Return the debris distances of the runs, and how their limit settled."""
    settings, distances_m = runs.ensemble.settings, runs.distances_m
    limit_m = runs.limits["limit"][0] if runs.limits else None
    limit = None if limit_m is None else (limit_m, distance_to_keep(rounded_up(limit_m, "0.01")))
    words = Text(
        "The debris distance of a run is the smallest distance from the bridge's first outline in plan that all "
        "of its debris, and every ball, stayed within at all recorded times, in the air included. A run that did "
        "not finish counts as one of unlimited debris distance."
    )
    counts, limits_m = limits_by_runs(distances_m, settings.quantile, settings.confidence, settings.rank)
    blocks: list[Block] = [Paragraph(words)]
    if runs.table.done.any():
        blocks.append(
            Picture(
                partial(reach_distribution, reaches_m=distances_m, limit=limit, quantile=settings.quantile),
                Text("Debris distances of the runs, and which share of {} runs stays within it.", len(distances_m)),
                95.0,
            )
        )
        blocks.append(
            Picture(
                partial(limit_over_runs, reaches_m=distances_m, runs=counts, limits_m=limits_m),
                Text(
                    "How the limit settled: at each number of runs the highest rank that they allow is taken, up "
                    "to the {} distance, which was fixed beforehand. Only the last limit is a statement.",
                    ordinal(settings.rank),
                ),
                80.0,
            )
        )
    if runs.conclusions and runs.conclusions.at_once:
        blocks += _limits_at_once(runs.conclusions.at_once)
    return Section("How far debris gets", tuple(blocks))


def _limits_at_once(at_once: SimultaneousLimits) -> list[Block]:
    if not all(map(math.isfinite, at_once.limits.values())):
        return [Paragraph("Several limits that hold at once are not known, because of runs that did not finish.")]
    words = Text(
        "With {} confidence at least {} of such runs stay below all of these limits at once (Guba, Makai and Pál "
        "2003). Each is at least as large as a limit of its own.",
        percent(at_once.confidence),
        percent(at_once.quantile),
    )
    columns = (
        Column("output", "output"),
        Column("limit", "limit", ".4g", of_row=True),
        Column("rank from the largest", "rank", "d"),
    )
    rows = [(shown(name), limit, at_once.ranks[name]) for name, limit in at_once.limits.items()]
    return [Paragraph(words), DataTable("limits_at_once", "Limits that hold together", columns, rows)]
