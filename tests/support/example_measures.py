# SPDX-License-Identifier: GPL-3.0-or-later
"""Quantities of an example's run that differ from one draw of its shards to the next.

`scripts/seeds` prints their ranges over many draws, and the tests of the examples have their limits beyond those. A new
one is a function of a run that returns values by name, None for what did not happen, in `OF_EVERY_RUN` or, where it
belongs to some examples, in `OF_EXAMPLES`.
"""

from collections.abc import Callable, Iterable
from itertools import accumulate, pairwise

import numpy as np
from support.example_runs import ExampleRun

from bridge_demolition_addon.model.bridge import deck_underside
from bridge_demolition_addon.model.bridge.layout import pier_axes
from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.results.energy import is_known, made_share, throws_of
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.scenario import Scenario

Measure = Callable[[ExampleRun], dict[str, float | None]]

DENT_M = 1.3
"""Distance on plan from the target of the ball, within which shards have the deflection under it."""

HAMMERED_WIDTH_M = 0.2
"""Of the shards along the path of the jackhammer."""


def throws(run: ExampleRun) -> dict[str, float | None]:
    """How far debris gets on plan."""
    throws_m = run.throws_m(run.shards)
    return {"largest_throw_m": throws_m.max(), "throw_95_percent_m": np.quantile(throws_m, 0.95)}


def broken_connections(run: ExampleRun) -> dict[str, float | None]:
    """How many connections are broken in the end, and the share of all that they are."""
    connections = run.summary["connections"]
    return {
        "broken_connections": connections["broken"],
        "broken_share": connections["broken"] / max(1, connections["count"]),
    }


def deck_falls(run: ExampleRun) -> dict[str, float | None]:
    """How far half of each span's deck has come down, and the share of it that is more than 2 m lower."""
    axes_m = axes_of_supports(run.scenario)
    deck = run.of_members("deck")
    along_m = run.results.frames.positions_m[0, deck, 0]
    found = {}
    for number, (begin_m, end_m) in enumerate(pairwise(axes_m), start=1):
        fallen_m = run.fallen_m(deck[(along_m > begin_m) & (along_m < end_m)])
        found[f"span_{number}_median_fall_m"] = np.median(fallen_m)
        found[f"span_{number}_share_fallen_2_m"] = (fallen_m > 2.0).mean()
    return found


def axes_of_supports(scenario: Scenario) -> list[float]:
    """Positions along the road of the axes that spans are between; none where no table says them."""
    if scenario.bridge:
        return pier_axes(scenario.bridge).tolist()
    spans = scenario.steelwork.decks if scenario.steelwork else ()
    return [span.position_m[0] + along_m for span in spans for along_m in accumulate(span.span_lengths_m, initial=0.0)]


def times(run: ExampleRun) -> dict[str, float | None]:
    """When the ball first hits, since when everything rests, and how many shards still move at the end."""
    moving = run.summary["moving_at_end"]
    return {
        "first_impact_s": RunSummary.of(run.summary).first_hit_s,
        "came_to_rest_s": run.summary["came_to_rest_s"],
        "still_moving_shards": moving["shards"] if moving else 0,
    }


def solver_energy(run: ExampleRun) -> dict[str, float | None]:
    """Energy that Bullet's solver made, in all and by its causes, over what was dissipated, and doubtful throws."""
    work = run.results.frames.work
    if not is_known(run.results):
        return {}
    dissipated_j = np.nansum(work.dissipated_j)
    return {
        "made_share": made_share(run.results),
        "made_by_connections_share": np.nansum(work.made_by_connections_j) / dissipated_j,
        "made_by_contacts_share": np.nansum(work.made_by_contacts_j) / dissipated_j,
        "made_by_lifting_share": np.nansum(work.made_by_lifting_j) / dissipated_j,
        "doubtful_throws": throws_of(run.results).doubtful.sum(),
    }


def before_it_begins(run: ExampleRun) -> dict[str, float | None]:
    """How far the bridge has moved and what has broken when something is about to be done to it, if not at once."""
    begins_s = run.begins_s
    if not begins_s:
        return {}
    before = run.at(begins_s) - 1
    broken = ~run.results.frames.intact[before]
    return {
        "moved_before_m": run.moved_m(run.shards, before).max(),
        "broken_before": broken.sum(),
        "broken_before_share": broken.mean(),
    }


