# SPDX-License-Identifier: GPL-3.0-or-later
"""Ratios of benches are kept by commit and processor, and what has grown is named."""

import bench
import bench_history
import pytest


@pytest.fixture
def history(tmp_path, monkeypatch):
    """Keep ratios of commits, one after another, on a processor."""
    table, picture = tmp_path / "bench.csv", tmp_path / "bench.png"

    def keep(commit, value, processor="one"):
        monkeypatch.setattr(bench_history, "commit", lambda: commit)
        monkeypatch.setattr(bench_history, "processor_name", lambda: processor)
        bench_history.keep({"recording": {"every sub-step over bare step": value}}, table, picture)
        return table

    yield keep
    assert picture.stat().st_size > 5000


def test_a_ratio_that_grew_by_more_than_5_percent_is_named(history):
    history("a1", 1.10)
    assert list(bench_history.grown(history("b2", 1.15))) == []
    (line,) = bench_history.grown(history("c3", 1.30))
    assert line == "slower: recording, every sub-step over bare step: 1.15 in b2, 1.30 in c3, +13%"


def test_ratios_of_two_processors_are_not_held_against_each_other(history):
    history("a1", 1.10)
    assert list(bench_history.grown(history("b2", 1.80, "another"))) == []
    rows = bench_history.kept(history("c3", 1.1))
    assert [row["value"] for row in rows] == ["1.1", "1.8", "1.1"]
    assert all(float(row["load"]) >= 0.0 for row in rows)


def test_small_sizes_are_not_kept(capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["bench", "recording", "--keep", "--smallest"])
    with pytest.raises(SystemExit):
        bench.main()
    assert "the smallest sizes say nothing of speed" in capsys.readouterr().err


@pytest.mark.long
def test_benches_return_their_ratios(tmp_path):
    """Recording at its smallest size: each way takes longer than nothing."""
    status = bench.run_all(["recording"], tmp_path, smallest=True, keep=False)
    assert status == 0 and "every sub-step over bare step" in (tmp_path / "recording.json").read_text(encoding="utf-8")
