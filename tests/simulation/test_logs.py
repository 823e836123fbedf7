"""Logs read back as any other program would read them."""

import csv

import numpy as np
import pytest

from bridge_demolition_addon.simulation.logs import DEBRIS_COLUMNS, FORCE_COLUMNS, BodyLog

COLUMNS = ("frame", "time_s", "body", "x_m", "y_m")


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_one_line_per_body_and_frame(tmp_path):
    path = tmp_path / "log.csv"
    with BodyLog(path, COLUMNS, ["deck", "pier"]) as log:
        log.write(2, 0.0, np.array([[1.0, 2.0], [3.0, 4.0]]))
        log.write(3, 0.04, np.array([[-1.5, 1e-20], [0.0, 1e9]]))
    assert rows_of(path) == [
        ["frame", "time_s", "body", "x_m", "y_m"],
        ["2", "0", "deck", "1", "2"],
        ["2", "0", "pier", "3", "4"],
        ["3", "0.04", "deck", "-1.5", "1e-20"],
        ["3", "0.04", "pier", "0", "1e+09"],
    ]


def test_values_are_kept_to_more_than_single_precision(tmp_path):
    values = np.random.default_rng(2).normal(scale=1e5, size=(50, 2))
    path = tmp_path / "log.csv"
    with BodyLog(path, COLUMNS, [str(number) for number in range(50)]) as log:
        log.write(1, 1 / 3, values)
    rows = rows_of(path)[1:]
    # Nine digits are written; Bullet works with the seven of single precision.
    np.testing.assert_allclose(np.array([row[3:] for row in rows], float), values, rtol=5e-9)
    assert float(rows[0][1]) == pytest.approx(1 / 3, rel=5e-9)


@pytest.mark.parametrize("name", ['a,b and "c"', "100 %", "%s %d %(x)s", "Brücke ×2", "two\nlines", " ", "'", "a;b"])
def test_any_name_of_a_body_comes_back(tmp_path, name):
    path = tmp_path / "log.csv"
    with BodyLog(path, COLUMNS, [name, "next"]) as log:
        log.write(7, 0.5, np.array([[1.0, 2.0], [3.0, 4.0]]))
    assert rows_of(path)[1:] == [["7", "0.5", name, "1", "2"], ["7", "0.5", "next", "3", "4"]]


def test_every_frame_is_on_disk_at_once(tmp_path):
    path = tmp_path / "log.csv"
    log = BodyLog(path, COLUMNS, ["deck"])
    assert len(rows_of(path)) == 1
    for frame in (1, 2, 3):
        log.write(frame, frame * 0.04, np.zeros((1, 2)))
        assert len(rows_of(path)) == 1 + frame
        assert path.read_text().endswith("\n")
    log.close()


def test_unknown_values_are_nan(tmp_path):
    path = tmp_path / "log.csv"
    with BodyLog(path, COLUMNS, ["deck"]) as log:
        log.write(1, 0.0, np.array([[np.nan, 1.0]]))
    assert np.isnan(float(rows_of(path)[1][3]))


def test_an_older_file_is_replaced(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("something else\n" * 100)
    BodyLog(path, COLUMNS, []).close()
    assert rows_of(path) == [list(COLUMNS)]


def test_without_bodies_there_are_no_lines(tmp_path):
    with BodyLog(tmp_path / "log.csv", COLUMNS, []) as log:
        log.write(1, 0.0, np.zeros((0, 2)))
    assert len(rows_of(tmp_path / "log.csv")) == 1


@pytest.mark.parametrize("shape", [(1, 2), (3, 2), (2, 3)])
def test_values_of_another_shape_are_refused(tmp_path, shape):
    with BodyLog(tmp_path / "log.csv", COLUMNS, ["deck", "pier"]) as log, pytest.raises(TypeError):
        log.write(1, 0.0, np.zeros(shape))
    assert len(rows_of(tmp_path / "log.csv")) == 1


def test_the_file_is_closed_after_an_error(tmp_path):
    with pytest.raises(RuntimeError), BodyLog(tmp_path / "log.csv", COLUMNS, ["deck"]) as log:
        raise RuntimeError
    with pytest.raises(ValueError, match="closed"):
        log.write(1, 0.0, np.zeros((1, 2)))


@pytest.mark.parametrize("columns", [FORCE_COLUMNS, DEBRIS_COLUMNS])
def test_columns_begin_alike_and_carry_units(columns):
    assert columns[:3] == ("frame", "time_s", "body")
    assert all(name.endswith(("_N", "_m")) for name in columns[3:])
