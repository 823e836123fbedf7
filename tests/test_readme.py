# SPDX-License-Identifier: GPL-3.0-or-later
"""The README is short, and its commands run as they stand there; with a small bridge and a few runs, to be quick."""

import csv
import re
import shlex
from pathlib import Path

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.cli.main import COMMANDS, main

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
MOST_LINES = 120

SMALLER = (
    ("duration_s = 4.0", "duration_s = 0.7"),
    ("shards = 160", "shards = 24"),
)
"""Changes to the scenario that `bda new` writes: the pier goes at 0.5 s."""

FEWER = (("runs = 93", "runs = 1\nquantile = 0.5\nconfidence = 0.5\nrank = 1"),)


def blocks(language):
    """Fenced blocks of a language, in order."""
    return re.findall(rf"^```{language}\n(.*?)^```", TEXT, flags=re.S | re.M)


def commands(name):
    """Commands in blocks that begin with a name, in order, as words."""
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    return [shlex.split(line, comments=True) for line in lines if line.split()[0] == name]


def replaced(path, changes):
    text = path.read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")


def test_it_is_short():
    assert len(TEXT.splitlines()) <= MOST_LINES


@pytest.mark.long
def test_its_commands_run_one_after_the_other(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (study,) = blocks("toml")
    Path("my_study.toml").write_text(study, encoding="utf-8")
    replaced(Path("my_study.toml"), FEWER)
    ran = []
    for _, command, *arguments in commands("bda"):
        assert main([command, *arguments]) == 0, capsys.readouterr().err
        ran.append(command)
        if command == "new":
            replaced(Path("my_bridge.toml"), SMALLER)
    assert ran == ["new", "check", "run", "study"]
    for made in re.findall(r"`(my_\w+/[\w.]+)`", TEXT):
        assert Path(made).is_file(), made
    assert Path("my_study", "report", "report.html").is_file()


def test_every_command_that_it_names_is_there():
    named = set(re.findall(r"`bda (\w+)", TEXT))
    assert named and named <= set(COMMANDS)


def test_its_figures_are_those_of_the_demolition_that_it_shows():
    """Twenty runs of the demo, by the table that is kept of them."""
    with (ROOT / "docs" / "data" / "seeds" / "drilled_two_spans.csv").open(encoding="utf-8", newline="") as file:
        runs = list(csv.DictReader(file))
    assert len(runs) == 20
    for words, column, factor in (
        ("95 % of the shards end within", "throw_95_percent_m", 1.0),
        ("largest throw of a shard", "largest_throw_m", 1.0),
        ("before the first charge", "broken_before_share", 100.0),
        ("made by the solver", "made_share", 100.0),
    ):
        (line,) = (line for line in TEXT.splitlines() if line.startswith("|") and words in line)
        shown = [float(number) for number in re.findall(r"(\d+(?:\.\d+)?) (?:m|%)\W", line.split("|", 2)[2])]
        values = sorted(factor * float(run[column]) for run in runs)
        assert shown == pytest.approx([values[0], values[10], values[-1]], rel=0.05), line


@pytest.mark.parametrize("words", ["the bars of its design", "until its pile rests", "no plan", "340 m by Lundborg"])
def test_it_says_what_the_first_numbers_rest_on(words):
    limits = TEXT[TEXT.index("What may come of it") : TEXT.index("## Install")]
    assert words in " ".join(limits.split())
