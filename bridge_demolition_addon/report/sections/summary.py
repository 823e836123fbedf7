"""First page of the report of a run: a picture, the verdict, the plan with its limit, and what to doubt."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from ...charts.plan_maps import debris_map, map_height_mm
from ...model.debris.footprint import bodies_that_moved, footprint, reaches_on_the_way
from ...model.debris.throws import Debris
from ...model.results.arrays import Results
from ...model.results.collapse import Span, spans_of
from ...model.results.motion import MOVED_M, relative_to_ground, travel, without_removed
from ...model.results.moving import creep_summary, creep_text, still_moving_note
from ...model.scenario import Scenario
from ...model.sequence.ending import asleep_text
from ...texts import Quantity, Text, joined
from ..document.blocks import Block, Paragraph, Photo, Picture, facts
from ..run_folder import ReportedRun
from ..wording.verdict import Flyrock, clearance_rows, run_limit, run_verdict, verdict_so_far, verdict_without_frames
from .cover import first_doubts_notice, photo_caption
from .planned_sequence import means_text

FIRST_PHOTOS = ("after", "impact", "before")
"""Names of rendered pictures; the first one that is there stands on the first page."""

_MOST_NAMED = 8


def run_summary(run: ReportedRun, debris: Debris | None, flyrock: Flyrock | str | None = None) -> tuple[Block, ...]:
    """Return what stands on the first page: of a run without results only what is missing of it.

    What has to be said before any result stands before the picture, and is all there is of a run that ended before
    its demolition began.
    """
    missing = [Paragraph(text, is_notice=True) for text in run.shortcomings]
    if run.results is None or debris is None or not len(run.results.inventory.of_kind("shard")):
        verdict = Paragraph(verdict_without_frames(run.results is not None), is_notice=True)
        rows = [*_means(run.scenario), *clearance_rows(run.scenario, flyrock)]
        return (verdict, *missing, *_plan(rows))
    blocks: list[Block] = [*first_doubts_notice(run), *_picture(run, debris)]
    outcome: list[tuple[str, str]] = []
    got = None
    if not run.ending.is_before_demolition:
        distance_m = _distance_m(run.results)
        blocks.append(Paragraph(verdict_of(run, distance_m), is_notice=True))
        outcome = list(_outcome(run, distance_m))
        got = distance_m, "{} that debris got in this one run"
    rows = [*_means(run.scenario), *outcome, *clearance_rows(run.scenario, flyrock, got), *_basis(run)]
    doubts = [Paragraph(text, is_notice=True) for text in _doubts(run)]
    return (*blocks, *_plan(rows), *missing, *doubts)


def verdict_of(run: ReportedRun, distance_m: float) -> str:
    """Return the verdict on a run with shards, by how far their debris got from the bridge's plan, m."""
    lost = lost_shares(_spans(run))
    if not run.ending.has_outcome:
        return verdict_so_far(lost, distance_m)
    return run_verdict(lost, distance_m, _end(run), is_final=not run.still_moving)


def lost_shares(spans: Sequence[Span]) -> dict[str, float]:
    """Return the parts of their heights above the ground that spans have lost at the end, by name."""
    heights = {span.name: (float(span.heights_m[0]), float(span.heights_m[-1])) for span in spans}
    return {name: (first - last) / first if first > 0.0 else 0.0 for name, (first, last) in heights.items()}


def _spans(run: ReportedRun) -> tuple[Span, ...]:
    bridge = run.scenario.bridge if run.scenario else None
    return spans_of(run.recorded, bridge.span_lengths_m if bridge else ())


def _end(run: ReportedRun) -> str:
    rest = run.rest
    if rest.first_motion_s is None:
        return Text("nothing moved")
    if rest.at_rest_s is None and not rest.moving_at_end:
        return Text("not all rested for long enough before the end")
    if rest.at_rest_s is None:
        return Text(
            "{} of {} shards still moved at the end", rest.moving_at_end, len(run.recorded.inventory.of_kind("shard"))
        )
    return Text("all was at rest from {} s on", f"{rest.at_rest_s:.1f}")


def _distance_m(results: Results) -> float:
    """Return how far debris and balls got from the bridge's plan at any time, m, as in a study."""
    left = relative_to_ground(results)
    shards, balls = left.inventory.of_kind("shard"), left.inventory.of_kind("ball")
    moved = bodies_that_moved(left, np.concatenate([shards, balls]))
    return float(reaches_on_the_way(left, moved, footprint(left, shards, 0)).max(initial=0.0))


