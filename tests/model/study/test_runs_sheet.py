# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheet of runs has what the CSV has, as pandas reads both, and the same bytes for the same rows."""

import math

import pandas
import pytest

from bridge_demolition_addon.model.study.runs_table import RunRow, RunsTable, write_runs, write_sheet

TABLE = RunsTable(
    (
        RunRow(1, "done", {"ball.mass_kg": 5000.25, "kind": "TNT"}, {"reach_m": 12.5, "down": True, "rest_s": None}),
        RunRow(2, "crashed", {"ball.mass_kg": 0.1 + 0.2, "kind": "=PETN"}, {}),
        RunRow(3, "done", {"ball.mass_kg": 1e-7, "kind": "TNT"}, {"reach_m": math.nan, "down": False, "rest_s": 3.5}),
    )
)


def test_pandas_reads_the_same_from_both(tmp_path):
    write_runs(TABLE, tmp_path / "runs.csv")
    assert write_sheet(TABLE, tmp_path / "runs.xlsx")
    csv, sheet = pandas.read_csv(tmp_path / "runs.csv"), pandas.read_excel(tmp_path / "runs.xlsx")
    pandas.testing.assert_frame_equal(csv, sheet, check_dtype=False)
    # Some versions of pandas read the last bit of a number as they like.
    assert csv["in.ball.mass_kg"].tolist() == pytest.approx([5000.25, 0.1 + 0.2, 1e-7], rel=1e-15)
    assert csv["out.reach_m"].isna().tolist() == [False, True, True]


def test_the_same_rows_give_the_same_bytes(tmp_path):
    for name in ("first.xlsx", "second.xlsx"):
        write_sheet(TABLE, tmp_path / name)
    assert (tmp_path / "first.xlsx").read_bytes() == (tmp_path / "second.xlsx").read_bytes()
