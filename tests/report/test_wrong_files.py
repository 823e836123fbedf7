"""Files of a run that are well-formed and wrong are said in the report, and left out of it."""

import json

import numpy as np
import pytest
from run_folders import flying_shards, keep_run

from bridge_demolition_addon.core.errors import OutputError
from bridge_demolition_addon.core.results.arrays import load_results
from bridge_demolition_addon.report.run_folder import read_run

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
        load_results(folder / "results.npz")
    assert str(folder / "results.npz") in str(refusal.value) and said in str(refusal.value)
    assert any(text.startswith("results.npz cannot be read") for text in read_run(folder).shortcomings)


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"title": 3}, "title: is 3"),
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


def test_lists_nested_without_end_are_no_summary(tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), None)
    (folder / "summary.json").write_text("[" * 100_000, encoding="utf-8")
    assert any(text.startswith("summary.json cannot be read") for text in read_run(folder).shortcomings)
