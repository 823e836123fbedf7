"""Comparison of several runs."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial
from itertools import takewhile

from ..charts.histories import compared_histories
from ..charts.plan_maps import debris_maps, debris_maps_height_mm
from ..model.debris.throws import Debris, debris_of
from ..model.results.collapse import collapse_progress
from ..model.results.force_history import largest_on_a_shard
from ..model.scenario import Ball
from ..model.schema import given
from ..texts import Quantity, Text, Unit, joined, point_text
from .document.blocks import Block, Column, DataTable, Document, Paragraph, Picture, Section
from .findings import findings
from .run_folder import ReportedRun


def comparison(runs: Sequence[ReportedRun], version: str) -> Document:
    """Return the main findings of several runs in one table, and their courses in common charts.

    Runs without results are named and left out of what needs them.
    """
    names = unique_names(runs)
    whole = [(name, run) for name, run in zip(names, runs, strict=True) if run.results is not None]
    notices = [
        Paragraph(Text("{}: {}", name, text), is_notice=True)
        for name, run in zip(names, runs, strict=True)
        for text in (*(Text("{}.", doubt) for doubt in (run.first_doubts if run.results else ())), *run.shortcomings)
    ]
    if shared := shared_beginning(runs):
        notices.append(Paragraph(Text("The names of all folders begin with {}, which is left out here.", shared)))
    listed = [(name, run.title, _differences(run)) for name, run in zip(names, runs, strict=True)]
    columns = (Column("run", "run"), Column("scenario", "scenario"), Column("ball and charges", "means"))
    sections = [Section("The runs", (*notices, DataTable("runs", "Runs", columns, listed)))]
    if whole:
        debris = [(name, debris_of(run.recorded)) for name, run in whole]
        sections.append(Section("Findings", (_finding_table(whole, debris),)))
        sections.append(Section("Courses", tuple(_charts(whole, debris))))
    return Document(
        Text("Comparison of {} runs", len(runs)), Text("Bridge Demolition Add-on {}", version), tuple(sections)
    )


def unique_names(runs: Sequence[ReportedRun]) -> list[str]:
    """Return the names of the runs without what they share, with numbers where two folders are called the same."""
    names = [run.name.removeprefix(shared_beginning(runs)) for run in runs]
    return [Text("{} ({})", name, row + 1) if names.count(name) > 1 else name for row, name in enumerate(names)]


def shared_beginning(runs: Sequence[ReportedRun]) -> str:
    """Return the whole words that all names of runs begin with: bridge_ of bridge_mid_span and bridge_near_end.

    Without it the names are as short as columns and legends want them.
    """
    names = (re.findall(r"[^_ -]*[_ -]", run.name) for run in runs)
    shared = "".join(words[0] for words in takewhile(lambda words: len(set(words)) == 1, zip(*names, strict=False)))
    return "" if any(run.name == shared for run in runs) else shared


def _differences(run: ReportedRun) -> str:
    if run.scenario is None:
        return Text("not known")
    ball, charges = run.scenario.ball, run.scenario.charges
    words = []
    if ball:
        mass, ways = Quantity(ball.mass_kg / 1e3, "t", "g"), _ways_of(ball)
        words.append(Text("ball of {} {}", mass, joined("{}, then {}", ways)))
    if charges and run.scenario.blast.explosion:
        mass = Quantity(sum(charge.mass_kg for charge in charges), "kg", "g")
        words.append(Text("1 charge, {}", mass) if len(charges) == 1 else Text("{} charges, {}", len(charges), mass))
    return joined("{}; {}", words) or Text("no ball and no charges")


def _ways_of(ball: Ball) -> list[Text]:
    if ball.cable:
        length = Quantity(ball.cable.length_m, "m", "g")
        return [Text("on a cable of {}, drawn aside by {}°", length, f"{ball.cable.angle_degrees:g}")]
    return [
        Text("from {} on {}", Quantity(given(drop.drop_height_m), "m", "g"), point_text((along, across)))
        for drop in ball.drops
        for along, across in [given(drop.target_m)]
    ]


def _finding_table(runs: Sequence[tuple[str, ReportedRun]], debris: Sequence[tuple[str, Debris]]) -> DataTable:
    by_run = [findings(run, of_it) for (_, run), (_, of_it) in zip(runs, debris, strict=True)]
    columns = (
        Column("", "finding"),
        Column("unit", "unit"),
        *(Column(Text("{}", name), name, ".5g", of_row=True) for name, _ in runs),
    )
    rows = [(same[0].label, same[0].unit, *(finding.value for finding in same)) for same in zip(*by_run, strict=True)]
    return DataTable("comparison", "Main findings", columns, rows)


def _charts(runs: Sequence[tuple[str, ReportedRun]], debris: Sequence[tuple[str, Debris]]) -> list[Block]:
    progress = [(name, run.recorded.frames.time_s, 100.0 * collapse_progress(run.recorded)) for name, run in runs]
    broken = [
        (name, run.recorded.frames.time_s, 100.0 * (~run.recorded.frames.intact).mean(axis=1))
        for name, run in runs
        if run.recorded.frames.intact.shape[1]
    ]
    loads = []
    for name, run in runs:
        frames = run.recorded.frames
        loads.append((name, frames.time_s, largest_on_a_shard(run.recorded, frames.loads.body_peak_sums_n) / 1e3))
    charts = (
        (Text("progress of the collapse (%)"), progress),
        (Text("connections cracked or torn (%)"), broken),
        (Text("largest load on a shard ({})", Unit("kN")), loads),
    )
    blocks: list[Block] = [
        Picture(partial(compared_histories, label=label, histories=histories), Text("{}.", label.capital))
        for label, histories in charts
        if histories
    ]
    caption = Text("Debris at the end in plan, and the bridge before.")
    return [*blocks, Picture(partial(debris_maps, runs=debris), caption, debris_maps_height_mm(debris))]
