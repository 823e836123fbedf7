"""The collapse in a report: heights of the spans, progress, time to rest, and energy."""

from __future__ import annotations

from functools import partial

import numpy as np

from ...charts.histories import energy_history, progress_history, span_heights
from ...engineering.mechanics.work import FrameWork
from ...model.results.arrays import Results
from ...model.results.collapse import REST_SPEED_M_S, Span, collapse_progress, spans_of
from ...model.results.energy import Energy, energy_of
from ...model.results.solver_energy import ACCEPTED_SHARE, is_known, made_share
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section, facts
from ..findings import NO_OUTCOME
from ..run_folder import ReportedRun


def collapse_section(run: ReportedRun) -> Section:
    """Return how the bridge came down."""
    results = run.recorded
    bridge = run.scenario.bridge if run.scenario else None  # there is none where all is of files or objects
    lengths = bridge.span_lengths_m if bridge else ()
    spans, progress, energy = spans_of(results, lengths), collapse_progress(results), energy_of(results)
    definitions = (
        "Progress is the part of the height of the shards' common centre of mass above the ground that is lost: 100 % "
        f"would be all of it flat on the ground. A shard moves from a speed of {REST_SPEED_M_S:g} m/s on; all rest "
        "once their kinetic energy stays below what the scenario takes for rest."
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
    words = (
        "Blender's solver makes energy where it pulls stretched connections together, or pushes overlapping bodies "
        "apart. A real structure has no such energy: shards that gain it are thrown too far."
    )
    rows = [
        ("Made by the solver", f"{np.nansum(work.made_j) / 1e3:.1f} kJ"),
        ("Share of what was dissipated between bodies", f"{100.0 * share:.2f} %"),
        ("by connections pulled together", f"{np.nansum(work.made_by_connections_j) / 1e3:.1f} kJ"),
        ("by contacts pushed apart", f"{np.nansum(work.made_by_contacts_j) / 1e3:.1f} kJ"),
        ("by bodies moved out of each other", f"{np.nansum(work.made_by_lifting_j) / 1e3:.1f} kJ"),
        ("Dissipated between bodies", f"{np.nansum(work.dissipated_j) / 1e6:.3f} MJ"),
        *_in_cracks(work),
        ("Work of gravity", f"{np.nansum(work.gravity_j) / 1e6:.3f} MJ"),
        ("Work of blast and other loads", f"{np.nansum(work.loads_j) / 1e6:.3f} MJ"),
        ("Work of tools", f"{np.nansum(work.tools_j) / 1e6:.3f} MJ"),
    ]
    blocks: list[Block] = [Paragraph(words), facts("Energy made by the solver", rows, "solver_energy")]
    if share > ACCEPTED_SHARE:
        warning = (
            f"The solver made {100.0 * share:.1f} % of what was dissipated, more than {100.0 * ACCEPTED_SHARE:g} %: "
            "shorter sub-steps or more solver iterations make it less."
        )
        blocks.insert(1, Paragraph(warning, is_notice=True))
    return blocks


def _in_cracks(work: FrameWork) -> list[tuple[str, str]]:
    """Return the parts of what was dissipated in cracks that bars cross; none where there were none."""
    parts = (("by bars that yielded", work.yielding_j), ("by sides of their cracks", work.crack_friction_j))
    sums = [(name, float(np.nansum(of_frames_j))) for name, of_frames_j in parts]
    return [(name, f"{total_j / 1e6:.3f} MJ") for name, total_j in sums if total_j > 0.0]


def _course(run: ReportedRun, progress: np.ndarray) -> list[tuple[str, str]]:
    rest, ending = run.rest, run.ending
    began = "never" if rest.first_motion_s is None else f"{rest.first_motion_s:.3f} s"
    if not ending.has_outcome:
        began = f"not up to {ending.time_s:.2f} s" if rest.first_motion_s is None else began
        ended = NO_OUTCOME
    elif rest.first_motion_s is None:
        ended = "nothing moved"
    elif rest.at_rest_s is None:
        ended = f"not within this run: {rest.moving_at_end} shards still move at the end"
        ended = ended if rest.moving_at_end else "not for long enough before the end of the run"
    else:
        ended = f"{rest.at_rest_s:.3f} s, {rest.at_rest_s - rest.first_motion_s:.3f} s after the first motion"
    return [
        ("First shard moves", began),
        ("All shards at rest", ended),
        ("Progress of the collapse at the end", f"{100.0 * progress[-1]:.1f} %"),
    ]


def _load_rows(run: ReportedRun) -> list[tuple[str, str]]:
    """Return each load at the first break, at the first motion and at the end."""
    results, rows = run.recorded, []
    broken = np.flatnonzero((~results.frames.intact).any(axis=1))
    moved_s = run.rest.first_motion_s
    for number, load in enumerate(run.scenario.loads if run.scenario else (), start=1):
        forces = [f"{load.force_n(float(results.frames.time_s[-1])) / 1e3:.4g} kN at the end"]
        if moved_s is not None:
            forces.insert(0, f"{load.force_n(moved_s) / 1e3:.4g} kN as the first shard moved")
        if len(broken):
            forces.insert(0, f"{load.force_n(float(results.frames.time_s[broken[0]])) / 1e3:.4g} kN at the first break")
        rows.append((f"Load {number}{f' on {load.where}' if load.where else ''}", "; ".join(forces)))
    return rows


def _span_table(spans: tuple[Span, ...]) -> DataTable:
    columns = (
        Column("span", "span", "", lambda span: span.name),
        Column("shards", "shards", "d", lambda span: len(span.bodies)),
        Column("height at first (m)", "height_first_m", ".2f", lambda span: float(span.heights_m[0])),
        Column("at the end (m)", "height_last_m", ".2f", lambda span: float(span.heights_m[-1])),
        Column("came down by (m)", "drop_m", ".2f", lambda span: span.drop_m),
    )
    return DataTable.of("spans", "Spans: height of the centre of mass", columns, spans)


def _energy_table(energy: Energy) -> DataTable:
    columns = (
        Column("time (s)", "time_s", ".2f", lambda step: float(energy.times_s[step])),
        Column("potential (MJ)", "potential_MJ", ".3f", lambda step: float(energy.potential_j[step]) / 1e6),
        Column("kinetic (MJ)", "kinetic_MJ", ".3f", lambda step: float(energy.kinetic_j[step]) / 1e6),
        Column("of it in rotation (MJ)", "rotation_MJ", ".3f", lambda step: float(energy.rotation_j[step]) / 1e6),
        Column("dissipated (MJ)", "dissipated_MJ", ".3f", lambda step: float(energy.dissipated_j[step]) / 1e6),
    )
    count = len(energy.times_s)
    steps = sorted({round(share * (count - 1) / 8) for share in range(9)} | {int(energy.kinetic_j.argmax())})
    return DataTable.of("energy", "Energy over time, the largest kinetic energy among it", columns, steps)
