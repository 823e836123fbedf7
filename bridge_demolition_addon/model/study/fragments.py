"""How far fragments of blast zones fly in the runs of a study: within a factor of 2, and no safety distance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...engineering.drilled_charges.fragments import Ranges
from ...engineering.statistics.order_limits import achieved_confidence, least_runs, nth_largest
from ..bridge.preparation import prepared_members
from ..scenario import Scenario
from ..structure.charge_plan import flyrock_of_run
from .runs_table import RunsTable

HALF, MOST, NEARLY_ALL, FARTHEST = "fragments_50_m", "fragments_99_m", "fragments_99_9_m", "fragments_farthest_m"
"""Outputs: distances on plan from the middle of its zone that parts of the mass in fragments stay within, of the zone
whose fragments fly farthest."""

LUNDBORG, MCKENZIE = "lundborg_m", "mckenzie_m"
"""Outputs: the largest distances by two rules, as if nothing covered the holes."""


@dataclass(frozen=True, slots=True)
class FragmentLimits:
    """Upper tolerance limits of how far fragments fly, each by itself; infinite where there are too few runs."""

    runs: int
    quantile: float  # asked beforehand: part of all runs that each limit is for
    confidence: float  # asked beforehand
    rank: int  # asked beforehand: which of the largest distances of the runs they are
    achieved_confidence: float
    half_m: float  # for the distance that 50 % of the mass stays within
    most_m: float  # 99 %
    nearly_all_m: float  # 99.9 %
    largest_m: float  # for the farthest fragment
    lundborg_m: float  # the largest of the runs
    mckenzie_m: float

    @property
    def are_known(self) -> bool:
        """Whether there are limits."""
        return math.isfinite(self.nearly_all_m)

    @property
    def ranges(self) -> Ranges:
        """Return them as the ranges of a zone."""
        return Ranges(self.half_m, self.most_m, self.nearly_all_m, self.largest_m)


def fragment_outputs(scenario: Scenario) -> dict[str, float]:
    """Return the outputs of a run; nothing without blast zones, and 0 where none of them fires."""
    if not scenario.blast_zones:
        return {}
    flown = flyrock_of_run(scenario, prepared_members(scenario).members)
    sampled = [of.sampled for of in flown]
    return {
        HALF: max((ranges.half_m for ranges in sampled), default=0.0),
        MOST: max((ranges.most_m for ranges in sampled), default=0.0),
        NEARLY_ALL: max((ranges.nearly_all_m for ranges in sampled), default=0.0),
        FARTHEST: max((ranges.largest_m for ranges in sampled), default=0.0),
        LUNDBORG: max((of.lundborg_m for of in flown), default=0.0),
        MCKENZIE: max((of.mckenzie_m for of in flown), default=0.0),
    }


def fragment_limits(table: RunsTable, quantile: float, confidence: float, rank: int) -> FragmentLimits | None:
    """Return the limits from the table of all runs of a study; None without blast zones, as in earlier studies."""
    if NEARLY_ALL not in table.outputs:
        return None
    runs = len(table)
    has_enough = runs >= least_runs(quantile, confidence, rank)
    limits = [
        nth_largest(table.largest(name), rank) if has_enough else math.inf
        for name in (HALF, MOST, NEARLY_ALL, FARTHEST)
    ]
    by_rule = [float(np.max(table.output(name)[table.done], initial=0.0)) for name in (LUNDBORG, MCKENZIE)]
    achieved = achieved_confidence(rank, runs, quantile) if runs >= rank else 0.0
    return FragmentLimits(runs, quantile, confidence, rank, achieved, *limits, *by_rule)
