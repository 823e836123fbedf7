"""Sentences on the results of a study. They are rounded so that each is true as it stands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...engineering.statistics.order_limits import achieved_confidence, least_runs
from ...engineering.units import rounded_down, rounded_up
from ...model.debris.throws import PILES_NOTE
from ...model.sequence.ending import FASTEST
from ...model.study.conclusions import Conclusions, DebrisLimit, DoubtfulThrows, FragmentLimits, Proportion
from ...model.study.file import Ensemble, Study
from ...model.study.settings import StudySettings
from ...texts import DOWN, Quantity, Text, distance_to_keep, joined
from .numbers import listed, ordinal, percent, percent_down, percent_up
from .verdict import CORDON, cordon_text, flyrock_of_runs

_DOUBT = Text("All of these are known within a factor of 2: factor 2, no safety distance.")


def input_names(ensemble: Ensemble) -> list[str]:
    """Return what varies, as a study names it: a key of every table of a list only once."""
    zones = ensemble.scenario.blast_zones
    misfires = [Text("which blast zones fire")] if any(zone.probability_fires < 1.0 for zone in zones) else []
    return [*(vary.key for vary in ensemble.settings.vary), *misfires, Text("the seed of the fracture")]


def study_sentences(study: Study, conclusions: Conclusions) -> Iterator[str]:
    """Yield what a study states, the limit of the debris distance first."""
    exclusion = study.scenario.exclusion
    buffer_m = exclusion.buffer_m if exclusion else None
    yield limit_sentence(conclusions.reach, input_names(study), study.settings.least_mass_kg, buffer_m)
    if conclusions.still_moving:
        yield moving_sentence(conclusions.still_moving, conclusions.reach.runs)
    if conclusions.single_moving:
        fastest_m_s = FASTEST * study.scenario.time.rest_speed_m_s
        yield single_moving_sentence(conclusions.single_moving, conclusions.reach.runs, fastest_m_s)
    if conclusions.reach.is_known:
        yield repeat_sentence(conclusions.reach)
        if conclusions.reach.runout_factor == 1.0:
            yield Text("{}; the buffer has to cover that.", PILES_NOTE)
        else:
            yield Text("{}; the factor for runout is for that.", PILES_NOTE)
    if conclusions.doubtful is None:
        yield (
            Text(
                "Throws that nothing explains but energy of the solver were not counted, as these runs recorded "
                'none: study.keep = "logs" does.'
            )
        )
    elif conclusions.doubtful.throws:
        yield doubtful_sentence(conclusions.doubtful)
    if conclusions.fragments:
        yield fragments_sentence(conclusions.fragments, exclusion.cordon_m if exclusion else None)
    for criterion in conclusions.criteria:
        yield success_sentence(criterion)
    if conclusions.success and len(conclusions.criteria) > 1:
        yield success_sentence(conclusions.success)
    for part in conclusions.standing:
        yield harm_sentence(replace(part, what=Text("left {} standing, or less than half down", part.what)))


def fragments_sentence(limits: FragmentLimits, cordon_m: float | None) -> str:
    """Return how far fragments of blast zones fly, with two rules and the scenario's cordon, if any."""
    rules = Text(
        "By Lundborg they fly up to {}, by McKenzie up to {}, as if nothing covered the holes",
        distance_to_keep(rounded_up(limits.lundborg_m, "1")),
        distance_to_keep(rounded_up(limits.mckenzie_m, "1")),
    )
    beside = rules
    if cordon_m is not None:
        beside = Text("{}. {}: {}", rules, CORDON, cordon_text(cordon_m, flyrock_of_runs(limits).distances))
    if not limits.are_known:
        return Text("How far fragments that are smaller than shards fly has no limit yet. {}. {}", beside, _DOUBT)
    half, most, nearly_all = (
        distance_to_keep(rounded_up(limit_m, "1")) for limit_m in (limits.half_m, limits.most_m, limits.nearly_all_m)
    )
    return Text(
        "Fragments that are smaller than shards: with {} confidence for each, in at least {} of such runs 50 % of "
        "their mass stay within {} of their blast zone, 99 % within {} and 99.9 % within {}. {}. {}",
        percent(limits.confidence),
        percent(limits.quantile),
        half,
        most,
        nearly_all,
        beside,
        _DOUBT,
    )


def moving_sentence(moving: int, runs: int) -> str:
    """Return that distances of some runs are not final."""
    return Text(
        "In {} of {} runs shards still moved at the end: their distances are not final, and a limit from them may "
        "be too small. Give the scenario a longer time.duration_s.",
        moving,
        runs,
    )


def single_moving_sentence(moving: int, runs: int, fastest_m_s: float) -> str:
    """Return that some runs rested as a whole, but not each shard of them."""
    return Text(
        "In {} of {} runs everything rested as a whole, while single shards still moved, at less than {}: these "
        "may lie a little farther in the end.",
        moving,
        runs,
        Quantity(fastest_m_s, "m/s", "g"),
    )


