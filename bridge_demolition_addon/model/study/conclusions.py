"""Conclusions of a study: numbers that its runs state about further runs, each with its confidence.

They hold where runs are independent, and where their number, the rank and what is asked were fixed beforehand. A run
that did not finish counts as one of unlimited debris distance that met no criterion. ``report/wording`` has sentences.

A zone that is drawn around runs holds these runs, and says little of others. One that stands in the scenario was fixed
before any run of that scenario; so how many of these leave it says how likely the next one does.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from manifold3d import CrossSection

from ...engineering.drilled_charges.fragments import Ranges
from ...engineering.geometry.plan_areas import signed_area
from ...engineering.statistics.binomial import lower_limit, upper_limit
from ...engineering.statistics.order_limits import (
    achieved_confidence,
    coverage,
    least_runs,
    most_support,
    nth_largest,
    repeated_limit,
)
from ...errors import OutputError
from ...texts import Text
from ..bridge.preparation import prepared_members
from ..scenario import Scenario, Zone
from ..structure.charge_plan import flyrock_of_run
from .criteria import part_of_output
from .file import Study
from .runs_table import REACH, TRUSTED_REACH, RunsTable

HALF, MOST, NEARLY_ALL, FARTHEST = "fragments_50_m", "fragments_99_m", "fragments_99_9_m", "fragments_farthest_m"
"""Outputs: distances on plan from the middle of its zone that parts of the mass in fragments stay within, of the zone
whose fragments fly farthest."""

LUNDBORG, MCKENZIE = "lundborg_m", "mckenzie_m"
"""Outputs: the largest distances by two rules, as if nothing covered the holes."""


@dataclass(frozen=True, slots=True)
class FragmentLimits:
    """Upper tolerance limits of how far fragments fly, each by itself; infinite where there are too few runs."""

    runs: int
    quantile: float  # asked beforehand: part of the runs that each limit is for
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
    """Return the limits from the table of a study's runs; None without blast zones, as in earlier studies."""
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


SIMULTANEOUS = (REACH, "largest_throw_m")
"""Outputs whose limits hold together: as many as the fewest runs of a study by default allow."""

_JSON_NAMES = {
    "exceedances": "farther",
    "achieved_confidence": "sure",
    "coverage": "share",
    "repeat_above_m": "again_above_m",
    "repeat_below_m": "again_below_m",
    "repeat_exceedance": "again_beyond",
    "count": "happened",
}
"""What ``study.json`` calls some of these numbers."""


@dataclass(frozen=True, slots=True)
class DebrisLimit:
    """Limit of the distance of debris from the bridge's plan."""

    runs: int
    unfinished: int  # runs that did not finish
    quantile: float  # asked beforehand: part of the runs that the limit is for
    confidence: float  # asked beforehand: its confidence
    rank: int  # asked beforehand: which of the largest distances it is
    runs_needed: int  # least number of runs for a limit
    limit_m: float  # infinite where there are too few runs, or too many that did not finish
    exceedances: int  # runs beyond the limit, unfinished ones included
    achieved_confidence: float  # that the quantile stays within the limit
    coverage: float  # part of the runs that stays within the limit with the confidence asked
    repeat_above_m: float  # a study of as many other runs has its limit above this with the confidence; -inf if unknown
    repeat_below_m: float  # and not above this; inf if unknown
    repeat_exceedance: float  # probability that its limit is larger than every distance of these runs
    runout_factor: float = 1.0  # asked beforehand: on the limit, for what loose blocks run out short

    def to_keep_m(self, buffer_m: float | None = None) -> float:
        """Return the distance to keep, m: the limit with the factor for runout, and a buffer if there is one."""
        return self.limit_m * self.runout_factor + (buffer_m or 0.0)

    @property
    def has_enough_runs(self) -> bool:
        """Whether there are as many runs as a limit needs."""
        return self.runs >= self.runs_needed

    @property
    def is_known(self) -> bool:
        """Whether there is a limit."""
        return math.isfinite(self.limit_m)


@dataclass(frozen=True, slots=True)
class DoubtfulThrows:
    """Throws that nothing explains but the solver, in the runs of a study."""

    throws: int
    runs: int  # with such throws
    judged: int  # runs where it is known
    limit_m: float  # of the debris distance without them; infinite as the limit with them


