# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables that grow on the disk: numpy reads them at any time, and a kill takes no whole row."""

import gc
import sys
import threading

import numpy as np
import pytest

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.system.array_files.table import GrowingTable, stored_rows

ROW = np.dtype([("time", "<f8"), ("places", "<f4", (2, 3)), ("none", "<f4", (0, 3)), ("whole", "?", (3,))], align=True)


def rows(first, count):
    made = np.zeros(count, ROW)
    made["time"] = first + np.arange(count)
    made["places"] = made["time"][:, None, None] / 3.0
    made["whole"][:, 1] = True
    return made


def filled(path):
    table = GrowingTable(path, ROW)
    for first in range(12):
        table.append(rows(first, 1))
    return table


@pytest.fixture
def table(tmp_path):
    return filled(tmp_path / "table.npy")


def test_numpy_reads_it_after_every_row(tmp_path):
    table = GrowingTable(tmp_path / "table.npy", ROW)
    assert len(np.load(table.path)) == len(table) == 0
    for count in range(1, 12):
        table.append(rows(count - 1, 1))
        for mode in (None, "r"):
            read = np.load(table.path, mmap_mode=mode)
            assert read.dtype == ROW and read.tobytes() == rows(0, count).tobytes()


def test_rows_come_back_one_by_one_and_all_together(table):
    table.append(rows(12, 3))
    assert table.row(7).tobytes() == rows(7, 1).tobytes()
    assert table.rows().tobytes() == stored_rows(table.path).tobytes() == rows(0, 15).tobytes()
    assert table.rows()["none"].shape == (15, 0, 3)


def test_what_was_mapped_stays_as_it_is_when_rows_are_added(table):
    mapped = table.rows()
    table.append(rows(0, 1))
    assert mapped.tobytes() == rows(0, 12).tobytes()


def test_stored_rows_stay_when_another_program_empties_the_file(table):
    stored = stored_rows(table.path)
    with table.path.open("rb+") as file:
        file.truncate(0)  # which ends a process that has mapped it
    assert stored.tobytes() == rows(0, 12).tobytes()


@pytest.mark.parametrize("cut", [1, ROW.itemsize - 1, ROW.itemsize, 3 * ROW.itemsize + 1])
def test_rows_that_were_cut_off_are_dropped(table, cut):
    with table.path.open("rb+") as file:
        file.truncate(table.path.stat().st_size - cut)
    left = 12 + -cut // ROW.itemsize
    assert stored_rows(table.path).tobytes() == rows(0, left).tobytes()


def test_a_row_that_the_header_does_not_count_yet_is_dropped(table):
    with table.path.open("ab") as file:
        file.write(rows(12, 1).tobytes())
    assert len(stored_rows(table.path)) == len(np.load(table.path)) == 12


@pytest.mark.skipif(sys.platform == "win32", reason="Windows replaces no open file")
def test_a_new_table_in_its_place_leaves_what_was_mapped(table):
    mapped = table.rows()
    GrowingTable(table.path, ROW).append(rows(5, 1))
    assert mapped.tobytes() == rows(0, 12).tobytes()
    assert table.row(3).tobytes() == rows(3, 1).tobytes()
    table.remove()  # which is not at the path any more
    assert stored_rows(table.path).tobytes() == rows(5, 1).tobytes()


def test_a_removed_table_is_read_as_long_as_it_is_there(table):
    mapped = table.rows()
    table.remove()
    assert table.row(3).tobytes() == rows(3, 1).tobytes()
    del table
    gc.collect()
    assert mapped.tobytes() == rows(0, 12).tobytes()


def test_a_removed_table_is_gone(tmp_path):
    path = tmp_path / "table.npy"
    table = filled(path)
    table.remove()
    del table
    gc.collect()
    assert not path.exists()


def test_rows_are_read_while_others_are_added(table):
    """A render reads in a thread of its own while the next frame is recorded."""
    wrong = []

    def read():
        for _ in range(300):
            for number in (0, 5, 11):
                if table.row(number).tobytes() != rows(number, 1).tobytes():
                    wrong.append(number)

    thread = threading.Thread(target=read)
    thread.start()
    for number in range(12, 312):
        table.append(rows(number, 1))
    thread.join()
    assert not wrong and table.rows().tobytes() == rows(0, 312).tobytes()


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    with pytest.raises(OutputError, match=r"absent.table\.npy: cannot be written \(No such file or directory\)"):
        GrowingTable(tmp_path / "absent" / "table.npy", ROW)


def test_a_table_that_was_cut_short_by_others_is_named(table):
    with table.path.open("rb+") as file:
        file.truncate(300)
    with pytest.raises(OutputError, match=r"table\.npy: was cut short"):
        table.row(11)


@pytest.mark.parametrize("write", [lambda f: np.save(f, np.zeros(3)), lambda f: f.write(b"PK"), lambda f: None])
def test_other_files_are_no_tables(tmp_path, write):
    with (tmp_path / "other.npy").open("wb") as file:
        write(file)
    with pytest.raises(ValueError):
        stored_rows(tmp_path / "other.npy")
