"""The report of a search."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ...charts.ensemble_charts import search_curve
from ...model.search.conclusions import Answer, answer_of
from ...model.study.shown_names import words_and_unit
from ...system.progress import Progress
from ...texts import Text
from ...version import VERSION
from ..document.blocks import Column, DataTable, Paragraph, Picture, Report, Section
from ..wording.numbers import percent
from ..wording.search import search_sentences
from .document import doubts_of, ensemble_document, statement_section, unfinished_sentence
from .influence import correlation_table
from .reported_ensemble import ReportedEnsemble

_STATISTICS = Text(
    "Values are chosen after Neyer (1994). The probability of success rises as a normal distribution along the "
    "quantity, or along its logarithm; the limit is from the ratio of likelihoods. It says how the model scatters."
)


@dataclass(frozen=True, eq=False)
class SearchAnswer(ReportedEnsemble):
    """A search, its runs and their answer, so far."""

    answer: Answer


def read_answer(folder: Path) -> SearchAnswer:
    """Read a search, also one that goes on."""
    return SearchAnswer.read(folder, lambda search, table: {"answer": answer_of(search, table)})


def search_report(runs: SearchAnswer, _target: Path, _progress: Progress) -> Report:
    """Return the report of a search."""
    version, answer = VERSION, runs.answer
    sentences = search_sentences(answer)
    if answer.ended_as is None:
        sentences = [unfinished_sentence(runs, answer.search.settings.trials), *sentences]
    statement = statement_section(runs, sentences, doubts_of(runs))
    document = ensemble_document(
        runs, version, statement, [_curve_section(answer)], [_runs_section(answer)], _STATISTICS, _asked(answer)
    )
    settings = runs.ensemble.scenario.report
    return Report(document, (correlation_table(runs),), settings=settings)


def _asked(answer: Answer) -> Iterator[tuple[str, str]]:
    settings = answer.search.settings
    yield Text("Runs"), Text("{} of up to {}, {} of them a success", answer.runs, settings.trials, answer.successes)
    yield (
        Text("Asked"),
        (
            Text(
                "where {} from {} to {} succeeds with {} probability, with {} confidence",
                settings.key,
                answer.search.amount(f"{settings.lowest:g}", shown=False),
                answer.search.amount(f"{settings.highest:g}"),
                percent(settings.probability),
                percent(settings.confidence),
            )
        ),
    )


def _curve_section(answer: Answer) -> Section:
    caption = Text("All runs, and the probability of success along {}.", answer.search.settings.key)
    return Section("The curve", (Picture(partial(search_curve, answer=answer), caption, 110.0),))


def _runs_section(answer: Answer) -> Section:
    search = answer.search
    words, unit = words_and_unit(search.settings.key)
    if search.settings.factor:
        words = Text("{} (factor)", words)
    columns = (
        Column("run", "trial", "d"),
        Column(words, "value", ".6g", unit="" if search.settings.factor else unit or search.unit),
        Column("all criteria", "success"),
    )
    rows = [
        (number, float(value), Text("met") if success else Text("not met"))
        for number, (value, success) in enumerate(zip(answer.values, answer.trials.successes, strict=True), start=1)
    ]
    order = Paragraph(
        Text("In the order in which they were chosen. All inputs and outputs are in {}.", search.table_file)
    )
    return Section("The runs", (order, DataTable("trials", "Runs", columns, rows)))
