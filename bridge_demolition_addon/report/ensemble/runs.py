"""The draws of a study: all in a table, and the median and the worst of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...model.study.runs_table import DONE, REACH, RunRow
from ..document.blocks import Block, Column, DataTable, Paragraph, Photo, Section
from .influence import correlations_of
from .study_runs import StudyRuns, shown

_MOST_DRAWS = 200
"""Of more, only the farthest are listed."""

_MOST_INPUTS, _MOST_OUTPUTS = 3, 3
"""Columns that fit on a page, besides that of the reach: the inputs that matter most for it."""

_LARGE = 1e4
"""Numbers from which on digits after the point are left out."""

_PICTURES = {"before": "before", "impact": "in the course of the run", "after": "at the end"}


def telling_section(runs: StudyRuns) -> Section | None:
    """Return the median and the worst draw; None where no run finished."""
    if runs.table.median_row is None:
        return None
    median, worst = runs.table.rows[runs.table.median_row], runs.table.rows[runs.table.worst_row]
    columns = (
        Column("", "quantity"),
        Column(f"median, draw {median.number}", "median"),
        Column(f"worst, draw {worst.number}", "worst"),
    )
    both = [{**row.inputs, **row.outputs} for row in (median, worst)]
    names = (*runs.table.inputs, *runs.table.outputs)
    rows = [(shown(name), *(_text(values.get(name)) for values in both)) for name in names]
    blocks: list[Block] = [
        Paragraph(
            f"Of the runs that finished, draw {median.number} has the median reach, and draw {worst.number} the "
            "largest. bda study with --again and the number of a draw runs it once more, bit for bit, and keeps "
            "everything of it: logs, scene and pictures."
        ),
        DataTable("median_and_worst", "The median and the worst draw", columns, rows),
        *_photos(runs, median, "Median draw"),
    ]
    if worst is not median:
        blocks += _photos(runs, worst, "Worst draw")
    return Section("The median and the worst draw", tuple(blocks))


def draws_section(runs: StudyRuns) -> Section:
    """Return the table of draws, the farthest first."""
    order = np.argsort(-runs.reaches_m, kind="stable")
    inputs, outputs = _strongest_inputs(runs), _other_outputs(runs)
    columns = (
        Column("run", "run", "d"),
        Column("status", "status"),
        Column(shown(REACH), REACH, ".2f"),
        *(Column(shown(name), name, ".4g") for name in outputs),
        *(Column(shown(name), name, ".4g" if runs.table.input(name).dtype == float else "") for name in inputs),
        *((Column("criteria met", "criteria_met"),) if runs.criteria else ()),
    )
    rows = [_row(runs, runs.table.rows[row], outputs, inputs) for row in order[:_MOST_DRAWS]]
    words = (
        "Draws that went farthest come first, and before them those that did not finish. What does not fit here, draws "
        "as well as inputs and outputs, is in runs.csv."
    )
    return Section("The draws", (Paragraph(words), DataTable("farthest_draws", "Draws", columns, rows)))


def _other_outputs(runs: StudyRuns) -> tuple[str, ...]:
    return tuple(name for name in runs.numbers if name != REACH)[:_MOST_OUTPUTS]


def _strongest_inputs(runs: StudyRuns) -> tuple[str, ...]:
    strongest = [one for one, other, _ in correlations_of(runs) if other == REACH]
    return tuple(dict.fromkeys([*strongest, *runs.varied]))[:_MOST_INPUTS]


def _row(runs: StudyRuns, row: RunRow, outputs: tuple[str, ...], inputs: tuple[str, ...]) -> tuple[Any, ...]:
    met = sum(row.outputs.get(name) is True for name in runs.criteria)
    criteria = (f"{met} of {len(runs.criteria)}" if row.status == DONE else None,) if runs.criteria else ()
    values = (*map(row.outputs.get, (REACH, *outputs)), *map(row.inputs.get, inputs))
    return row.number, row.status.replace("_", " "), *values, *criteria


def _photos(runs: StudyRuns, row: RunRow, title: str) -> list[Photo]:
    pictures = runs.pictures.get(row.number, {})
    reach = row.outputs[REACH]
    return [
        Photo(pictures[name], f"{title}, {row.number}, with a reach of {reach:.2f} m: {words}.")
        for name, words in _PICTURES.items()
        if name in pictures
    ]


def _text(value: Any) -> str | None:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return None
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.0f}" if abs(value) >= _LARGE else f"{value:.5g}"
    return str(value)
