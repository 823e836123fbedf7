"""The one shape of the reports of studies, searches and optimisations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...model.results.solver_energy import LARGE_SHARE
from ...model.study.file import Study
from ...model.study.runs_table import DONE
from ..document.blocks import Block, Document, Listing, Paragraph, Section, facts
from ..sections.cover import trust_section
from ..wording.numbers import percent
from ..wording.study import input_names
from .criteria import criteria_section
from .influence import influence_section, varied_section
from .reported_ensemble import ReportedEnsemble

_AS_SAMPLED = (
    "Statements say how the model scatters over the inputs that vary, from the distributions that were given. Wrong "
    "distributions, inputs that scatter and do not vary here, and errors of the model are in none of them."
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
    subtitle = (
        f"Report of {article} {ensemble.kind} with {len(runs.table)} simulated demolitions. Bridge Demolition Add-on "
        f"{version}"
    )
    return Document(ensemble.scenario.title, subtitle, tuple(filter(None, sections)), summary)


def statement_section(runs: ReportedEnsemble, sentences: Sequence[str], warnings: Iterable[str] = ()) -> Section:
    """Return what the runs state, the first sentence set apart, and what to doubt."""
    first, *others = sentences
    blocks: list[Block] = [Paragraph(first, is_notice=True), *map(Paragraph, others)]
    blocks += [Paragraph(text, is_notice=True) for text in warnings]
    return Section(f"What this {runs.ensemble.kind} says", tuple(blocks))


def unfinished_sentence(runs: ReportedEnsemble, total: int) -> str:
    """Return how far an ensemble is that goes on."""
    kind, up_to = runs.ensemble.kind, "" if isinstance(runs.ensemble, Study) else "up to "
    return (
        f"{len(runs.table)} of {up_to}{total} runs are there: the {kind} states nothing before all that it needs are. "
        "Go on with the command that started it."
    )


def doubts_of(runs: ReportedEnsemble) -> Iterator[str]:
    """Yield what to doubt of runs: those not finished, not come to rest, or with much energy made by the solver."""
    table = runs.table
    lost = [row for row in table.rows if row.status != DONE]
    if lost:
        named = ", ".join(f"{row.number} ({row.status.replace('_', ' ')})" for row in lost[:_MOST_NAMED])
        others = " and others" if len(lost) > _MOST_NAMED else ""
        yield f"{len(lost)} of {len(table)} runs did not finish: {named}{others}."
    moving = sum(row.status == DONE and row.outputs.get(_REST) is None for row in table.rows)
    if moving and _REST in table.outputs:
        yield (
            f"In {moving} of {len(table)} runs not everything had rested for "
            f"{runs.ensemble.scenario.time.rest_hold_s:g} s when their time was over: debris may have gone on. Give "
            "the scenario a longer time.duration_s."
        )
    made = [row.outputs.get(_MADE) or 0.0 for row in table.rows if row.status == DONE]
    if most := sum(share > LARGE_SHARE for share in made):
        yield (
            f"In {most} of {len(table)} runs the solver made more than {percent(LARGE_SHARE)} of what was dissipated, "
            f"up to {100.0 * max(made):.1f} %: debris may be thrown too far."
        )


def _files_section(runs: ReportedEnsemble, version: str, asked: Iterable[tuple[str, str]]) -> Section:
    """Return the settings of the runs and their files, so that they can be repeated."""
    ensemble, kind = runs.ensemble, runs.ensemble.kind
    rows = [
        ("Scenario", ensemble.scenario.title),
        ("Folder", runs.name),
        *asked,
        ("Varied", ", ".join(input_names(ensemble))),
        (f"Seed of the {kind}", str(ensemble.settings.seed)),
        ("Run with", ", ".join(f"{name.replace('_', ' ')} {number}" for name, number in runs.versions.items())),
        ("Bridge Demolition Add-on", version),
    ]
    use = (
        f"With these two files and the versions above the {kind} can be repeated: the same files give the same runs, "
        "and the same runs the same outcomes."
    )
    files = Listing(ensemble.text), Listing(ensemble.scenario_text)
    return Section(f"The {kind} and its scenario", (facts(f"The {kind}", rows, kind), Paragraph(use), *files))
