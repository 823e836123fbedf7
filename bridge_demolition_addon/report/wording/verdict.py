"""The verdict of a report in one sentence, and what goes with each debris distance: small fragments, a cordon."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ...engineering.units import rounded_up
from ...model.results.collapse import FALLEN, STANDS
from ...model.scenario import Scenario
from ...model.structure.charge_plan import ChargePlan, zone_name
from ...model.structure.zone_fragments import NO_SAFETY_DISTANCE
from ...model.study.conclusions import DebrisLimit, FragmentLimits
from ...texts import Text, distance_to_keep, joined
from .numbers import listed, percent

NO_LIMIT_OF_ONE_RUN = Text("one run gives no limit to plan with")

_NO_FRAMES = Text("No frame of this one run is there, only its logs: it has no verdict.")
_NO_SHARDS = Text("This one run has no shards: there is no bridge to judge.")


def run_verdict(lost: Mapping[str, float], distance_m: float, end: str, *, is_final: bool = True) -> str:
    """Return what one run came out as; where that is not final, no span stood, it had only not come down.

    Parameters
    ----------
    lost
        Parts of their heights that spans have lost at the end, by name.
    distance_m
        How far debris got from the bridge's plan at any time.
    end
        When all was at rest, or what still moved, as a clause.
    """
    return Text("In this one run {}, {}, and {}.", _spans(lost, is_final=is_final), _debris(distance_m), end)


def verdict_so_far(lost: Mapping[str, float], distance_m: float) -> str:
    """Return how far a run without an outcome had got when it ended; arguments as in `run_verdict`."""
    return Text("Up to then {}, and {}.", _spans(lost, is_final=False), _debris(distance_m))


def verdict_without_frames(has_results: bool) -> str:
    """Return why there is no verdict on a run."""
    return _NO_SHARDS if has_results else _NO_FRAMES


def run_limit(distance_m: float, note: str = "") -> str:
    """Return how far debris of one run got, and that this is no limit; `note` says why it is not final."""
    debris = _debris(distance_m)
    if note:
        return Text("{} in this one run ({}); {}", debris, note, NO_LIMIT_OF_ONE_RUN)
    return Text("{} in this one run; {}", debris, NO_LIMIT_OF_ONE_RUN)


def with_what_is_added(around: Text, limit: DebrisLimit, buffer_m: float | None) -> Text:
    """Return a text of a limit with the distance to keep, by the factor for runout and a buffer where there are any."""
    in_all, factor = distance_to_keep(rounded_up(limit.to_keep_m(buffer_m), "0.1")), f"{limit.runout_factor:g}"
    buffer = distance_to_keep(buffer_m or 0.0, "g")
    if limit.runout_factor == 1.0:
        return Text("{}, {} with the buffer of {}", around, in_all, buffer) if buffer_m else around
    if not buffer_m:
        return Text("{}, {} with the factor of {} for runout", around, in_all, factor)
    return Text("{}, {} with the factor of {} for runout and the buffer of {}", around, in_all, factor, buffer)


def study_verdict(limit: DebrisLimit, buffer_m: float | None, *, is_final: bool = True) -> str:
    """Return what a study says to plan with, or that it says nothing yet."""
    if not limit.has_enough_runs:
        return Text("These {} runs set no limit yet: it takes {}.", limit.runs, limit.runs_needed)
    if not limit.is_known:
        return Text("These runs set no limit, as {} of {} did not finish.", limit.unfinished, limit.runs)
    around = Text("Debris stays within {} of the bridge's plan", distance_to_keep(rounded_up(limit.limit_m, "0.1")))
    around = with_what_is_added(around, limit, buffer_m)
    parts = around, percent(limit.quantile), limit.runs, percent(limit.confidence)
    if is_final:
        return Text("{}, in at least {} of runs like these {}, with {} confidence.", *parts)
    return Text(
        "{}, in at least {} of runs like these {}, with {} confidence, while some of them still moved at their end.",
        *parts,
    )


def _spans(lost: Mapping[str, float], *, is_final: bool) -> str:
    fallen = [name for name, share in lost.items() if share >= FALLEN]
    stood = [name for name, share in lost.items() if share <= STANDS]
    partly = {name: share for name, share in lost.items() if STANDS < share < FALLEN}
    if len(stood) == len(lost) and not is_final:
        return Text("no span had come down")
    if len(stood) == len(lost):
        most = rounded_up(100.0 * max(0.0, *lost.values(), 0.0), "1")
        return Text("the bridge stood, with no more than {} % of a span's height lost", most)
    parts = [Text("{} came down", listed(fallen))] if fallen else []
    parts += [
        Text("{} came down by {} % of its height", name, f"{100.0 * share:.0f}") for name, share in partly.items()
    ]
    parts += [Text("{} stood" if is_final else "{} had not come down", listed(stood))] if stood else []
    return listed(parts)


def _debris(distance_m: float) -> str:
    if distance_m <= 0.0:
        return Text("no debris got beyond the bridge's plan")
    return Text("debris stayed within {} of the bridge's plan", distance_to_keep(rounded_up(distance_m, "0.1")))


FRAGMENTS, CORDON = Text("Fragments (flyrock)"), Text("Cordon")

Distance = tuple[float, str]
"""How far something gets, m, and the pattern of a text with what or by which rule."""


@dataclass(frozen=True, slots=True)
class Flyrock:
    """How far fragments of the zones fly: sampled under their cover, and the largest by each rule without one, m."""

    sampled: tuple[object, ...]  # the pattern of a text on those, and its values but for the last
    farthest_m: float  # 0 where nothing is sampled
    lundborg_m: float
    mckenzie_m: float

    @property
    def text(self) -> str:
        """Return all distances, with what they are worth."""
        rules = distance_to_keep(self.lundborg_m, ".0f"), distance_to_keep(self.mckenzie_m, ".0f")
        without = Text("up to {} by Lundborg and {} by McKenzie without a cover: {}", *rules, NO_SAFETY_DISTANCE)
        pattern, *values = self.sampled
        return Text(str(pattern), *values, without)

    @property
    def distances(self) -> list[Distance]:
        """Return each distance that a cordon is held against."""
        return [
            (self.lundborg_m, "{} by Lundborg"),
            (self.mckenzie_m, "{} by McKenzie"),
            (self.farthest_m, "{} of the farthest sampled fragment"),
        ]


def flyrock_of_plan(plan: ChargePlan) -> Flyrock | None:
    """Return how far fragments of a charge plan fly, of the zone that is worst for each; None without explosive."""
    flown = [(of, placed) for placed, of in zip(plan.zones, plan.flyrock, strict=True) if of is not None]
    if not flown:
        return None
    farthest, worst = max(flown, key=lambda pair: pair[0].sampled.largest_m)
    nearly_all_m = max(of.sampled.nearly_all_m for of, _ in flown)
    return Flyrock(
        (
            "sampled under their cover up to {} ({}), 99.9 % of their mass within {}; {}",
            distance_to_keep(farthest.sampled.largest_m, ".0f"),
            zone_name(worst),
            distance_to_keep(nearly_all_m, ".0f"),
        ),
        farthest.sampled.largest_m,
        max(of.lundborg_m for of, _ in flown),
        max(of.mckenzie_m for of, _ in flown),
    )


def flyrock_of_runs(limits: FragmentLimits) -> Flyrock:
    """Return how far fragments fly by the limits of a study."""
    if not limits.are_known:
        return Flyrock(("sampled ones have no limit yet; {}",), 0.0, limits.lundborg_m, limits.mckenzie_m)
    return Flyrock(
        (
            "sampled under their cover up to {}, 99.9 % of their mass within {}; {}",
            distance_to_keep(limits.largest_m, ".0f"),
            distance_to_keep(limits.nearly_all_m, ".0f"),
        ),
        limits.largest_m,
        limits.lundborg_m,
        limits.mckenzie_m,
    )


def fragment_rows(scenario: Scenario | None, flyrock: Flyrock | str | None) -> Iterator[tuple[str, str]]:
    """Yield how far fragments fly; `flyrock` is why it is not known, if that is so, and None without blast zones."""
    if isinstance(flyrock, Flyrock):
        yield FRAGMENTS, flyrock.text
    elif flyrock:
        yield FRAGMENTS, Text("not known: {}", flyrock)
    elif scenario is not None and (scenario.charges or scenario.cuts):
        yield FRAGMENTS, Text("not known: those of bare and of cutting charges are not modelled")


def clearance_rows(
    scenario: Scenario | None, flyrock: Flyrock | str | None, debris: Distance | None = None
) -> Iterator[tuple[str, str]]:
    """Yield how far fragments fly, and the cordon of a scenario against them and against debris."""
    yield from fragment_rows(scenario, flyrock)
    flown = flyrock.distances if isinstance(flyrock, Flyrock) else []
    if scenario is not None and scenario.exclusion is not None and scenario.exclusion.cordon_m is not None:
        yield CORDON, cordon_text(scenario.exclusion.cordon_m, [*flown, *([debris] if debris else ())])
    elif flown:
        far_m, what = max(flown)
        yield (
            CORDON,
            Text("none in the scenario; the largest distance of fragments is {}", _distance_text(far_m, what)),
        )


def cordon_text(cordon_m: float, distances: Sequence[Distance]) -> str:
    """Return how far a cordon is, and which distances, the largest first, are beyond it."""
    beyond = sorted((distance for distance in distances if distance[0] > cordon_m), reverse=True)
    cordon = distance_to_keep(cordon_m, "g")
    if beyond:
        shorter = joined("{} and {}", [_distance_text(*each) for each in beyond])
        return Text("{} around the bridge's plan, by the scenario: shorter than {}", cordon, shorter)
    if distances:
        return Text("{} around the bridge's plan, by the scenario: not shorter than any of these distances", cordon)
    return Text("{} around the bridge's plan, by the scenario", cordon)


def _distance_text(distance_m: float, what: str) -> Text:
    """Return a distance, as the table of fragments has it, and what it is."""
    return Text(what, distance_to_keep(distance_m, ".0f"))
