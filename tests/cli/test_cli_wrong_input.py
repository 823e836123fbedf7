# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrong input ends with status 2 and one line that names the file, the key and what was expected."""

import sys
from pathlib import Path

import pytest
from support.processes import run_bda
from support.scenarios import I235

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.scenario.file import scenario_text

RIGHT = scenario_text(I235)


def with_line(key, line):
    """The right scenario with another line for one key, such as ``bridge.deck.width_m``; an empty line removes it."""
    table, _, name = key.rpartition(".")
    lines = RIGHT.splitlines()
    start = lines.index(f"[{table}]")
    position = next(position for position in range(start, len(lines)) if lines[position].startswith(f"{name} = "))
    return "\n".join([*lines[:position], line, *lines[position + 1 :]])


def with_value(key, value):
    return with_line(key, f"{key.rpartition('.')[2]} = {value}")


def without(key):
    return with_line(key, "")


def without_table(table):
    start = RIGHT.index(f"[{table}]\n")
    return RIGHT[:start] + RIGHT[RIGHT.index("\n\n", start) :]


def with_more_in(table, line):
    return RIGHT.replace(f"[{table}]\n", f"[{table}]\n{line}\n")


# What is expected of a value is pinned where the table of the scenario is tested.
WRONG_FILES = {
    "no TOML": ("width = = 3", ["not a TOML file", "line 1, column 9"]),
    "key given twice": (
        with_more_in("scenario", "seed = 1"),
        ["line 4: seed = 235 gives a key of its table a second time: leave one of them out"],
    ),
    "table given twice": (RIGHT + "\n[ball]\n", ["[ball] is there a second time: put all of its keys under the first"]),
    "number of too many digits": (
        with_value("scenario.seed", "9" * 5000),
        ["has a number of 5000 digits: expected one of up to 300"],
    ),
    "too deep": (f"a = {'[' * 5000}{']' * 5000}", ["not a TOML file: it has brackets in brackets, hundreds deep"]),
    "not UTF-8": (RIGHT.replace("I-235", "Br\xfccke").encode("latin-1"), ["not a text in UTF-8, at byte"]),
    "UTF-16": (RIGHT.encode("utf-16"), ["a text in UTF-16: save it again as UTF-8 (in Notepad, Save As, Encoding)"]),
    "unknown table": (
        RIGHT.replace("[connections]", "[conections]"),
        ["conections is unknown", "did you mean connections?"],
    ),
    "unknown inner table": (
        RIGHT.replace("[bridge.deck]", "[bridge.decks]"),
        ["bridge.decks is unknown", "did you mean bridge.deck?"],
    ),
    "unknown key": (
        with_line("bridge.deck.width_m", "widht_m = 8.5"),
        ["bridge.deck.widht_m is unknown", "did you mean bridge.deck.width_m?"],
    ),
    "key without its unit": (
        with_line("ball.mass_kg", "mass = 10000"),
        ["ball.mass is unknown", "did you mean ball.mass_kg?"],
    ),
    "part of a key": (
        with_line("connections.search_radius_m", "radius_m = 1.0"),
        ["connections.radius_m is unknown", "did you mean connections.search_radius_m?"],
    ),
    "key of another table": (
        with_more_in("fracture", "density_kg_m3 = 2400"),
        ["fracture.density_kg_m3 is unknown", "did you mean bridge.density_kg_m3?"],
    ),
    "key outside of tables": ('title = "x"\n' + RIGHT, ["title is unknown", "did you mean scenario.title?"]),
    "key like no other": (
        with_more_in("fracture", "xyz = 1"),
        ["fracture.xyz is unknown", "expected one of shards"],
    ),
    "key of several lines": (
        with_more_in("fracture", r'"a\nb" = 1'),
        [r'fracture."a\nb" is unknown', "expected one of shards"],
    ),
    "missing key": (
        without("bridge.deck.width_m"),
        ["bridge.deck.width_m is missing"],
    ),
    "missing title": (without("scenario.title"), ["scenario.title is missing"]),
    "missing heading": (without_table("scenario"), ["scenario.title is missing"]),
    "missing table": (without_table("time"), ["time is missing"]),
    "missing inner table": (without_table("bridge.piers"), ["bridge.piers is missing"]),
    "number for a table": ("ball = 5\n" + without_table("ball"), ["ball is 5"]),
    "list for a table": (RIGHT.replace("[ball]", "[[ball]]"), ["ball is a list of length 1"]),
    "number for the heading": (
        "scenario = 5\n" + without_table("scenario"),
        ["scenario is 5"],
    ),
    "number for an inner table": (
        without_table("bridge.deck").replace("[bridge]\n", "[bridge]\ndeck = 5\n"),
        ["bridge.deck is 5"],
    ),
    "text for a number": (
        with_value("ball.mass_kg", '"10 t"'),
        ['ball.mass_kg is "10 t"'],
    ),
    "switch for a number": (with_value("ball.mass_kg", "true"), ["ball.mass_kg is true"]),
    "table for a number": (with_value("ball.mass_kg", "{}"), ["ball.mass_kg is a table"]),
    "date for a number": (
        with_value("ball.mass_kg", "2019-01-01"),
        ["ball.mass_kg is 2019-01-01"],
    ),
    "list for a number": (
        with_value("ball.mass_kg", "[1, 2]"),
        ["ball.mass_kg is a list of length 2"],
    ),
    "fraction for a whole number": (
        with_value("fracture.shards", "200.0"),
        ["fracture.shards is 200.0"],
    ),
    "switch for a whole number": (
        with_value("fracture.shards", "true"),
        ["fracture.shards is true"],
    ),
    "number for a switch": (
        with_value("connections.foundation", "1"),
        ["connections.foundation is 1"],
    ),
    "number for a text": (
        with_value("scenario.title", "235"),
        ["scenario.title is 235"],
    ),
    "number for a list": (
        with_value("bridge.span_lengths_m", "13.0"),
        ["bridge.span_lengths_m is 13.0"],
    ),
    "negative": (with_value("ball.mass_kg", "-5"), ["ball.mass_kg is -5"]),
    "zero": (with_value("time.duration_s", "0"), ["time.duration_s is 0"]),
    "not a number": (with_value("ball.mass_kg", "nan"), ["ball.mass_kg is nan"]),
    "infinite": (with_value("ball.mass_kg", "inf"), ["ball.mass_kg is inf"]),
    "too large to store": (
        with_value("ball.mass_kg", "1e300"),
        ["ball.mass_kg is 1e+300"],
    ),
    "hexadecimal of any length": (
        with_value("ball.mass_kg", "0x" + "f" * 5000),
        ["ball.mass_kg is a whole number of more than 64 bits"],
    ),
    "no spans": (
        with_value("bridge.span_lengths_m", "[]"),
        ["bridge.span_lengths_m is a list of length 0"],
    ),
    "negative span": (
        with_value("bridge.span_lengths_m", "[13.0, -13.0]"),
        ["bridge.span_lengths_m.2 is -13.0"],
    ),
    "target of three numbers": (
        with_value("ball.target_m", "[6.5, 0.0, 5.0]"),
        ["ball.target_m is a list of length 3"],
    ),
    "unknown choice": (
        with_value("connections.type", '"WELD"'),
        ['connections.type is "WELD"'],
    ),
    "stretched out of all proportion": (
        with_more_in("fracture", "stretch = [1.0, 1e-30, 1.0]"),
        ["fracture.stretch.2 is 1e-30", "expected a list of 3 numbers from 0.01 to 100"],
    ),
    "charge as heavy as the earth": (
        RIGHT + "\n[[charges]]\nplace_m = [0.0, 0.0, 1.0]\nmass_kg = 6e24\n",
        ["charges.mass_kg is 6e+24"],
    ),
    "bridge longer than single precision reaches": (
        with_value("bridge.span_lengths_m", "[7000.0, 6000.0]"),
        ["bridge.span_lengths_m add up to 13000", "expected at most 10000 (m)"],
    ),
    "blank title": (with_value("scenario.title", '" "'), ['scenario.title is " "']),
    "title of two lines": (
        with_value("scenario.title", r'"a\nb"'),
        [r'scenario.title is "a\nb"'],
    ),
    "density and mass": (
        with_more_in("bridge", "density_kg_m3 = 2400"),
        ["bridge.density_kg_m3 and bridge.mass_kg are given together"],
    ),
    "neither density nor mass": (
        without("bridge.mass_kg"),
        ["bridge has no density_kg_m3 or mass_kg: give one of them"],
    ),
    "two breaking forces": (
        with_more_in("connections", "breaking_force_n = 1"),
        ["connections.breaking_force_n and connections.breaking_force_kgf are given together"],
    ),
    "no breaking force": (
        without("connections.breaking_force_kgf"),
        ["connections has no breaking_force_n, breaking_force_kgf or material: give one of them"],
    ),
    "no search radius": (
        without("connections.search_radius_m"),
        ["connections.search_radius_m is missing"],
    ),
    "search radius for faces": (
        with_value("connections.method", '"face"'),
        ["connections.search_radius_m is 1.0"],
    ),
    "asleep without falling asleep": (
        with_value("shards.use_deactivation", "false"),
        ["shards.start_deactivated is true"],
    ),
    "pier cap as long as the span": (
        with_value("bridge.pier_caps.length_m", "13.0"),
        ["bridge.pier_caps.length_m is 13.0"],
    ),
    "column longer than the span": (
        with_value("bridge.piers.column_length_m", "14"),
        ["bridge.piers.column_length_m is 14.0"],
    ),
    "columns wider than the cap": (
        with_value("bridge.piers.columns", "13"),
        ["bridge.piers.column_width_m is 0.7", "bridge.pier_caps.width_m"],
    ),
    "columns wider than the deck": (
        without_table("bridge.pier_caps").replace("columns = 2", "columns = 13"),
        ["bridge.piers.column_width_m is 0.7", "bridge.deck.width_m"],
    ),
    "ball beside the deck": (
        with_value("ball.target_m", "[6.5, 4.3]"),
        ["ball.target_m.2 is 4.3"],
    ),
    "ball beyond the deck": (
        with_value("ball.target_m", "[13.6, 0.0]"),
        ["ball.target_m.1 is 13.6"],
    ),
    "ball let go too late": (
        with_value("ball.release_time_s", "5"),
        ["ball.release_time_s is 5.0"],
    ),
    "too many frames": (
        with_value("time.duration_s", "1e6"),
        ["time.duration_s is 1000000.0"],
    ),
    "NUL in a path": (
        RIGHT + '\n[[geometry]]\nname = "a"\nfile = "a\\u0000b.stl"\ndensity_kg_m3 = 2400\n',
        [r'"a\u0000b.stl" is no path of a file'],
    ),
    "NUL in the path of the base": (
        '[scenario]\nbased_on = "a\\u0000b.toml"\n',
        [r'"a\u0000b.toml" is no path of a file'],
    ),
    "base that is a device": ('[scenario]\nbased_on = "/dev/zero"\n', ["is a pipe or a device, not a file"]),
    "no frame": (with_value("time.duration_s", "1e-9"), ["time.duration_s is 1e-09"]),
}


