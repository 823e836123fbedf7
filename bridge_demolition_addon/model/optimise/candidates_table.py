"""The table of candidates, and which of them no other beats in charge and reach at once."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...system.disk import whole_file
from ..study.runs_table import REACH
from .file import Optimisation
from .rounds import SEARCH, Result, Rounds, quantile_of
from .settings import CHARGE


@dataclass(frozen=True, slots=True)
class Tried:
    """A candidate whose runs have all ended.

    Attributes
    ----------
    number : int
        From 1.
    values : dict
        What was tried, by name.
    result : Result
        What it came to in the search.
    charge_kg, reach_m : float
        Mass of its charges, and the quantile of its reach; infinite where not known.
    holds : bool
        Whether it met all criteria as often as they have to be met.
    on_front : bool
        Whether no other that holds has both less charge and less reach.
    """

    number: int
    values: dict[str, Any]
    result: Result
    charge_kg: float
    reach_m: float
    holds: bool
    on_front: bool


def tried_of(optimisation: Optimisation, rounds: Rounds) -> list[Tried]:
    """Return all candidates whose runs of the search have ended."""
    settings, draws = optimisation.settings, rounds.draws(SEARCH)
    numbers = [n for n, each in enumerate(rounds.candidates) if all(draw in each.outputs for draw in draws)]
    results = [rounds.result(number, SEARCH) for number in numbers]
    charges, reaches = (
        [_quantile(rounds, number, name, settings.quantile) for number in numbers] for name in (CHARGE, REACH)
    )
    holds = np.array([each.share >= settings.probability for each in results], bool)
    fronts = front_of(np.array(charges), np.array(reaches), holds)
    shown = [optimisation.space.shown(rounds.candidates[number].shares) for number in numbers]
    rows = zip(numbers, shown, results, charges, reaches, holds.tolist(), fronts.tolist(), strict=True)
    return [Tried(number + 1, *others) for number, *others in rows]


def front_of(charges_kg: np.ndarray, reaches_m: np.ndarray, holds: np.ndarray) -> np.ndarray:
    """Return which candidates (n,) hold and are not beaten: none that holds is less in one and no more in the other."""
    counts = holds & np.isfinite(reaches_m)
    less = (charges_kg[:, None] <= charges_kg) & (reaches_m[:, None] <= reaches_m)
    better = less & ((charges_kg[:, None] < charges_kg) | (reaches_m[:, None] < reaches_m))
    return counts & ~(better & counts[:, None]).any(axis=0)


def write_candidates(tried: Sequence[Tried], path: Path) -> None:
    """Write the table as CSV; what is not known is empty."""
    names = list(dict.fromkeys(name for each in tried for name in each.values))
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        columns = ["candidate", *names, "objective", "successes", "runs", "holds", CHARGE, "reach_m", "on_front"]
        rows.writerow(columns)
        for each in tried:
            found = [each.result.value, each.result.successes, each.result.runs, each.holds]
            cells = [each.number, *map(each.values.get, names), *found, each.charge_kg, each.reach_m, each.on_front]
            rows.writerow(map(_cell, cells))


def _quantile(rounds: Rounds, number: int, name: str, quantile: float) -> float:
    found = [rounds.candidates[number].outputs[draw].get(name) for draw in rounds.draws(SEARCH)]
    return quantile_of(np.array([math.inf if value is None else value for value in found], float), quantile)


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and not math.isfinite(value):
        return ""
    return f"{value:.9g}" if isinstance(value, float) else str(value)
