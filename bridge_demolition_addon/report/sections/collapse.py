"""The collapse in a report: heights of the spans, progress, time to rest, and energy."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...charts.histories import energy_history, progress_history, span_heights
from ...engineering.mechanics.work import FrameWork
from ...model.results.arrays import Results
from ...model.results.collapse import REST_SPEED_M_S, Span, collapse_progress, spans_of
from ...model.results.energy import ACCEPTED_SHARE, Energy, counted_share, energy_of, is_known, made_share
from ...texts import Quantity, Text, joined
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section, facts
from ..findings import NO_OUTCOME
from ..run_folder import ReportedRun


def collapse_section(run: ReportedRun) -> Section:
    """Return how the bridge came down."""
    results = run.recorded
    bridge = run.scenario.bridge if run.scenario else None  # there is none where all is of files or objects
    lengths = bridge.span_lengths_m if bridge else ()
    spans, progress, energy = spans_of(results, lengths), collapse_progress(results), energy_of(results)
    definitions = Text(
        "Progress is the part of the height of the shards' common centre of mass above the ground that is lost: "
        "100 % would be all of it flat on the ground. A shard moves from a speed of {} on; all rest once their "
        "kinetic energy stays below what the scenario takes for rest.",
        Quantity(REST_SPEED_M_S, "m/s", "g"),
    )
    blocks: list[Block] = [
        Paragraph(definitions),
        facts("Course of the collapse", [*_course(run, progress), *_load_rows(run)], "collapse"),
    ]
    if spans:
        blocks += [
            Picture(
                partial(span_heights, times_s=results.frames.time_s, spans=spans, impact_s=run.ball.first_hit_s),
                "Height of every span over time.",
            ),
            _span_table(spans),
        ]
    blocks += [
        Picture(
            partial(progress_history, times_s=results.frames.time_s, progress=progress, impact_s=run.ball.first_hit_s),
            "Progress of the collapse.",
            75.0,
        ),
        Picture(
            partial(energy_history, energy=energy, impact_s=run.ball.first_hit_s),
            "Energy of shards and ball, the potential one above its least in this run. Dissipated is the energy "
            "lost since the beginning by impacts, friction, damping and breaking. It falls where anything but gravity "
            "does work.",
        ),
        _energy_table(energy),
        *_solver_blocks(results),
    ]
    return Section("Collapse", tuple(blocks))


def _solver_blocks(results: Results) -> list[Block]:
    """Return the energy that the solver made by numerical error."""
    if not is_known(results):
        return [Paragraph("How much energy the solver made is not known: not every sub-step was read.")]
    work, share = results.frames.work, made_share(results)
    words = Text(
        "Blender's solver makes energy where it pulls stretched connections together, or pushes overlapping "
        "bodies apart. A real structure has no such energy: shards that gain it are thrown too far."
    )
    rows = [
        (Text("Made by the solver"), Quantity(np.nansum(work.made_j) / 1e3, "kJ", ".1f")),
        (Text("Share of what was dissipated between bodies"), Text("{} %", f"{100.0 * share:.2f}")),
        (Text("by connections pulled together"), Quantity(np.nansum(work.made_by_connections_j) / 1e3, "kJ", ".1f")),
        (Text("by contacts pushed apart"), Quantity(np.nansum(work.made_by_contacts_j) / 1e3, "kJ", ".1f")),
        (Text("by bodies moved out of each other"), Quantity(np.nansum(work.made_by_lifting_j) / 1e3, "kJ", ".1f")),
        (Text("Dissipated between bodies"), Quantity(np.nansum(work.dissipated_j) / 1e6, "MJ", ".3f")),
        *_in_cracks(work),
        (Text("Work of gravity"), Quantity(np.nansum(work.gravity_j) / 1e6, "MJ", ".3f")),
        (Text("Work of blast and other loads"), Quantity(np.nansum(work.loads_j) / 1e6, "MJ", ".3f")),
        (Text("Work of tools"), Quantity(np.nansum(work.tools_j) / 1e6, "MJ", ".3f")),
    ]
    blocks: list[Block] = [Paragraph(words), facts("Energy made by the solver", rows, "solver_energy")]
    if counted_share(results) > ACCEPTED_SHARE:
        warning = Text(
            "The solver made {} % of what was dissipated, more than {} %: shorter sub-steps or more solver "
            "iterations make it less.",
            f"{100.0 * share:.1f}",
            f"{100.0 * ACCEPTED_SHARE:g}",
        )
        blocks.insert(1, Paragraph(warning, is_notice=True))
    return blocks


def _in_cracks(work: FrameWork) -> list[tuple[str, str]]:
    """Return the parts of what was dissipated in cracks that bars cross; none where there were none."""
    parts = ((Text("by bars that yielded"), work.yielding_j), (Text("by sides of their cracks"), work.crack_friction_j))
    sums = [(name, float(np.nansum(of_frames_j))) for name, of_frames_j in parts]
    return [(name, Quantity(total_j / 1e6, "MJ", ".3f")) for name, total_j in sums if total_j > 0.0]


def _course(run: ReportedRun, progress: np.ndarray) -> list[tuple[str, str]]:
    rest, ending = run.rest, run.ending
    began = Text("never") if rest.first_motion_s is None else Text("{} s", f"{rest.first_motion_s:.3f}")
    if not ending.has_outcome:
        began = Text("not up to {} s", f"{ending.time_s:.2f}") if rest.first_motion_s is None else began
        ended = NO_OUTCOME
    elif rest.first_motion_s is None:
        ended = Text("nothing moved")
    elif rest.at_rest_s is None:
        ended = Text("not within this run: {} shards still move at the end", rest.moving_at_end)
        ended = ended if rest.moving_at_end else Text("not for long enough before the end of the run")
    else:
        ended = Text(
            "{} s, {} s after the first motion", f"{rest.at_rest_s:.3f}", f"{rest.at_rest_s - rest.first_motion_s:.3f}"
        )
    return [
        (Text("First shard moves"), began),
        (Text("All shards at rest"), ended),
        (Text("Progress of the collapse at the end"), Text("{} %", f"{100.0 * progress[-1]:.1f}")),
    ]


def _load_rows(run: ReportedRun) -> list[tuple[str, str]]:
    """Return each load at the first break, at the first motion and at the end."""
    results = run.recorded
    rows: list[tuple[str, str]] = []
    broken = np.flatnonzero((~results.frames.intact).any(axis=1))
    moved_s = run.rest.first_motion_s
    for number, load in enumerate(run.scenario.loads if run.scenario else (), start=1):
        forces = [Text("{} at the end", Quantity(load.force_n(float(results.frames.time_s[-1])) / 1e3, "kN", ".4g"))]
        if moved_s is not None:
            forces.insert(0, Text("{} as the first shard moved", Quantity(load.force_n(moved_s) / 1e3, "kN", ".4g")))
        if len(broken):
            forces.insert(
                0,
                Text(
                    "{} at the first break",
                    Quantity(load.force_n(float(results.frames.time_s[broken[0]])) / 1e3, "kN", ".4g"),
                ),
            )
        name = Text("Load {} on {}", number, load.where) if load.where else Text("Load {}", number)
        rows.append((name, joined("{}; {}", forces)))
    return rows


def _span_table(spans: tuple[Span, ...]) -> DataTable:
    columns = (
        Column("span", "span", "", lambda span: span.name),
        Column("shards", "shards", "d", lambda span: len(span.bodies)),
        Column("height at first", "height_first_m", ".2f", lambda span: float(span.heights_m[0])),
        Column("at the end", "height_last_m", ".2f", lambda span: float(span.heights_m[-1])),
        Column("came down by", "drop_m", ".2f", lambda span: span.drop_m),
    )
    return DataTable.of("spans", "Spans: height of the centre of mass", columns, spans)


def _energy_table(energy: Energy) -> DataTable:
    columns = (
        Column("time", "time_s", ".2f", lambda step: float(energy.times_s[step])),
        Column("potential", "potential_MJ", ".3f", lambda step: float(energy.potential_j[step]) / 1e6),
        Column("kinetic", "kinetic_MJ", ".3f", lambda step: float(energy.kinetic_j[step]) / 1e6),
        Column("of it in rotation", "rotation_MJ", ".3f", lambda step: float(energy.rotation_j[step]) / 1e6),
        Column("dissipated", "dissipated_MJ", ".3f", lambda step: float(energy.dissipated_j[step]) / 1e6),
    )
    count = len(energy.times_s)
    steps = sorted({round(share * (count - 1) / 8) for share in range(9)} | {int(energy.kinetic_j.argmax())})
    return DataTable.of("energy", "Energy over time, the largest kinetic energy among it", columns, steps)