def hit_of_the_ball(run: ExampleRun) -> dict[str, float | None]:
    """How fast the ball meets the bridge, where it loads it most, and where the ball ends."""
    target_m, (ball,) = run.scenario.ball.target_m, run.results.inventory.of_kind("ball")
    loads_n = run.results.frames.loads.body_peak_sums_n[run.at(run.summary["impact"]["time_s"]), run.shards]
    apart_m = np.linalg.norm(run.results.frames.positions_m[0, run.shards, :2] - target_m, axis=1)
    heights_m = run.results.frames.positions_m[:, ball, 2]
    return {
        "approach_m_s": run.summary["hits_of_the_ball"][0]["approach_m_s"],
        "most_loaded_from_target_m": apart_m[loads_n.argmax()],
        "ten_most_loaded_from_target_m": np.median(apart_m[np.argsort(loads_n)[-10:]]),
        "ball_ends_m": heights_m[-1],
        "ball_lowest_m": heights_m.min(),
    }


def dent_of_the_ball(run: ExampleRun) -> dict[str, float | None]:
    """How far the deck has come down under the ball in the end: the middle of its shards near the target."""
    deck = run.of_members("deck")
    apart_m = np.linalg.norm(run.results.frames.positions_m[0, deck, :2] - run.scenario.ball.target_m, axis=1)
    fallen_m = run.fallen_m(deck)
    return {
        "deflection_under_ball_m": np.median(fallen_m[apart_m < DENT_M]),
        "largest_fall_of_deck_m": fallen_m.max(),
    }


def bars(run: ExampleRun) -> dict[str, float | None]:
    """How many connections with bars cracked, and in how many they ruptured."""
    found = run.summary["reinforcement"]
    return {f"bars_{name}": found[name] for name in ("cracked", "yielded", "ruptured_in_part", "ruptured")}


def second_span(run: ExampleRun) -> dict[str, float | None]:
    """How far the span beside the one that is hit has moved, and the pier at its far end, soon and later."""
    deck, soon = run.of_members("deck"), run.at(3.0)
    neighbour = deck[run.results.frames.positions_m[0, deck, 0] > 13.0]
    return {
        "neighbour_moved_at_3_s_m": run.moved_m(neighbour, soon).max(),
        "far_pier_moved_at_3_s_m": run.moved_m(run.members_of("pier 3 cap", "pier 3 column 1"), soon).max(),
        "neighbour_moved_m": run.moved_m(neighbour).max(),
    }


def flight_from_charges(run: ExampleRun, near_m: float, steps_after: int | None) -> dict[str, float | None]:
    """Directions in which the shards beside each charge fly once its wave is past them: those of the worst charge."""
    counts, medians, shares = [], [], []
    for charge in run.scenario.charges:
        nearest, detonation_s = run.near(charge, near_m), run.scenario.blast.start_s + charge.delay_s
        # 5 m at more than the speed of sound, or the first frame that ends after it.
        loaded = run.at(detonation_s + 0.015) if steps_after is None else run.at(detonation_s) + steps_after
        cosines = run.outwards(charge, nearest, loaded)
        counts.append(len(nearest))
        medians.append(np.median(cosines))
        shares.append((cosines > 0.0).mean())
    return {
        "shards_by_a_charge": min(counts),
        "outward_median_cosine": min(medians),
        "outward_share": min(shares),
    }


def outward_in_slow_motion(run: ExampleRun) -> dict[str, float | None]:
    """Flight of the shards within 3 m of charges that go off in slow motion."""
    return flight_from_charges(run, 3.0, None)


def outward_in_the_next_frame(run: ExampleRun) -> dict[str, float | None]:
    """Flight of the shards within 3.5 m of charges, a frame after each goes off."""
    return flight_from_charges(run, 3.5, 1)


def collapse_in_one_and_a_half_seconds(run: ExampleRun) -> dict[str, float | None]:
    """What has broken 1.5 s after the start, and how far the inner deck has come down, as a share of its height."""
    step, deck, spans_m = run.at(1.5), run.of_members("deck"), run.scenario.bridge.spans_m
    first_m = run.results.frames.positions_m[0]
    inner = deck[abs(first_m[deck, 0] - spans_m / 2.0) < 0.4 * spans_m]
    return {
        "broken_share_at_1_5_s": (~run.results.frames.intact[step]).mean(),
        "inner_deck_fallen_share_at_1_5_s": np.median(run.fallen_m(inner, step) / first_m[inner, 2]),
    }


def fall_by_its_own_weight(run: ExampleRun) -> dict[str, float | None]:
    """How far the deck has come down by when."""
    deck, soon = run.of_members("deck"), run.at(0.5)
    return {
        "broken_at_0_5_s": (~run.results.frames.intact[soon]).sum(),
        "largest_fall_at_0_5_s_m": run.fallen_m(deck, soon).max(),
        "median_fall_at_1_5_s_m": np.median(run.fallen_m(deck, run.at(1.5))),
        "median_fall_at_2_s_m": np.median(run.fallen_m(deck, run.at(2.0))),
    }


