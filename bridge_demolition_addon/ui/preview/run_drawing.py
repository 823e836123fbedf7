"""Drawing the preview of a run in the 3D view: debris on the ground, what falls, what stands, and sentences on it."""

from __future__ import annotations

import bpy
import gpu

from ...display.preview_outcome import PreviewOutcome
from ...model.study.preview_trust import ALIKE_PERCENT, LEAST_THROW, MOST_THROW
from ...studies.preview_process import Preview
from ..languages.words import translated
from ..scene_units import area_text, length_text, mass_text
from ..task_progress import time_left_text
from ..view_drawing import ViewDrawing, draw_lines, write_at_foot
from .decorator import is_wanted
from .run_beside import beside

_DEBRIS, _FALLEN, _STANDING = (1.0, 0.3, 0.9, 1.0), (1.0, 0.3, 0.9, 0.45), (0.45, 1.0, 0.5, 0.55)
_DEBRIS_PX, _SHARD_PX = 3.0, 1.0
_OF_BEFORE = 0.3
"""How much of its opacity is left of a preview of other values than the panels show now."""


def sentences() -> list[str]:
    """Return what is said of the preview; nothing while it is off."""
    if not beside.is_on:
        return []
    shown = beside.shown
    if shown is None or (shown.outcome is None and beside.is_of_before):
        return [translated("Preview: one coarse run begins")] if beside.is_running else []
    if shown.outcome is None:
        return [translated("No preview: {}").format(shown.reason)]
    lines = _of_outcome(shown.outcome, shown.is_over)
    if beside.is_of_before:
        return [*lines, translated("These are the values before; a new run goes on")]
    return [*lines, _progress(shown, shown.outcome)]


def _of_outcome(outcome: PreviewOutcome, is_over: bool) -> list[str]:
    heading = [translated("Preview in {} shards: one coarse run, no forecast").format(outcome.shards)]
    if not outcome.fallen and not is_over:
        return [*heading, translated("All shards stand so far")]  # which may be before anything is done to them
    if outcome.is_elastic:
        heading.append(_trust())
    if not outcome.fallen:
        return [*heading, translated("All shards stand")]
    fallen = translated("{} shards ({}) fall, {} stand").format(
        outcome.fallen, mass_text(outcome.fallen_kg), outcome.standing
    )
    lies = translated("Debris covers {}, up to {} from the bridge").format(
        area_text(outcome.area_m2, ".0f"), length_text(outcome.farthest_m, ".1f")
    )
    if not outcome.falling:
        return [*heading, fallen, lies]
    flying = translated("{} still fall: shown where they would land in free flight").format(outcome.falling)
    return [*heading, fallen, flying, lies]


def _trust() -> str:
    """Return what is known of previews that take longer steps than the run."""
    tested = translated(
        "Longer steps than in the run: {} % of spans fell or stood alike, debris got {} to {} times as far"
    )
    return tested.format(ALIKE_PERCENT, f"{LEAST_THROW:.1f}", f"{MOST_THROW:.1f}")


def _progress(shown: Preview, outcome: PreviewOutcome) -> str:
    if shown.is_over:
        return translated("The run ended after {} s").format(f"{outcome.time_s:.1f}")
    times = (f"{outcome.time_s:.1f}", f"{outcome.duration_s:.1f}")
    so_far = translated("Only so far: {} s of {} s, the run goes on").format(*times)
    return so_far if shown.left_s is None else f"{so_far}, {time_left_text(shown.left_s)}"


def _draw_in_space(context: bpy.types.Context) -> None:
    outcome = beside.shown.outcome if beside.is_on and beside.shown else None
    if outcome is None or not is_wanted(context):
        return
    share = _OF_BEFORE if beside.is_of_before else 1.0
    gpu.state.blend_set("ALPHA")
    for lines, colour, width_px in (
        (outcome.standing_lines_m, _STANDING, _SHARD_PX),
        (outcome.fallen_lines_m, _FALLEN, _SHARD_PX),
        (outcome.debris_lines_m, _DEBRIS, _DEBRIS_PX),
    ):
        draw_lines(context, lines, (*colour[:3], share * colour[3]), width_px)
    gpu.state.blend_set("NONE")


def _draw_on_screen(context: bpy.types.Context) -> None:
    if is_wanted(context):
        write_at_foot(context, sentences())


drawing = ViewDrawing(_draw_in_space, _draw_on_screen)