def only_error_line(capsys):
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("bda: error: ")
    assert printed.err.endswith("\n")
    assert len(printed.err.splitlines()) == 1
    return printed.err


@pytest.mark.parametrize("content, words", WRONG_FILES.values(), ids=WRONG_FILES)
def test_wrong_files_are_refused(content, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("wrong.toml").write_bytes(content if isinstance(content, bytes) else content.encode())
    for command in (["check", "wrong.toml"], ["run", "wrong.toml", "--output", "results", "--overwrite"]):
        assert main(command) == 2
        line = only_error_line(capsys)
        assert line.startswith("bda: error: wrong.toml: ")
        for word in words:
            assert word in line
    assert [path.name for path in tmp_path.iterdir()] == ["wrong.toml"]


@pytest.mark.parametrize(
    "content, words",
    [
        (with_value("fracture.shards", "1"), "fracture.shards is 1: expected at least 7"),
        (
            with_more_in("fracture", 'points_file = "/dev/zero"'),
            'fracture.points_file is "/dev/zero": is a pipe or a device, not a file',
        ),
    ],
    ids=["too few shards", "points from a device"],
)
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such device")
def test_what_is_found_wrong_later_names_the_file_too(content, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("wrong.toml").write_text(content, encoding="utf-8")
    for command in (["check", "wrong.toml"], ["run", "wrong.toml", "--output", "results", "--quiet"]):
        assert main(command) == 2
        complained = capsys.readouterr().err
        assert complained.startswith("bda: error: wrong.toml: ") and words in complained
    assert not Path("results").exists()


@pytest.mark.parametrize(
    "name, words",
    [
        ("missing.toml", "missing.toml: no such file: expected a scenario in TOML"),
        ("folder", "folder: is a directory: expected a scenario in TOML"),
        ("file/scenario.toml", "file/scenario.toml: cannot be read: Not a directory"),
        ("x" * 5000, "cannot be read: File name too long"),
        ("two\nlines.toml", "two lines.toml: no such file"),
    ],
    ids=["missing", "folder", "in a file", "long name", "name of two lines"],
)
@pytest.mark.skipif(sys.platform == "win32", reason="Windows says it in other words")
def test_files_that_cannot_be_read_are_refused(name, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    Path("file").touch()
    for command in (["check", name], ["run", name, "--output", "results"]):
        assert main(command) == 2
        assert words in only_error_line(capsys)
    assert not Path("results").exists()


@pytest.mark.parametrize(
    "arguments, words",
    [
        ([], "COMMAND"),
        (["chek"], "'chek' is no command: did you mean check?"),
        (["check"], "SCENARIO.toml"),
        (["check", "a.toml", "b.toml"], "unrecognized arguments: b.toml"),
        (["check", "a.toml", "--output", "results"], "unrecognized arguments: --output results"),
        (["run", "a.toml", "--output"], "--output: expected one argument"),
        (["run", "a.toml", "--out", "results"], "unrecognized arguments: --out results: did you mean --output?"),
        (
            ["run", "a.toml", "--output", "results", "--no-picture"],
            "unrecognized arguments: --no-picture: did you mean --no-pictures?",
        ),
    ],
)
def test_wrong_command_lines_are_refused(arguments, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    line = only_error_line(capsys)
    assert words in line
    assert "--help" in line
    assert list(tmp_path.iterdir()) == []


def test_the_process_ends_with_the_status_too(tmp_path):
    status, printed, complained = run_bda("run", "missing.toml", "--output", tmp_path / "new")
    assert (status, printed) == (2, "")
    assert complained == "bda: error: missing.toml: no such file: expected a scenario in TOML\n"
    assert not (tmp_path / "new").exists()
