"""Neighbours in the report of a study: the largest vibration and pressure of all its runs at each."""

from __future__ import annotations

import numpy as np

from ...model.study.shown_names import shown
from ...texts import Text
from ..document.blocks import Column, DataTable, Paragraph, Section
from .study_runs import StudyRuns

_OF_NEIGHBOURS = "neighbours."
_COLUMNS = (
    Column("neighbour and quantity", "quantity"),
    Column("median", "median", ".3g", of_row=True),
    Column("largest", "largest", ".3g", of_row=True),
    Column("of runs", "runs", "d"),
)


def neighbours_section(runs: StudyRuns) -> Section | None:
    """Return what runs do at the neighbours; None where nothing is known of them."""
    rows = []
    for name in runs.table.outputs:
        values = runs.table.output(name)
        if not name.startswith(_OF_NEIGHBOURS) or values.dtype != float:
            continue
        known = values[np.isfinite(values)]
        if len(known):
            label = shown(name.removeprefix(_OF_NEIGHBOURS))
            rows.append((label, float(np.median(known)), float(known.max()), len(known)))
    if not rows:
        return None
    words = Text(
        "The largest of these runs is no limit: other runs may have more. Criteria of the study say how often."
    )
    table = DataTable("neighbours_of_runs", "At the neighbours, of the runs that finished", _COLUMNS, rows)
    return Section("Neighbours", (Paragraph(words), table))
