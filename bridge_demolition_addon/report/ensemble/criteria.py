"""Criteria: what makes a run a success, and of a study how often runs are one."""

from __future__ import annotations

from ...model.study.conclusions import Proportion
from ...model.study.criteria import Criterion
from ...texts import Quantity, Text, joined
from ..document.blocks import Column, DataTable, Paragraph, Section
from ..wording.study import success_sentence
from .reported_ensemble import ReportedEnsemble
from .study_runs import StudyRuns

_COLUMNS = (
    Column("criterion", "criterion"),
    Column("what is asked", "kind"),
    Column("runs that met it", "met", "d"),
    Column("of", "runs", "d"),
    Column("share", "share_percent", ".2f"),
    Column("at least", "at_least_percent", ".2f"),
    Column("at most", "at_most_percent", ".2f"),
)


def criteria_section(runs: ReportedEnsemble) -> Section:
    """Return what is asked of a run, and of a study how often runs meet it."""
    criteria, kind = runs.ensemble.criteria, runs.ensemble.kind
    if not criteria:
        words = Text(
            "The {} names no [[criteria]], such as a span that has to come down or a zone that nothing may enter.",
            Text(kind),
        )
        return Section("Criteria", (Paragraph(words),))
    conclusions = runs.conclusions if isinstance(runs, StudyRuns) else None
    if not isinstance(runs, StudyRuns) or conclusions is None or conclusions.success is None:
        rows = [(criterion.name, _asked(criterion)) for criterion in criteria]
        words = Text("A run is a success where it meets all of these. A run that did not finish meets nothing.")
        return Section("Criteria", (Paragraph(words), DataTable("criteria", "Criteria", _COLUMNS[:2], rows)))
    confidence = runs.ensemble.settings.confidence
    words = Text(
        "How often runs meet what is asked. A run that did not finish meets nothing. The limits of each share are "
        "one-sided, after Clopper and Pearson: each by itself holds with {} % confidence.",
        f"{100.0 * confidence:.10g}",
    )
    counted = [
        (criterion.name, _asked(criterion), *_numbers(proportion))
        for criterion, proportion in zip(criteria, conclusions.criteria, strict=True)
    ]
    counted.append((Text("all of them"), "", *_numbers(conclusions.success)))
    table = DataTable("criteria", "Criteria", _COLUMNS, counted)
    return Section("Criteria", (Paragraph(words), table, Paragraph(success_sentence(conclusions.success))))


def _numbers(proportion: Proportion) -> tuple[int, int, float, float, float]:
    count, runs = proportion.count, proportion.runs
    return count, runs, 100.0 * (count / runs), 100.0 * proportion.at_least, 100.0 * proportion.at_most


def _asked(criterion: Criterion) -> str:
    of = {"span": criterion.span, "zone": criterion.zone, "neighbour": criterion.neighbour}
    limits = {"kPa": criterion.limit_kpa, "mm/s": criterion.limit_mm_s}
    words: list[str] = [Text(f"{name} {{}}", value) for name, value in of.items() if value is not None]
    words += [Quantity(value, unit, "g") for unit, value in limits.items() if value is not None]
    words += [Text("{} % of the height", f"{100.0 * criterion.share:g}")] if criterion.share is not None else []
    kind = Text(criterion.kind)
    return Text("{}: {}", kind, joined("{}, {}", words)) if words else kind
