# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs, studies, searches, optimisations, imports that are ended at any moment: the same command, the same tables.

With BDA_MOMENTS=50 in the environment each is ended at as many moments, else at a few.
"""

import os
import signal
import sys
import time
from random import Random

import pytest
from support.ifc_bridges import whole_bridge
from support.optimise_files import optimise_file
from support.processes import outcome, start_bda, start_program
from support.scenarios import SHORT_RUN
from support.study_files import TABLES as STUDY_TABLES
from support.study_files import study_file

from bridge_demolition_addon.model.scenario.file import scenario_text

MOMENTS = int(os.environ.get("BDA_MOMENTS", "2"))
SIGNALS = (signal.SIGKILL, signal.SIGTERM)
TABLES = {
    "run": ("force_log.csv", "debris_log.csv", "breaking_log.csv", "scenario_as_run.toml"),
    "study": STUDY_TABLES,
    "search": ("trials.csv", "search.json", "curve.csv"),
    "optimise": ("trials.csv", "candidates.csv", "optimise.json"),
    "import": ("scenario.toml", "elements.csv", "import.txt"),
}

pytestmark = [pytest.mark.long, pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")]


def search_file(folder):
    path = study_file(folder)
    varied = path.read_text(encoding="utf-8").split("[[vary]]")[1]
    text = """
[search]
scenario = "scenario.toml"
key = "ball.mass_kg"
lowest = 8000.0
highest = 10000.0
trials = 16
[[criteria]]
name = "down"
kind = "collapsed"
[[vary]]
"""
    (folder / "search.toml").write_text(text + varied, encoding="utf-8")
    return folder / "search.toml"


def run_file(folder):
    (folder / "scenario.toml").write_text(scenario_text(SHORT_RUN), encoding="utf-8")
    return folder / "scenario.toml"


FILES = {
    "run": run_file,
    "study": study_file,
    "search": search_file,
    "optimise": optimise_file,
    "import": lambda folder: whole_bridge().written(folder / "bridge.ifc"),
}


def start(command, path, output):
    if command == "run":
        return start_bda("run", path, "--output", output, "--no-pictures", "--overwrite")
    if command == "import":
        return start_bda("import", path, "--output", output, "--shards", "20")
    log = output.with_name(f"{output.name}.log")
    log.touch()
    return start_program("bda_ensemble", log, 0, command, path, "--output", output, "--jobs", "2")


def tables(command, output):
    return {name: (output / name).read_bytes() for name in TABLES[command]}


@pytest.mark.parametrize("command", FILES)
def test_what_is_ended_at_any_moment_comes_to_the_same_tables(command, tmp_path):
    (tmp_path / "in").mkdir()
    path, began = FILES[command](tmp_path / "in"), time.monotonic()
    status, _, complained = outcome(start(command, path, tmp_path / "whole"))
    takes_s = time.monotonic() - began
    assert status == 0, complained
    whole, random = tables(command, tmp_path / "whole"), Random(f"{command} {MOMENTS}")
    for moment in range(MOMENTS):
        output, number = tmp_path / f"out_{moment}", SIGNALS[moment % 2]
        process = start(command, path, output)
        time.sleep(takes_s * random.uniform(0.05, 1.0))
        process.send_signal(number)
        status, _, complained = outcome(process)
        assert status in (0, -signal.SIGKILL, -signal.SIGTERM, 128 + number), complained
        assert "Traceback" not in complained
        if command == "import" and output.exists():
            assert tables(command, output) == whole
            continue
        status, _, complained = outcome(start(command, path, output))
        assert status == 0, complained
        assert tables(command, output) == whole
        assert not list(output.rglob("*.part*"))
