# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/validation.md says of blind forecasts."""

from __future__ import annotations

import statistics
from collections.abc import Iterator, Sequence

from blind import BlindCase, Foreseen, Outcome, kept_forecast, kept_outcome

_HEAD = """Forecasts that were committed before the outcome was opened: set-up, numbers and ranges first, then what was
measured. A forecast is never made again, and one that misses stays here. `git show COMMIT` has the forecast and no
outcome; how to add one: [CONTRIBUTING.md](../CONTRIBUTING.md#blind-forecasts)."""


def section(cases: Sequence[BlindCase]) -> list[str]:
    """Return the lines of the section: how many hit, then each case."""
    lines = ["## Blind forecasts", "", _HEAD, "", "| case | within its range, of | forecast over measured |"]
    lines += ["| --- | --- | --- |", *(_overview(case) for case in cases), ""]
    for case in cases:
        lines += case_lines(case)
    return lines


def compared(name: str) -> Iterator[tuple[Foreseen, float]]:
    """Yield what was foreseen in a case beside what was measured, where that is known."""
    outcome = kept_outcome(name)
    measured = outcome.measured if outcome else ()
    for foreseen, value in zip(kept_forecast(name).foreseen, measured, strict=bool(outcome)):
        if value is not None:
            yield foreseen, value


def _overview(case: BlindCase) -> str:
    pairs = list(compared(case.name))
    ratios = [foreseen.value / measured for foreseen, measured in pairs]
    hits = f"{sum(foreseen.has(measured) for foreseen, measured in pairs)} of {len(pairs)}"
    said = f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})" if ratios else "not opened"
    anchor = case.title.lower().replace(" ", "-")
    return f"| [{case.title}](#{anchor}) | {hits} | {said} |"


def case_lines(case: BlindCase) -> list[str]:
    """Return the lines of a case: what was known and assumed, what was foreseen and what was measured."""
    forecast, outcome = kept_forecast(case.name), kept_outcome(case.name)
    measured: Sequence[float | None] = outcome.measured if outcome else [None] * len(forecast.foreseen)
    return [
        f"### {case.title}",
        "",
        case.asked,
        "",
        f"*Known before*: {case.known}",
        "",
        f"*Assumed*: {case.assumed}",
        "",
        f"*Source*: {case.source}",
        "",
        "| quantity | forecast | its range | measured | forecast over measured | |",
        "| --- | --- | --- | --- | --- | --- |",
        *(_row(*pair) for pair in zip(forecast.foreseen, measured, strict=True)),
        "",
        *_outcome(outcome),
        f"Made on {forecast.made} with version `{forecast.version}`; `scripts/blind_forecast {case.name} --again "
        "--output DIR` prints what it would be now.",
        "",
    ]


def _row(foreseen: Foreseen, measured: float | None) -> str:
    value, low, high = (f"{number:.3g}" for number in (foreseen.value, foreseen.low, foreseen.high))
    first = f"| {foreseen.quantity} | {value} {foreseen.unit} | {low} to {high} {foreseen.unit} |"
    if measured is None:
        return f"{first} not known | | |"
    verdict = "" if foreseen.has(measured) else "**missed**"
    ratio = f"{foreseen.value / measured:.2f}" if measured else ""
    return f"{first} {measured:.3g} {foreseen.unit} | {ratio} | {verdict} |"


def _outcome(outcome: Outcome | None) -> list[str]:
    if outcome is None:
        return ["The outcome has not been opened.", ""]
    said = f"The forecast was committed in `{outcome.forecast_commit}`; the outcome was opened on {outcome.opened}."
    return [f"*What it says*: {outcome.learned}", "", said, ""]