def hole_in_the_girder(run: ExampleRun) -> dict[str, float | None]:
    """What moves in the middle span, where it is, and how much the rest of the bridge moves."""
    deck = run.of_members("deck")
    along_m = run.results.frames.positions_m[0, deck, 0]
    moved = run.moved_m(deck) > 0.3
    return {
        "deck_shards_moved": moved.sum(),
        "moved_median_along_m": np.median(along_m[moved]) if moved.any() else None,
        "first_span_moved_m": run.moved_m(deck[along_m < 11.0]).max(),
        "piers_moved_m": run.moved_m(run.of_members("pier")).max(),
        "abutments_moved_m": run.moved_m(run.of_members("abutment")).max(),
    }


def from_path(run: ExampleRun, bodies: np.ndarray) -> np.ndarray:
    """Distance on plan (n,) of bodies from the way that the chisel went."""
    (hammer,) = run.scenario.jackhammers
    (first, across), (last, _) = hammer.path_m
    end = min(last, first + hammer.speed_m_s * (hammer.end_time_s - hammer.start_time_s))
    positions = run.results.frames.positions_m[0, bodies]
    return np.hypot(positions[:, 0] - np.clip(positions[:, 0], first, end), positions[:, 1] - across)


def slot_of_the_jackhammer(run: ExampleRun) -> dict[str, float | None]:
    """What comes off the slab along the path, and how little everything else moves."""
    (hammer,), deck, results = run.scenario.jackhammers, run.of_members("deck"), run.results
    apart_m, radius_m = from_path(run, deck), hammer.diameter_m / 2.0
    volumes_m3, fallen = results.inventory.volumes_m3[deck], run.fallen_m(deck) > 1.0
    beyond = deck[apart_m > radius_m + 3 * HAMMERED_WIDTH_M + 0.1]
    first_blow = run.at(hammer.start_time_s + 0.5 / hammer.blows_per_second)
    most_loaded = deck[results.frames.loads.body_peak_sums_n[: first_blow + 1, deck].max(axis=0).argmax()]
    return {
        "volume_along_path_over_elsewhere": volumes_m3[apart_m < 0.5].mean() / volumes_m3[apart_m > 2.0].mean(),
        "fallen_under_chisel_share": fallen[apart_m < radius_m].mean(),
        "fallen_shards": fallen.sum(),
        "fallen_from_path_m": apart_m[fallen].max() if fallen.any() else None,
        "shards_beyond": len(beyond),
        "beyond_moved_m": run.moved_m(beyond).max(),
        "carriers_moved_m": run.moved_m(run.of_members("girder", "abutment")).max(),
        "most_loaded_from_start_m": np.linalg.norm(results.frames.positions_m[0, most_loaded, :2] - hammer.path_m[0]),
    }


def course_of_the_steps(run: ExampleRun) -> dict[str, float | None]:
    """What has broken after each tool, and when the ball hits while it falls and while it is lifted."""
    removed = [run.results.inventory.body_names.tolist().index(name) for name in run.summary["events"][2]["shards"]]
    others = np.setdiff1d(run.shards, removed)
    hits_s = np.array([hit["time_s"] for hit in run.summary["hits_of_the_ball"]])
    broken = (~run.results.frames.intact).sum(axis=1)
    return {
        "lowest_shard_m": run.results.frames.positions_m[-1, others, 2].min(),
        "broken_by_jackhammer": broken[run.at(1.9)],
        "broken_by_first_fall": broken[run.at(4.0)] - broken[run.at(1.9)],
        "broken_later": broken[-1] - broken[run.at(4.0)],
        # It is let go at 2.0 s, and what stands up from the deck may meet it before it would be there.
        "hits_of_first_fall": ((hits_s > 2.5) & (hits_s < 3.6)).sum(),
        "hits_of_second_fall": ((hits_s > 6.7) & (hits_s < 7.3)).sum(),
        "hits_while_lifted": ((hits_s > 4.0) & (hits_s < 5.7)).sum(),
    }


def load_around_the_ball(run: ExampleRun) -> dict[str, float | None]:
    """How much more the deck that is hit is loaded near the ball than farther away."""
    deck = run.members_of(run.hit_deck)
    impact = run.at(run.summary["impact"]["time_s"])
    apart_m = np.linalg.norm(run.results.frames.positions_m[0, deck, :2] - run.scenario.ball.target_m, axis=1)
    loads_n = run.results.frames.loads.body_peak_sums_n[impact, deck]
    return {"load_near_over_far": loads_n[apart_m < 2.0].mean() / loads_n[apart_m > 4.0].mean()}


