"""Main findings of a run, one number each: the summary of a report, and the columns of a comparison."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.units import kilonewtons, mass_text, rounded_up
from ..model.debris.throws import Debris, percentiles_by_mass
from ..model.results.collapse import collapse_progress
from ..model.results.connection_counts import ConnectionCounts
from ..model.results.force_history import most_loaded
from ..model.results.moving import still_moving_note
from .run_folder import ReportedRun

IMPACT = "Impact of the ball"

NO_OUTCOME = "not known: the run has no outcome"


@dataclass(frozen=True, slots=True)
class Finding:
    """A number with its name and unit, and its text."""

    label: str
    unit: str
    value: float | None
    text: str


def findings(run: ReportedRun, debris: Debris) -> list[Finding]:
    """Return the main findings of a run that has results, always in the same order, the value None where unknown."""
    results = run.recorded
    rest, has_outcome = run.rest, run.ending.has_outcome
    rest_s = rest.at_rest_s if has_outcome else None
    unrest = "nothing moved" if rest.first_motion_s is None else "not at rest at the end"
    unrest = unrest if has_outcome else NO_OUTCOME
    first = [
        _finding(IMPACT, "s", run.ball.first_hit_s, ".3f", "none" if has_outcome else "none so far"),
        *_connections(ConnectionCounts.of_results(results)),
        _finding("Progress of the collapse", "%", 100.0 * float(collapse_progress(results)[-1]), ".0f"),
        _finding("All shards at rest from", "s", rest_s, ".2f", unrest),
        Finding("Debris", "t", float(debris.masses_kg.sum()) / 1e3, mass_text(float(debris.masses_kg.sum()), 1)),
        _finding("Footprint of the debris", "m²", debris.area.area(), ".0f"),
        _finding("Height of the pile", "m", debris.highest_m, ".2f"),
    ]
    return [*first, *_throws(run, debris), _largest_load(run)]


def _connections(counts: ConnectionCounts) -> list[Finding]:
    """Return what has cracked and what is torn, apart where the run recorded it."""
    cracked, torn = f"not known: cracked or torn {counts.broken} of {counts.connections}", "not known"
    if counts.cracked is not None:
        yielded = f", of these yielded {counts.yielded}" if counts.cracked else ""
        cracked = f"{counts.cracked} of {counts.connections}{yielded}"
        torn = f"{counts.torn} of {counts.connections}"
    return [
        Finding("Connections cracked, held by bars", "1", counts.cracked, cracked),
        Finding("Connections torn", "1", counts.torn, torn),
    ]


def _throws(run: ReportedRun, debris: Debris) -> list[Finding]:
    labels = ("95 % of the debris's mass thrown up to", "Largest throw", "Debris beyond the bridge's outline, at most")
    if not len(debris.bodies):
        return [Finding(label, "m", None, "no debris") for label in labels]
    farthest = debris.throws_m.argmax()
    largest, body = float(debris.throws_m[farthest]), run.recorded.inventory.body_names[debris.bodies[farthest]]
    (most_of_it,) = percentiles_by_mass(debris.throws_m, debris.masses_kg, (95,)).tolist()
    reach_m, note = float(debris.reaches_m.max()), still_moving_note(run.recorded)
    texts = (f"{most_of_it:.2f} m", f"{largest:.2f} m, {body}", f"{rounded_up(reach_m, '0.01')} m")
    return [
        Finding(label, "m", value, f"{text} ({note})" if note else text)
        for label, value, text in zip(labels, (most_of_it, largest, reach_m), texts, strict=True)
    ]


def _largest_load(run: ReportedRun) -> Finding:
    results = run.recorded
    peaks = most_loaded(results.frames.loads.body_peaks_n, results.inventory.of_kind("shard"), 1)
    if not peaks:
        return Finding("Largest load on a shard", "kN", None, "not known")
    (peak,) = peaks
    name, time_s = results.inventory.body_names[peak.row], results.frames.time_s[peak.step]
    text = f"{kilonewtons(peak.force_n)} kN, the resultant on {name} in its worst sub-step, at {time_s:.3f} s"
    return Finding("Largest load on a shard", "kN", peak.force_n / 1e3, text)


def _finding(label: str, unit: str, value: float | None, form: str, otherwise: str = "none") -> Finding:
    if value is None or not np.isfinite(value):
        return Finding(label, unit, None, otherwise)
    return Finding(label, unit, value, f"{value:{form}} {unit}")
