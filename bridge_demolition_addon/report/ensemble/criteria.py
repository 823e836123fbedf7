"""Criteria of a study: how likely a run meets them."""

from __future__ import annotations

from ...model.study.conclusions import Proportion
from ...model.study.criteria import Criterion
from ..document.blocks import Block, Column, DataTable, Paragraph, Section
from ..wording.study import success_sentence
from .study_runs import StudyRuns

_COLUMNS = (
    Column("criterion", "criterion"),
    Column("what is asked", "kind"),
    Column("runs that met it", "met", "d"),
    Column("of", "runs", "d"),
    Column("share (%)", "share_percent", ".2f"),
    Column("at least (%)", "at_least_percent", ".2f"),
    Column("at most (%)", "at_most_percent", ".2f"),
)


def criteria_section(runs: StudyRuns) -> Section:
    """Return how likely a run meets the criteria of a study."""
    criteria = runs.study.criteria
    if not criteria:
        words = (
            "The study names no [[criteria]], such as a span that has to come down or a zone that nothing may enter."
        )
        return Section("Criteria", (Paragraph(words),))
    if runs.said is None:
        return Section("Criteria", (Paragraph("What is said of them follows when all runs are there."),))
    confidence = runs.study.settings.confidence
    words = (
        "How likely a run meets what is asked. A run that did not finish meets nothing. The limits of each share are "
        f"one-sided, after Clopper and Pearson: each by itself holds with {100.0 * confidence:.10g} % confidence."
    )
    rows = [
        (each.name, _asked(each), *_numbers(chance)) for each, chance in zip(criteria, runs.said.criteria, strict=True)
    ]
    rows.append(("all of them", "", *_numbers(runs.said.success)))
    blocks: list[Block] = [Paragraph(words), DataTable("criteria", "Criteria", _COLUMNS, rows)]
    blocks.append(Paragraph(success_sentence(runs.said.success)))
    return Section("Criteria", tuple(blocks))


def _numbers(proportion: Proportion) -> tuple[int, int, float, float, float]:
    shares = proportion.count / proportion.runs, proportion.at_least, proportion.at_most
    return proportion.count, proportion.runs, *(100.0 * share for share in shares)


def _asked(criterion: Criterion) -> str:
    of = {"span": criterion.span, "zone": criterion.zone, "neighbour": criterion.neighbour}
    limits = {"kPa": criterion.limit_kpa, "mm/s": criterion.limit_mm_s}
    words = [f"{name} {value}" for name, value in of.items() if value is not None]
    words += [f"{value:g} {unit}" for unit, value in limits.items() if value is not None]
    words += [f"{100.0 * criterion.share:g} % of the height"] if criterion.share is not None else []
    return f"{criterion.kind}: {', '.join(words)}" if words else criterion.kind
