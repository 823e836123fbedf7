"""Answer of a search: where success has the probability that was asked for, with its confidence."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ...engineering.search.neyer import median_interval
from ...engineering.search.probit import LevelOutcomes, fitted, limit
from ...system.disk import whole_file
from ...texts import Text
from ..study.conclusions import finite
from ..study.outcome import SUCCESS
from ..study.runs_table import RunsTable
from .file import Search

CLOSE_ENOUGH, OUT_OF_RUNS = Text("the limit is as close as was asked for"), Text("all runs were made")
NEVER, ALWAYS = Text("the criteria were never met in the range"), Text("the criteria were always met in the range")
FALLING = Text("the criteria are met less often where they should be met more often")

OPENING = 8
"""Runs of one kind only, after which the criteria count as always or never met in the range."""

PROBABILITIES = (0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99)
"""Of the curve."""


@dataclass(frozen=True, slots=True, eq=False)
class SearchCurve:
    """Values of the quantity for k probabilities of success."""

    probabilities: np.ndarray  # (k,)
    values: np.ndarray  # (k,), where success most likely has them
    lows: np.ndarray  # (k,), one-sided limits with the confidence of the search; nan where the runs set none
    highs: np.ndarray  # (k,), also


@dataclass(frozen=True, eq=False)
class Answer:
    """Result of some runs of a search, in the unit of the quantity.

    `spread` is the standard deviation about the median, of the natural logarithm where the search is logarithmic; 0
    where successes and failures do not overlap. Beyond `limit`, away from failure, the criteria are met with at least
    the probability of the search, with its confidence. `without_model` is the median by probabilistic bisection, and
    the interval about it that has that confidence. `ended_as` is None as long as the search goes on.
    """

    search: Search
    values: np.ndarray  # (n,), of the runs
    trials: LevelOutcomes  # the same as levels, and which of the runs met all criteria
    median: float | None  # where half of the runs meet the criteria, most likely; None if unknown
    spread: float | None
    value: float | None  # where as many as were asked for meet them, most likely; None if unknown
    median_limits: tuple[float, float]  # each with the confidence of the search; infinite where unknown
    limit: float
    without_model: tuple[float, float, float]
    ended_as: str | None

    @property
    def runs(self) -> int:
        """Number of runs."""
        return len(self.trials)

    @property
    def successes(self) -> int:
        """Number of runs that met all criteria."""
        return int(self.trials.successes.sum())

    @property
    def is_known(self) -> bool:
        """Whether there is a limit."""
        return self.value is not None and math.isfinite(self.limit)

    @cached_property
    def curve(self) -> SearchCurve | None:
        """The curve; None as long as none fits."""
        normal, scale = fitted(self.trials), self.search.scale
        if normal is None:
            return None
        values = [scale.value(normal.quantile(share)) for share in PROBABILITIES]
        confidence = self.search.settings.confidence
        ends = [
            [scale.value(limit(self.trials, share, confidence, side)) for side in (-1, 1)] for share in PROBABILITIES
        ]
        known = np.where(np.isfinite(ends), ends, np.nan)
        low, high = (1, 0) if scale.is_falling else (0, 1)
        return SearchCurve(np.array(PROBABILITIES), np.array(values), known[:, low], known[:, high])

    def as_json(self) -> dict[str, Any]:
        """Return it as ``search.json`` has it."""
        settings = self.search.settings
        middle, *interval = self.without_model
        values = {
            "key": settings.key,
            "unit": self.search.unit,
            "success": settings.success,
            "probability": settings.probability,
            "confidence": settings.confidence,
            "ended_as": self.ended_as,
            "trials": self.runs,
            "successes": self.successes,
            **{name: getattr(self, name) for name in ("median", "median_limits", "spread", "value", "limit")},
            "without_a_model": {"median": middle, "interval": interval},
        }
        return finite(values)


def answer_of(search: Search, table: RunsTable) -> Answer:
    """Return the answer of a search from the table of its runs."""
    scale, settings = search.scale, search.settings
    values = np.array([float(row.inputs[settings.key]) for row in table.rows])
    trials = LevelOutcomes(np.array([scale.level(float(value)) for value in values]), table.met(SUCCESS))
    normal = fitted(trials)
    ends = [scale.value(limit(trials, 0.5, settings.confidence, side)) for side in (-1, 1)]
    middle, *interval = (scale.value(level) for level in median_interval(trials, *scale.ends, settings.confidence))
    return Answer(
        search=search,
        values=values,
        trials=trials,
        median=None if normal is None else scale.value(normal.median),
        spread=None if normal is None else float(normal.spread),
        value=None if normal is None else scale.value(normal.quantile(settings.probability)),
        median_limits=(min(ends), max(ends)),
        limit=scale.value(limit(trials, settings.probability, settings.confidence, 1)),
        without_model=(middle, min(interval), max(interval)),
        ended_as=reason_to_stop(search, trials),
    )


def reason_to_stop(search: Search, trials: LevelOutcomes) -> str | None:
    """Return why a search ends after runs whose outcomes are all known; None as long as it goes on."""
    settings, scale = search.settings, search.scale
    if len(trials) >= OPENING and not trials.successes.any():
        return NEVER
    if len(trials) >= OPENING and trials.successes.all():
        return ALWAYS
    if settings.within is not None and trials.overlap and (normal := fitted(trials)) is not None:
        end = scale.value(limit(trials, settings.probability, settings.confidence, 1))
        if math.isfinite(end) and abs(end - scale.value(normal.quantile(settings.probability))) <= settings.within:
            return CLOSE_ENOUGH
    if len(trials) >= settings.trials:
        return FALLING if fitted(trials) is None else OUT_OF_RUNS
    return None


def write_curve(curve: SearchCurve, path: Path) -> None:
    """Write a curve as CSV; what is not known is empty."""
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["probability", "value", "lower_limit", "upper_limit"])
        for row in zip(curve.probabilities, curve.values, curve.lows, curve.highs, strict=True):
            rows.writerow([f"{cell:.6g}" if math.isfinite(cell) else "" for cell in row])
