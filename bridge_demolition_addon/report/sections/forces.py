"""Forces and stresses in a report: histories, the most loaded, the hits of the ball, and what broke."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from ...charts.histories import (
    breaking_history,
    compared_histories,
    contact_force_history,
    load_history,
    logged_load_history,
)
from ...charts.stress_elevation import stress_elevation
from ...engineering.geometry.vectors import length
from ...model.results.arrays import Results
from ...model.results.force_history import (
    BearingHistory,
    bearing_histories,
    breaking_by_kind,
    contact_forces,
    most_loaded,
)
from ...model.results.records import BearingOfRun
from ...model.run_folder.logs import LoggedForces
from ...model.scenario.scenario import bearing_tables
from ...model.structure.bearing_ranges import ONE_CUT
from ...texts import Text, Unit
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section
from ..run_folder import ReportedRun
from .reinforcement import bar_blocks

_MOST_LINES = 8

_NOTES = Text(
    "At rest: mean over the first frame after any warm-up. Least and largest are those of single sub-steps, as "
    "long as the bearing was there; below 0 it held against uplift or, without tension, Bullet's constraint "
    "answered to contacts, which a bearing cannot. Opened: largest part of its area that lifted off. "
    "Displacement: largest horizontal one of what lies above against what lies below, from where they were built, "
    "and the part of it that slid. Moments are about the axis across the road. Every frame is in bearing_log.csv."
)


def bearing_blocks(run: ReportedRun) -> list[Block]:
    """Return a table and a chart of a run's bearings; none without `[[bearings]]`."""
    of_all = bearing_histories(run.recorded, bearing_tables(run.scenario) if run.scenario else ())
    histories = [bearing for bearing in of_all if np.isfinite(bearing.forces_n[1:]).any()]
    extremes = run.summary.bearings if run.summary else ()
    blocks: list[Block] = []
    if extremes:
        blocks += [_extremes(extremes), Paragraph(_NOTES), Paragraph(ONE_CUT)]
    elif histories:
        blocks += [_means(histories), Paragraph(ONE_CUT)]
    if histories:
        largest = sorted(histories, key=lambda bearing: -float(np.nanmax(bearing.forces_n[1:, 2], initial=-np.inf)))
        shown = [bearing for bearing in histories if bearing in largest[:_MOST_LINES]]
        times_s = run.recorded.frames.time_s[1:]
        lines = [(bearing.name, times_s, bearing.forces_n[1:, 2] / 1e3) for bearing in shown]
        caption = Text("Vertical forces of bearings on what lies above them, each the mean over a frame.")
        if len(histories) > len(shown):
            caption = Text("{} The {} with the largest are shown.", caption, _MOST_LINES)
        blocks.append(
            Picture(
                partial(compared_histories, label=Text("vertical force ({})", Unit("kN")), histories=lines), caption
            )
        )
    return blocks


def _extremes(bearings: Sequence[BearingOfRun]) -> DataTable:
    columns = (
        Column("bearing", "bearing", "", lambda bearing: bearing.name),
        Column("up at rest", "at_rest_up_kN", ".1f", scaled("at_rest_up_n", 1e-3)),
        Column("least", "least_up_kN", ".1f", scaled("least_up_n", 1e-3)),
        Column(Text("largest", context="force"), "largest_up_kN", ".1f", scaled("largest_up_n", 1e-3)),
        Column("at", "largest_up_s", ".3f", scaled("largest_up_s", 1.0)),
        Column("largest horizontal", "largest_horizontal_kN", ".1f", scaled("largest_horizontal_n", 1e-3)),
        Column("largest moment", "largest_moment_y_kNm", ".1f", scaled("largest_moment_y_nm", 1e-3)),
        Column("opened", "largest_open_percent", ".0f", scaled("largest_open_share", 100.0)),
        Column("displacement", "largest_displacement_mm", ".1f", scaled("largest_displacement_m", 1e3)),
        Column("slid", "slip_mm", ".1f", scaled("slip_m", 1e3)),
        Column("left at the end", "left_percent", ".0f", scaled("left_share", 100.0)),
    )
    return DataTable.of("bearings", "Bearings", columns, bearings)


def scaled(name: str, factor: float = 1.0) -> Callable[[Any], float | None]:
    """Return what gives a field of a record by a factor; None where it is not known."""

    def value(record: Any) -> float | None:
        found: float | None = getattr(record, name)
        return None if found is None else factor * found

    return value


