# SPDX-License-Identifier: GPL-3.0-or-later
"""All tables of a run in a workbook, read by openpyxl."""

import csv

import numpy as np
import openpyxl
import pytest
from support.exported_runs import turning_run
from support.run_folders import keep_run
from support.sample_results import hanging_chain

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.units import name_and_unit
from bridge_demolition_addon.exports import sheets
from bridge_demolition_addon.exports.sheets import write_sheets

LOG = "frame,time_s,body,force_x_N,note\n3,0.5,Shard 0,-1.25,=1+1\n4,1.0,Shard 1,,\n"


def written(folder, results):
    """The sheets of a workbook by name, each a list of rows."""
    path = folder / "run.xlsx"
    write_sheets(folder, results, path, Silence())
    book = openpyxl.load_workbook(path, read_only=True)
    return {sheet.title: [list(row) for row in sheet.iter_rows(values_only=True)] for sheet in book}


def column(rows, name):
    """The values below a heading."""
    return [row[rows[0].index(name)] for row in rows[1:]]


@pytest.fixture(scope="module")
def workbook(tmp_path_factory):
    """The sheets, and the run that they are of."""
    results = turning_run()
    folder = keep_run(tmp_path_factory.mktemp("sheets") / "run", results)
    (folder / "force_log.csv").write_text(LOG, encoding="utf-8")
    (folder / "tables").mkdir()
    (folder / "tables" / "zones.csv").write_text("zone,mass_t\nRoad,2.5\n", encoding="utf-8")
    return written(folder, results), results


def test_places_of_all_bodies_in_every_frame_are_those_recorded(workbook):
    tables, results = workbook
    rows, frames = tables["motion"], results.frames
    count = len(results.inventory.body_names)
    found = np.array([column(rows, f"{axis}_m") for axis in "xyz"]).T.reshape(len(frames), count, 3)
    assert (found.astype(np.float32) == frames.positions_m).all()  # 16 digits are written
    assert column(rows, "body") == results.inventory.body_names.tolist() * len(frames)
    assert column(rows, "time_s")[::count] == pytest.approx(frames.time_s, rel=1e-15)


def test_logs_and_tables_of_the_report_are_in_it_as_numbers_and_texts(workbook):
    tables, _ = workbook
    lines = list(csv.reader(LOG.splitlines()))
    assert tables["force_log"] == [
        lines[0],
        [3, 0.5, "Shard 0", -1.25, "=1+1"],  # a text, no formula
        [4, 1, "Shard 1", None, None],
    ]
    assert tables["report zones"] == [["zone", "mass_t"], ["Road", 2.5]]


def test_connections_of_the_hanging_chain_broke_when_they_did(tmp_path):
    rows = written(tmp_path, hanging_chain())["connections"]
    assert column(rows, "broken_by_s") == [None, pytest.approx(0.16)]
    assert list(zip(column(rows, "first_body"), column(rows, "second_body"), strict=True)) == [
        ("upper", "Ground"),
        ("upper", "lower"),
    ]
    # Each carries what hangs below it: 500 kg and 200 kg, and the last, for half a frame, a pull of 1 kN to the side.
    assert column(rows, "peak_force_N")[1] == pytest.approx(np.hypot(200.0 * 9.80665, 1000.0))


def test_bodies_have_their_throw_and_masses(tmp_path):
    rows = written(tmp_path, hanging_chain())["bodies"]
    assert column(rows, "mass_kg") == [0, 300, 200, 1000]
    assert column(rows, "throw_m")[2] == pytest.approx(5.0)  # lower has moved by (3, 4, -12) m


def test_every_column_is_listed_with_its_unit(workbook):
    tables, _ = workbook
    units = {(sheet, name): unit for sheet, name, unit in tables["units"][1:]}
    assert set(units) == {(sheet, name) for sheet, rows in tables.items() if sheet != "units" for name in rows[0]}
    assert units["motion", "velocity_x_m_s"] == "m/s"
    assert units["report zones", "mass_t"] == "t"
    assert units["bodies", "kind"] is None


@pytest.mark.parametrize(
    "name, unit",
    [
        ("force_x_N", "N"),
        ("impulse_Ns", "N·s"),
        ("torsion_Nm", "N·m"),
        ("von_mises_Pa", "Pa"),
        ("scaled_distance_m_kg13", "m/kg^(1/3)"),
        ("projected_area_m2", "m²"),
        ("density_kg_m3", "kg/m³"),
        ("made_by_solver_J", "J"),
        ("angular_velocity_rad_s", "rad/s"),
        ("member", ""),
        ("asleep", ""),
    ],
)
def test_units_end_the_names_of_columns(name, unit):
    assert name_and_unit(name)[1] == unit


def test_what_does_not_fit_on_a_sheet_goes_on_in_the_next(tmp_path, monkeypatch):
    monkeypatch.setattr(sheets, "MOST_ROWS", 5)
    tables = written(tmp_path, hanging_chain())
    names = [name for name in tables if name.startswith("motion")]
    assert names == ["motion", "motion 2", "motion 3", "motion 4"]  # 20 rows
    assert len({tuple(tables[name][0]) for name in names}) == 1
    assert [number for name in names for number in column(tables[name], "frame")] == [2] * 4 + [3] * 4 + [4] * 4 + [
        5
    ] * 4 + [6] * 4


def test_the_same_run_gives_the_same_bytes(tmp_path):
    results = hanging_chain()
    for name in ("one.xlsx", "two.xlsx"):
        write_sheets(tmp_path, results, tmp_path / name, Silence())
    assert (tmp_path / "one.xlsx").read_bytes() == (tmp_path / "two.xlsx").read_bytes()
