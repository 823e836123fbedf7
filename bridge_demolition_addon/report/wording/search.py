"""Sentences on the answer of a search."""

from __future__ import annotations

from ...model.schema import given
from ...model.search.conclusions import FALLING, NEVER, Answer
from ...texts import Text
from .numbers import four_digits


def search_sentences(answer: Answer) -> list[str]:
    """Return what a search states, in plain words."""
    search, settings = answer.search, answer.search.settings
    counted = Text(
        "{} of {} runs met all criteria: {}.",
        answer.successes,
        answer.runs,
        Text(answer.ended_as or "the search goes on"),
    )
    if answer.value is None:
        return [counted, _advice(answer)]
    sentences: list[str] = [
        counted,
        Text(
            "{}: half of all runs meet them at {}, and {} of all at {}, most likely.",
            settings.key,
            search.amount(four_digits(given(answer.median))),
            f"{settings.probability:.4g}",
            search.amount(four_digits(answer.value)),
        ),
    ]
    if answer.is_known:
        sentences.append(
            Text(
                "With {} confidence, {} of all runs meet them at {}.",
                f"{settings.confidence:.4g}",
                f"{settings.probability:.4g}",
                Text(
                    "{} or more" if settings.success == "above" else "{} or less",
                    search.amount(four_digits(answer.limit)),
                ),
            )
        )
        if not settings.lowest <= answer.limit <= settings.highest:
            sentences.append(
                Text("That is outside the range in which runs were made: it rests on the shape of the curve.")
            )
    else:
        sentences.append(Text("The runs set no limit yet: raise search.trials, and start the search again."))
    if key := _limiting_end(answer):
        sentences.append(Text("The median is at the end of the range or beyond it: move search.{}.", key))
    _, low, high = answer.without_model
    sentences.append(
        Text(
            "Without a model of how the probability rises, the median is {} to {} with {} probability.",
            search.amount(four_digits(low), shown=False),
            search.amount(four_digits(high)),
            f"{settings.confidence:.4g}",
        )
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
        return Text('Try search.success = "{}".', "below" if settings.success == "above" else "above")
    key = "highest" if (answer.ended_as == NEVER) == (settings.success == "above") else "lowest"
    return Text(
        "Runs went from {} to {}: move search.{}, or ask for something else.",
        f"{settings.lowest:g}",
        f"{settings.highest:g}",
        key,
    )
