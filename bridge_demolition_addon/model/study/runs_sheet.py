"""Table of the runs of a study as a sheet (XLSX), where XlsxWriter is installed."""

from __future__ import annotations

import math
from datetime import datetime
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ...system.disk import whole_file
from .runs_table import INPUT, OUTPUT, RUN, STATUS, RunsTable

_NO_TIME = datetime(2000, 1, 1)
"""When the sheet says it was made: the same rows give the same bytes."""


def write_sheet(table: RunsTable, path: Path) -> bool:
    """Write the table of a study, whole or not at all, with the columns of the CSV.

    Returns
    -------
    bool
        Whether it was written: XlsxWriter is there.
    """
    if find_spec("xlsxwriter") is None:
        return False
    import xlsxwriter

    with whole_file(path) as part:
        book = xlsxwriter.Workbook(str(part), {"strings_to_formulas": False, "strings_to_urls": False})
        book.set_properties({"created": _NO_TIME})
        sheet = book.add_worksheet("runs")
        names = [RUN, STATUS, *(INPUT + name for name in table.inputs), *(OUTPUT + name for name in table.outputs)]
        sheet.write_row(0, 0, names, book.add_format({"bold": True}))
        sheet.freeze_panes(1, 2)
        for line, row in enumerate(table.rows, start=1):
            values = [*map(row.inputs.get, table.inputs), *map(row.outputs.get, table.outputs)]
            sheet.write_row(line, 0, [row.number, row.status, *map(_cell, values)])
        book.close()
    return True


def _cell(value: Any) -> Any:
    """Return what a sheet can hold: it knows neither infinity nor what is no number."""
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value