def too_few_sentence(limit: DebrisLimit) -> Text:
    """Return how many runs a limit needs, where there are too few."""
    first, share, confidence = least_runs(limit.quantile, limit.confidence), percent(limit.quantile), limit.confidence
    asked = share, ordinal(limit.rank), percent(confidence)
    if first < limit.runs_needed:
        return Text(
            "Too few runs for a limit yet: it needs {} runs (or {} with study.rank = 1), has {}. Only then do {} "
            "of all runs stay within the {} debris distance, with {} confidence. Raise study.runs, and start the "
            "study again in the same folder: it keeps all runs that are done.",
            limit.runs_needed,
            first,
            limit.runs,
            *asked,
        )
    return Text(
        "Too few runs for a limit yet: it needs {} runs, has {}. Only then do {} of all runs stay within the {} "
        "debris distance, with {} confidence. Raise study.runs, and start the study again in the same folder: it "
        "keeps all runs that are done.",
        limit.runs_needed,
        limit.runs,
        *asked,
    )


def planned_limit_text(settings: StudySettings) -> str:
    """Return which limit as many runs as are planned will give, or what they will lack for one."""
    runs, rank, share = settings.runs, settings.rank, percent(settings.quantile)
    needed = least_runs(settings.quantile, settings.confidence, rank)
    if runs >= needed:
        return (
            f"The {ordinal(rank)} debris distance of {runs} runs will be the limit for {share} of all, with "
            f"{percent(settings.confidence)} confidence; {needed} runs are needed."
        )
    other = f", or {least_runs(settings.quantile, settings.confidence)} with study.rank = 1" if rank > 1 else ""
    largest = percent_down(achieved_confidence(1, runs, settings.quantile))
    return (
        f"{runs} runs give no limit: {needed} are needed for the {ordinal(rank)} debris distance to be one for {share} "
        f"of all, with {percent(settings.confidence)} confidence{other}. The largest of {runs} holds for {share} with "
        f"{largest} confidence."
    )


def limit_sentence(limit: DebrisLimit, inputs: Sequence[str], least_mass_kg: float, buffer_m: float | None) -> str:
    """Return the limit of the debris distance with the buffer of the scenario, if any; or why there is none."""
    if not limit.has_enough_runs:
        return too_few_sentence(limit)
    if not limit.is_known:
        return Text(
            "These runs set no limit: {} of {} did not finish. Their debris distance counts as unlimited, and the "
            "limit is the {} distance. Find out why they stopped, and run the study again without that.",
            limit.unfinished,
            limit.runs,
            ordinal(limit.rank),
        )
    debris = Text("debris of {} or more", Quantity(least_mass_kg, "kg", "g")) if least_mass_kg > 0.0 else Text("debris")
    most = Text("all but {}", limit.exceedances) if limit.exceedances else Text("all of them")
    if limit.unfinished:
        most = _unfinished(limit, most)
    added = Text("a buffer has to be added")
    if buffer_m is not None:
        added = Text(
            "the buffer of {} is added, {} in all",
            distance_to_keep(buffer_m, "g"),
            distance_to_keep(rounded_up(limit.to_keep_m(buffer_m), "0.1")),
        )
    stayed = listed(inputs), debris, distance_to_keep(rounded_up(limit.limit_m, "0.1")), most
    within = (
        Text(
            "In {} independent runs, in which {} was sampled from the distributions of this study, {} stayed "
            "within {} of the bridge's plan in {}.",
            limit.runs,
            *stayed,
        )
        if len(inputs) == 1
        else Text(
            "In {} independent runs, in which {} were sampled from the distributions of this study, {} stayed "
            "within {} of the bridge's plan in {}.",
            limit.runs,
            *stayed,
        )
    )
    share = Text(
        "With {} confidence at least {} of such runs stay within it.",
        percent(limit.confidence),
        percent(limit.quantile),
    )
    model = Text(
        "This says how the model scatters; it does not cover what the model leaves out, such as pieces smaller "
        "than a shard, for which {}.",
        added,
    )
    if limit.runout_factor == 1.0:
        return joined("{} {}", (within, share, model))
    runout = Text(
        "Loose blocks run out short in this model: the limit is multiplied by {}, to {}.",
        f"{limit.runout_factor:g}",
        distance_to_keep(rounded_up(limit.to_keep_m(), "0.1")),
    )
    return joined("{} {}", (within, share, runout, model))


