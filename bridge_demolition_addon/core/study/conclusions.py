"""Conclusions of a study: all that its runs say of the next one, once every one of them is there."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import OutputError
from .runs_table import REACH, RunsTable
from .statements import Chance, LimitsAtOnce, ReachLimit, as_json, chance_of, limits_at_once, reach_limit


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


def conclusions(
    table: RunsTable,
    *,
    runs: int,
    quantile: float,
    confidence: float,
    rank: int,
    criteria: Sequence[str] = (),
    at_once: Sequence[str] = (),
) -> Conclusions:
    """Return the conclusions of a study.

    Parameters
    ----------
    table
        All of its runs.
    runs, quantile, confidence, rank
        What was fixed beforehand.
    criteria
        Names of outputs that say whether a run met something.
    at_once
        Names of outputs for which limits are to hold together: the worse, the larger.

    Raises
    ------
    OutputError
        Not all runs are there: who stops when a result pleases has no confidence to state.
    ScenarioError
        The runs are too few for what was asked.
    """
    if len(table) != runs:
        raise OutputError(f"{len(table)} of {runs} runs are there: a study says nothing before all of them are")
    met = [table.met(name) for name in criteria]
    return Conclusions(
        statuses=dict(sorted(Counter(row.status for row in table.rows).items())),
        reach=reach_limit(table.largest(REACH), quantile, confidence, rank),
        criteria=tuple(
            chance_of(f"met the criterion {name}", each, confidence) for name, each in zip(criteria, met, strict=True)
        ),
        success=chance_of("met all criteria", np.all(met, axis=0), confidence) if met else None,
        at_once=limits_at_once({name: table.largest(name) for name in at_once}, quantile, confidence),
    )
