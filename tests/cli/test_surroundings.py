# SPDX-License-Identifier: GPL-3.0-or-later
"""Computers that lack what others have: no home, or no folder for temporary files."""

import json
import sys
from dataclasses import replace

import pytest
from support.ifc_bridges import whole_bridge
from support.processes import run_bda, run_program
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.run_folder.summary import read_summary
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.sequence.ending import unusable_texts

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows names its folders otherwise")
NO_SCRATCH = "bda: error: no folder for temporary files can be written to: set TMPDIR to one that can\n"


def brief(folder):
    path = folder / "scenario.toml"
    path.write_text(scenario_text(replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.1))), encoding="utf-8")
    return path


@pytest.mark.slow
@pytest.mark.parametrize("command", ["run", "import"])
def test_without_a_folder_for_temporary_files_nothing_begins(command, tmp_path):
    path = brief(tmp_path) if command == "run" else whole_bridge().written(tmp_path / "bridge.ifc")
    done = run_program("bda_without_scratch", command, path, "--output", tmp_path / "out", "--quiet")
    assert (done.returncode, done.stdout, done.stderr) == (1, "", NO_SCRATCH)
    assert not (tmp_path / "out").exists()


def summary(output):
    return json.loads((output / "summary.json").read_text(encoding="utf-8"))


@pytest.mark.long
def test_without_a_home_a_run_and_its_report_are_whole(tmp_path):
    path, output = brief(tmp_path), tmp_path / "out"
    nowhere = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "MPLCONFIGDIR"), "/proc/1/nowhere")
    for command in (("run", path, "--output", output, "--no-pictures"), ("report", output)):
        status, _, complained = run_bda(*command, "--quiet", **nowhere)
        assert status == 0
        assert "Traceback" not in complained  # matplotlib says where its fonts go
        said = [line for line in complained.splitlines() if "bda" in line]
        assert said == [f"bda: {path}: {text}" for text in unusable_texts(read_summary(output)) if command[0] == "run"]
    assert (output / "summary.json").exists() and (output / "report.pdf").stat().st_size > 0