def repeat_sentence(limit: DebrisLimit) -> str:
    """Return how much the limit itself scatters."""
    ends = []
    if math.isfinite(limit.repeat_above_m):
        ends.append(Text("above {}", Quantity(rounded_down(limit.repeat_above_m, "0.1"), "m", rounding=DOWN)))
    if math.isfinite(limit.repeat_below_m):
        ends.append(Text("not above {}", distance_to_keep(rounded_up(limit.repeat_below_m, "0.1"))))
    beyond, within = percent_up(limit.repeat_exceedance), joined("{} and {}", ends)
    if not ends:
        return Text(
            "If the study were made again with other runs, in {} of such studies it would lie beyond every "
            "distance seen here.",
            beyond,
        )
    if len(ends) == 1:
        return Text(
            "If the study were made again with other runs, its limit would lie {}, with {} confidence; in {} of "
            "such studies it would lie beyond every distance seen here.",
            within,
            percent(limit.confidence),
            beyond,
        )
    return Text(
        "If the study were made again with other runs, its limit would lie {}, with {} confidence each; in {} of "
        "such studies it would lie beyond every distance seen here.",
        within,
        percent(limit.confidence),
        beyond,
    )


def doubtful_sentence(doubtful: DoubtfulThrows) -> str:
    """Return how many throws are doubtful, and the limit without them."""
    counts = doubtful.throws, doubtful.runs, doubtful.judged
    limit = distance_to_keep(rounded_up(doubtful.limit_m, "0.1")) if math.isfinite(doubtful.limit_m) else None
    if doubtful.throws == 1:
        text = Text(
            "{} throw in {} of {} runs is doubtful: neither the height of fall nor a ball explains it, so the "
            "solver has made the energy.",
            *counts,
        )
        return text if limit is None else Text("{} Without it the limit is {}.", text, limit)
    text = Text(
        "{} throws in {} of {} runs are doubtful: neither the height of fall nor a ball explains them, so the "
        "solver has made the energy.",
        *counts,
    )
    return text if limit is None else Text("{} Without them the limit is {}.", text, limit)


def success_sentence(proportion: Proportion) -> str:
    """Return how often runs do something that is good."""
    return Text(
        "{}. With {} confidence at least {} of such runs do.",
        _counted(proportion),
        percent(proportion.confidence),
        percent_down(proportion.at_least),
    )


def harm_sentence(proportion: Proportion) -> str:
    """Return how often runs do something that is bad."""
    return Text(
        "{}. With {} confidence at most {} of such runs do.",
        _counted(proportion),
        percent(proportion.confidence),
        percent_up(proportion.at_most),
    )


def verified_sentence(left: Proportion, quantile: float) -> str:
    """Return what runs that left a zone, or did not, state about it; the zone was fixed before any of them."""
    if left.at_most <= 1.0 - quantile:
        return Text(
            "{} So it holds {} of such runs. This is so where the zone was fixed before these runs; if it was "
            "made from a study, that study must have used another seed.",
            harm_sentence(left),
            percent(quantile),
        )
    needed = [least_runs(quantile, left.confidence, rank) for rank in (1, 2)]
    return Text(
        "{} That does not show that it holds {} of them: it takes {} runs without one that leaves it, or {} runs "
        "with one. This is so where the zone was fixed before these runs; if it was made from a study, that study "
        "must have used another seed.",
        harm_sentence(left),
        percent(quantile),
        *needed,
    )


def shape_sentence(corners: int, quantile: float, confidence: float) -> str:
    """Return why a zone drawn around runs holds less than it seems to, by the corners of the hull, and what to do."""
    return Text(
        "A zone drawn around the debris of these runs is no such limit: the runs chose its shape, whose convex "
        "hull has {} corners. Even with their number fixed beforehand, it takes {} runs until such a zone holds "
        "{} of other runs, with {} confidence. Take the limit instead, whose shape was fixed before the first "
        "run, or verify the zone: write it into [[zones]] of the scenario, run the study with another seed, and "
        "then bda study with --verify.",
        corners,
        least_runs(quantile, confidence, corners),
        percent(quantile),
        percent(confidence),
    )


def standing_text(standing: Sequence[Proportion]) -> str:
    """Return which spans and piers may stand at the end, each with how likely it is at most."""
    counted = [
        Text("{}: {} of {} runs, at most {} of such runs", part.what, part.count, part.runs, percent_up(part.at_most))
        for part in standing
        if part.count
    ]
    likeliest = max(standing, key=lambda part: part.at_most)
    none = Text(
        "no span and no pier in {} runs, each in at most {} of such runs",
        likeliest.runs,
        percent_up(likeliest.at_most),
    )
    which = joined("{}; {}", counted) if counted else none
    return Text("{} (each by itself with {} confidence)", which, percent(likeliest.confidence))


def _unfinished(limit: DebrisLimit, most: Text) -> Text:
    if limit.unfinished < limit.exceedances:
        return Text("{}, {}", most, Text("{} of which did not finish", limit.unfinished))
    return Text("{}, which did not finish" if limit.unfinished == 1 else "{}, none of which finished", most)


def _counted(proportion: Proportion) -> str:
    if proportion.count == 0:
        return Text("None of {} runs {}", proportion.runs, proportion.what)
    if proportion.count == proportion.runs:
        return Text("All {} runs {}", proportion.runs, proportion.what)
    return Text("{} of {} runs {}", proportion.count, proportion.runs, proportion.what)
