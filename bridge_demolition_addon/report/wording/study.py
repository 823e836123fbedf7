"""Sentences on the results of a study. They are rounded so that each is true as it stands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ...engineering.statistics.order_limits import achieved_confidence, least_runs
from ...engineering.units import rounded_down, rounded_up
from ...model.debris.measured_piles import PILES_NOTE
from ...model.sequence.rest import FASTEST
from ...model.study.conclusions import Conclusions, DebrisLimit, DoubtfulThrows, Proportion
from ...model.study.file import Ensemble, Study
from ...model.study.fragments import FragmentLimits
from ...model.study.settings import StudySettings
from .clearance import CORDON, cordon_text, flyrock_of_runs
from .numbers import listed, ordinal, percent, percent_down, percent_up

_DOUBT = "All of these are known within a factor of 2: factor 2, no safety distance."


def input_names(ensemble: Ensemble) -> list[str]:
    """Return what varies, as a study names it: a key of all tables of a list only once."""
    zones = ensemble.scenario.blast_zones
    misfires = ["which blast zones fire"] if any(zone.probability_fires < 1.0 for zone in zones) else []
    return [*(vary.key for vary in ensemble.settings.vary), *misfires, "the seed of the fracture"]


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
        yield f"{PILES_NOTE}; the buffer has to cover that."
    if conclusions.doubtful is None:
        yield (
            "Throws that nothing explains but energy of the solver were not counted, as these runs recorded none: "
            'study.keep = "logs" does.'
        )
    elif conclusions.doubtful.throws:
        yield doubtful_sentence(conclusions.doubtful)
    if conclusions.fragments:
        yield fragments_sentence(conclusions.fragments, exclusion.cordon_m if exclusion else None)
    for criterion in conclusions.criteria:
        yield success_sentence(criterion)
    if conclusions.success and len(conclusions.criteria) > 1:
        yield success_sentence(conclusions.success)


def fragments_sentence(limits: FragmentLimits, cordon_m: float | None) -> str:
    """Return how far fragments of blast zones fly, beside two rules and the cordon of the scenario, if any."""
    rules = (
        f"By Lundborg they fly up to {rounded_up(limits.lundborg_m, '1')} m, by McKenzie up to "
        f"{rounded_up(limits.mckenzie_m, '1')} m, as if nothing covered the holes"
    )
    beside = rules
    if cordon_m is not None:
        beside += f". {CORDON}: {cordon_text(cordon_m, flyrock_of_runs(limits).distances)}"
    if not limits.are_known:
        return f"How far fragments that are smaller than shards fly has no limit yet. {beside}. {_DOUBT}"
    half, most, nearly_all = (
        f"{rounded_up(limit_m, '1')} m" for limit_m in (limits.half_m, limits.most_m, limits.nearly_all_m)
    )
    return (
        f"Fragments that are smaller than shards: with {percent(limits.confidence)} confidence for each, in at least "
        f"{percent(limits.quantile)} of such runs 50 % of their mass stay within {half} of their blast zone, 99 % "
        f"within {most} and 99.9 % within {nearly_all}. {beside}. {_DOUBT}"
    )


def moving_sentence(moving: int, runs: int) -> str:
    """Return that distances of some runs are not final."""
    return (
        f"In {moving} of {runs} runs shards still moved at the end: their distances are not final, and a limit from "
        "them may be too small. Give the scenario a longer time.duration_s."
    )


def single_moving_sentence(moving: int, runs: int, fastest_m_s: float) -> str:
    """Return that some runs rested as a whole, but not each shard of them."""
    return (
        f"In {moving} of {runs} runs everything rested as a whole, while single shards still moved, at less than "
        f"{fastest_m_s:g} m/s: these may lie a little farther in the end."
    )


def too_few_sentence(limit: DebrisLimit) -> str:
    """Return how many runs a limit needs, where there are too few."""
    first = least_runs(limit.quantile, limit.confidence)
    other = f" (or {first} with study.rank = 1)" if first < limit.runs_needed else ""
    return (
        f"Too few runs for a limit yet: it needs {limit.runs_needed} runs{other}, has {limit.runs}. Only "
        f"then do {percent(limit.quantile)} of all runs stay within the {ordinal(limit.rank)} debris distance, with "
        f"{percent(limit.confidence)} confidence. Raise study.runs, and start the study again in the same folder: it "
        "keeps all runs that are done."
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
        return (
            f"These runs set no limit: {limit.unfinished} of {limit.runs} did not finish. Their debris "
            f"distance counts as unlimited, and the limit is the {ordinal(limit.rank)} distance. Find out why they "
            "stopped, and run the study again without that."
        )
    debris = f"debris of {least_mass_kg:g} kg or more" if least_mass_kg > 0.0 else "debris"
    most = f"all but {limit.exceedances}" if limit.exceedances else "all of them"
    unfinished = f", {_unfinished(limit)}" if limit.unfinished else ""
    added = "a buffer has to be added"
    if buffer_m is not None:
        added = f"the buffer of {buffer_m:g} m is added, {rounded_up(limit.limit_m + buffer_m, '0.1')} m in all"
    limit_m, sampled = rounded_up(limit.limit_m, "0.1"), "was sampled" if len(inputs) == 1 else "were sampled"
    return (
        f"In {limit.runs} independent runs, in which {listed(inputs)} {sampled} from the distributions of this study, "
        f"{debris} stayed within {limit_m} m of the bridge's plan in {most}{unfinished}. With "
        f"{percent(limit.confidence)} confidence at least {percent(limit.quantile)} of such runs stay within it. This "
        "says how the model scatters; it does not cover what the model leaves out, such as pieces smaller than a "
        f"shard, for which {added}."
    )


def repeat_sentence(limit: DebrisLimit) -> str:
    """Return how much the limit itself scatters."""
    ends = []
    if math.isfinite(limit.repeat_above_m):
        ends.append(f"above {rounded_down(limit.repeat_above_m, '0.1')} m")
    if math.isfinite(limit.repeat_below_m):
        ends.append(f"not above {rounded_up(limit.repeat_below_m, '0.1')} m")
    confidence = f"with {percent(limit.confidence)} confidence{' each' if len(ends) > 1 else ''}"
    within = f"its limit would lie {' and '.join(ends)}, {confidence}; " if ends else ""
    return (
        f"If the study were made again with other runs, {within}in {percent_up(limit.repeat_exceedance)} of such "
        "studies it would lie beyond every distance seen here."
    )


def doubtful_sentence(doubtful: DoubtfulThrows) -> str:
    """Return how many throws are doubtful, and the limit without them."""
    one, runs = doubtful.throws == 1, "run" if doubtful.judged == 1 else "runs"
    limit = f" Without {'it' if one else 'them'} the limit is {rounded_up(doubtful.limit_m, '0.1')} m."
    return (
        f"{doubtful.throws} {'throw' if one else 'throws'} in {doubtful.runs} of {doubtful.judged} {runs} "
        f"{'is' if one else 'are'} doubtful: neither the height of fall nor a ball explains {'it' if one else 'them'}, "
        f"so the solver has made the energy.{limit if math.isfinite(doubtful.limit_m) else ''}"
    )


def success_sentence(proportion: Proportion) -> str:
    """Return how often runs do something that is good."""
    return (
        f"{_counted(proportion)}. With {percent(proportion.confidence)} confidence at least "
        f"{percent_down(proportion.at_least)} of such runs do."
    )


def harm_sentence(proportion: Proportion) -> str:
    """Return how often runs do something that is bad."""
    return (
        f"{_counted(proportion)}. With {percent(proportion.confidence)} confidence at most "
        f"{percent_up(proportion.at_most)} of such runs do."
    )


def verified_sentence(left: Proportion, quantile: float) -> str:
    """Return what runs that left a zone, or did not, state about it; the zone was fixed before any of them."""
    if left.at_most <= 1.0 - quantile:
        meaning = f"So it holds {percent(quantile)} of such runs"
    else:
        needed = [least_runs(quantile, left.confidence, rank) for rank in (1, 2)]
        meaning = (
            f"That does not show that it holds {percent(quantile)} of them: it takes {needed[0]} runs "
            f"without one that leaves it, or {needed[1]} runs with one"
        )
    return (
        f"{harm_sentence(left)} {meaning}. This is so where the zone was fixed before these runs; if it was made from "
        "a study, that study must have used another seed."
    )


def shape_sentence(corners: int, quantile: float, confidence: float) -> str:
    """Return why a zone drawn around runs holds less than it seems to, by the corners of the hull, and what to do."""
    return (
        "A zone drawn around the debris of these runs is no such limit: the runs chose its shape, whose convex hull "
        f"has {corners} corners. Even with their number fixed beforehand, it takes "
        f"{least_runs(quantile, confidence, corners)} runs until such a zone holds {percent(quantile)} of other runs, "
        f"with {percent(confidence)} confidence. Take the limit instead, whose shape was fixed before the first run, "
        "or verify the zone: write it into [[zones]] of the scenario, run the study with another seed, and then "
        "bda study with --verify."
    )


def _unfinished(limit: DebrisLimit) -> str:
    if limit.unfinished < limit.exceedances:
        return f"{limit.unfinished} of which did not finish"
    return "which did not finish" if limit.unfinished == 1 else "none of which finished"


def _counted(proportion: Proportion) -> str:
    counts = {0: f"None of {proportion.runs}", proportion.runs: f"All {proportion.runs}"}
    return f"{counts.get(proportion.count, f'{proportion.count} of {proportion.runs}')} runs {proportion.what}"
