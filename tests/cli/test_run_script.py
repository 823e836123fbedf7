# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/run_scenario.py is ``bda run`` for a Blender; the bpy module stands in where there is none."""

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from support.checkout import ROOT
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario.file import scenario_text

SCRIPT = ROOT / "scripts" / "run_scenario.py"
Run = Callable[..., subprocess.CompletedProcess[str]]


def blender_command() -> list[str]:
    """A Blender that can run the checkout: one whose Python has the packages it needs."""
    blender = shutil.which("blender")
    if not blender:
        pytest.skip("there is no blender on the path")
    imports = "import trimesh, manifold3d, matplotlib"
    probe = [blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python-expr", imports]
    if subprocess.run(probe, capture_output=True).returncode:
        pytest.skip(f"{blender} does not find trimesh, manifold3d or matplotlib")
    return [blender, "-b", "--factory-startup", "--python"]


@pytest.fixture(params=["bpy", "blender"])
def run(request: pytest.FixtureRequest, tmp_path: Path) -> Run:
    """Run the script with arguments, somewhere else than in the checkout."""
    python = [sys.executable] if request.param == "bpy" else blender_command()

    def started(*arguments: str) -> subprocess.CompletedProcess[str]:
        command = [*python, str(SCRIPT), "--", *arguments]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)

    return started


@pytest.mark.long
def test_it_runs_a_scenario_where_the_shell_is(run: Run, tmp_path: Path) -> None:
    short = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.25))
    (tmp_path / "short.toml").write_text(scenario_text(short), encoding="utf-8")
    outcome = run("short.toml", "--output", "results", "--no-pictures")
    assert outcome.returncode == 0, outcome.stderr
    assert (tmp_path / "results" / "summary.json").is_file()


@pytest.mark.long
def test_wrong_input_gives_its_status(run: Run) -> None:
    outcome = run("no_such.toml", "--output", "results")
    assert outcome.returncode == 2
    assert "no_such.toml" in outcome.stderr


@pytest.mark.long
def test_no_arguments_are_a_wrong_input(run: Run) -> None:
    assert run().returncode == 2


def test_a_python_without_the_libraries_is_told_what_to_do(tmp_path: Path) -> None:
    command = [sys.executable, "-I", "-S", str(SCRIPT), "--", "short.toml", "--output", "results"]
    outcome = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert outcome.returncode == 1
    assert outcome.stderr.startswith(
        "run_scenario: the Python of this Blender has no numpy: install the extension's zip"
    )
    assert len(outcome.stderr.splitlines()) == 1
