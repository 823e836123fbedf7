"""What a search says: where success has the probability that was asked for, and how sure that is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ...engineering.search.bisection import median_interval
from ...engineering.search.probit import Trials, fitted, limit
from .file import Search

CLOSE_ENOUGH, OUT_OF_TRIALS = "the limit is as close as was asked for", "all trials were made"
NEVER, ALWAYS = "the criteria were never met in the range", "the criteria were always met in the range"
FALLING = "the criteria are met the less often the farther one goes where they should be met more often"

OPENING = 8
"""Trials of one kind only, after which it is said that the criteria are always or never met in the range."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What is known after some trials, in the unit of the quantity.

    Attributes
    ----------
    trials, successes : int
        How many there were, and how many met all criteria.
    median, value : float or None
        Where the criteria are met by every other run, and with the probability that was asked for, most likely; None
        as long as that is not known.
    spread : float or None
        Standard deviation about the median, of the natural logarithm where the search is logarithmic; 0 where no
        trials overlap.
    median_limits : (float, float)
        Limits of the median, each with the confidence that was asked for; infinite where not known.
    limit : float
        Beyond it, away from failure, the criteria are met with at least that probability, with that confidence.
    without_model : (float, float, float)
        Median by probabilistic bisection, and the interval about it that has that confidence.
    """

    trials: int
    successes: int
    median: float | None
    spread: float | None
    value: float | None
    median_limits: tuple[float, float]
    limit: float
    without_model: tuple[float, float, float]

    @property
    def is_known(self) -> bool:
        """Whether there is a limit."""
        return self.value is not None and math.isfinite(self.limit)

    def as_json(self) -> dict[str, Any]:
        """Return it as ``search.json`` has it; what is infinite is not known, and null."""
        low, high = (each if math.isfinite(each) else None for each in self.median_limits)
        middle, *interval = self.without_model
        return {
            "trials": self.trials,
            "successes": self.successes,
            "median": self.median,
            "median_limits": [low, high],
            "spread": self.spread,
            "value": self.value,
            "limit": self.limit if math.isfinite(self.limit) else None,
            "without_a_model": {"median": middle, "interval": interval},
        }


def answer_of(search: Search, trials: Trials) -> Answer:
    """Return what trials, by their levels, say."""
    scale, settings = search.scale, search.settings
    found = fitted(trials)
    ends = [scale.value(limit(trials, 0.5, settings.confidence, side)) for side in (-1, 1)]
    return Answer(
        trials=len(trials),
        successes=int(trials.successes.sum()),
        median=found and scale.value(found.median),
        spread=found and float(found.spread),
        value=found and scale.value(found.quantile(settings.probability)),
        median_limits=(min(ends), max(ends)),
        limit=scale.value(limit(trials, settings.probability, settings.confidence, 1)),
        without_model=_in_order(
            [scale.value(each) for each in median_interval(trials, *scale.ends, settings.confidence)]
        ),
    )


def reason_to_stop(search: Search, trials: Trials) -> str | None:
    """Return why a search ends after trials whose outcomes are all known; None as long as it goes on."""
    settings = search.settings
    if len(trials) >= OPENING and not trials.successes.any():
        return NEVER
    if len(trials) >= OPENING and trials.successes.all():
        return ALWAYS
    if settings.within is not None and trials.overlap:
        answer = answer_of(search, trials)
        if answer.is_known and abs(answer.limit - answer.value) <= settings.within:
            return CLOSE_ENOUGH
    if len(trials) >= settings.trials:
        return FALLING if fitted(trials) is None else OUT_OF_TRIALS
    return None


def sentences(search: Search, answer: Answer, reason: str) -> list[str]:
    """Return what a search says, in plain words."""
    settings = search.settings
    unit = f" {search.unit}" if search.unit else ""
    seen = f"{answer.successes} of {answer.trials} trials met all criteria: {reason}."
    if answer.value is None:
        return [seen, _advice(search, reason)]
    told = [
        seen,
        f"{settings.key}: half of all runs meet them at {_shown(answer.median)}{unit}, and "
        f"{settings.probability:.4g} of all at {_shown(answer.value)}{unit}, most likely.",
    ]
    where = "or more" if settings.success == "above" else "or less"
    if answer.is_known:
        told.append(
            f"With {settings.confidence:.4g} confidence, {settings.probability:.4g} of all runs meet them at "
            f"{_shown(answer.limit)}{unit} {where}."
        )
        if not settings.lowest <= answer.limit <= settings.highest:
            told.append("That is outside the range in which trials were made: it rests on the shape of the curve.")
    else:
        told.append("The trials set no limit yet: make more of them.")
    if farther := _end_in_the_way(search, answer):
        told.append(f"The median is at the end of the range or beyond it: move search.{farther}.")
    _, low, high = answer.without_model
    told.append(
        f"Without a model of how the probability rises, the median is {_shown(low)} to {_shown(high)}{unit} with "
        f"{settings.confidence:.4g} probability."
    )
    return told


def _end_in_the_way(search: Search, answer: Answer) -> str | None:
    """Which end of the range keeps trials away from the median; None where it is well within."""
    low, high = search.scale.ends
    level = search.scale.level(answer.median)
    margin = 0.02 * (high - low)
    if low + margin < level < high - margin:
        return None
    return "lowest" if (level <= low + margin) != search.scale.is_falling else "highest"


def _advice(search: Search, reason: str) -> str:
    settings = search.settings
    if reason == FALLING:
        return f'Try search.success = "{"below" if settings.success == "above" else "above"}".'
    farther = "highest" if (reason == NEVER) == (settings.success == "above") else "lowest"
    return (
        f"Trials went from {settings.lowest:g} to {settings.highest:g}: move search.{farther}, or ask for something "
        "else."
    )


def _in_order(values: list[float]) -> tuple[float, float, float]:
    middle, *ends = values
    return middle, min(ends), max(ends)


def _shown(value: float) -> str:
    """To four digits, without an exponent where it need not have one."""
    return f"{float(f'{value:.4g}'):.10g}"
