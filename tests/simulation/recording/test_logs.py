# SPDX-License-Identifier: GPL-3.0-or-later
"""Logs read back as any other program would read them."""

import csv
from contextlib import closing

import numpy as np
import pytest
from support.sample_results import FRAME_S, G, changed, hanging_chain, without_connections

from bridge_demolition_addon.engineering.mechanics.section_cuts import SectionForces
from bridge_demolition_addon.model.run_folder.logs import (
    BREAKING_TABLE,
    DEBRIS_TABLE,
    FORCE_TABLE,
    BodyLog,
    LogColumn,
    LogTable,
)
from bridge_demolition_addon.simulation.recording.breaking import Breaks
from bridge_demolition_addon.simulation.recording.logs import Logs

TABLE = LogTable(("body",), (LogColumn("", "m", lambda values: values, ("x", "y")),))


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_one_line_per_body_and_frame(tmp_path):
    path = tmp_path / "log.csv"
    with closing(BodyLog(path, TABLE, ["deck", "pier"])) as log:
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
    with closing(BodyLog(path, TABLE, [str(number) for number in range(50)])) as log:
        log.write(1, 1 / 3, values)
    rows = rows_of(path)[1:]
    # Nine digits are written; Bullet works with the seven of single precision.
    np.testing.assert_allclose(np.array([row[3:] for row in rows], float), values, rtol=5e-9)
    assert float(rows[0][1]) == pytest.approx(1 / 3, rel=5e-9)


@pytest.mark.parametrize("name", ['a,b and "c"', "100 %", "%s %d %(x)s", "Brücke ×2", "two\nlines", " ", "'", "a;b"])
def test_any_name_of_a_body_comes_back(tmp_path, name):
    path = tmp_path / "log.csv"
    with closing(BodyLog(path, TABLE, [name, "next"])) as log:
        log.write(7, 0.5, np.array([[1.0, 2.0], [3.0, 4.0]]))
    assert rows_of(path)[1:] == [["7", "0.5", name, "1", "2"], ["7", "0.5", "next", "3", "4"]]


def test_every_frame_is_on_disk_at_once(tmp_path):
    path = tmp_path / "log.csv"
    log = BodyLog(path, TABLE, ["deck"])
    assert len(rows_of(path)) == 1
    for frame in (1, 2, 3):
        log.write(frame, frame * 0.04, np.zeros((1, 2)))
        assert len(rows_of(path)) == 1 + frame
        assert path.read_text().endswith("\n")
    log.close()


def test_unknown_values_are_nan(tmp_path):
    path = tmp_path / "log.csv"
    with closing(BodyLog(path, TABLE, ["deck"])) as log:
        log.write(1, 0.0, np.array([[np.nan, 1.0]]))
    assert np.isnan(float(rows_of(path)[1][3]))


