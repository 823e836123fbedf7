# SPDX-License-Identifier: GPL-3.0-or-later
"""What is left of a study where its draws cost nothing."""

import sys

import pytest
from support.processes import run_program
from support.study_files import study_file

MOST_MS = 30.0
MOST_MB = 300.0
MANY = 10_000


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="memory is told like this on Linux only")
def test_ten_thousand_draws_need_little_time_and_memory(tmp_path):
    """By processor time, as other tests run beside this one, and by what 500 draws more keep."""
    few, many = (study_file(tmp_path / str(runs), runs) for runs in (100, 600))
    done = run_program("many_runs", few, many, tmp_path / "out")
    assert done.returncode == 0, done.stderr
    (first, _, memory_mb), (second, each_ms, more_mb) = (
        [float(word) for word in line.split()] for line in done.stdout.splitlines()
    )
    assert (first, second) == (100, 600)
    assert each_ms < MOST_MS
    a_draw_mb = max(more_mb - memory_mb, 0.0) / (second - first)
    assert memory_mb + a_draw_mb * MANY < MOST_MB
