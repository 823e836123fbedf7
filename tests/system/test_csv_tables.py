# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as CSV: damage and size are said in words, and no text becomes a formula in a spreadsheet."""

import csv
import os
import random

import pytest
from support.sample_results import hanging_chain

from bridge_demolition_addon.errors import OutputError, UnreadableError
from bridge_demolition_addon.exports.sheets import write_sheets
from bridge_demolition_addon.model.run_folder.logs import read_logged_forces
from bridge_demolition_addon.report.document.blocks import Column, DataTable, write_tables
from bridge_demolition_addon.system.progress import Progress
from bridge_demolition_addon.system.reading import csv_cell, csv_rows

LOG = "time_s,body,peak_force_sum_N,peak_force_N\n" + "".join(
    f"{frame / 10},{body},{frame}.5,1.5\n" for frame in range(20) for body in ("a", "b", "Ground")
)


def test_rows_are_those_of_the_file(tmp_path):
    (tmp_path / "a.csv").write_text('\ufeffname,x\n"two\nlines, one name",1\n\nä,\n', encoding="utf-8")
    assert list(csv_rows(tmp_path / "a.csv", 100)) == [["name", "x"], ["two\nlines, one name", "1"], [], ["ä", ""]]


@pytest.mark.parametrize(
    "content, message",
    [
        (b"a,b\n1,\xff\xfe\n", "is no text in UTF-8"),
        (b"a,b\n" + b"x" * 200_000 + b"\n", "is no table: field larger than field limit"),
        (b"a,b\n" + b"1," * 1_000_000, "has a line of more than 1000000 letters"),
        (b"a,b\n" * 3_000_000, r"has 12.0 MB: expected at most 10 MB"),
    ],
)
def test_what_is_no_table_is_said(tmp_path, content, message):
    (tmp_path / "a.csv").write_bytes(content)
    with pytest.raises(UnreadableError, match=message):
        list(csv_rows(tmp_path / "a.csv", 10_000_000))


def test_a_file_of_gigabytes_without_a_line_break_is_not_read(tmp_path):
    with (tmp_path / "force_log.csv").open("wb") as file:
        file.write(b"time_s,body")
        os.truncate(file.fileno(), 5_000_000_000)  # sparse: it takes no room
    with pytest.raises(OutputError, match=r"force_log.csv cannot .* line of more than 1000000 letters"):
        read_logged_forces(tmp_path)


def test_damaged_logs_are_read_or_refused_in_words_whatever_reads_them(tmp_path):
    chance, refused = random.Random(3), 0
    for _ in range(60):
        content = bytearray(LOG.encode())
        for _ in range(20):
            content[chance.randrange(len(content))] = chance.randrange(256)
        (tmp_path / "force_log.csv").write_bytes(content[: chance.randrange(10, len(content))])
        for read in (
            lambda: read_logged_forces(tmp_path),
            lambda: write_sheets(tmp_path, hanging_chain(), tmp_path / "a.xlsx", Progress()),
        ):
            try:
                read()
            except OutputError as error:
                refused += 1
                assert "force_log.csv" in str(error)
    assert refused > 60


@pytest.mark.parametrize("text", ["=1+1", "@SUM(A1)", "+cmd|' /C calc'!A0", "-2+3"])
def test_texts_that_look_like_formulas_are_texts(tmp_path, text):
    table = DataTable("zones", "Zones", (Column("Zone", "zone"), Column("x", "x_m")), [(text, -1.5)])
    write_tables([table], tmp_path)
    rows = list(csv.reader((tmp_path / "zones.csv").open(encoding="utf-8", newline="")))
    assert rows == [["zone", "x_m"], [f"'{text}", "-1.5"]]


def test_numbers_and_names_stay_as_they_are():
    for value in (-1.5, 3, None, "-1.5", "+2", "-inf", "deck", "pier-2", ""):
        assert csv_cell(value) is value
