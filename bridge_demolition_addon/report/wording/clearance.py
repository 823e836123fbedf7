"""How far fragments fly, and a cordon held against them: what stands beside each debris distance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...model.scenario import Scenario
from ...model.structure.charge_plan import ChargePlan, zone_name
from ...model.structure.zone_fragments import NO_SAFETY_DISTANCE
from ...model.study.fragments import FragmentLimits
from ...texts import Text, distance_to_keep, joined

FRAGMENTS, CORDON = Text("Fragments (flyrock)"), Text("Cordon")

Distance = tuple[float, str]
"""How far something gets, m, and the pattern of a text with what or by which rule."""


@dataclass(frozen=True, slots=True)
class Flyrock:
    """How far fragments of all zones fly: sampled under their cover, and the largest by each rule without one, m."""

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