def _means(histories: Sequence[BearingHistory]) -> DataTable:
    """Return the table of a run whose summary has no bearings: one that was recorded before, or was killed."""

    def upwards(choose: Callable[[np.ndarray], Any]) -> Callable[[BearingHistory], float]:
        return lambda bearing: float(choose(bearing.forces_n[1:, 2])) / 1e3

    columns = (
        Column("bearing", "bearing", "", lambda bearing: bearing.name),
        Column("up at first", "first_up_kN", ".1f", upwards(lambda forces: forces[0])),
        Column("least", "least_up_kN", ".1f", upwards(np.nanmin)),
        Column(Text("largest", context="force"), "largest_up_kN", ".1f", upwards(np.nanmax)),
        Column(
            "largest horizontal",
            "largest_horizontal_kN",
            ".1f",
            lambda bearing: float(np.nanmax(length(bearing.forces_n[1:, :2]))) / 1e3,
        ),
        Column("left at the end", "left_percent", ".0f", lambda bearing: 100.0 * float(bearing.intact[-1])),
    )
    return DataTable.of("bearings", "Forces of bearings, each the mean over a frame", columns, histories)


_BEYOND_THE_FORCE = Text(
    "The force of a connection is the resultant of its three directions. Each direction by itself is held up to "
    "the breaking force, so that the resultant can be up to √3 times as large."
)


def force_section(run: ReportedRun) -> Section:
    """Return loads, hits and breaking of a run that has results."""
    results = run.recorded
    known = np.isfinite(results.frames.loads.body_sums_n).any()
    blocks: list[Block] = []
    if known:
        forces = contact_forces(results)
        blocks += [
            Picture(
                partial(contact_force_history, forces=forces, impact_s=run.ball.first_hit_s),
                "Contact forces, each the mean over a frame. Contacts that press a body from two sides cancel "
                "within it, so that the total is a lower bound. Foundations that hold are not contacts.",
            ),
            Picture(
                partial(load_history, results=results, impact_s=run.ball.first_hit_s),
                "Largest load on a shard by its connections and contacts together. Peaks of impacts grow as the step "
                "of the physics shrinks.",
            ),
            _loaded_bodies(results),
            _loaded_connections(results),
            *bearing_blocks(run),
            *bar_blocks(run),
        ]
        if run.scenario and run.scenario.connections.breaking_force_newton is not None:
            blocks.append(Paragraph(_BEYOND_THE_FORCE))
    else:
        blocks.append(Paragraph("Forces were not recorded in this run.", is_notice=True))
    blocks += _hit_blocks(run)
    if known:
        blocks += _stress_blocks(run)
    blocks += _breaking_blocks(run)
    return Section("Forces and stresses", tuple(blocks))


def logged_section(run: ReportedRun) -> Section:
    """Return what the logs of a killed run still hold of forces and breaking."""
    blocks: list[Block] = []
    forces: LoggedForces | None = run.logged_forces
    if forces is not None:
        draw = partial(
            logged_load_history, times_s=forces.times_s, sums_n=forces.sums_n, resultants_n=forces.resultants_n
        )
        blocks.append(Picture(draw, "Largest load on a shard or ball, as far as logged."))
    if run.logged_breaks is not None:
        blocks.append(Paragraph(Text("Connections cracked or torn as far as logged: {}.", run.logged_breaks)))
    return Section("Forces as far as logged", tuple(blocks))


def _loaded_bodies(results: Results) -> DataTable:
    inventory, frames = results.inventory, results.frames
    resultants_n = frames.loads.body_peaks_n
    columns = (
        Column("shard", "shard", "", lambda peak: str(inventory.body_names[peak.row])),
        Column("of", "member", "", lambda peak: str(inventory.body_members[peak.row])),
        Column("mass", "mass_kg", ".0f", significant=3, value=lambda peak: float(inventory.masses_kg[peak.row])),
        Column("sum of magnitudes", "peak_force_sum_kN", ".1f", lambda peak: float(peak.force_n / 1e3)),
        Column(
            "resultant then",
            "peak_force_kN",
            ".1f",
            lambda peak: float(resultants_n[peak.step, peak.row] / 1e3),
        ),
        Column("time", "time_s", ".3f", lambda peak: float(frames.time_s[peak.step])),
    )
    peaks = most_loaded(frames.loads.body_peak_sums_n, inventory.of_kind("shard"))
    return DataTable.of("most_loaded_shards", "The ten most loaded shards", columns, peaks)


def _loaded_connections(results: Results) -> DataTable:
    inventory, frames = results.inventory, results.frames
    ends = inventory.body_names[inventory.pairs]
    columns = (
        Column("connection", "connection", "", lambda peak: str(inventory.connection_names[peak.row])),
        Column("between", "first_body", "", lambda peak: str(ends[peak.row, 0])),
        Column("and", "second_body", "", lambda peak: str(ends[peak.row, 1])),
        Column("area", "area_m2", ".3f", lambda peak: _area_m2(inventory.areas_m2[peak.row])),
        Column("force", "peak_force_kN", ".1f", lambda peak: peak.force_n / 1e3),
        Column("time", "time_s", ".3f", lambda peak: float(frames.time_s[peak.step])),
        Column("broken at", "broken_s", ".3f", lambda peak: _broken_s(results, peak.row)),
    )
    peaks = most_loaded(frames.loads.connection_peaks_n, np.arange(len(inventory.pairs)))
    return DataTable.of("most_loaded_connections", "The ten most loaded connections", columns, peaks)


