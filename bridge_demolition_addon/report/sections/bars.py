"""Bars across cracks in a report of a run: how many cracks they held, and how much of their strain they used."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from ...charts.histories import compared_histories
from ...model.results.arrays import Results
from ...model.results.bar_extremes import largest_use_text
from ...texts import Text
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture
from ..run_folder import ReportedRun

_NOTES = Text(
    "Use is the opening of a crack at its worst corner by that at which bars rupture. Under an impact it depends "
    "on the length of sub-steps: it is no margin against rupture. Ruptured are cracks that all their bars let go, "
    "in part those that some did: of a hinge that folds, bars at the closed edge stay. Cracks at work are in "
    "bar_log.csv, frame by frame."
)


def bar_blocks(run: ReportedRun) -> list[Block]:
    """Return a table and a chart of bars by kind of member; none without reinforcement across elastic connections."""
    bars = run.summary.reinforcement if run.summary else None
    if not bars:
        return []
    if not bars["cracked"]:
        return [Paragraph(Text("None of the {} connections with bars cracked.", bars["with_bars"]))]
    blocks: list[Block] = [_by_kind(bars["by_kind"]), Paragraph(_NOTES)]
    if largest := largest_use_text(run.summary.values if run.summary else {}):
        blocks.append(Paragraph(Text("Bars used at most {}.", largest)))
    if lines := use_histories(run.recorded):
        draw = partial(compared_histories, label=Text("use of the rupture strain (%)"), histories=lines)
        blocks.append(Picture(draw, "Largest use of bars in each kind of member, in any sub-step of a frame."))
    return blocks


def use_histories(results: Results) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Return the largest use of bars (k,), in per cent, in each kind of member over times (k,)."""
    use, kinds = results.frames.loads.body_bar_use, results.inventory.body_member_kinds
    if use is None:
        return []
    times_s = results.frames.time_s[1:]
    histories: list[tuple[str, np.ndarray, np.ndarray]] = []
    for kind in np.unique(kinds[kinds != ""]):
        largest = 100.0 * use[1:, kinds == kind].max(axis=1, initial=0.0)
        if largest.any():
            histories.append((Text(str(kind)), times_s, largest))
    return histories


def _by_kind(kinds: Sequence[Mapping[str, Any]]) -> DataTable:
    def value(key: str, factor: float = 1.0) -> Callable[[Mapping[str, Any]], float | None]:
        return lambda kind: None if kind[key] is None else factor * kind[key]

    columns = (
        Column("member", "member_kind", "", lambda kind: Text(kind["kind"])),
        Column("cracked", "cracked", "", lambda kind: kind["cracked"]),
        Column("yielded", "yielded", "", lambda kind: kind["yielded"]),
        Column("ruptured", "ruptured", "", lambda kind: kind["ruptured"]),
        Column("in part", "ruptured_in_part", "", lambda kind: kind["ruptured_in_part"]),
        Column("held at the end", "held_at_end", "", lambda kind: kind["held_at_end"]),
        Column("largest use", "largest_use_percent", ".0f", value("largest_use_share", 100.0)),
        Column("at", "largest_use_s", ".3f", value("largest_use_s")),
    )
    return DataTable.of("cracked_connections", "Cracked connections with bars, by kind of member", columns, kinds)
