"""The report of an optimisation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from ...charts.ensemble_charts import tradeoff
from ...model.optimise.conclusions import CANDIDATE, ROUND, Best, TriedCandidate, best_of, tried_candidates
from ...model.optimise.file import Optimisation
from ...model.optimise.rounds import CONFIRMATION
from ...model.study.runs_table import RunsTable
from ...model.study.shown_names import words_and_unit
from ...system.progress import Progress
from ...texts import Quantity, Text, joined
from ...version import VERSION
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Report, Section
from ..wording.numbers import percent
from ..wording.optimise import optimise_sentences
from .document import doubts_of, ensemble_document, statement_section, unfinished_sentence
from .influence import correlation_table
from .reported_ensemble import ReportedEnsemble
from .runs import runs_section

_MOST_CANDIDATES = 200
_STATISTICS = Text(
    "Candidates are proposed by a tree-structured Parzen estimator (Bergstra et al. 2011). Choosing the best of "
    "many that scatter chooses luck as well (winner's curse): so the finalists, and the one that is chosen, are "
    "run again with inputs by chance that were not used before. Only these fresh runs make statements: the limit "
    "by rank after Wilks (1941), the probability after Clopper and Pearson (1934)."
)


@dataclass(frozen=True, eq=False)
class TriedCandidates(ReportedEnsemble):
    """An optimisation and its runs, what its candidates came to, and the best of them; None before its end."""

    ensemble: Optimisation
    tried: tuple[TriedCandidate, ...]
    best: Best | None


def read_candidates(folder: Path) -> TriedCandidates:
    """Read an optimisation, also one that goes on."""
    return TriedCandidates.read(folder, _candidates)


def _candidates(optimisation: Optimisation, table: RunsTable) -> dict[str, Any]:
    confirmed = sum(row.inputs[ROUND] == CONFIRMATION for row in table.rows)
    is_over = confirmed == optimisation.settings.confirmation_runs
    tried = tuple(tried_candidates(optimisation, table))
    return {"tried": tried, "best": best_of(optimisation, table) if is_over else None}


def optimise_report(runs: TriedCandidates, _target: Path, _progress: Progress) -> Report:
    """Return the report of an optimisation."""
    version, best, optimisation = VERSION, runs.best, runs.ensemble
    sentences = optimise_sentences(best) if best else [unfinished_sentence(runs, optimisation.settings.runs)]
    statement = statement_section(runs, sentences, (*_warnings(best), *doubts_of(runs)))
    pictures = [_winner_section(best)] if best else []
    tables = [_candidates_section(runs.tried, best, optimisation.settings.unit), runs_section(runs, (CANDIDATE, ROUND))]
    asked = _asked(optimisation, runs)
    document = ensemble_document(runs, version, statement, pictures, tables, _STATISTICS, asked)
    settings = runs.ensemble.scenario.report
    return Report(document, (correlation_table(runs),), settings=settings)


def _asked(optimisation: Optimisation, runs: ReportedEnsemble) -> Iterator[tuple[str, str]]:
    settings = optimisation.settings
    yield (
        Text("Runs"),
        Text("{} of up to {}, {} of them finished", len(runs.table), settings.runs, int(runs.table.done.sum())),
    )
    yield (
        Text("Asked"),
        Text(
            "the smallest {}, as the {} quantile of a candidate's runs",
            Text(settings.objective),
            f"{settings.quantile:g}",
        ),
    )
    yield (
        Text("Has to hold"),
        Text(
            "all criteria with {} probability, at {} confidence",
            percent(settings.probability),
            percent(settings.confidence),
        ),
    )
    yield (
        Text("Rounds"),
        (
            Text(
                "{} candidates, runs of each: {}; {} finalists, fresh runs of each: {}; fresh runs of the one "
                "chosen: {}",
                settings.candidates,
                settings.runs_each,
                settings.finalists,
                settings.finalist_runs,
                settings.confirmation_runs,
            )
        ),
    )
    yield Text("What may change"), joined("{}, {}", optimisation.space.names)


def _warnings(best: Best | None) -> Iterator[str]:
    """What a reader must not overlook."""
    if best is None:
        return
    if not best.is_confirmed:
        yield Text("The chosen candidate is not confirmed: its fresh runs met the criteria too rarely. Do not use it.")
    if best.looked_better_by > 0.0 and best.searched.value > 0.0:
        unit = best.optimisation.settings.unit
        yield (
            Text(
                "Winner's curse: in the search the chosen candidate looked better by {} than on fresh runs. Other "
                "candidates of the search look too good as well: trust the fresh runs alone.",
                Quantity(best.looked_better_by, unit, ".4g"),
            )
        )


def _winner_section(best: Best) -> Section:
    """The chosen candidate in each round, and among all candidates."""
    settings = best.optimisation.settings
    unit = settings.unit
    columns = (
        Column("round", "round"),
        Column("runs", "runs", "d"),
        Column("met all criteria", "successes", "d"),
        Column(settings.objective, "objective", ".4g", unit=unit),
    )
    rounds = ((Text("search"), best.searched), (Text("final"), best.final), (Text("confirmation"), best.confirmed))
    rows = [(name, result.runs, result.successes, result.value) for name, result in rounds]
    blocks: list[Block] = [
        DataTable("chosen_candidate", Text("Candidate {} in each round", best.candidate), columns, rows)
    ]
    if any(candidate.charge_kg > 0.0 for candidate in best.tried):
        caption = Text(
            "Charge and debris distance of all candidates in the search, and those that no other beats in both. "
            "They rest on few runs each."
        )
        blocks.append(Picture(partial(tradeoff, best=best), caption, 110.0))
    return Section("The chosen candidate", tuple(blocks))


def _candidates_section(tried: Sequence[TriedCandidate], best: Best | None, unit: str) -> Section:
    """All candidates: those that succeed often enough first, by their objective."""
    names = list(tried[0].values) if tried else []
    columns = (
        Column("candidate", "candidate", "d"),
        *(Column(words, name, ".4g", unit=own) for name in names for words, own in [words_and_unit(name)]),
        Column("objective", "objective", ".4g", unit=unit),
        Column("met all", "successes", "d"),
        Column("of", "runs", "d"),
        Column("charge", "charge_kg", ".4g"),
        Column("debris distance", "reach_m", ".4g", is_reach=True),
        Column("", "remark"),
    )
    ordered = sorted(tried, key=lambda candidate: (not candidate.holds, candidate.result.value, candidate.number))
    rows = [
        (
            candidate.number,
            *(candidate.values[name] for name in names),
            candidate.result.value,
            candidate.result.successes,
            candidate.result.runs,
            candidate.charge_kg,
            candidate.reach_m,
            _remark(candidate, best),
        )
        for candidate in ordered[:_MOST_CANDIDATES]
    ]
    words = Paragraph(
        "What each candidate came to in the search. Those that succeed often enough come first, by their objective. "
        "All of them are in candidates.csv."
    )
    return Section("The candidates", (words, DataTable("candidates", "Candidates", columns, rows)))


def _remark(candidate: TriedCandidate, best: Best | None) -> str:
    if best and candidate.number == best.candidate:
        return Text("chosen")
    if not candidate.holds:
        return Text("fails too often")
    return Text("no other has less of both") if candidate.on_front else ""
