"""What a planner wants to know of decks on girders at rest: their studs, and how much of these they use."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...engineering.elasticity.equilibrium import Equilibrium
from ..actions import Fact
from ..scenario import Scenario
from ..scenario.girders import GirderSpan, StudRow
from ..scenario.scenario import studs_of
from .equilibrium import loads_of
from .model import Model


def deck_facts(scenario: Scenario, model: Model, rest: Equilibrium) -> Iterator[Fact]:
    """Yield how decks of a model at rest lie on their girders, without cracks."""
    if not model.decks or not scenario.steelwork:
        return
    for number, span in enumerate(scenario.steelwork.decks):
        studs = studs_of(span, scenario)
        if studs is None:
            loose = f"on {span.girders} girders without studs, with a friction of {span.deck_friction:g}"
            yield span.deck_name, loose
            continue
        yield span.deck_name, f"on {span.girders} girders, {_described(span, studs)}"
        mine = model.decks.only(model.decks.decks == number)
        counts = mine.studded_m * studs.per_m
        if (several := counts >= 1.0).any():
            yield from _used(scenario, model, rest, mine.rows[several], counts[several], studs)


def _described(span: GirderSpan, studs: StudRow) -> str:
    by = "by EN 1994-1-1, 6.6.3.1" if span.stud_diameter_mm is not None else "as given"
    return (
        f"{studs.per_m:g} studs/m on each: {studs.shear_n / 1e3:.1f} kN in shear ({by}), "
        f"{studs.uplift_n / 1e3:.1f} kN in uplift, {studs.stiffness_n_m / 1e6:.0f} kN/mm, no partial factors"
    )


def _used(
    scenario: Scenario, model: Model, rest: Equilibrium, rows: np.ndarray, counts: np.ndarray, studs: StudRow
) -> Iterator[Fact]:
    """Yield the shear and uplift of the stud that has most of each, of contacts with so many studs (c,), 1 or more."""
    forces, factor = loads_of(model, rest).forces_n[rows], scenario.connections.strength_factor
    shear = np.sqrt(np.square(forces[:, :2]).sum(axis=1)) / counts
    lifted = np.maximum(-forces[:, 2], 0.0) / counts
    for what, each, strength in (("shear", shear, studs.shear_n), ("uplift", lifted, studs.uplift_n)):
        row = int(each.argmax())
        place = model.connections.points[rows[row], 0]
        share = f"{each[row] / factor / strength:.0%}"
        yield f"studs in {what}", f"{each[row] / 1e3:.1f} kN each at most, {share}, at x = {place:.2f} m"