def i235_deck_that_is_hit(run: ExampleRun) -> dict[str, float | None]:
    """How much of the deck that is hit comes down, and how the ball goes through it."""
    deck = run.members_of(run.hit_deck)
    masses_kg = run.results.inventory.masses_kg[deck]
    (ball,) = run.results.inventory.of_kind("ball")
    heights_m, underside_m = run.results.frames.positions_m[:, ball, 2], deck_underside(run.scenario.bridge)
    below = np.flatnonzero(heights_m < underside_m / 2.0)
    found = {
        "hit_deck_down_share": masses_kg[run.fallen_m(deck) > 1.0].sum() / masses_kg.sum(),
        "largest_reach_m": debris_of(run.results).reaches_m.max(),
        "hit_deck_highest_m": run.results.frames.positions_m[-1, deck, 2].max(),
        "lowest_shard_m": run.results.frames.positions_m[-1, run.shards, 2].min(),
        "deck_above_ball_share": None,
        "ball_highest_afterwards_m": None,
    }
    if len(below):
        higher = run.results.frames.positions_m[below[0], deck, 2] > heights_m[below[0]]
        found["deck_above_ball_share"] = masses_kg[higher].sum() / masses_kg.sum()
        found["ball_highest_afterwards_m"] = heights_m[below[0] :].max()
    return found


def i235_decks_that_stay(run: ExampleRun) -> dict[str, float | None]:
    """How much the other decks and all piers move and break."""
    names = set(run.results.inventory.body_members[run.of_members("deck")])
    staying = run.members_of(*(names - {run.hit_deck}))
    within = np.isin(run.results.inventory.pairs, staying).all(axis=1)
    moved_m = abs(run.results.frames.positions_m[-1] - run.results.frames.positions_m[0])[staying]
    return {
        "other_decks_moved_m": moved_m.max(),
        "other_decks_share_fallen_2_m": (run.fallen_m(staying) > 2.0).mean(),
        "other_decks_broken_share": (~run.results.frames.intact[-1, within]).mean(),
        "piers_fall_m": run.fallen_m(run.of_members("pier", "pier cap")).max(),
    }


OF_EVERY_RUN: tuple[Measure, ...] = (
    throws,
    broken_connections,
    deck_falls,
    times,
    solver_energy,
    before_it_begins,
)
I235_SPANS = (hit_of_the_ball, load_around_the_ball, i235_deck_that_is_hit, i235_decks_that_stay)
OF_EXAMPLES: dict[str, tuple[Measure, ...]] = {
    "i235_one_span": (hit_of_the_ball, load_around_the_ball, i235_deck_that_is_hit),
    "i235_steps": (course_of_the_steps,),
    "i235_three_spans_between_decks": I235_SPANS,
    "i235_three_spans_mid_span": I235_SPANS,
    "i235_three_spans_near_end": I235_SPANS,
    "i235_three_spans_neighbouring_deck": I235_SPANS,
    "i235_two_spans": I235_SPANS,
    "jackhammer_dismantling": (slot_of_the_jackhammer,),
    "single_span_awake": (fall_by_its_own_weight,),
    "single_span_explosives": (outward_in_the_next_frame, collapse_in_one_and_a_half_seconds),
    "three_span_box_girder": (hit_of_the_ball, dent_of_the_ball, bars, hole_in_the_girder),
    "two_spans_13m_ball": (hit_of_the_ball, dent_of_the_ball, bars, second_span),
    "two_spans_13m_explosives": (outward_in_slow_motion,),
    "two_spans_20m_delays": (collapse_in_one_and_a_half_seconds,),
}
"""More of single examples, by their names."""


OF_BEGINNINGS: tuple[Measure, ...] = (
    before_it_begins,
    hit_of_the_ball,
    load_around_the_ball,
    outward_in_slow_motion,
    outward_in_the_next_frame,
    fall_by_its_own_weight,
    slot_of_the_jackhammer,
)
"""Those that look no further than a few frames after something is done to an example."""


def measures_of(name: str, run: ExampleRun) -> dict[str, float | None]:
    """All quantities of a run of an example, by name."""
    return _measured((*OF_EVERY_RUN, *OF_EXAMPLES.get(name, ())), run)


def measures_of_beginning(name: str, run: ExampleRun) -> dict[str, float | None]:
    """Those of its quantities that are known after the beginning of its run."""
    of_example = (*OF_EVERY_RUN, *OF_EXAMPLES.get(name, ()))
    return _measured([measure for measure in of_example if measure in OF_BEGINNINGS], run)


def _measured(measures: Iterable[Measure], run: ExampleRun) -> dict[str, float | None]:
    found = {}
    for measure in measures:
        found |= {quantity: None if value is None else float(value) for quantity, value in measure(run).items()}
    return found
