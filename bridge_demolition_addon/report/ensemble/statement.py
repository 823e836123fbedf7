"""First section of a study's report: the statement, and how sure it is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from ...charts.study_charts import limit_over_runs, reach_distribution
from ...engineering.statistics.order_limits import limits_by_runs
from ...model.study.conclusions import SimultaneousLimits
from ...model.study.runs_table import DONE
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section, facts
from ..wording.numbers import ordinal, percent, rounded_up
from ..wording.study import input_names, study_sentences
from .study_runs import StudyRuns, shown


def statement_section(runs: StudyRuns, version: str) -> Section:
    """Return the statement of a study, or how far it is."""
    blocks: list[Block] = []
    if runs.said is None:
        blocks.append(Paragraph(_not_yet(runs), is_notice=True))
    else:
        first, *others = study_sentences(runs.study, runs.said)
        blocks += [Paragraph(first, is_notice=True), *map(Paragraph, others)]
    blocks += [Paragraph(text, is_notice=True) for text in _doubts(runs)]
    blocks.append(facts("The study", list(_study_facts(runs, version)), "study"))
    return Section("What this study says", tuple(blocks))


def reach_section(runs: StudyRuns) -> Section:
    """Return how far the runs reach, and how their limit settled."""
    settings, reaches_m = runs.study.settings, runs.reaches_m
    limit_m = runs.limits["limit"][0] if runs.limits else None
    limit = None if limit_m is None else (limit_m, f"{rounded_up(limit_m, '0.01')} m")
    words = (
        "The reach of a run is the smallest distance from the bridge's first outline in plan that all of its debris, "
        "and every ball, stayed within at all recorded times, in the air included. A run that did not finish counts as "
        "one of unlimited reach."
    )
    counts, limits_m = limits_by_runs(reaches_m, settings.quantile, settings.confidence, settings.rank)
    blocks: list[Block] = [Paragraph(words)]
    if runs.table.done.any():
        blocks.append(
            Picture(
                partial(reach_distribution, reaches_m=reaches_m, limit=limit, quantile=settings.quantile),
                f"How many runs reach how far, and which share of all {len(reaches_m)} runs stays within a distance.",
                95.0,
            )
        )
        blocks.append(
            Picture(
                partial(limit_over_runs, reaches_m=reaches_m, runs=counts, limits_m=limits_m),
                "How the limit settled: at each number of runs the highest rank that they allow is taken, up to the "
                f"{ordinal(settings.rank)} reach, which was fixed beforehand. Only the last limit is a statement.",
                80.0,
            )
        )
    if runs.said and runs.said.at_once:
        blocks += _limits_at_once(runs.said.at_once)
    return Section("How far debris gets", tuple(blocks))


def _not_yet(runs: StudyRuns) -> str:
    return (
        f"{len(runs.table)} of {runs.study.settings.runs} runs are there: the study says nothing before all of them "
        "are, as their number was fixed beforehand. Go on with the command that started it."
    )


def _doubts(runs: StudyRuns) -> Iterator[str]:
    unfinished = len(runs.table) - int(runs.table.done.sum())
    if unfinished:
        found = [row for row in runs.table.rows if row.status != DONE]
        named = ", ".join(f"{row.number} ({row.status.replace('_', ' ')})" for row in found[:_MOST_NAMED])
        others = " and others" if unfinished > _MOST_NAMED else ""
        yield f"{unfinished} of {len(runs.table)} runs did not finish: {named}{others}."
    moving = _still_moving(runs)
    if moving:
        yield (
            f"In {moving} of {len(runs.table)} runs not everything had rested for "
            f"{runs.study.scenario.time.rest_hold_s:g} s when their time was over: debris may have gone on. Give the "
            "scenario a longer time.duration_s."
        )


_MOST_NAMED = 8
_REST = "came_to_rest_s"


def _still_moving(runs: StudyRuns) -> int:
    if _REST not in runs.table.outputs:
        return 0
    return sum(row.status == DONE and row.outputs.get(_REST) is None for row in runs.table.rows)


def _study_facts(runs: StudyRuns, version: str) -> Iterator[tuple[str, str]]:
    settings = runs.study.settings
    yield "Scenario", runs.study.scenario.title
    yield "Folder", runs.name
    yield "Runs", f"{len(runs.table)} of {settings.runs}, {int(runs.table.done.sum())} of them finished"
    yield (
        "Asked",
        (
            f"the limit that {percent(settings.quantile)} of runs stay within, with {percent(settings.confidence)} "
            f"confidence, from the {ordinal(settings.rank)} reach"
        ),
    )
    if runs.said:
        reach = runs.said.reach
        if reach.is_known:
            yield "Limit of the reach", f"{rounded_up(reach.limit_m, '0.01')} m"
        yield (
            "So many runs allow",
            (
                f"{percent(settings.quantile)} of runs with {100.0 * reach.achieved_confidence:.2f} % confidence, or "
                f"{100.0 * reach.coverage:.2f} % of runs with {percent(settings.confidence)} confidence"
            ),
        )
    yield "Varied", ", ".join(input_names(runs.study))
    yield "Seed of the study", str(settings.seed)
    yield "Run with", ", ".join(f"{name.replace('_', ' ')} {number}" for name, number in runs.versions.items())
    yield "Bridge Demolition Add-on", version


def _limits_at_once(at_once: SimultaneousLimits) -> list[Block]:
    if not all(map(math.isfinite, at_once.limits.values())):
        return [Paragraph("Several limits that hold at once are not known, because of runs that did not finish.")]
    words = (
        f"With {percent(at_once.confidence)} confidence at least {percent(at_once.quantile)} of such runs stay below "
        "all of these limits at once (Guba, Makai and Pál 2003). Each is at least as large as a limit of its own."
    )
    columns = (
        Column("output", "output"),
        Column("limit", "limit", ".4g"),
        Column("rank from the largest", "rank", "d"),
    )
    rows = [(shown(name), limit, at_once.ranks[name]) for name, limit in at_once.limits.items()]
    return [Paragraph(words), DataTable("limits_at_once", "Limits that hold together", columns, rows)]
