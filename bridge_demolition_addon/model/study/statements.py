"""What is said of the next run after many: limits and probabilities, each with its confidence, in one sentence each.

They hold where runs are independent draws, and where their number, the rank and what is asked were fixed beforehand. A
run that did not finish is one of unlimited reach that met no criterion. Numbers in sentences are rounded to the side of
safety, so that a sentence is true as it stands.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from typing import Any

import numpy as np

from ...engineering.statistics.order_limits import confidence_of, least_runs, most_touching, nth_largest, share_within
from ...engineering.statistics.proportions import lower_limit, upper_limit
from ...engineering.statistics.repetition import repeated_limit
from ...errors import ScenarioError

_MOST_INPUTS_NAMED = 6


def check_runs(runs: int, quantile: float, confidence: float, rank: int) -> None:
    """Make sure that a study of so many runs can say what it is asked.

    Raises
    ------
    ScenarioError
        It has too few runs; the text says how many it needs.
    """
    needed = least_runs(quantile, confidence, rank)
    if runs < needed:
        first = least_runs(quantile, confidence)
        other = f", or {first} with study.rank = 1" if first < needed else ""
        raise ScenarioError(
            f"study.runs is {runs}: expected at least {needed}{other}, so that the {ordinal(rank)} reach is one that "
            f"{percent(quantile)} of all runs stay within, with {percent(confidence)} confidence"
        )


@dataclass(frozen=True, slots=True)
class ReachLimit:
    """How far debris gets from the bridge's plan.

    Attributes
    ----------
    runs, unfinished : int
        How many runs there are, and how many of them did not finish.
    quantile, confidence, rank
        What was asked beforehand: which share of all runs the limit is for, how sure, and which of the farthest reaches
        it is.
    limit_m : float
        The limit; infinity where too many runs did not finish.
    farther : int
        How many of the runs went farther, unfinished ones included.
    sure : float
        Confidence that the quantile stays within: no less than was asked.
    share : float
        Share of all runs that stays within with the confidence asked: no less than the quantile.
    again_above_m, again_below_m : float
        With the confidence each, a study of as many other draws has its limit above the first, and not above the
        second: minus infinity and infinity where so few runs do not say.
    again_beyond : float
        How likely its limit is larger than every reach of these runs.
    """

    runs: int
    unfinished: int
    quantile: float
    confidence: float
    rank: int
    limit_m: float
    farther: int
    sure: float
    share: float
    again_above_m: float
    again_below_m: float
    again_beyond: float

    def sentence(self, inputs: Sequence[str], least_mass_kg: float, buffer_m: float | None) -> str:
        """Return the statement.

        Parameters
        ----------
        inputs
            What was drawn for each run, in words.
        least_mass_kg
            Lightest shard that counts.
        buffer_m
            What the scenario adds for what the model leaves out; None where it says nothing.
        """
        if math.isinf(self.limit_m):
            return (
                f"These runs set no limit: {self.unfinished} of {self.runs} did not finish, each of them counts as one "
                f"of unlimited reach, and the limit was to be the {ordinal(self.rank)} reach. Find out why they "
                "stopped, and make the study again without that."
            )
        debris = f"debris of {least_mass_kg:g} kg or more" if least_mass_kg > 0.0 else "debris"
        most = f"all but {self.farther}" if self.farther else "all of them"
        ended = f", {self._unfinished_in_words}" if self.unfinished else ""
        added = "a buffer has to be added"
        if buffer_m is not None:
            added = f"the buffer of {buffer_m:g} m is added, {rounded_up(self.limit_m + buffer_m, '0.1')} m in all"
        limit, drawn = rounded_up(self.limit_m, "0.1"), "was drawn" if len(inputs) == 1 else "were drawn"
        return (
            f"In {self.runs} independent runs, in which {listed(inputs)} {drawn} from the distributions of this study, "
            f"{debris} stayed within {limit} m of the bridge's plan in {most}{ended}. With {percent(self.confidence)} "
            f"confidence at least {percent(self.quantile)} of such runs stay within it. This says how the model "
            "scatters; it does not cover what the model leaves out, such as pieces smaller than a shard, for which "
            f"{added}."
        )

    @property
    def _unfinished_in_words(self) -> str:
        if self.unfinished < self.farther:
            return f"{self.unfinished} of which did not finish"
        return "which did not finish" if self.unfinished == 1 else "none of which finished"

    @property
    def spread_sentence(self) -> str:
        """Return how much the limit itself is chance."""
        ends = []
        if math.isfinite(self.again_above_m):
            ends.append(f"above {rounded_down(self.again_above_m, '0.1')} m")
        if math.isfinite(self.again_below_m):
            ends.append(f"not above {rounded_up(self.again_below_m, '0.1')} m")
        sure = f"with {percent(self.confidence)} confidence{' each' if len(ends) > 1 else ''}"
        within = f"its limit would lie {' and '.join(ends)}, {sure}; " if ends else ""
        return (
            f"Were the study made once more, with other draws, {within}in {percent_up(self.again_beyond)} of such "
            "studies it would lie beyond every reach seen here."
        )


def reach_limit(reaches_m: np.ndarray, quantile: float, confidence: float, rank: int) -> ReachLimit:
    """Return the limit of the reach.

    Parameters
    ----------
    reaches_m : (n,) float
        Of all runs; infinity for each that did not finish.
    quantile, confidence, rank
        What was asked beforehand.

    Raises
    ------
    ScenarioError
        There are too few runs.
    """
    runs = len(reaches_m)
    check_runs(runs, quantile, confidence, rank)
    limit_m = nth_largest(reaches_m, rank)
    above_m, below_m, beyond = repeated_limit(reaches_m, rank, confidence)
    return ReachLimit(
        runs=runs,
        unfinished=int(np.isinf(reaches_m).sum()),
        quantile=quantile,
        confidence=confidence,
        rank=rank,
        limit_m=limit_m,
        farther=int((reaches_m > limit_m).sum()),
        sure=confidence_of(rank, runs, quantile),
        share=share_within(rank, runs, confidence),
        again_above_m=above_m,
        again_below_m=below_m,
        again_beyond=beyond,
    )


@dataclass(frozen=True, slots=True)
class Chance:
    """How likely a run does something that is fixed beforehand, such as meet a criterion or leave a zone.

    Attributes
    ----------
    what : str
        What it does: ``the runs that …``.
    happened, runs : int
        How many of the runs did it, and how many there are.
    confidence : float
        Of each of the limits by itself.
    at_least, at_most : float
        Limits of the probability, after Clopper and Pearson.
    """

    what: str
    happened: int
    runs: int
    confidence: float
    at_least: float
    at_most: float

    @property
    def success_sentence(self) -> str:
        """Return the statement where it is good that it happens."""
        return (
            f"{self._counted}. With {percent(self.confidence)} confidence at least {percent_down(self.at_least)} of "
            "such runs do."
        )

    @property
    def harm_sentence(self) -> str:
        """Return the statement where it is bad that it happens."""
        return (
            f"{self._counted}. With {percent(self.confidence)} confidence at most {percent_up(self.at_most)} of such "
            "runs do."
        )

    @property
    def _counted(self) -> str:
        counts = {0: f"None of {self.runs}", self.runs: f"All {self.runs}"}
        return f"{counts.get(self.happened, f'{self.happened} of {self.runs}')} runs {self.what}"


def chance_of(what: str, happened: np.ndarray, confidence: float) -> Chance:
    """Return how likely something is that happened (n,) in some of the runs."""
    count, runs = int(happened.sum()), len(happened)
    return Chance(
        what,
        count,
        runs,
        confidence,
        float(lower_limit(count, runs, confidence)),
        float(upper_limit(count, runs, confidence)),
    )


@dataclass(frozen=True, slots=True)
class LimitsAtOnce:
    """Limits of several outputs that hold together, after Guba, Makai and Pál.

    Attributes
    ----------
    quantile, confidence
        Which share of all runs stays below all of them at once, and how sure that is.
    limits : dict
        Of each output by its name.
    ranks : dict
        Which of its largest values each limit is.
    """

    quantile: float
    confidence: float
    limits: dict[str, float]
    ranks: dict[str, int]


def limits_at_once(outputs: Mapping[str, np.ndarray], quantile: float, confidence: float) -> LimitsAtOnce | None:
    """Return limits of several outputs that hold together; None where the runs are too few for so many.

    Parameters
    ----------
    outputs : dict of (n,) float
        Values in all runs by name, infinity where a run did not finish. Which they are is to be fixed beforehand.
    quantile, confidence
        What the limits have to hold together.
    """
    runs = min(map(len, outputs.values()), default=0)
    touching = most_touching(runs, quantile, confidence) if runs else 0
    if touching < max(len(outputs), 1):
        return None
    # All of them together may touch so many runs; what does not divide evenly goes to the first.
    each, more = divmod(touching, len(outputs))
    ranks = {name: each + (number < more) for number, name in enumerate(outputs)}
    limits = {name: nth_largest(values, ranks[name]) for name, values in outputs.items()}
    return LimitsAtOnce(quantile, confidence, limits, ranks)


def verified_sentence(left: Chance, quantile: float) -> str:
    """Return what runs that left a zone, or did not, say of it; it was fixed before any of them."""
    if left.at_most <= 1.0 - quantile:
        meaning = f"So it holds {percent(quantile)} of such runs"
    else:
        needed = [least_runs(quantile, left.confidence, rank) for rank in (1, 2)]
        meaning = (
            f"That does not show that it holds {percent(quantile)} of them: {needed[0]} runs would, of which none "
            f"leaves it, or {needed[1]}, of which one does"
        )
    return (
        f"{left.harm_sentence} {meaning}. This is so where the zone was fixed before these runs; if it was made from a "
        "study, that has to have had another seed."
    )


def shape_sentence(corners: int, quantile: float, confidence: float) -> str:
    """Return why a zone that is drawn around runs holds less than it seems to, and what to do instead.

    Parameters
    ----------
    corners
        Of the convex hull of what the runs covered: each may be another run's.
    quantile, confidence
        What is asked of it.
    """
    return (
        "A zone that is drawn around what these runs covered is no such limit: the runs chose its shape, whose convex "
        f"hull has {corners} corners. Even had their number been fixed beforehand, such a zone would be known to hold "
        f"{percent(quantile)} of other runs, with {percent(confidence)} confidence, only from "
        f"{least_runs(quantile, confidence, corners)} runs on. Take the limit instead, whose shape was fixed before "
        "the first run, or verify the zone: write it into [[zones]] of the scenario, give the study another seed, and "
        "ask bda study with --verify what its runs say."
    )


def as_json(statement: Any) -> dict[str, Any]:
    """Return a statement as JSON has it: what has no end is null."""
    return {name: _finite(value) for name, value in asdict(statement).items()}


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _finite(each) for name, each in value.items()}
    return None if isinstance(value, float) and not math.isfinite(value) else value


def listed(names: Sequence[str]) -> str:
    """Return names in a sentence; of many only how many there are."""
    if len(names) > _MOST_INPUTS_NAMED:
        return f"{len(names)} quantities"
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def ordinal(rank: int) -> str:
    """Return ``largest``, ``2nd largest`` and so on."""
    if rank == 1:
        return "largest"
    ending = "th" if rank % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(rank % 10, "th")
    return f"{rank}{ending} largest"


def percent(share: float) -> str:
    """Return a share that somebody chose, with the digits it has."""
    return f"{100.0 * share:.10g} %"


def percent_up(share: float) -> str:
    """Return a share in percent, rounded up to the second decimal."""
    return f"{rounded_up(100.0 * share, '0.01')} %"


def percent_down(share: float) -> str:
    """Return a share in percent, rounded down to the second decimal."""
    return f"{rounded_down(100.0 * share, '0.01')} %"


def rounded_up(value: float, step: str) -> str:
    """Return a number, rounded up to a decimal step such as 0.1; what binary fractions leave of one does not count."""
    return str(_short(value).quantize(Decimal(step), ROUND_CEILING))


def rounded_down(value: float, step: str) -> str:
    """Return a number, rounded down to a decimal step; see `rounded_up`."""
    return str(_short(value).quantize(Decimal(step), ROUND_FLOOR))


def _short(value: float) -> Decimal:
    return Decimal(f"{value:.9f}")
