# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of a run that are well-formed and wrong are said in the report, and left out of it."""

import json
import os
import struct
import sys
import zlib
from dataclasses import replace

import numpy as np
import pytest
from support.long_cases import long_but
from support.report_texts import told
from support.run_folders import TOLD, flying_shards, keep_run

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.debris.footprint import check_covers_ground
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.report.run_folder import read_run

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files")
HIT = {"ball": "b", "time_s": 1.0, "lasted_s": 1.0, "approach_m_s": 1.0, "impulse_Ns": 1.0, "raw_peak_force_N": 1.0}


@pytest.mark.parametrize(
    "name, changed, said",
    [
        ("places_m", None, "places_m"),
        ("places_m", lambda a: a[:-1], "places_m: expected a length of 13, as in frames, found 12 along axis 0"),
        ("places_m", lambda a: a[..., :2], "places_m: expected a length of 3, found 2 along axis 2"),
        ("places_m", lambda a: a[0], "places_m: expected 3 axes, found 2"),
        ("places_m", lambda a: a * 1e300, "places_m: expected numbers of at most 1e+07"),
        ("places_m", lambda a: a * np.nan, "places_m: expected numbers of at most 1e+07"),
        ("places_m", lambda a: a.astype(str), "places_m: expected fractions, found <U"),
        ("rotations", lambda a: -7.0 * a, "rotations: expected rotation matrices"),
        ("masses_kg", lambda a: -a, "masses_kg: expected no negative numbers"),
        ("times_s", lambda a: a[::-1], "times_s: expected numbers that do not fall"),
        ("intact", lambda a: a.astype(float), "intact: expected true or false, found float64"),
        ("pairs", lambda a: a + 2**60, "pairs: expected whole numbers from -1 to 6"),
        ("pairs", lambda a: a + 0.5, "pairs: expected whole numbers, found float64"),
        ("balls", lambda a: a + 1, "balls: expected whole numbers from 0 to 6"),
        ("vertex_counts", lambda a: a + 1, "vertex_counts: add up to 63, expected 56, as in vertices_m"),
        ("body_names", lambda a: a[:-1], "as in places_m"),
        ("body_names", lambda a: np.array(["\udcfc", *a[1:]]), "body_names: expected texts in Unicode"),
        ("vertices_m", lambda a: 0.0 * a, "vertices_m: expected shards that cover an area in plan"),
        ("connection_peaks_n", lambda a: np.full(a.shape, 1e300), "connection_peaks_n: expected numbers of at most"),
    ],
)
def test_wrong_arrays_are_named(tmp_path, name, changed, said):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    with np.load(folder / "results.npz") as stored:
        arrays = dict(stored)
    before = arrays.pop(name)
    if changed:
        arrays[name] = changed(before)
    np.savez(folder / "results.npz", **arrays)
    with pytest.raises(OutputError) as refusal:
        check_covers_ground(load_results(folder / "results.npz"))
    assert said in str(refusal.value)
    (shortcoming,) = (text for text in read_run(folder).shortcomings if text.startswith("results.npz"))
    assert shortcoming.startswith("results.npz cannot be read") and said in shortcoming


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"title": 3}, "title: is 3"),
        ({"title": "\udcfc"}, 'title: is "\\\\udcfc"'),
        ({"completed": "no"}, 'completed: is "no"'),
        ({"blender": None}, "blender: is missing"),
        ({"density_kg_m3": "2400"}, 'density_kg_m3: is "2400"'),
        ({"density_kg_m3": 1e308}, "density_kg_m3: is 1e+308"),
        ({"density_kg_m3": 10**400}, "density_kg_m3: is a whole number of more than 64 bits"),
        ({"impact": 1.0}, "impact: is 1.0"),
        ({"impact": {}}, "impact: has no time_s"),
        ({"impact": {"time_s": float("nan")}}, "time_s: is nan"),
        ({"key_frame": None}, "key_frame: is missing"),
        ({"key_frame": {"time_s": 1.0, "reason": []}}, "reason: is a list"),
        ({"hits_of_the_ball": 1}, "hits_of_the_ball: is 1"),
        ({"hits_of_the_ball": [1]}, "hits_of_the_ball[0]: is 1, expected a table"),
        ({"hits_of_the_ball": [{}]}, "hits_of_the_ball[0]: has no ball"),
        ({"hits_of_the_ball": [HIT, HIT | {"lasted_s": True}]}, "lasted_s: is true"),
        ({"hits_of_the_ball": [HIT | {"hertz_peak_force_N": {}}]}, "hertz_peak_force_N: is a table"),
    ],
)
def test_wrong_values_of_a_summary_are_named(tmp_path, changes, said):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    path = folder / "summary.json"
    path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | changes), encoding="utf-8")
    run = read_run(folder)
    assert run.summary is None
    (shortcoming,) = (text for text in run.shortcomings if text.startswith("summary.json"))
    assert shortcoming.startswith("summary.json is not what a run writes") and said in shortcoming