def _area_m2(area_m2: float) -> float | None:
    return float(area_m2) if area_m2 > 0.0 else None


def _broken_s(results: Results, connection: int) -> float | None:
    broken = np.flatnonzero(~results.frames.intact[:, connection])
    return float(results.frames.time_s[broken[0]]) if len(broken) else None


def _hit_blocks(run: ReportedRun) -> list[Block]:
    hits = run.ball.hits_of_the_ball
    if not len(run.recorded.inventory.of_kind("ball")):
        return [Paragraph("There is no ball in this run.")]
    if not hits:
        return [Paragraph("The ball hit nothing, or its hits were not recorded.")]

    columns = (
        Column("ball", "ball", "", lambda hit: hit.ball),
        Column("time", "time_s", ".3f", scaled("time_s")),
        Column("lasted", "lasted_ms", ".1f", scaled("lasted_s", 1e3)),
        Column("speed", "approach_m_s", ".2f", scaled("approach_m_s")),
        Column("impulse", "impulse_kNs", ".2f", scaled("impulse_ns", 1e-3), unit="kN·s"),
        Column("raw peak", "raw_peak_force_MN", ".2f", scaled("raw_peak_force_n", 1e-6), unit="MN"),
        Column("half sine", "half_sine_peak_force_MN", ".2f", scaled("half_sine_peak_force_n", 1e-6), unit="MN"),
        Column("Hertz", "hertz_peak_force_MN", ".2f", scaled("hertz_peak_force_n", 1e-6), unit="MN"),
    )
    notes = Text(
        "The impulse of a hit does not depend on the step of the physics, the raw peak does. Half sine: the "
        "impulse spread over Hertz's or the given contact time. Hertz: the force of an elastic hit, which steel "
        "and concrete cannot reach, an upper bound for a ball that flies into something. Where falling debris "
        "pushes the ball while it touches, the impulse is larger than the speed explains, and Hertz's force says "
        "nothing."
    )
    return [DataTable.of("hits_of_the_ball", "Hits of the ball", columns, hits), Paragraph(notes)]


def _stress_blocks(run: ReportedRun) -> list[Block]:
    results, moments = run.recorded, []
    if run.ball.impact is not None:
        moments.append(
            (
                int(np.abs(results.frames.time_s - run.ball.impact.time_s).argmin()),
                Text("in the frame of the ball's impact"),
            )
        )
    peaks = most_loaded(results.frames.loads.body_peak_sums_n, results.inventory.of_kind("shard"), 1)
    if peaks:
        moments.append((peaks[0].step, Text("in the frame of the largest load")))
    caption = (
        "Equivalent stress of the shards {}, {} s, seen from the side, nearer shards in front: the mean over each "
        "shard, in the sub-step of the frame in which its loads were largest."
    )
    return [
        Picture(
            partial(stress_elevation, results=results, step=step),
            Text(caption, words, f"{results.frames.time_s[step]:.3f}"),
            85.0,
        )
        for step, words in moments
        if np.nanmax(results.frames.loads.von_mises_pa[step], initial=0.0) > 0.0
    ]


def _breaking_blocks(run: ReportedRun) -> list[Block]:
    results = run.recorded
    kinds = breaking_by_kind(results)
    if not kinds:
        return [Paragraph("There are no connections, or nothing is known of them.")]
    columns = (
        Column("connections", "kind", "", lambda kind: kind.kind),
        Column("there were", "count", "d", lambda kind: kind.count),
        Column("cracked or torn", "broken", "d", lambda kind: int(kind.broken[-1])),
        Column("cracked or torn", "broken_percent", ".1f", lambda kind: 100.0 * kind.broken[-1] / kind.count),
        Column("torn", "torn", "d", lambda kind: None if kind.torn is None else int(kind.torn[-1])),
        Column(
            "first at",
            "first_break_s",
            ".3f",
            lambda kind: float(results.frames.time_s[(kind.broken > 0).argmax()]) if kind.broken.any() else None,
        ),
    )
    return [
        Picture(
            partial(breaking_history, times_s=results.frames.time_s, kinds=kinds, impact_s=run.ball.first_hit_s),
            "Connections cracked or torn, by the members that they joined.",
            100.0,
        ),
        DataTable.of("breaking", "Connections by kind", columns, kinds),
    ]
