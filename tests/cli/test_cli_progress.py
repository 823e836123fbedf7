# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress is a bar on a terminal, lines elsewhere, and nothing when quiet."""

import os
import re
import select
import struct
import sys
import time
from io import StringIO

import pytest

from bridge_demolition_addon.cli.progress import PlainLines, Silence, StepsOfLongWork, TerminalBar, progress_on
from bridge_demolition_addon.model.results.collapse import ConnectionCounts

if sys.platform != "win32":
    import fcntl
    import termios

needs_terminal = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals to open")


NOTHING = ConnectionCounts(60, 0, 0, 0, 0)


def play(progress, frames):
    progress.stage("simulating")
    for done in range(1, frames + 1):
        progress.frame(done, frames, ConnectionCounts(60, done // 2, 0, 0, done // 2), left_s=65.0 * (frames - done))
    progress.stage("rendering")
    progress.finish()


def test_plain_lines_come_with_each_tenth():
    stream = StringIO()
    play(PlainLines(stream), 120)
    lines = stream.getvalue().splitlines()
    assert lines[0] == "simulating"
    assert lines[1] == "frame  12 of 120, torn: 6 of 60 connections, about 117:00 left"
    assert lines[-2:] == ["frame 120 of 120, torn: 60 of 60 connections", "rendering"]
    assert len(lines) == 12


def test_few_frames_have_a_line_each():
    stream = StringIO()
    play(PlainLines(stream), 3)
    assert stream.getvalue().splitlines()[1:4] == [
        "frame 1 of 3, torn: 0 of 60 connections, about 2:10 left",
        "frame 2 of 3, torn: 1 of 60 connections, about 1:05 left",
        "frame 3 of 3, torn: 1 of 60 connections",
    ]


def test_parts_of_long_work_say_how_far_it_is_and_how_long_it_takes():
    """100 parts of 1 s each: lines after 2 s, from 20 s on ever more seldom."""
    now, stream = [0.0], StringIO()
    progress = PlainLines(stream, lambda: now[0])
    progress.stage("writing")
    for done in range(1, 101):
        now[0] = float(done)
        progress.part(done, 100, "pages written")
    lines = stream.getvalue().splitlines()
    assert lines[1] == "  2 of 100 pages written, about 1:38 left"
    assert lines[-1] == "100 of 100 pages written"
    assert 15 < len(lines) < 30


def test_parts_of_short_work_have_one_line():
    stream = StringIO()
    progress = PlainLines(stream, lambda: 0.0)
    for done in range(1, 101):
        progress.part(done, 100, "pages written")
    assert stream.getvalue() == "100 of 100 pages written\n"


def test_steps_are_said_once_work_is_long():
    stream = StringIO()
    with StepsOfLongWork(stream, 3, long_s=0.05) as progress:
        progress.stage("cuts")
        assert stream.getvalue() == ""
        while not stream.getvalue():
            time.sleep(0.01)
        progress.stage("stands")
    with StepsOfLongWork(stream, 3, long_s=60.0) as progress:
        progress.stage("is short")
    assert stream.getvalue() == "bda: step 1 of 3: cuts\nbda: step 2 of 3: stands\n"


@pytest.fixture
def terminal():
    """Open a terminal of a given width; gives the stream to write to, and a function that reads what it shows."""
    opened = []

    def open_terminal(columns):
        ours, theirs = os.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", 25, columns, 0, 0))
        stream = os.fdopen(theirs, "w")
        reading = os.fdopen(ours, "rb", buffering=0)
        opened.append(reading)

        def shown():
            stream.flush()
            text = b""
            while select.select([reading], [], [], 0.2)[0]:
                text += reading.read(10_000)
            stream.close()
            return text.decode().replace("\r\n", "\n")

        return stream, shown

    yield open_terminal
    for file in opened:
        file.close()


@needs_terminal
def test_the_bar_grows_in_place_and_leaves_its_line(terminal):
    stream, shown = terminal(80)
    play(TerminalBar(stream), 4)
    first, bars, last = shown().split("\n")[:3]
    drawn = bars.split("\r")[1:]
    assert (first, last) == ("simulating", "rendering")
    assert re.match(r"\[#+\.+\] frame 1 of 4, torn: 0 of 60 connections, 3:15 left$", drawn[0])
    assert re.match(r"\[#+\] frame 4 of 4, torn: 2 of 60 connections *$", drawn[-1])


@needs_terminal
@pytest.mark.parametrize("columns", [10, 38, 45, 60])
def test_the_bar_fits_a_narrow_terminal(columns, terminal):
    stream, shown = terminal(columns)
    progress = TerminalBar(stream)
    progress.frame(1, 4, NOTHING, None)
    progress.frame(4, 4, NOTHING, 0.0)
    progress.finish()
    assert max(len(drawn) for drawn in shown().strip("\n").split("\r")) <= columns


@needs_terminal
def test_the_bar_tells_how_long_it_still_takes(terminal, monkeypatch):
    clock = iter(range(100))
    monkeypatch.setattr("tqdm.std.time", lambda: float(next(clock)))
    stream, shown = terminal(100)
    progress = TerminalBar(stream)
    for done in range(1, 4):
        progress.frame(done, 10, NOTHING, None)
    progress.finish()
    assert re.search(r"\d\d:\d\d left", shown())


def test_silence_prints_nothing(capsys):
    play(Silence(), 10)
    assert capsys.readouterr() == ("", "")


@needs_terminal
def test_the_stream_decides():
    assert isinstance(progress_on(StringIO(), quiet=False), PlainLines)
    assert isinstance(progress_on(StringIO(), quiet=True), Silence)
    ours, theirs = os.openpty()
    with os.fdopen(ours, "rb"), os.fdopen(theirs, "w") as terminal:
        assert isinstance(progress_on(terminal, quiet=False), TerminalBar)
        assert isinstance(progress_on(terminal, quiet=True), Silence)