def _picture(run: ReportedRun, debris: Debris) -> Iterator[Block]:
    """Yield the picture of the end, or a map of the debris where none was rendered."""
    if name := first_photo(run):
        yield Photo(run.pictures[name], photo_caption(run, name))
    elif len(debris.bodies):
        zones = run.scenario.zones if run.scenario else ()
        low_x, low_y, high_x, high_y = np.array([debris.area.bounds(), debris.outline.bounds()]).T
        bounds = (min(low_x), min(low_y), max(high_x), max(high_y))
        draw = partial(debris_map, results=run.recorded, debris=debris, zones=zones)
        yield Picture(draw, "Debris at the end in plan.", min(map_height_mm(bounds), 95.0))


def first_photo(run: ReportedRun) -> str | None:
    """Return the name of the rendered picture on the first page; None without one."""
    return next((name for name in FIRST_PHOTOS if name in run.pictures), None)


def _plan(rows: Sequence[tuple[str, str]]) -> Iterator[Block]:
    if rows:
        yield facts("The plan", rows, "plan")


def _means(scenario: Scenario | None) -> list[tuple[str, str]]:
    return [(Text("Done to the bridge"), means_text(scenario))] if scenario else []


def _outcome(run: ReportedRun, distance_m: float) -> Iterator[tuple[str, str]]:
    """Yield what came down and what stays."""
    yield (
        Text("Came down by"),
        joined("{}, {}", [Text("{} {}", span.name, Quantity(span.drop_m, "m", ".2f")) for span in _spans(run)]),
    )
    is_final = run.ending.has_outcome and not run.still_moving
    yield Text("Stays") if is_final else Text("Has not moved"), _staying_text(run.recorded)
    yield Text("Debris distance"), run_limit(distance_m, still_moving_note(run.recorded))


def _staying_text(results: Results) -> str:
    """Return which members have no shard that moved."""
    shards = results.inventory.of_kind("shard")
    moved = travel(results.frames.positions_m[0, shards], results.frames.positions_m[-1, shards]) > MOVED_M
    members = results.inventory.body_members[shards]
    names = [str(name) for name in dict.fromkeys(members.tolist()) if name]
    staying = [name for name in names if not moved[members == name].any()]
    if not staying:
        return Text("no member without a shard that moved by more than {}", Quantity(MOVED_M, "m", "g"))
    which = Text("{} of {} members", len(staying), len(names))
    if len(staying) <= _MOST_NAMED:
        which = Text("{} ({})", which, joined("{}, {}", staying))
    return Text("{}, of which no shard moved by more than {}", which, Quantity(MOVED_M, "m", "g"))


def _basis(run: ReportedRun) -> Iterator[tuple[str, str]]:
    """Yield what all this rests on."""
    shards = len(run.recorded.inventory.of_kind("shard"))
    if run.scenario:
        with_seed = "one run, seed {}, {} shards; another seed may throw farther; a study gives a limit"
        yield Text("Rests on"), Text(with_seed, run.scenario.seed, shards)
    else:
        without = "one run, {} shards; another seed may throw farther; a study gives a limit"
        yield Text("Rests on"), Text(without, shards)


def _doubts(run: ReportedRun) -> Iterator[str]:
    """Yield what to doubt of a run that has results."""
    results = run.recorded
    if len(results.frames) < 2:
        yield Text("Only one frame was recorded: nothing has moved yet, and there are no forces.")
    stability = run.summary.stability.texts if run.summary and run.summary.stability else ()
    yield from (Text("{}.", text) for text in stability)
    if not stability and run.scenario and (asleep := asleep_text(run.scenario)):  # of a run of an earlier version
        yield Text("{}.", asleep)
    if text := creep_text(creep_summary(without_removed(results)[0])):
        yield Text("{}.", text)
    if np.isnan(results.frames.loads.body_sums_n[1:]).any():
        yield (
            Text(
                "Forces are not known in every frame, as the compiled core or Blender's memory was not as "
                "expected or recording began late: what needs them is empty."
            )
        )
    if results.load_sampling.startswith("last sub-step"):
        yield Text("Loads were read once a frame only: peaks and impulses of impacts are missed for the most part.")
