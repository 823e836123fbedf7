"""Main findings of a run, one number each: the summary of a report, and the columns of a comparison."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.units import kilonewtons, mass_text, rounded_up
from ..model.debris.throws import Debris, percentiles_by_mass
from ..model.results.collapse import ConnectionCounts, collapse_progress
from ..model.results.force_history import most_loaded
from ..model.results.moving import still_moving_note
from ..texts import UP, Quantity, Text, Unit, distance_to_keep
from .run_folder import ReportedRun

IMPACT = Text("Impact of the ball")

NO_OUTCOME, NONE = Text("not known: the run has no outcome"), Text("none")


@dataclass(frozen=True, slots=True)
class Finding:
    """A number with its name and unit, and its text."""

    label: str
    unit: Unit
    value: float | None
    text: str


def findings(run: ReportedRun, debris: Debris) -> list[Finding]:
    """Return the main findings of a run that has results, always in the same order, the value None where unknown."""
    results = run.recorded
    rest, has_outcome = run.rest, run.ending.has_outcome
    rest_s = rest.at_rest_s if has_outcome else None
    unrest = Text("nothing moved") if rest.first_motion_s is None else Text("not at rest at the end")
    unrest = unrest if has_outcome else NO_OUTCOME
    first = [
        _finding(IMPACT, "s", run.ball.first_hit_s, ".3f", Text("none") if has_outcome else Text("none so far")),
        *_connections(ConnectionCounts.of_results(results)),
        _finding(Text("Progress of the collapse"), "%", 100.0 * float(collapse_progress(results)[-1]), ".0f"),
        _finding(Text("All shards at rest from"), "s", rest_s, ".2f", unrest),
        Finding(
            Text("Debris"), Unit("t"), float(debris.masses_kg.sum()) / 1e3, mass_text(float(debris.masses_kg.sum()), 1)
        ),
        _finding(Text("Footprint of the debris"), "m²", debris.area.area(), ".0f"),
        _finding(Text("Height of the pile"), "m", debris.highest_m, ".2f"),
    ]
    return [*first, *_throws(run, debris), _largest_load(run)]


def _connections(counts: ConnectionCounts) -> list[Finding]:
    """Return what has cracked and what is torn, apart where the run recorded it."""
    cracked, torn = Text("not known: cracked or torn {} of {}", counts.broken, counts.connections), Text("not known")
    if counts.cracked is not None:
        cracked = Text("{} of {}", counts.cracked, counts.connections)
        if counts.cracked:
            cracked = Text("{} of {}, of these yielded {}", counts.cracked, counts.connections, counts.yielded)
        torn = Text("{} of {}", counts.torn, counts.connections)
    return [
        Finding(Text("Connections cracked, held by bars"), Unit("1"), counts.cracked, cracked),
        Finding(Text("Connections torn"), Unit("1"), counts.torn, torn),
    ]


def _throws(run: ReportedRun, debris: Debris) -> list[Finding]:
    labels = (
        Text("95 % of the debris's mass thrown up to"),
        Text("Largest throw"),
        Text("Debris beyond the bridge's outline, at most"),
    )
    if not len(debris.bodies):
        return [Finding(label, Unit("m", UP), None, Text("no debris")) for label in labels]
    farthest = debris.throws_m.argmax()
    largest, body = float(debris.throws_m[farthest]), run.recorded.inventory.body_names[debris.bodies[farthest]]
    (most_of_it,) = percentiles_by_mass(debris.throws_m, debris.masses_kg, (95,)).tolist()
    reach_m, note = float(debris.reaches_m.max()), still_moving_note(run.recorded)
    texts = (
        distance_to_keep(most_of_it, ".2f"),
        Text("{}, {}", distance_to_keep(largest, ".2f"), body),
        distance_to_keep(rounded_up(reach_m, "0.01")),
    )
    return [
        Finding(label, Unit("m", UP), value, Text("{} ({})", text, note) if note else text)
        for label, value, text in zip(labels, (most_of_it, largest, reach_m), texts, strict=True)
    ]


def _largest_load(run: ReportedRun) -> Finding:
    results = run.recorded
    peaks = most_loaded(results.frames.loads.body_peaks_n, results.inventory.of_kind("shard"), 1)
    if not peaks:
        return Finding(Text("Largest load on a shard"), Unit("kN"), None, Text("not known"))
    (peak,) = peaks
    name, time_s = results.inventory.body_names[peak.row], results.frames.time_s[peak.step]
    text = Text(
        "{}, the resultant on {} in its worst sub-step, at {} s",
        Quantity(kilonewtons(peak.force_n), "kN"),
        name,
        f"{time_s:.3f}",
    )
    return Finding(Text("Largest load on a shard"), Unit("kN"), peak.force_n / 1e3, text)


def _finding(label: str, unit: str, value: float | None, form: str, otherwise: str = NONE) -> Finding:
    if value is None or not np.isfinite(value):
        return Finding(label, Unit(unit), None, otherwise)
    return Finding(label, Unit(unit), value, Quantity(value, unit, form))
