# SPDX-License-Identifier: GPL-3.0-or-later
"""The ways in the README of the package: a small run and a small study pass their files, in the order of the rows."""

import ast
import os
import re

import pytest
from support.checkout import ROOT, SMALL, TESTS
from support.processes import run_bda

PACKAGE = ROOT / "bridge_demolition_addon"

CHARGED = """
[blast]
start_s = 0.05
apply = "direct"

[[charges]]
name = "west"
position_m = [0.0, 0.0, 1.0]
mass_kg = 1.0
"""

STUDY = """
[study]
scenario = "bridge.toml"
runs = 1
quantile = 0.5
confidence = 0.5
rank = 1

[[vary]]
key = "ball.drop_height_m"
distribution = "uniform"
lowest = 0.2
highest = 0.4
"""


def names_in(path):
    """Functions, classes, and methods with their class, that a module defines."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body if path.is_file() else ():
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        if isinstance(node, ast.ClassDef):
            for method in node.body:
                if isinstance(method, ast.FunctionDef):
                    yield from (method.name, f"{node.name}.{method.name}")


def ways():
    """The stations of each way by its heading: the file of a row, and the first of its functions that the row names."""
    text = (ROOT / "bridge_demolition_addon" / "README.md").read_text(encoding="utf-8")
    found = {}
    for heading, section in re.findall(r"^## (The way of .*?)\n(.*?)(?=^## |\Z)", text, flags=re.S | re.M):
        rows = re.findall(r"^\| \[([^\]]+)\]\([^)]*\) \| (.*) \|$", section, flags=re.M)
        for file, description in rows:
            defined = set(names_in(PACKAGE / file))
            named = [name for name in re.findall(r"`([\w.]+)`", description) if name in defined]
            found.setdefault(heading, []).append((file, named[0] if named else "a name that it defines"))
    return found


WAYS = ways()


@pytest.fixture(scope="module")
def passed(tmp_path_factory):
    """Stations that a run and a study passed, in order, from all processes."""
    folder = tmp_path_factory.mktemp("traced")
    scenario = SMALL.read_text(encoding="utf-8").replace("duration_s = 1.5", "duration_s = 0.3")
    (folder / "bridge.toml").write_text(scenario.replace("shards = 30", "shards = 12") + CHARGED, encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    environment = {
        "PYTHONPATH": os.pathsep.join(map(str, (TESTS / "tracing", ROOT))),
        "TRACED": " ".join(sorted({f"{file}:{name}" for way in WAYS.values() for file, name in way})),
        "TRACE_FOLDER": str(folder),
    }
    for command in (
        ("run", folder / "bridge.toml", "--output", folder / "run", "--no-pictures"),
        ("study", folder / "study.toml", "--output", folder / "study", "--jobs", "1"),
        ("report", folder / "study"),
    ):
        status, printed, _ = run_bda(*command, "--quiet", **environment)  # so coarse a run warns of the solver's energy
        assert (status, printed) == (0, "")
    lines = [line.split() for path in folder.glob("*.txt") for line in path.read_text(encoding="utf-8").splitlines()]
    return [tuple(station.split(":")) for _, station in sorted(lines, key=lambda line: int(line[0]))]


@pytest.mark.long
@pytest.mark.parametrize("way", WAYS)
def test_a_run_passes_the_files_of_a_way_in_order(way, passed):
    calls = iter(passed)
    missing = next((station for station in WAYS[way] if station not in calls), None)
    assert missing is None, f"{missing} is not passed after the rows above it"


def test_the_ways_are_found():
    assert len(WAYS) >= 3 and all(len(stations) > 3 for stations in WAYS.values())
