"""First page of the report of a study: its plan, the verdict, the limit and what it rests on, and what to doubt."""

from __future__ import annotations

from collections.abc import Iterator

from ...engineering.units import rounded_up
from ...texts import Text, distance_to_keep
from ..document.blocks import Block, Paragraph, facts
from ..wording.clearance import Flyrock, clearance_rows, flyrock_of_runs
from ..wording.numbers import listed, percent, percent_down
from ..wording.sequence import means_text
from ..wording.study import input_names
from ..wording.verdict import study_verdict
from .document import doubts_of, unfinished_sentence
from .plan import plan_picture
from .study_runs import StudyRuns


def study_summary(runs: StudyRuns, flyrock: Flyrock | str | None = None) -> tuple[Block, ...]:
    """Return what stands on the first page, what makes runs doubtful first; `flyrock` is that of the scenario."""
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
    yield Text("Limit"), _limit_text(runs)
    if conclusions and conclusions.fragments:
        flyrock = flyrock_of_runs(conclusions.fragments)
    limit = (next(iter(runs.limits.values()))[0], "{} that debris stays within by this study") if runs.limits else None
    yield from clearance_rows(scenario, flyrock, limit)
    yield Text("Rests on"), _basis_text(runs)


def _limit_text(runs: StudyRuns) -> str:
    if not runs.limits:
        return Text("none yet")
    limits = [distance_to_keep(rounded_up(far_m, "0.1")) for far_m, _ in runs.limits.values()]
    around = Text("{} around the bridge's plan", limits[0])
    if len(limits) > 1:
        return Text("{}, {} with the buffer of {}", around, limits[1], distance_to_keep(runs.buffer_m or 0.0, "g"))
    return Text("{}; a buffer has to be added", around)


def _basis_text(runs: StudyRuns) -> str:
    settings, names = runs.ensemble.settings, input_names(runs.ensemble)
    was = "{} of {} independent runs, in which {} was sampled; asked are {} of runs with {} confidence"
    were = "{} of {} independent runs, in which {} were sampled; asked are {} of runs with {} confidence"
    asked = percent(settings.quantile), percent(settings.confidence)
    return Text(was if len(names) == 1 else were, len(runs.table), settings.runs, listed(names), *asked)