@dataclass(frozen=True, slots=True)
class Proportion:
    """How often runs do something that was fixed beforehand: `what` ends ``runs that …``."""

    what: str
    count: int  # how many of the runs did it
    runs: int
    confidence: float  # of each limit by itself
    at_least: float  # limit of the probability, after Clopper and Pearson
    at_most: float  # also


@dataclass(frozen=True, slots=True)
class SimultaneousLimits:
    """Limits of several outputs that hold together, after Guba, Makai and Pál."""

    quantile: float  # part of the runs that stays below all limits at once
    confidence: float  # of that
    limits: dict[str, float]  # by name of the output
    ranks: dict[str, int]  # which of its largest values each limit is


@dataclass(frozen=True, eq=False, slots=True)
class Conclusions:
    """What a study states."""

    statuses: dict[str, int]  # number of runs that ended in each way
    reach: DebrisLimit
    criteria: tuple[Proportion, ...]  # in the order of the study
    success: Proportion | None  # all criteria at once; None without criteria
    at_once: SimultaneousLimits | None  # None where there are too few runs
    doubtful: DoubtfulThrows | None  # None where no run knows of any, as in studies of earlier versions
    still_moving: int = 0  # runs that ended before everything rested: their distances are not final
    single_moving: int = 0  # runs that rested as a whole, while single shards still moved
    fragments: FragmentLimits | None = None  # None without blast zones
    standing: tuple[Proportion, ...] = ()  # how often each span and pier, `what`, is not down

    def as_json(self) -> dict[str, Any]:
        """Return them as ``study.json`` has them."""
        return {
            "statuses": self.statuses,
            "reach": as_json(self.reach),
            "criteria": [as_json(criterion) for criterion in self.criteria],
            "success": self.success and as_json(self.success),
            "at_once": self.at_once and as_json(self.at_once),
            "doubtful_throws": self.doubtful and as_json(self.doubtful),
            "still_moving": self.still_moving,
            "single_moving": self.single_moving,
            **({"fragments": as_json(self.fragments)} if self.fragments else {}),
            "standing": [as_json(part) for part in self.standing],
        }


def conclusions(study: Study, table: RunsTable) -> Conclusions:
    """Return the conclusions of a study from the table of its runs."""
    settings = study.settings
    if len(table) != settings.runs:
        raise OutputError(
            f"{len(table)} of {settings.runs} runs are there: a study states nothing before all of them are"
        )
    confidence = settings.confidence
    met = [table.met(criterion.output) for criterion in study.criteria]
    return Conclusions(
        statuses=dict(sorted(Counter(row.status for row in table.rows).items())),
        reach=replace(
            debris_limit(table.largest(REACH), settings.quantile, confidence, settings.rank),
            runout_factor=settings.runout_factor,
        ),
        criteria=tuple(
            proportion(Text("met the criterion {}", criterion.name), which, confidence)
            for criterion, which in zip(study.criteria, met, strict=True)
        ),
        success=proportion(Text("met all criteria"), np.all(met, axis=0), confidence) if met else None,
        at_once=simultaneous_limits(
            {name: table.largest(name) for name in SIMULTANEOUS}, settings.quantile, confidence
        ),
        doubtful=_doubtful_throws(study, table),
        still_moving=table.still_moving,
        single_moving=table.single_moving,
        fragments=fragment_limits(table, settings.quantile, confidence, settings.rank),
        standing=tuple(_standing(table, confidence)),
    )


def _standing(table: RunsTable, confidence: float) -> Iterator[Proportion]:
    """Yield how often each span and pier is not down at the end; a run that did not finish brought nothing down."""
    for name in table.outputs:
        part = part_of_output(name)
        if part is None or not np.isfinite(table.output(name)).any():
            continue
        yield proportion(part, ~table.fallen(name), confidence)


