"""Single runs: all in a table, and of a study the median and the worst of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...model.optimise.conclusions import ROUND
from ...model.study.runs_table import DONE, REACH, RunRow
from ...model.study.shown_names import is_reach, shown, words_and_unit
from ...texts import Text, distance_to_keep
from ..document.blocks import Block, Column, DataTable, Paragraph, Photo, Section
from .influence import correlations_of
from .reported_ensemble import ReportedEnsemble, StudyRuns

_MOST_RUNS = 200
"""Of more, only the farthest are listed."""

_MOST_INPUTS, _MOST_OUTPUTS = 3, 3
"""Columns that fit on a page, apart from that of the debris distance: the inputs that matter most for it."""

_LARGE = 1e4
"""Numbers from which on digits after the point are left out."""

_PICTURES = {"before": Text("before"), "impact": Text("in the course of the run"), "after": Text("at the end")}


def extremes_section(runs: StudyRuns) -> Section | None:
    """Return the median and the worst run; None where no run finished."""
    if runs.table.median_row is None or runs.table.worst_row is None:
        return None
    median, worst = runs.table.rows[runs.table.median_row], runs.table.rows[runs.table.worst_row]
    columns = (
        Column("", "quantity"),
        Column(Text("median, run {}", median.number), "median", of_row=True),
        Column(Text("worst, run {}", worst.number), "worst", of_row=True),
    )
    both = [{**row.inputs, **row.outputs} for row in (median, worst)]
    names = (*runs.table.inputs, *runs.table.outputs)
    rows = [(shown(name), *(_text(values.get(name)) for values in both)) for name in names]
    blocks: list[Block] = [
        Paragraph(
            Text(
                "Of the runs that finished, run {} has the median debris distance, and run {} the largest. bda "
                "study with --again and the number of a run makes it again, bit for bit, and keeps everything of "
                "it: logs, scene and pictures.",
                median.number,
                worst.number,
            )
        ),
        DataTable("median_and_worst", "The median and the worst run", columns, rows),
        *_photos(runs, median, Text("Median run")),
    ]
    if worst is not median:
        blocks += _photos(runs, worst, Text("Worst run"))
    return Section("The median and the worst run", tuple(blocks))


def runs_section(runs: ReportedEnsemble, first: Sequence[str] = ()) -> Section:
    """Return the table of runs, those with the largest debris distance first.

    Parameters
    ----------
    runs
        The runs.
    first
        Inputs that are shown whatever their influence.
    """
    order = np.argsort(-runs.distances_m, kind="stable")
    inputs, outputs = (*first, *_strongest_inputs(runs, first)), _other_outputs(runs)
    columns = (
        Column("run", "run", "d"),
        Column("status", "status"),
        *(_column(name, ".2f" if name == REACH else ".4g") for name in (REACH, *outputs)),
        *(_column(name, ".4g" if runs.table.input(name).dtype == float else "") for name in inputs),
        *((Column("criteria met", "criteria_met"),) if runs.criteria else ()),
    )
    rows = [_row(runs, runs.table.rows[row], outputs, inputs) for row in order[:_MOST_RUNS]]
    words = Text(
        "Runs with the largest debris distance come first, and before them those that did not finish. What does "
        "not fit here, runs as well as inputs and outputs, is in {}.",
        runs.ensemble.table_file,
    )
    return Section("The runs", (Paragraph(words), DataTable("farthest_draws", "Runs", columns, rows)))


def _input(name: str, value: Any) -> Any:
    return Text(value) if name == ROUND and isinstance(value, str) else value


def _column(name: str, form: str) -> Column:
    words, unit = words_and_unit(name)
    return Column(words, name, form, unit=unit, is_reach=is_reach(name))


def _other_outputs(runs: ReportedEnsemble) -> tuple[str, ...]:
    return tuple(name for name in runs.numbers if name != REACH)[:_MOST_OUTPUTS]


def _strongest_inputs(runs: ReportedEnsemble, without: Sequence[str]) -> tuple[str, ...]:
    strongest = [name for name, output, _ in correlations_of(runs) if output == REACH]
    names = [name for name in dict.fromkeys([*strongest, *runs.varied]) if name not in without]
    return tuple(names[:_MOST_INPUTS])


def _row(runs: ReportedEnsemble, row: RunRow, outputs: tuple[str, ...], inputs: tuple[str, ...]) -> tuple[Any, ...]:
    met = sum(row.outputs.get(name) is True for name in runs.criteria)
    criteria = (Text("{} of {}", met, len(runs.criteria)) if row.status == DONE else None,) if runs.criteria else ()
    values = (*map(row.outputs.get, (REACH, *outputs)), *(_input(name, row.inputs.get(name)) for name in inputs))
    return row.number, Text(row.status.replace("_", " ")), *values, *criteria


def _photos(runs: StudyRuns, row: RunRow, title: str) -> list[Photo]:
    pictures = runs.pictures.get(row.number, {})
    distance_m = row.outputs[REACH]
    return [
        Photo(
            pictures[name],
            Text(
                "{}, {}, with a debris distance of {}: {}.",
                title,
                row.number,
                distance_to_keep(distance_m, ".2f"),
                words,
            ),
        )
        for name, words in _PICTURES.items()
        if name in pictures
    ]


def _text(value: Any) -> str | None:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return None
    if isinstance(value, bool):
        return Text("yes") if value else Text("no")
    if isinstance(value, float):
        return f"{value:.0f}" if abs(value) >= _LARGE else f"{value:.5g}"
    return str(value)
