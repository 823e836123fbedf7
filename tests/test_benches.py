# SPDX-License-Identifier: GPL-3.0-or-later
"""Every bench of `scripts/bench` works, at its smallest size: what it measures there is not looked at."""

import importlib
import subprocess
import sys

import pytest
from bench import BENCHES
from benches.deck import SMALLEST, deck
from support.checkout import ROOT
from support.long_cases import long_but

QUICK = ("fracture",)
"""That which takes least."""


@pytest.mark.parametrize("name", long_but(QUICK, BENCHES))
def test_a_bench_prints_what_it_measured(name):
    command = [sys.executable, str(ROOT / "scripts" / "bench.py"), name, "--smallest"]
    run = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=300, check=False)
    assert run.returncode == 0, run.stderr
    assert any(character.isdigit() for character in run.stdout)


def test_every_bench_is_run():
    modules = (ROOT / "scripts" / "benches").glob("*.py")
    assert {path.stem for path in modules if "def main(smallest" in path.read_text(encoding="utf-8")} == set(BENCHES)


@pytest.mark.parametrize(("name", "stiffness"), [("strength", "rigid"), ("elastic", "elastic")])
def test_connections_of_a_bench_are_as_stiff_as_it_says(name, stiffness):
    settings = importlib.import_module(f"benches.{name}").SETTINGS
    assert deck(SMALLEST, connections=settings).connections.stiffness == stiffness


def test_an_unknown_bench_is_named():
    command = [sys.executable, str(ROOT / "scripts" / "bench.py"), "blasts"]
    run = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=60, check=False)
    assert run.returncode == 2
    assert "no bench has the name blasts" in run.stderr