def _doubtful_throws(study: Study, table: RunsTable) -> DoubtfulThrows | None:
    settings = study.settings
    counts = [int(row.outputs["doubtful_throws"]) for row in table.rows if row.outputs.get(TRUSTED_REACH) is not None]
    if not counts:
        return None
    known = table.done & np.isfinite(table.largest(TRUSTED_REACH))
    distances_m = np.where(known, table.largest(TRUSTED_REACH), table.largest(REACH))
    limit = debris_limit(distances_m, settings.quantile, settings.confidence, settings.rank)
    return DoubtfulThrows(sum(counts), sum(count > 0 for count in counts), len(counts), limit.limit_m)


def debris_limit(distances_m: np.ndarray, quantile: float, confidence: float, rank: int) -> DebrisLimit:
    """Return the limit of the runs' distances (n,); infinity for each that did not finish."""
    runs, needed = len(distances_m), least_runs(quantile, confidence, rank)
    limit_m = nth_largest(distances_m, rank) if runs >= needed else math.inf
    has_rank = runs >= rank
    repeated = repeated_limit(distances_m, rank, confidence) if has_rank else (-math.inf, math.inf, 1.0)
    return DebrisLimit(
        runs=runs,
        unfinished=int(np.isinf(distances_m).sum()),
        quantile=quantile,
        confidence=confidence,
        rank=rank,
        runs_needed=needed,
        limit_m=limit_m,
        exceedances=int((distances_m > limit_m).sum()),
        achieved_confidence=achieved_confidence(rank, runs, quantile) if has_rank else 0.0,
        coverage=coverage(rank, runs, confidence) if has_rank else 0.0,
        repeat_above_m=repeated[0],
        repeat_below_m=repeated[1],
        repeat_exceedance=repeated[2],
    )


def proportion(what: str, which: np.ndarray, confidence: float) -> Proportion:
    """Return how often runs do something, by which (n,) of them did."""
    count, runs = int(which.sum()), len(which)
    at_least, at_most = (float(limit(count, runs, confidence)) for limit in (lower_limit, upper_limit))
    return Proportion(what, count, runs, confidence, at_least, at_most)


def simultaneous_limits(
    outputs: Mapping[str, np.ndarray], quantile: float, confidence: float
) -> SimultaneousLimits | None:
    """Return limits of several outputs that hold together; None where there are too few runs for their number.

    The runs' values (n,) are infinite where a run did not finish. Choose the outputs before the runs.
    """
    runs = min(map(len, outputs.values()), default=0)
    support = most_support(runs, quantile, confidence) if runs else 0
    if support < max(len(outputs), 1):
        return None
    # This many runs may set them together; what does not divide evenly goes to the first.
    share, rest = divmod(support, len(outputs))
    ranks = {name: share + (number < rest) for number, name in enumerate(outputs)}
    limits = {name: nth_largest(values, ranks[name]) for name, values in outputs.items()}
    return SimultaneousLimits(quantile, confidence, limits, ranks)


def as_json(statement: Any) -> dict[str, Any]:
    """Return a statement as JSON has it."""
    return {_JSON_NAMES.get(name, name): finite(value) for name, value in asdict(statement).items()}


def finite(value: Any) -> Any:
    """Return a value as JSON has it, also one in a dictionary or a list: a number that is not finite is null."""
    if isinstance(value, dict):
        return {name: finite(inner) for name, inner in value.items()}
    if isinstance(value, list | tuple):
        return [finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


_BEYOND_M2 = 1e-4
"""Area beyond a zone that counts; outlines are kept to a millimetre."""


def zone_area(zone: Zone) -> CrossSection:
    """Return what a zone covers in plan."""
    corners = np.array(zone.corners_m, float)
    return CrossSection([corners if signed_area(corners) > 0.0 else corners[::-1]])


def holds(zone: Zone, area: CrossSection) -> bool:
    """Return whether an area lies within a zone."""
    return (area - zone_area(zone)).area() <= _BEYOND_M2


def proportion_leaving(zone: Zone, swept: Iterable[Sequence[np.ndarray] | None], confidence: float) -> Proportion:
    """Return how often debris leaves a zone in plan that was fixed before the runs.

    Each run has outlines (k, 2) of what its debris covered at any time, or None where it did not finish, which counts
    as one that left the zone.
    """
    left = [rings is None or (bool(len(rings)) and not holds(zone, CrossSection(list(rings)))) for rings in swept]
    return proportion(Text("left the zone {}", zone.name), np.array(left, bool), confidence)