@POSIX
@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda path: path.symlink_to("/dev/zero")])
@pytest.mark.parametrize("name", ["force_log.csv", "breaking_log.csv", "frames/before.png", "results.npz"])
def test_what_is_no_file_is_neither_waited_for_nor_read_without_end(tmp_path, name, make):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    (folder / "results.npz").write_bytes(b"damaged, so that logs are read")
    (folder / "frames").mkdir()
    (folder / name).unlink(missing_ok=True)
    make(folder / name)
    assert any(name in text and "left out" in text for text in read_run(folder).shortcomings)


def test_a_picture_that_says_it_is_larger_than_there_is_memory(tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    (folder / "frames").mkdir()
    header = struct.pack(">IIBBBBB", 2**31 - 1, 2**31 - 1, 8, 2, 0, 0, 0)
    checked = b"IHDR" + header
    chunk = struct.pack(">I", len(header)) + checked + struct.pack(">I", zlib.crc32(checked))
    (folder / "frames" / "after.png").write_bytes(b"\x89PNG\r\n\x1a\n" + chunk)
    run = read_run(folder)
    assert not run.pictures and any("frames/after.png is no whole picture" in text for text in run.shortcomings)


@pytest.mark.parametrize("bodies", long_but([slice(2, 5)], [slice(0, 1), slice(2, 5), slice(1, 6)]))
def test_shards_whose_vertices_coincide_are_reported_with_the_others(tmp_path, bodies):
    results = flying_shards(6, 13)
    vertices, volumes = results.inventory.vertices_m.reshape(7, 8, 3).copy(), results.inventory.volumes_m3.copy()
    vertices[bodies] = volumes[bodies] = 0.0
    inventory = replace(results.inventory, vertices_m=vertices.reshape(-1, 3), volumes_m3=volumes)
    folder = keep_run(tmp_path / "run", replace(results, inventory=inventory), TOLD)
    assert "Blast" in told(folder).titles


@pytest.mark.long
def test_shards_without_vertices_are_points(tmp_path, capsys):
    results = flying_shards(6, 13)
    counts, volumes = results.inventory.vertex_counts.copy(), results.inventory.volumes_m3.copy()
    counts[0] = volumes[0] = 0
    vertices = results.inventory.vertices_m[8:]
    inventory = replace(results.inventory, vertices_m=vertices, vertex_counts=counts, volumes_m3=volumes)
    folder = keep_run(tmp_path / "run", replace(results, inventory=inventory), TOLD)
    assert main(["report", str(folder), "--quiet"]) == 0, capsys.readouterr().err


def test_lists_nested_without_end_are_no_summary(tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    (folder / "summary.json").write_text("[" * 100_000, encoding="utf-8")
    assert any(text.startswith("summary.json cannot be read") for text in read_run(folder).shortcomings)
