"""What changes with the number of shards, as it was measured: said of the scenario at hand."""

from __future__ import annotations

from collections.abc import Iterator

from ..actions import Fact
from ..scenario import Scenario

DEBRIS_M = {50: 2.6, 100: 3.5, 200: 3.8, 400: 7.0}
"""Debris distance of a drilled span of 13 m by its shards, the median of the seeds in docs/data/convergence.csv."""

SAG_M = {100: 0.055, 200: 0.058, 400: 0.064}
"""Deflection of a reinforced span of 13 m under a ball of 10 t by the shards of two of them, from
docs/data/reinforced_deck.csv."""


def convergence_facts(scenario: Scenario, shards: int) -> Iterator[Fact]:
    """Yield how much finer and coarser cuts changed the outcome of a demolition of the same kind."""
    if scenario.bridge is None:
        return
    spans = len(scenario.bridge.span_lengths_m)
    here = f"here {shards / spans:.0f} shards a span: docs/choosing.md says what to take"
    if scenario.blast_zones or scenario.charges:
        yield "debris distance", f"of a drilled span in {_listed(DEBRIS_M, 1, 'm')}, the median over seeds;"
        yield "", here
    elif scenario.ball:
        halves = {count // 2: sag for count, sag in SAG_M.items()}
        yield "dent of a ball", f"in a span in {_listed(halves, 3, 'm')}, the median over seeds;"
        yield "", here


def _listed(found: dict[int, float], digits: int, unit: str) -> str:
    counts = ", ".join(map(str, found))
    values = ", ".join(f"{value:.{digits}f}" for value in found.values())
    return f"{counts} shards: {values} {unit}"
