# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda charts``: pictures in the folder asked for, and wrong input refused in one line."""

from contextlib import chdir, redirect_stdout
from io import StringIO
from pathlib import Path

import pytest

from bridge_demolition_addon.charts.blast_design import CHARTS
from bridge_demolition_addon.cli.main import main


@pytest.fixture(scope="module")
def usual(tmp_path_factory):
    """The folder of all charts as they are without options, and what was printed."""
    with chdir(tmp_path_factory.mktemp("usual")), redirect_stdout(StringIO()) as printed:
        assert main(["charts"]) == 0
        return Path("charts").resolve(), printed.getvalue()


def test_charts_are_drawn_and_named(usual):
    """Into the folder `charts`, where no other is asked for."""
    folder, printed = usual
    assert printed.splitlines() == [str(Path("charts") / f"{name}.png") for name in CHARTS]
    assert sorted(path.stem for path in folder.iterdir()) == sorted(CHARTS)


@pytest.mark.long
def test_options_change_the_pictures(usual, tmp_path, capsys):
    report = ["--model", "kinney-graham", "--burst", "surface", "--scaled"]
    for folder, options in {"ratio": ["--unit", "ratio"], "report": report}.items():
        assert main(["charts", "--quiet", "--output", str(tmp_path / folder), *options]) == 0
    assert capsys.readouterr() == ("", "")
    for name in CHARTS:
        assert len({(folder / f"{name}.png").read_bytes() for folder in (usual[0], *tmp_path.iterdir())}) == 3


@pytest.mark.long
@pytest.mark.parametrize(
    "option, changed",
    [("--pulse-kg", {"pressure_over_time"}), ("--pier-kg", {name for name in CHARTS if name.startswith("two_span")})],
)
def test_a_charge_of_ones_own_changes_its_pictures_alone(usual, option, changed, tmp_path):
    assert main(["charts", "--quiet", "--output", str(tmp_path), option, "500"]) == 0
    differing = {path.stem for path in tmp_path.iterdir() if path.read_bytes() != (usual[0] / path.name).read_bytes()}
    assert differing == changed


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["--pulse-kg", "0"], "--pulse-kg: '0' is wrong: expected a number from"),
        (["--pier-kg", "much"], "--pier-kg: 'much' is wrong: expected a number from"),
        (["--unit", "psi"], "--unit: invalid choice: 'psi' (choose from"),
        (["--model", "conwep"], "--model: invalid choice: 'conwep'"),
        (["--burst", "water"], "--burst: invalid choice: 'water'"),
        (["--output"], "--output: expected one argument"),
        (["--output", "file"], "file: charts cannot be written: File exists"),
        (["pictures"], "unrecognized arguments: pictures"),
    ],
)
def test_wrong_input_is_refused(arguments, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("file").touch()
    assert main(["charts", *arguments]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("bda: error: ")
    assert len(printed.err.splitlines()) == 1
    assert words in printed.err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
