"""The run whose results the panels show: the last recording, or the run that an opened file was saved with.

Blender forgets the frames that it played with many a change, and would show the bridge as it was built next to a pile.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import bpy

from ...engineering.units import kilonewtons
from ...errors import DemolitionError, OutputError, UnreadableError
from ...model.results.arrays import Results
from ...model.results.collapse import ConnectionCounts
from ...model.results.records import BearingOfRun
from ...model.results.stability import STANDS
from ...model.run_folder.files import SUMMARY_FILE
from ...model.run_folder.summary import RunSummary, read_summary
from ...model.schema import given
from ...model.sequence.ending import doubts_of_run
from ...simulation.blender_events import contours_of, shown_results
from ...simulation.kept_run import digest_of_run, folder_of_run, has_run, results_of_run
from ..languages.words import translated
from ..recording.session import last_recording, last_recording_of
from ..scene_units import length_text, mass_text, units_of_texts


def counts_line(counts: ConnectionCounts) -> str:
    """Return the line, as `ConnectionCounts.text` has it."""
    count = counts.connections
    if counts.cracked is None:
        return translated("Cracked or torn: {} of {} connections").format(counts.broken, count)
    if not counts.cracked:
        return translated("Torn: {} of {} connections").format(counts.torn, count)
    if counts.yielded is None:
        text = translated("Cracked (bars hold): {}; torn: {} of {} connections")
        return text.format(counts.cracked, counts.torn, count)
    text = translated("Cracked (bars hold): {}, of these yielded: {}; torn: {} of {} connections")
    return text.format(counts.cracked, counts.yielded, counts.torn, count)


_N_PER_KN = 1000.0
_MS_PER_S = 1000.0


class LargestValue(NamedTuple):
    """A largest value as text, with the body and the frame that it was at."""

    text: str
    body: str
    frame: int


_SHOWN = ("title", "mass_kg", "connections", "largest_resultant", "largest_throw", "frames", "substep_s", "fingerprint")
"""What a summary has to have to be shown."""

_read: dict[tuple[str, ...], ShownRun] = {}
"""The run read last, by its folder and digest, language and units: panels are drawn many times a second."""


@dataclass(frozen=True, slots=True)
class ShownRun:
    """Texts of the panels on a run.

    Attributes
    ----------
    stands
        That the bridge stands by itself; empty where it does not, or this is not known.
    doubts
        That it does not stand, fell before anything was done to it, and what still moved, as far as known.
    lines
        Totals, in short lines.
    explained_peak
        What the peak force is, and why the contours show another number.
    bearings
        Rows of the table of bearings, with its head; none without bearings.
    results
        Loads what was recorded.
    """

    folder: Path
    title: str
    summary: RunSummary
    stands: str
    doubts: tuple[str, ...]
    lines: tuple[str, ...]
    peak_force: LargestValue | None
    largest_throw: LargestValue | None
    explained_peak: str
    bearings: tuple[tuple[str, ...], ...]
    results: Callable[[], Results]

    @classmethod
    def of(cls, folder: Path, summary: RunSummary, last_frame: int, results: Callable[[], Results]) -> ShownRun:
        """Put a summary into texts."""
        if lacking := sorted(set(_SHOWN) & set(summary.lacks)):
            path, missing = folder / SUMMARY_FILE, ", ".join(lacking)
            raise OutputError(f"{path}: is not what a run writes: has no {missing}; run the scene again")
        force, throw = summary.largest_resultant, summary.largest_throw
        stability = summary.stability.texts if summary.stability else ()
        stands = stability[:1] if summary.stability and summary.stability.verdict == STANDS else ()
        return cls(
            folder=folder,
            title=summary.title,
            summary=summary,
            stands="".join(stands),
            doubts=(*stability[len(stands) :], *doubts_of_run(summary)),
            lines=tuple(lines_of(summary)),
            peak_force=force and LargestValue(_force_text(force.force_n), force.body, force.frame),
            largest_throw=throw and LargestValue(_throw_text(throw.throw_m, summary), throw.body, last_frame),
            explained_peak=explained_peak(summary),
            bearings=bearing_rows(summary.bearings),
            results=results,
        )


def shown_run(scene: bpy.types.Scene) -> ShownRun | None:
    """Return the run whose results are shown; None before there was one of what is built in the scene.

    A run that is kept with the scene, and cannot be found or read, raises OutputError.
    """
    last = last_recording_of(scene)
    if has_run(scene) and not (last and last.summary.result_digest == digest_of_run(scene)):
        return _of_file(scene)
    return ShownRun.of(last.folder, last.summary, last.recording.last_frame, last.recording.results) if last else None


def why_no_run(scene: bpy.types.Scene) -> str | None:
    """Return in a sentence why no results are shown; None where there are some, or they cannot be read."""
    if shown_run(scene):
        return None
    if last := last_recording():
        sentence = translated("The last results are of another bridge than is built here: {}, in {}")
        return sentence.format(last.summary.title, last.folder)
    return translated("Nothing was recorded yet: run the scene first")


def forget_shown() -> None:
    """Forget the run that was read."""
    _read.clear()


def explained_peak(summary: RunSummary) -> str:
    """Return in a sentence what the peak force is, and why the contours show another number."""
    longest, shortest = summary.substep_s, summary.shortest_substep_s or summary.substep_s
    length = f"{longest * _MS_PER_S:.3g}"
    if shortest < 0.999 * longest:  # frames have more or fewer
        length = translated("{} to {}").format(f"{shortest * _MS_PER_S:.3g}", length)
    sentence = translated(
        "The resultant on a shard in its worst sub-step, of {} ms. Contours show the frame mean, or with Peak So Far "
        "this peak"
    )
    return sentence.format(length)


def bearing_rows(bearings: Sequence[BearingOfRun]) -> tuple[tuple[str, ...], ...]:
    """Return the table of bearings of a run, with its head: vertical forces at rest, least and largest; horizontal."""
    forces_n = attrgetter("at_rest_up_n", "least_up_n", "largest_up_n", "largest_horizontal_n")
    rows = [(bearing.name, *map(_kilonewtons, forces_n(bearing)), _happened(bearing)) for bearing in bearings]
    head = tuple(map(translated, ("Bearings, kN", "at rest", "least", "most", "sideways")))
    return ((*head, ""), *rows) if rows else ()


def _throw_text(throw_m: float, summary: RunSummary) -> str:
    throw = length_text(throw_m, ".2f")
    return translated("{}, not final").format(throw) if summary.moving_at_end else throw


def _force_text(force_n: float) -> str:
    return f"{kilonewtons(force_n)} kN"


def _kilonewtons(force_n: float | None) -> str:
    return translated("not known") if force_n is None else f"{force_n / _N_PER_KN:.1f}"


def _happened(bearing: BearingOfRun) -> str:
    """What a bearing did, in few letters."""
    if bearing.gone_s is not None:
        return translated("gone at {} s").format(f"{bearing.gone_s:.2f}")
    percent = round(100.0 * bearing.largest_open_share)
    how_far = translated("opened") if bearing.opened else translated("opened by {} %").format(percent)
    return translated(" and ").join(
        filter(None, (how_far if percent else "", translated("slid") if bearing.slid else ""))
    )


def lines_of(summary: RunSummary) -> list[str]:
    """Return the totals of a summary in short lines."""
    bars, creeping = summary.reinforcement, summary.creeping
    return [
        translated("Total mass: {}").format(mass_text(given(summary.mass_kg)["shard"])),
        counts_line(summary.counts),
        *([translated("Bars: {}").format(bars.text)] if bars else []),
        translated("{} frames, {} s").format(summary.frames, f"{summary.simulated_s:.2f}"),
        *([translated("Creeping at the end: {} shards").format(creeping.shards)] if creeping else []),
    ]


def _of_file(scene: bpy.types.Scene) -> ShownRun:
    folder = folder_of_run(scene)
    name = (str(folder), digest_of_run(scene), bpy.app.translations.locale, units_of_texts())
    if name not in _read:
        try:
            summary = read_summary(folder)
        except (UnreadableError, DemolitionError, ValueError) as error:
            raise OutputError(f"{folder / SUMMARY_FILE}: cannot be read: {error}") from error
        results = results_of_run(scene)
        last_frame = int(results.frames.number[-1])
        forget_shown()
        _read[name] = ShownRun.of(folder, summary, last_frame, lambda: results)
    return _read[name]


def follow_later(scene: bpy.types.Scene) -> None:
    """Place the bodies, or leave them to Blender, once it has finished its present drawing."""
    if shown_results(scene).stays_placed != _is_wanted(scene) and not bpy.app.timers.is_registered(follow):
        bpy.app.timers.register(follow, first_interval=0.0)


def unregister() -> None:
    """Leave all bodies to Blender."""
    if bpy.app.timers.is_registered(follow):
        bpy.app.timers.unregister(follow)
    for scene in bpy.data.scenes:
        shown_results(scene).stays_placed = False


def _is_wanted(scene: bpy.types.Scene) -> bool:
    settings = scene.bda
    return settings.show_section or bool(settings.compared_folder and settings.show_compared)


def follow() -> None:
    """Place the bodies of every scene, or leave them to Blender, as their settings are now."""
    for scene in bpy.data.scenes:
        shown = shown_results(scene)
        if shown.stays_placed == _is_wanted(scene):
            continue
        shown.stays_placed = not shown.stays_placed
        if shown.stays_placed:
            contours_of(scene).refresh()
        elif not contours_of(scene).is_shown:
            shown.put_bodies_back()
