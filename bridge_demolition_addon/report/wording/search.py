"""Sentences on the answer of a search."""

from __future__ import annotations

from ...model.schema import given
from ...model.search.conclusions import FALLING, NEVER, Answer
from .numbers import four_digits


def search_sentences(answer: Answer) -> list[str]:
    """Return what a search states, in plain words."""
    search, settings = answer.search, answer.search.settings
    unit = f" {search.unit}" if search.unit else ""
    counted = f"{answer.successes} of {answer.runs} runs met all criteria: {answer.ended_as or 'the search goes on'}."
    if answer.value is None:
        return [counted, _advice(answer)]
    sentences = [
        counted,
        f"{settings.key}: half of all runs meet them at {four_digits(given(answer.median))}{unit}, and "
        f"{settings.probability:.4g} of all at {four_digits(answer.value)}{unit}, most likely.",
    ]
    where = "or more" if settings.success == "above" else "or less"
    if answer.is_known:
        sentences.append(
            f"With {settings.confidence:.4g} confidence, {settings.probability:.4g} of all runs meet them at "
            f"{four_digits(answer.limit)}{unit} {where}."
        )
        if not settings.lowest <= answer.limit <= settings.highest:
            sentences.append("That is outside the range in which runs were made: it rests on the shape of the curve.")
    else:
        sentences.append("The runs set no limit yet: raise search.trials, and start the search again.")
    if key := _limiting_end(answer):
        sentences.append(f"The median is at the end of the range or beyond it: move search.{key}.")
    _, low, high = answer.without_model
    sentences.append(
        f"Without a model of how the probability rises, the median is {four_digits(low)} to {four_digits(high)}{unit} "
        f"with {settings.confidence:.4g} probability."
    )
    return sentences


def _limiting_end(answer: Answer) -> str | None:
    """Which end of the range keeps runs away from the median; None where it is well within."""
    scale = answer.search.scale
    low, high = scale.ends
    level = scale.level(given(answer.median))
    margin = 0.02 * (high - low)
    if low + margin < level < high - margin:
        return None
    return "lowest" if (level <= low + margin) != scale.is_falling else "highest"


def _advice(answer: Answer) -> str:
    settings = answer.search.settings
    if answer.ended_as == FALLING:
        return f'Try search.success = "{"below" if settings.success == "above" else "above"}".'
    key = "highest" if (answer.ended_as == NEVER) == (settings.success == "above") else "lowest"
    return f"Runs went from {settings.lowest:g} to {settings.highest:g}: move search.{key}, or ask for something else."