def test_an_older_file_is_replaced(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("something else\n" * 100)
    BodyLog(path, TABLE, []).close()
    assert rows_of(path) == [TABLE.headers]


def test_without_bodies_there_are_no_lines(tmp_path):
    with closing(BodyLog(tmp_path / "log.csv", TABLE, [])) as log:
        log.write(1, 0.0, np.zeros((0, 2)))
    assert len(rows_of(tmp_path / "log.csv")) == 1


@pytest.mark.parametrize("shape", [(1, 2), (3, 2), (2, 3)])
def test_values_of_another_shape_are_refused(tmp_path, shape):
    with closing(BodyLog(tmp_path / "log.csv", TABLE, ["deck", "pier"])) as log, pytest.raises(TypeError):
        log.write(1, 0.0, np.zeros(shape))
    assert len(rows_of(tmp_path / "log.csv")) == 1


def test_the_file_is_closed_after_an_error(tmp_path):
    with pytest.raises(RuntimeError), closing(BodyLog(tmp_path / "log.csv", TABLE, ["deck"])) as log:
        raise RuntimeError
    with pytest.raises(ValueError, match="closed"):
        log.write(1, 0.0, np.zeros((1, 2)))


@pytest.mark.parametrize("log", [FORCE_TABLE, DEBRIS_TABLE])
def test_columns_begin_alike_and_carry_units(log):
    assert log.headers[:3] == ["frame", "time_s", "body"]
    without_unit = {"asleep", "on_solver_energy"}
    assert all(name.endswith(("_N", "_m", "_Ns", "_Pa", "_J")) for name in set(log.headers[3:]) - without_unit)
    assert len(set(log.headers)) == len(log.headers)


def test_columns_of_breaking_carry_units():
    assert BREAKING_TABLE.headers[:5] == ["frame", "time_s", "connection", "first_body", "second_body"]
    assert all(name.endswith(("_N", "_Nm")) for name in BREAKING_TABLE.headers[5:])


def table(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def vectors(rows, *columns):
    return np.array([[float(row[column]) for column in columns] for row in rows])


def broken(connections, time_s=0.0, first=0.0):
    """Breaks of some connections under loads that count up from a first number, column by column."""
    numbers = first + np.arange(6.0 * len(connections)).reshape(-1, 6)
    loads = SectionForces(numbers[:, 0], numbers[:, 1:3], numbers[:, 3], numbers[:, 4:6])
    return Breaks(time_s, np.array(connections, int), loads)


def logged(folder, results, breaks=()):
    """All logs of a recording whose connections break in its last frame."""
    logs = Logs(folder, results.inventory)
    for frame in results.frames:
        logs.write_frame(frame)
    logs.write_breaks(results.frames.number[-1], breaks)
    logs.close(results.frames[-1])


# Nine digits are written.
WRITTEN = 5e-9


def test_force_log_holds_what_was_gathered(tmp_path):
    results = hanging_chain()
    logged(tmp_path, results)
    rows = table(tmp_path / "force_log.csv")
    assert list(rows[0]) == FORCE_TABLE.headers
    assert [row["body"] for row in rows] == 5 * results.inventory.body_names.tolist()
    assert [int(row["frame"]) for row in rows] == np.repeat(results.frames.number, 4).tolist()
    np.testing.assert_allclose(vectors(rows, "time_s")[:, 0], np.repeat(results.frames.time_s, 4), rtol=WRITTEN)
    for columns, values in (
        (("force_x_N", "force_y_N", "force_z_N"), results.frames.loads.body_forces_n),
        (("force_sum_N",), results.frames.loads.body_sums_n),
        (("peak_force_N",), results.frames.loads.body_peaks_n),
        (("peak_force_sum_N",), results.frames.loads.body_peak_sums_n),
        (
            ("contact_impulse_x_Ns", "contact_impulse_y_Ns", "contact_impulse_z_Ns"),
            results.frames.loads.body_contact_impulses_ns,
        ),
        (("signed_2019_N",), results.frames.loads.body_signed_2019_n),
        (("von_mises_Pa",), results.frames.loads.von_mises_pa),
        (("asleep",), results.frames.asleep),
    ):
        assert values.any(), columns
        np.testing.assert_allclose(vectors(rows, *columns), values.reshape(20, -1), rtol=WRITTEN, err_msg=str(columns))
    assert {row["asleep"] for row in rows} == {"0", "1"}


def test_lines_of_the_force_log_by_hand(tmp_path):
    logged(tmp_path, hanging_chain())
    rows = {(int(row["frame"]), row["body"]): row for row in table(tmp_path / "force_log.csv")}
    expected = {
        # Weight of 300 kg as resultant, those of 500 kg and 200 kg as sum, and the middle carries 350 kg over 1 m².
        (3, "upper"): {"force_z_N": 300, "force_sum_N": 700, "signed_2019_N": 700, "stress_largest_Pa": 350},
        (3, "Ground"): {"force_z_N": -500, "peak_force_N": 500, "signed_2019_N": -500, "stress_largest_Pa": 0},
        (4, "lower"): {"force_z_N": 200, "von_mises_Pa": 200, "stress_largest_Pa": 200, "stress_smallest_Pa": 0},
        # The ledge stops 1000 kg with 6 g in half a frame; at a lever of 0.5 m over 0.125 m³, their mean of 3 g is a
        # push of 12 000 kg per m².
        (6, "Wrecking ball"): {"force_z_N": 3000, "contact_impulse_z_Ns": 3000 * FRAME_S, "stress_smallest_Pa": -12000},
        (6, "lower"): {"force_z_N": 0, "peak_force_sum_N": 0, "von_mises_Pa": 0, "asleep": 0},
    }
    for key, numbers in expected.items():
        for column, number in numbers.items():
            assert float(rows[key][column]) == pytest.approx(number * G, rel=WRITTEN, abs=1e-9), (key, column)


def test_principal_stresses_are_the_largest_and_the_smallest(tmp_path):
    results = hanging_chain()
    stresses = results.frames.loads.stresses_pa.copy()
    # Mohr's circle around 50 with the radius √(30² + 40²) = 50, and a third principal stress in between.
    stresses[1, 2] = [[80, 40, 0], [40, 20, 0], [0, 0, 7]]
    logged(tmp_path, changed(results, stresses_pa=stresses))
    rows = [row for row in table(tmp_path / "force_log.csv") if (row["frame"], row["body"]) == ("3", "lower")]
    # Rounding of an eigenvalue that is 0.
    np.testing.assert_allclose(vectors(rows, "stress_largest_Pa", "stress_smallest_Pa"), [[100, 0]], atol=1e-12)


def test_debris_log_holds_first_and_last_places(tmp_path):
    results = hanging_chain()
    logged(tmp_path, results)
    rows = table(tmp_path / "debris_log.csv")
    assert list(rows[0]) == DEBRIS_TABLE.headers
    assert [(int(row["frame"]), row["body"]) for row in rows] == [
        (frame, name) for frame in (2, 6) for name in results.inventory.body_names
    ]
    np.testing.assert_allclose(
        vectors(rows, "x_m", "y_m", "z_m"), results.frames.positions_m[[0, 4]].reshape(-1, 3), rtol=WRITTEN
    )
    # Only *lower* moved, by (3, 4, -12) m: 13 m away, thrown by 5 m.
    travelled = np.zeros((8, 2))
    travelled[6] = 13.0, 5.0
    np.testing.assert_allclose(vectors(rows, "distance_m", "throw_m"), travelled, rtol=WRITTEN)


def test_breaking_log_names_each_connection_and_the_loads_it_broke_under(tmp_path):
    logged(tmp_path, hanging_chain(), [broken([1], 0.132, 10.0), broken([0, 1], 0.148, -1.5)])
    assert rows_of(tmp_path / "breaking_log.csv") == [
        BREAKING_TABLE.headers,
        ["6", "0.132", "Connection.001", "upper", "lower", "10", "11", "12", "13", "14", "15"],
        ["6", "0.148", "Connection", "upper", "Ground", "-1.5", "-0.5", "0.5", "1.5", "2.5", "3.5"],
        ["6", "0.148", "Connection.001", "upper", "lower", "4.5", "5.5", "6.5", "7.5", "8.5", "9.5"],
    ]


def test_columns_of_the_breaking_log_hold_what_they_are_named_after(tmp_path):
    loads = SectionForces(np.array([1.0]), np.array([[2.0, 3.0]]), np.array([4.0]), np.array([[5.0, 6.0]]))
    logged(tmp_path, hanging_chain(), [Breaks(0.15, np.array([0]), loads)])
    (row,) = table(tmp_path / "breaking_log.csv")
    numbers = {"axial_N": "1", "shear_y_N": "2", "shear_z_N": "3"}
    numbers |= {"torsion_Nm": "4", "bending_y_Nm": "5", "bending_z_Nm": "6"}
    assert numbers.items() <= row.items()
    assert (row["frame"], row["time_s"], row["first_body"], row["second_body"]) == ("6", "0.15", "upper", "Ground")


def test_without_breaks_the_breaking_log_has_its_header_alone(tmp_path):
    logged(tmp_path, without_connections(hanging_chain()), [broken([])])
    assert rows_of(tmp_path / "breaking_log.csv") == [BREAKING_TABLE.headers]
    assert len(rows_of(tmp_path / "force_log.csv")) == 1 + 20


def test_no_zero_has_a_sign(tmp_path):
    results = hanging_chain()
    loads = SectionForces(np.array([-0.0]), np.array([[-0.0, 0.0]]), np.array([-0.0]), np.array([[-0.0, 1.0]]))
    logged(
        tmp_path,
        changed(results, body_forces_n=-0.0 * results.frames.loads.body_forces_n),
        [Breaks(0.1, np.array([0]), loads)],
    )
    for log in ("force_log.csv", "debris_log.csv", "breaking_log.csv"):
        assert not [row for row in rows_of(tmp_path / log) if "-0" in row]


def test_loads_that_are_not_known_are_nan_in_the_log(tmp_path):
    results = hanging_chain()
    names = ("body_forces_n", "body_peaks_n", "stresses_pa", "von_mises_pa")
    logged(tmp_path, changed(results, **{name: np.full_like(results.arrays()[name], np.nan) for name in names}))
    rows = table(tmp_path / "force_log.csv")
    unknown = vectors(rows, "force_x_N", "peak_force_N", "stress_largest_Pa", "stress_smallest_Pa", "von_mises_Pa")
    assert np.isnan(unknown).all()
    assert np.isfinite(vectors(rows, "force_sum_N", "contact_impulse_z_Ns", "asleep")).all()


@pytest.mark.parametrize("name", ['a,b and "c"', "100 %s", "Brücke ×2", "two\nlines", "a\rb", "a\r\nb", " ", ""])
def test_any_name_comes_back_from_every_log(tmp_path, name):
    results = hanging_chain()
    results = changed(
        results,
        body_names=np.array(["Ground", name, "lower", "Wrecking ball"]),
        connection_names=np.array([name, "Connection.001"]),
    )
    logged(tmp_path, results, [broken([0])])
    for log in ("force_log.csv", "debris_log.csv"):
        assert [row["body"] for row in table(tmp_path / log)][:4] == results.inventory.body_names.tolist()
    (row,) = table(tmp_path / "breaking_log.csv")
    assert (row["connection"], row["first_body"], row["second_body"]) == (name, name, "Ground")


def test_every_frame_of_every_log_is_on_disk_at_once(tmp_path):
    results = hanging_chain()
    logs = Logs(tmp_path, results.inventory)
    assert [len(rows_of(tmp_path / f"{log}_log.csv")) for log in ("force", "debris", "breaking")] == [1, 1, 1]
    for step in range(3):
        logs.write_frame(results.frames[step])
        logs.write_breaks(2 + step, [broken([0])])
        # Places are logged at the beginning and, once more, at the end.
        lengths = [len(rows_of(tmp_path / f"{log}_log.csv")) for log in ("force", "debris", "breaking")]
        assert lengths == [1 + 4 * (step + 1), 5, 2 + step]
    logs.close(results.frames[2])
    assert len(rows_of(tmp_path / "debris_log.csv")) == 9


def test_older_logs_are_replaced(tmp_path):
    logged(tmp_path, hanging_chain(), [broken([0, 1])])
    written = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert sorted(written) == ["breaking_log.csv", "debris_log.csv", "force_log.csv"]
    logged(tmp_path, hanging_chain(), [broken([0, 1])])
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == written
    assert not any(b"\r" in content for content in written.values())
