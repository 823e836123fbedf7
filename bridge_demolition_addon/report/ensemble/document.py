"""The one shape of the reports of studies, searches and optimisations, and the criteria that make a run a success."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...model.results.energy import LARGE_SHARE
from ...model.study.conclusions import Proportion
from ...model.study.criteria import Criterion
from ...model.study.file import Study
from ...model.study.runs_table import DONE
from ...texts import Quantity, Text, joined
from ..document.blocks import Block, Column, DataTable, Document, Listing, Paragraph, Section, facts
from ..sections.control import document_control
from ..sections.cover import trust_section
from ..wording.numbers import percent
from ..wording.study import input_names, success_sentence
from .influence import influence_section, varied_section
from .reported_ensemble import ReportedEnsemble, StudyRuns

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


_AS_SAMPLED = Text(
    "Statements say how the model scatters over the inputs that vary, from the distributions that were given. "
    "Wrong distributions, inputs that scatter and do not vary here, and errors of the model are in none of them."
)
_MOST_NAMED = 8
_REST, _MADE = "came_to_rest_s", "made_by_solver_share"


def ensemble_document(
    runs: ReportedEnsemble,
    version: str,
    statement: Section,
    pictures: Iterable[Section],
    tables: Iterable[Section | None],
    statistics: str,
    asked: Iterable[tuple[str, str]],
    summary: tuple[Block, ...] = (),
) -> Document:
    """Return a report: statement, pictures of the result, what varied, tables of runs or candidates, statistics.

    What was asked and which settings the runs had stand at its end.
    """
    ensemble = runs.ensemble
    sections = (
        statement,
        *pictures,
        criteria_section(runs),
        varied_section(runs),
        influence_section(runs),
        *tables,
        trust_section(ensemble.scenario, statistics, _AS_SAMPLED),
        _files_section(runs, version, asked),
    )
    article = "an" if ensemble.kind[0] in "aeiou" else "a"
    of_kind = f"Report of {article} {ensemble.kind} with {{}} simulated demolitions. Bridge Demolition Add-on {{}}"
    subtitle = Text(of_kind, len(runs.table), version)
    control = document_control(ensemble.scenario, {"program": runs.versions.get("bridge_demolition_addon", "")})
    return Document(ensemble.scenario.title, subtitle, tuple(filter(None, sections)), summary, control)


def statement_section(runs: ReportedEnsemble, sentences: Sequence[str], warnings: Iterable[str] = ()) -> Section:
    """Return what the runs state, the first sentence set apart, and what to doubt."""
    first, *others = sentences
    blocks: list[Block] = [Paragraph(first, is_notice=True), *map(Paragraph, others)]
    blocks += [Paragraph(text, is_notice=True) for text in warnings]
    return Section(f"What this {runs.ensemble.kind} says", tuple(blocks))


def unfinished_sentence(runs: ReportedEnsemble, total: int) -> str:
    """Return how far an ensemble is that goes on."""
    kind, counts = Text(runs.ensemble.kind), (len(runs.table), total)
    if isinstance(runs.ensemble, Study):
        return Text(
            "{} of {} runs are there: the {} states nothing before all that it needs are. Go on with the command "
            "that started it.",
            *counts,
            kind,
        )
    return Text(
        "{} of up to {} runs are there: the {} states nothing before all that it needs are. Go on with the "
        "command that started it.",
        *counts,
        kind,
    )


def doubts_of(runs: ReportedEnsemble) -> Iterator[str]:
    """Yield what to doubt of runs: those not finished, not come to rest, or with much energy made by the solver."""
    table = runs.table
    lost = [row for row in table.rows if row.status != DONE]
    if lost:
        named = [Text("{} ({})", row.number, Text(row.status.replace("_", " "))) for row in lost[:_MOST_NAMED]]
        others = "{} of {} runs did not finish: {} and others."
        every = "{} of {} runs did not finish: {}."
        yield Text(others if len(lost) > _MOST_NAMED else every, len(lost), len(table), joined("{}, {}", named))
    moving = sum(row.status == DONE and row.outputs.get(_REST) is None for row in table.rows)
    if moving and _REST in table.outputs:
        yield (
            Text(
                "In {} of {} runs not everything had rested for {} s when their time was over: debris may have "
                "gone on. Give the scenario a longer time.duration_s.",
                moving,
                len(table),
                f"{runs.ensemble.scenario.time.rest_hold_s:g}",
            )
        )
    made = [row.outputs.get(_MADE) or 0.0 for row in table.rows if row.status == DONE]
    if most := sum(share > LARGE_SHARE for share in made):
        yield (
            Text(
                "In {} of {} runs the solver made more than {} of what was dissipated, up to {} %: debris may be "
                "thrown too far.",
                most,
                len(table),
                percent(LARGE_SHARE),
                f"{100.0 * max(made):.1f}",
            )
        )


def _files_section(runs: ReportedEnsemble, version: str, asked: Iterable[tuple[str, str]]) -> Section:
    """Return the settings of the runs and their files, so that they can be repeated."""
    ensemble, kind = runs.ensemble, runs.ensemble.kind
    rows = [
        (Text("Scenario"), ensemble.scenario.title),
        (Text("Folder"), runs.name),
        *asked,
        (Text("Varied"), joined("{}, {}", input_names(ensemble))),
        (Text(f"Seed of the {kind}"), str(ensemble.settings.seed)),
        (Text("Run with"), ", ".join(f"{name.replace('_', ' ')} {number}" for name, number in runs.versions.items())),
        ("Bridge Demolition Add-on", version),
    ]
    use = Text(
        "With these two files and the versions above the {} can be repeated: the same files give the same runs, "
        "and the same runs the same outcomes.",
        Text(kind),
    )
    files = Listing(ensemble.text), Listing(ensemble.scenario_text)
    return Section(f"The {kind} and its scenario", (facts(f"The {kind}", rows, kind), Paragraph(use), *files))
