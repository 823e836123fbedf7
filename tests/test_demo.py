# SPDX-License-Identifier: GPL-3.0-or-later
"""The demonstration, in an environment in which the project is installed."""

import subprocess
import sys

import pytest
from support.checkout import ROOT


@pytest.mark.long
def test_it_runs_the_example_into_the_folder_that_is_named(tmp_path):
    in_the_way = tmp_path / "a file"
    in_the_way.touch()
    command = [sys.executable, str(ROOT / "scripts" / "demo.py"), str(in_the_way)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2  # Blender may print lines of its own to the standard output
    assert str(in_the_way) in done.stderr
    assert done.stderr.startswith("bda: error: ")
    assert len(done.stderr.splitlines()) == 1
