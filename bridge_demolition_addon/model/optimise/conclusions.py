"""What an optimisation says: the values that did best, what they come to, and by how much they had looked better."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engineering.statistics.order_limits import most_touching, nth_largest
from ...engineering.statistics.proportions import lower_limit
from .file import Optimisation
from .rounds import CONFIRMATION, FINAL, SEARCH, Result, Rounds
from .settings import OptimiseSettings


@dataclass(frozen=True, slots=True)
class Best:
    """The candidate that was chosen.

    Attributes
    ----------
    candidate : int
        Its number, from 1.
    values : dict
        What was chosen, by name.
    searched, final, confirmed : Result
        What it came to in each round.
    limit : float or None
        The objective of that quantile is at most this, with the confidence that was asked for; None where there are
        too few runs to say, or not all of them finished.
    least_probability : float
        All criteria are met with at least this, with that confidence.
    """

    candidate: int
    values: dict[str, Any]
    searched: Result
    final: Result
    confirmed: Result
    limit: float | None
    least_probability: float

    @property
    def looked_better_by(self) -> float:
        """How much smaller the objective was in the search than it is on fresh draws."""
        return self.confirmed.value - self.searched.value


def best_of(optimisation: Optimisation, rounds: Rounds) -> Best:
    """Return what was found, once all runs have ended."""
    settings, number = optimisation.settings, rounds.chosen
    confirmed = rounds.result(number, CONFIRMATION)
    outputs = [rounds.candidates[number].outputs[draw] for draw in rounds.draws(CONFIRMATION)]
    values = np.array([math.inf if (value := each.get(settings.output)) is None else value for each in outputs], float)
    rank = most_touching(len(values), settings.quantile, settings.confidence)
    limit = nth_largest(values, rank) if rank else math.inf
    return Best(
        candidate=number + 1,
        values=optimisation.space.shown(rounds.candidates[number].shares),
        searched=rounds.result(number, SEARCH),
        final=rounds.result(number, FINAL),
        confirmed=confirmed,
        limit=limit if math.isfinite(limit) else None,
        least_probability=float(lower_limit(confirmed.successes, confirmed.runs, settings.confidence)),
    )


def as_json(optimisation: Optimisation, best: Best) -> dict[str, Any]:
    """Return what ``optimise.json`` says; what is infinite is not known, and null."""
    settings = optimisation.settings
    return {
        "objective": settings.objective,
        "unit": settings.unit,
        "quantile": settings.quantile,
        "probability": settings.probability,
        "confidence": settings.confidence,
        "candidate": best.candidate,
        "values": best.values,
        "confirmed": _result_as_json(best.confirmed)
        | {
            "limit": best.limit,
            "least_probability": best.least_probability,
            "meets_the_probability": best.least_probability >= settings.probability,
        },
        "in_the_final": _result_as_json(best.final),
        "in_the_search": _result_as_json(best.searched),
        "looked_better_by": _finite(best.looked_better_by),
    }


def sentences(optimisation: Optimisation, best: Best) -> list[str]:
    """Return what an optimisation says, in plain words."""
    settings, confirmed, unit = optimisation.settings, best.confirmed, optimisation.settings.unit
    told = [f"Candidate {best.candidate} of {settings.candidates} did best:"]
    units = {key.name: key.unit for each in optimisation.space.dimensions for key in each.keys}
    told += [f"  {name} = {_shown(value)} {units.get(name, '')}".rstrip() for name, value in best.values.items()]
    what = _what(settings)
    if math.isfinite(confirmed.value):
        told.append(f"On {confirmed.runs} fresh runs its {what} is {_shown(confirmed.value)} {unit}.")
    else:
        told.append(
            f"On {confirmed.runs} fresh runs its {what} is not known: too many did not finish, or come to rest."
        )
    if best.limit is not None and settings.objective != "charge":
        told.append(
            f"With {settings.confidence:g} confidence, {settings.quantile:g} of all such runs stay within "
            f"{_shown(best.limit)} {unit}."
        )
    told.append(_on_the_search(optimisation, best))
    met = best.least_probability >= settings.probability
    told.append(
        f"{confirmed.successes} of these {confirmed.runs} runs met all criteria: with {settings.confidence:g} "
        f"confidence at least {_shown(best.least_probability)} of all do, "
        f"{'and' if met else 'but'} {settings.probability:g} was asked for."
    )
    if not met:
        told.append(
            "So the candidate is not confirmed: widen the ranges, or give each candidate and finalist more runs, which "
            "tell those that just miss from those that hold."
        )
    return told


def _on_the_search(optimisation: Optimisation, best: Best) -> str:
    """By how much luck made it look better while it was chosen."""
    settings, searched = optimisation.settings, best.searched
    seen = f"In the search it met all criteria in {searched.successes} of {searched.runs} runs"
    if settings.objective == "charge" or not math.isfinite(best.looked_better_by):
        return f"{seen}."
    than = "better" if best.looked_better_by >= 0.0 else "worse"
    return (
        f"{seen} with {_shown(searched.value)} {settings.unit}, {_shown(abs(best.looked_better_by))} {settings.unit} "
        f"{than} than it is."
    )


def _what(settings: OptimiseSettings) -> str:
    if settings.objective == "charge":
        return "charge"
    named = {"reach": "reach", "time": "time until all rests", "vibration": "vibration"}[settings.objective]
    return f"{settings.quantile:g} quantile of the {named}"


def _result_as_json(result: Result) -> dict[str, Any]:
    return {"value": _finite(result.value), "successes": result.successes, "runs": result.runs}


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _shown(value: Any) -> str:
    """To four digits, without an exponent where it need not have one."""
    return f"{float(f'{value:.4g}'):.10g}"
