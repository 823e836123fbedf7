"""Sentences on the result of an optimisation."""

from __future__ import annotations

import math

from ...model.optimise.conclusions import Best
from ...model.optimise.settings import OptimiseSettings
from ...texts import UP, Quantity, Text
from .numbers import four_digits


def optimise_sentences(best: Best) -> list[str]:
    """Return what an optimisation states, in plain words."""
    settings, confirmed, unit = best.optimisation.settings, best.confirmed, best.optimisation.settings.unit
    units = {key.name: key.unit for dimension in best.optimisation.space.dimensions for key in dimension.keys}
    sentences: list[str] = [Text("Candidate {} of {} did best:", best.candidate, settings.candidates)]
    sentences += [
        Text("  {} = {}", name, Quantity(four_digits(value), own) if (own := units.get(name)) else four_digits(value))
        for name, value in best.values.items()
    ]
    objective = _objective(settings)
    if math.isfinite(confirmed.value):
        sentences.append(
            Text(
                "On {} fresh runs its {} is {}.",
                confirmed.runs,
                objective,
                Quantity(four_digits(confirmed.value), unit),
            )
        )
    else:
        sentences.append(
            Text(
                "On {} fresh runs its {} is not known: too many did not finish, or come to rest.",
                confirmed.runs,
                objective,
            )
        )
    if best.limit is not None and settings.objective != "charge":
        sentences.append(
            Text(
                "With {} confidence, {} of all such runs stay within {}.",
                f"{settings.confidence:g}",
                f"{settings.quantile:g}",
                Quantity(four_digits(best.limit), unit, rounding=UP),
            )
        )
    sentences.append(_search_sentence(best))
    sentences.append(
        Text(
            "{} of these {} runs met all criteria: with {} confidence at least {} of all do, and {} was asked for.",
            confirmed.successes,
            confirmed.runs,
            f"{settings.confidence:g}",
            four_digits(best.least_probability),
            f"{settings.probability:g}",
        )
        if best.is_confirmed
        else Text(
            "{} of these {} runs met all criteria: with {} confidence at least {} of all do, but {} was asked for.",
            confirmed.successes,
            confirmed.runs,
            f"{settings.confidence:g}",
            four_digits(best.least_probability),
            f"{settings.probability:g}",
        )
    )
    if not best.is_confirmed:
        sentences.append(
            Text(
                "So the candidate is not confirmed: widen the ranges, or give each candidate and finalist more "
                "runs, which tell those that just miss from those that hold."
            )
        )
    return sentences


def _search_sentence(best: Best) -> str:
    """By how much luck made it look better while it was chosen."""
    settings, searched = best.optimisation.settings, best.searched
    if settings.objective == "charge" or not math.isfinite(best.looked_better_by):
        return Text("In the search it met all criteria in {} of {} runs.", searched.successes, searched.runs)
    better = "In the search it met all criteria in {} of {} runs with {}, {} better than it is."
    worse = "In the search it met all criteria in {} of {} runs with {}, {} worse than it is."
    return Text(
        better if best.looked_better_by >= 0.0 else worse,
        searched.successes,
        searched.runs,
        Quantity(four_digits(searched.value), settings.unit),
        Quantity(four_digits(abs(best.looked_better_by)), settings.unit),
    )


def _objective(settings: OptimiseSettings) -> str:
    if settings.objective == "charge":
        return Text("charge")
    name = {"reach": Text("debris distance"), "time": Text("time until all rests"), "vibration": Text("vibration")}[
        settings.objective
    ]
    return Text("{} quantile of the {}", f"{settings.quantile:g}", name)
