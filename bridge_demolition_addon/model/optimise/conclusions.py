"""Result of an optimisation: the best values, their objective, and by how much they had looked better in the search."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...engineering.statistics.binomial import lower_limit
from ...engineering.statistics.order_limits import most_support, nth_largest
from ...system.disk import whole_file
from ..study.conclusions import finite
from ..study.runs_table import REACH, RunsTable
from .file import Optimisation
from .rounds import CONFIRMATION, FINAL, SEARCH, CandidateResult, objective_values, quantile_of, result_of
from .settings import CHARGE

CANDIDATE, ROUND = "candidate", "round"
"""Inputs of the table of runs that say which candidate runs, and why."""

_STATED_SETTINGS = ("objective", "unit", "quantile", "probability", "confidence")


@dataclass(frozen=True, slots=True)
class TriedCandidate:
    """A candidate all of whose runs of the search have ended."""

    number: int  # from 1
    values: dict[str, Any]  # by name
    result: CandidateResult  # of its runs in the search
    charge_kg: float  # infinite where not known
    reach_m: float  # quantile of its debris distance; infinite where not known
    holds: bool  # whether it met all criteria as often as they have to be met
    on_front: bool  # whether no other that holds has both less charge and a smaller debris distance


@dataclass(frozen=True, slots=True, eq=False)
class Best:
    """The candidate that was chosen, with limits that hold with the confidence of the optimisation.

    The quantile of its objective is at most `limit`; it meets all criteria with at least `least_probability`.
    """

    optimisation: Optimisation
    tried: tuple[TriedCandidate, ...]
    candidate: int  # its number, from 1
    values: dict[str, Any]  # by name
    searched: CandidateResult  # its result in each round
    final: CandidateResult
    confirmed: CandidateResult
    limit: float | None  # None where there are too few runs to state one, or not all of them finished
    least_probability: float

    @property
    def looked_better_by(self) -> float:
        """How much smaller the objective was in the search than it is on fresh runs."""
        return self.confirmed.value - self.searched.value

    @property
    def is_confirmed(self) -> bool:
        """Whether the criteria are met as often as was asked for."""
        return self.least_probability >= self.optimisation.settings.probability

    def as_json(self) -> dict[str, Any]:
        """Return it as ``optimise.json`` has it."""
        settings = self.optimisation.settings
        confirmed = {
            "limit": self.limit,
            "least_probability": self.least_probability,
            "meets_the_probability": self.is_confirmed,
        }
        values = {
            **{name: getattr(settings, name) for name in _STATED_SETTINGS},
            "candidate": self.candidate,
            "values": self.values,
            "confirmed": asdict(self.confirmed) | confirmed,
            "in_the_final": asdict(self.final),
            "in_the_search": asdict(self.searched),
            "looked_better_by": self.looked_better_by,
        }
        return finite(values)


def best_of(optimisation: Optimisation, table: RunsTable) -> Best:
    """Return the candidate that was chosen, from the table of runs."""
    settings = optimisation.settings
    number = next(row.inputs[CANDIDATE] for row in table.rows if row.inputs[ROUND] == CONFIRMATION)
    outputs = {name: _outputs(table, number, name) for name in (SEARCH, FINAL, CONFIRMATION)}
    results = {name: result_of(runs, settings) for name, runs in outputs.items()}
    values = objective_values(outputs[CONFIRMATION], settings.output)
    rank = most_support(len(values), settings.quantile, settings.confidence)
    limit = nth_largest(values, rank) if rank else math.inf
    confirmed = results[CONFIRMATION]
    tried = tuple(tried_candidates(optimisation, table))
    return Best(
        optimisation=optimisation,
        tried=tried,
        candidate=number,
        values=next(candidate.values for candidate in tried if candidate.number == number),
        searched=results[SEARCH],
        final=results[FINAL],
        confirmed=confirmed,
        limit=limit if math.isfinite(limit) else None,
        least_probability=float(lower_limit(confirmed.successes, confirmed.runs, settings.confidence)),
    )


def tried_candidates(optimisation: Optimisation, table: RunsTable) -> list[TriedCandidate]:
    """Return all candidates whose runs of the search have ended."""
    settings, names = optimisation.settings, optimisation.space.names
    inputs = {row.inputs[CANDIDATE]: row.inputs for row in table.rows}
    runs = {number: _outputs(table, number, SEARCH) for number in sorted(inputs)}
    runs = {number: outputs for number, outputs in runs.items() if len(outputs) == settings.runs_each}
    results = [result_of(outputs, settings) for outputs in runs.values()]
    charges, distances = (
        np.array([quantile_of(objective_values(outputs, name), settings.quantile) for outputs in runs.values()])
        for name in (CHARGE, REACH)
    )
    holds = np.array([result.share >= settings.probability for result in results], bool)
    fronts = front_of(charges, distances, holds)
    values = [{name: inputs[number].get(name) for name in names} for number in runs]
    columns = (charges.tolist(), distances.tolist(), holds.tolist(), fronts.tolist())
    return [TriedCandidate(*row) for row in zip(runs, values, results, *columns, strict=True)]


def front_of(charges_kg: np.ndarray, reaches_m: np.ndarray, holds: np.ndarray) -> np.ndarray:
    """Return which candidates (n,) hold, while no other that holds is less in one and not more in both."""
    counts = holds & np.isfinite(reaches_m)
    less = (charges_kg[:, None] <= charges_kg) & (reaches_m[:, None] <= reaches_m)
    better = less & ((charges_kg[:, None] < charges_kg) | (reaches_m[:, None] < reaches_m))
    return counts & ~(better & counts[:, None]).any(axis=0)


def write_candidates(tried: Sequence[TriedCandidate], path: Path) -> None:
    """Write the table as CSV; what is not known is empty."""
    names = list(dict.fromkeys(name for candidate in tried for name in candidate.values))
    columns = ["candidate", *names, "objective", "successes", "runs", "holds", CHARGE, "reach_m", "on_front"]
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(columns)
        for row in tried:
            result = [row.result.value, row.result.successes, row.result.runs, row.holds]
            cells = [row.number, *map(row.values.get, names), *result, row.charge_kg, row.reach_m, row.on_front]
            rows.writerow(map(_cell, cells))


def _outputs(table: RunsTable, candidate: int, of_round: str) -> list[Mapping[str, Any]]:
    """Return the outputs of the runs of a candidate in a round."""
    return [row.outputs for row in table.rows if row.inputs[CANDIDATE] == candidate and row.inputs[ROUND] == of_round]


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.9g}" if math.isfinite(value) else ""
    return str(value)
