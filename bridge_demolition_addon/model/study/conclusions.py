"""Conclusions of a study: all that its runs say of the next one, once every one of them is there."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...errors import OutputError
from .file import Study
from .runs_table import REACH, RunsTable
from .statements import Chance, LimitsAtOnce, ReachLimit, as_json, chance_of, limits_at_once, reach_limit

AT_ONCE = (REACH, "largest_throw_m")
"""Outputs for which limits are to hold together: as many as the fewest runs of a study by default allow."""


@dataclass(frozen=True, eq=False, slots=True)
class Conclusions:
    """What a study says.

    Attributes
    ----------
    statuses : dict
        How many runs ended in each way.
    reach
        How far debris gets.
    criteria
        How likely each criterion is met, in the order of the study.
    success
        How likely all of them are; None where there are none.
    at_once
        Limits of several outputs that hold together; None where the runs are too few for them.
    """

    statuses: dict[str, int]
    reach: ReachLimit
    criteria: tuple[Chance, ...]
    success: Chance | None
    at_once: LimitsAtOnce | None

    def as_json(self) -> dict[str, Any]:
        """Return them as ``study.json`` has them."""
        return {
            "statuses": self.statuses,
            "reach": as_json(self.reach),
            "criteria": [as_json(each) for each in self.criteria],
            "success": self.success and as_json(self.success),
            "at_once": self.at_once and as_json(self.at_once),
        }


def words_of_inputs(study: Study) -> list[str]:
    """Return what varies, as the study names it: a key of all tables of a list only once."""
    return [vary.key for vary in study.settings.vary] + ["the seed of the fracture"]


def sentences(study: Study, said: Conclusions) -> Iterator[str]:
    """Yield what a study says, the limit of the reach first."""
    exclusion = study.scenario.exclusion
    buffer_m = exclusion.buffer_m if exclusion else None
    yield said.reach.sentence(words_of_inputs(study), study.settings.least_mass_kg, buffer_m)
    if math.isfinite(said.reach.limit_m):
        yield said.reach.spread_sentence
    for each in said.criteria:
        yield each.success_sentence
    if said.success and len(said.criteria) > 1:
        yield said.success.success_sentence


def conclusions(study: Study, table: RunsTable) -> Conclusions:
    """Return the conclusions of a study from the table of all its runs.

    Raises
    ------
    OutputError
        Not all runs are there: who stops when a result pleases has no confidence to state.
    ScenarioError
        The runs are too few for what was asked.
    """
    settings = study.settings
    if len(table) != settings.runs:
        raise OutputError(
            f"{len(table)} of {settings.runs} runs are there: a study says nothing before all of them are"
        )
    confidence = settings.confidence
    met = [table.met(each.output) for each in study.criteria]
    return Conclusions(
        statuses=dict(sorted(Counter(row.status for row in table.rows).items())),
        reach=reach_limit(table.largest(REACH), settings.quantile, confidence, settings.rank),
        criteria=tuple(
            chance_of(f"met the criterion {criterion.name}", each, confidence)
            for criterion, each in zip(study.criteria, met, strict=True)
        ),
        success=chance_of("met all criteria", np.all(met, axis=0), confidence) if met else None,
        at_once=limits_at_once({name: table.largest(name) for name in AT_ONCE}, settings.quantile, confidence),
    )
