"""Sentences on the result of an optimisation."""

from __future__ import annotations

import math

from ...model.optimise.conclusions import Best
from ...model.optimise.settings import OptimiseSettings
from .numbers import four_digits


def optimise_sentences(best: Best) -> list[str]:
    """Return what an optimisation states, in plain words."""
    settings, confirmed, unit = best.optimisation.settings, best.confirmed, best.optimisation.settings.unit
    units = {key.name: key.unit for dimension in best.optimisation.space.dimensions for key in dimension.keys}
    sentences = [f"Candidate {best.candidate} of {settings.candidates} did best:"]
    sentences += [
        f"  {name} = {four_digits(value)} {units.get(name, '')}".rstrip() for name, value in best.values.items()
    ]
    objective = _objective(settings)
    if math.isfinite(confirmed.value):
        sentences.append(f"On {confirmed.runs} fresh runs its {objective} is {four_digits(confirmed.value)} {unit}.")
    else:
        sentences.append(
            f"On {confirmed.runs} fresh runs its {objective} is not known: too many did not finish, or come to rest."
        )
    if best.limit is not None and settings.objective != "charge":
        sentences.append(
            f"With {settings.confidence:g} confidence, {settings.quantile:g} of all such runs stay within "
            f"{four_digits(best.limit)} {unit}."
        )
    sentences.append(_search_sentence(best))
    sentences.append(
        f"{confirmed.successes} of these {confirmed.runs} runs met all criteria: with {settings.confidence:g} "
        f"confidence at least {four_digits(best.least_probability)} of all do, "
        f"{'and' if best.is_confirmed else 'but'} {settings.probability:g} was asked for."
    )
    if not best.is_confirmed:
        sentences.append(
            "So the candidate is not confirmed: widen the ranges, or give each candidate and finalist more runs, which "
            "tell those that just miss from those that hold."
        )
    return sentences


def _search_sentence(best: Best) -> str:
    """By how much luck made it look better while it was chosen."""
    settings, searched = best.optimisation.settings, best.searched
    met = f"In the search it met all criteria in {searched.successes} of {searched.runs} runs"
    if settings.objective == "charge" or not math.isfinite(best.looked_better_by):
        return f"{met}."
    than = "better" if best.looked_better_by >= 0.0 else "worse"
    return (
        f"{met} with {four_digits(searched.value)} {settings.unit}, {four_digits(abs(best.looked_better_by))} "
        f"{settings.unit} {than} than it is."
    )


def _objective(settings: OptimiseSettings) -> str:
    if settings.objective == "charge":
        return "charge"
    name = {"reach": "debris distance", "time": "time until all rests", "vibration": "vibration"}[settings.objective]
    return f"{settings.quantile:g} quantile of the {name}"
