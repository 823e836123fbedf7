# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of runs: written, read back, and refused where it is none."""

import csv
import math

import numpy as np
import pytest

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.study.runs_table import RunRow, RunsTable, read_runs, write_runs

ROWS = (
    RunRow(
        1,
        "done",
        {"ball.mass_kg": 5000.25, 'charges."mid, pier".kind': "TNT"},
        {"reach_m": 12.5, "down": True, "shards": 40},
    ),
    RunRow(2, "crashed", {"ball.mass_kg": 1e-7, 'charges."mid, pier".kind': "PETN"}, {}),
    RunRow(
        3, "done", {"ball.mass_kg": 0.1 + 0.2, 'charges."mid, pier".kind': "TNT"}, {"reach_m": math.nan, "down": False}
    ),
)
TABLE = RunsTable(ROWS)


@pytest.fixture
def written(tmp_path):
    write_runs(TABLE, tmp_path / "runs.csv")
    return tmp_path / "runs.csv"


def test_columns_are_what_went_in_and_what_came_out(written):
    with written.open(newline="", encoding="utf-8") as file:
        lines = list(csv.reader(file))
    assert lines == [
        ["run", "status", "in.ball.mass_kg", 'in.charges."mid, pier".kind', "out.reach_m", "out.down", "out.shards"],
        ["1", "done", "5000.25", "TNT", "12.5", "true", "40"],
        ["2", "crashed", "1e-07", "PETN", "", "", ""],
        ["3", "done", "0.30000000000000004", "TNT", "", "false", ""],
    ]


def test_what_is_read_is_what_was_written(written, tmp_path):
    table = read_runs(written)
    assert table.rows[0] == ROWS[0]
    assert table.input("ball.mass_kg").tolist() == [5000.25, 1e-7, 0.1 + 0.2]
    write_runs(table, tmp_path / "again.csv")
    assert (tmp_path / "again.csv").read_bytes() == written.read_bytes()


def test_runs_that_did_not_finish_count_as_the_worst(written):
    table = read_runs(written)
    assert table.done.tolist() == [True, False, True]
    assert table.largest("reach_m").tolist() == [12.5, np.inf, np.inf]
    assert table.met("down").tolist() == [True, False, False]


def test_texts_and_truths_are_no_numbers(written):
    table = read_runs(written)
    assert table.input('charges."mid, pier".kind').tolist() == ["TNT", "PETN", "TNT"]
    assert table.output("down").tolist() == [True, None, False]
    np.testing.assert_array_equal(table.output("shards"), [40.0, np.nan, np.nan])


@pytest.mark.parametrize(
    "text, message",
    [
        ("", "expected a table of runs"),
        ("time,force\n1,2\n", "expected a table of runs"),
        ("run,status,out.reach_m\n1,done\n", "found 1,done"),
        ("run,status\n-1,done\n", "found -1,done"),
        ("run,status\n1,fine\n", "found 1,fine"),
    ],
)
def test_another_table_is_refused(tmp_path, text, message):
    path = tmp_path / "runs.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(OutputError, match=message) as caught:
        read_runs(path)
    assert str(caught.value).startswith(f"{path}: ")


def test_a_table_that_is_not_there_is_named(tmp_path):
    with pytest.raises(OutputError, match=r"runs\.csv: no such file"):
        read_runs(tmp_path / "runs.csv")


def test_the_median_and_the_worst_row_are_of_runs_that_finished():
    reaches = {1: 4.0, 2: 9.0, 3: None, 4: 1.0, 5: 6.0}
    rows = [
        RunRow(number, "crashed" if reach_m is None else "done", {}, {} if reach_m is None else {"reach_m": reach_m})
        for number, reach_m in reaches.items()
    ]
    table = RunsTable(tuple(rows))
    assert (table.median_row, table.worst_row) == (0, 1)
    assert (RunsTable(tuple(rows[2:3])).median_row, RunsTable(()).worst_row) == (None, None)


def test_runs_that_did_not_rest_are_told_from_those_where_single_shards_move():
    outputs = (
        {"came_to_rest_s": 4.5, "moving_at_end": 0},
        {"came_to_rest_s": 5.5, "moving_at_end": 2},
        {"came_to_rest_s": None, "moving_at_end": 40},
        {"came_to_rest_s": None, "moving_at_end": 0},  # rested for less than it has to
    )
    table = RunsTable(tuple(RunRow(number, "done", {}, found) for number, found in enumerate(outputs, 1)))
    assert (table.still_moving, table.single_moving) == (1, 1)
    older = RunsTable((RunRow(1, "done", {}, {"came_to_rest_s": None}), RunRow(2, "done", {}, {"reach_m": 1.0})))
    assert (older.still_moving, older.single_moving) == (1, 0)
