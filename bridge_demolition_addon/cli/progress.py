"""Progress of a command: a bar on a terminal, plain lines elsewhere, or nothing."""

import threading
import time
from collections.abc import Callable
from typing import Self, TextIO

from tqdm import tqdm

from ..engineering.timing.time_left import clock
from ..system.progress import Counts, Progress


class CommandProgress(Progress):
    """Stages and counts of a command, each shown as the kind of progress does."""

    def frame(self, done: int, total: int, connections: Counts, left_s: float | None) -> None:
        self._show(done, total, f"frame {_counted(done, total)}, {connections.text}", left_s)

    def part(self, done: int, total: int, text: str) -> None:
        self._show(done, total, f"{_counted(done, total)} {text}")

    def runs(self, done: int, total: int, lost: int) -> None:
        """Give how many runs have ended, and how many of them did not finish."""
        self._show(done, total, f"run {_counted(done, total)}" + (f", {lost} not done" if lost else ""))

    def _show(self, done: int, total: int, text: str, left_s: float | None = None) -> None:
        """Show a count."""


class Silence(CommandProgress):
    """Nothing is shown."""


class TerminalBar(CommandProgress):
    """Stages as lines, and counts as a bar with the time left."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._bar: _Bar | None = None

    def stage(self, text: str) -> None:
        self.finish()
        print(text, file=self._stream, flush=True)

    def finish(self) -> None:
        if self._bar is not None:
            self._bar.close()
        self._bar = None

    def _show(self, done: int, total: int, text: str, left_s: float | None = None) -> None:
        left = "{remaining}" if left_s is None else clock(left_s)
        layout = "[{bar}] {desc}" + (f", {left} left" if done < total else "")
        if self._bar is None:
            look = {"bar_format": layout, "ascii": ".#", "dynamic_ncols": True}
            self._bar = _Bar(total=total, initial=done, desc=text, file=self._stream, **look)
        self._bar.bar_format = layout
        self._bar.set_description_str(text, refresh=False)
        self._bar.update(done - self._bar.n)


class _Bar(tqdm):
    """A bar without the thread that tqdm starts to redraw it: Blender ends badly with threads of its Python."""

    monitor_interval = 0


class PlainLines(CommandProgress):
    """Stages as lines, and a line after each tenth of the frames or runs, at the end of parts, and where one is due.

    One is due 2 s after the last one; after 20 s they come less and less often, so that a night's log can be read.
    """

    _EACH_S, _EACH_SHARE = 2.0, 0.1

    def __init__(self, stream: TextIO, clock_s: Callable[[], float] = time.monotonic) -> None:
        self._stream, self._clock_s = stream, clock_s
        self._tenths = 0
        self._began_s = self._last_s = clock_s()
        self._first: tuple[int, float] | None = None  # part of a stage, and when it was done: it may load libraries

    def stage(self, text: str) -> None:
        self._first = None
        self._print(text)

    def frame(self, done: int, total: int, connections: Counts, left_s: float | None) -> None:
        if self._begins_a_tenth(done, total) or self._is_due:
            super().frame(done, total, connections, left_s)

    def runs(self, done: int, total: int, lost: int) -> None:
        if self._begins_a_tenth(done, total) or self._is_due:
            super().runs(done, total, lost)

    def part(self, done: int, total: int, text: str) -> None:
        first, first_s = self._first = self._first or (done, self._clock_s())
        if done == total:
            super().part(done, total, text)
        elif self._is_due:
            left_s = None if done == first else (self._clock_s() - first_s) / (done - first) * (total - done)
            self._show(done, total, f"{_counted(done, total)} {text}", left_s)

    def _begins_a_tenth(self, done: int, total: int) -> bool:
        tenths, before = 10 * done // total, self._tenths
        self._tenths = tenths
        return tenths > before

    @property
    def _is_due(self) -> bool:
        now_s = self._clock_s()
        return now_s - self._last_s >= max(self._EACH_S, self._EACH_SHARE * (now_s - self._began_s))

    def _show(self, done: int, total: int, text: str, left_s: float | None = None) -> None:
        self._print(text if left_s is None or done == total else f"{text}, about {clock(left_s)} left")

    def _print(self, text: str) -> None:
        self._last_s = self._clock_s()
        print(text, file=self._stream, flush=True)


class StepsOfLongWork(Progress):
    """Steps of work that is short as a rule: the one that is done 2 s after it began, and those after it, as lines."""

    def __init__(self, stream: TextIO, steps: int, long_s: float = 2.0) -> None:
        self._stream, self._steps = stream, steps
        self._done, self._text = 0, ""
        self._is_long = False
        self._timer = threading.Timer(long_s, self._begin)
        self._timer.daemon = True
        self._timer.start()

    def stage(self, text: str) -> None:
        self._done, self._text = self._done + 1, text
        if self._is_long:
            self._print()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.finish()

    def finish(self) -> None:
        self._timer.cancel()

    def _begin(self) -> None:
        self._is_long = True
        if self._text:
            self._print()

    def _print(self) -> None:
        print(f"bda: step {self._done} of {self._steps}: {self._text}", file=self._stream, flush=True)


def progress_on(stream: TextIO, *, quiet: bool) -> CommandProgress:
    """Return the kind of progress that suits a stream."""
    if quiet:
        return Silence()
    return TerminalBar(stream) if stream.isatty() else PlainLines(stream)


def _counted(done: int, total: int) -> str:
    return f"{done:{len(str(total))}} of {total}"
