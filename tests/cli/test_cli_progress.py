"""Progress is a bar on a terminal, lines elsewhere, and nothing when quiet."""

import os
import sys
from io import StringIO

import pytest

from bridge_demolition_addon.cli.progress import PlainLines, Silence, TerminalBar, progress_on


def play(progress, frames):
    progress.stage("simulating")
    for done in range(1, frames + 1):
        progress.frame(done, frames, broken=done // 2)
    progress.stage("rendering")
    progress.finish()


def test_plain_lines_come_with_each_tenth():
    stream = StringIO()
    play(PlainLines(stream), 120)
    lines = stream.getvalue().splitlines()
    assert lines[0] == "simulating"
    assert lines[1] == "frame  12 of 120, 6 connections broken"
    assert lines[-2:] == ["frame 120 of 120, 60 connections broken", "rendering"]
    assert len(lines) == 12


def test_few_frames_have_a_line_each():
    stream = StringIO()
    play(PlainLines(stream), 3)
    assert stream.getvalue().splitlines()[1:4] == [
        "frame 1 of 3, 0 connections broken",
        "frame 2 of 3, 1 connection broken",
        "frame 3 of 3, 1 connection broken",
    ]


def test_the_bar_grows_in_place_and_leaves_its_line(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    stream = StringIO()
    play(TerminalBar(stream), 4)
    first, bars, last = stream.getvalue().split("\n")[:3]
    drawn = bars.split("\r")[1:]
    assert (first, last) == ("simulating", "rendering")
    assert drawn[0] == f"[{'#' * 10}{'.' * 30}] frame 1 of 4, 0 connections broken"
    assert drawn[-1] == f"[{'#' * 40}] frame 4 of 4, 2 connections broken"
    assert len(drawn) == 4


@pytest.mark.parametrize("columns", [10, 38, 45, 60])
def test_the_bar_fits_a_narrow_terminal(columns, monkeypatch):
    monkeypatch.setenv("COLUMNS", str(columns))
    stream = StringIO()
    TerminalBar(stream).frame(1, 4, 0)
    counts = "frame 1 of 4, 0 connections broken"
    assert stream.getvalue().endswith(counts)
    assert len(stream.getvalue().strip("\r")) <= max(columns, len(counts))


def test_silence_prints_nothing(capsys):
    play(Silence(), 10)
    assert capsys.readouterr() == ("", "")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals to open")
def test_the_stream_decides():
    assert isinstance(progress_on(StringIO(), quiet=False), PlainLines)
    assert isinstance(progress_on(StringIO(), quiet=True), Silence)
    ours, theirs = os.openpty()
    with os.fdopen(ours, "rb"), os.fdopen(theirs, "w") as terminal:
        assert isinstance(progress_on(terminal, quiet=False), TerminalBar)
        assert isinstance(progress_on(terminal, quiet=True), Silence)
