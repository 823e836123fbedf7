"""Progress of a command: a bar on a terminal, plain lines elsewhere, or nothing."""

from typing import TextIO

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
    """Stages as lines, and a line after each tenth of the frames or runs and at the end of parts."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._tenths = 0

    def stage(self, text: str) -> None:
        print(text, file=self._stream, flush=True)

    def frame(self, done: int, total: int, connections: Counts, left_s: float | None) -> None:
        if self._begins_a_tenth(done, total):
            super().frame(done, total, connections, left_s)

    def runs(self, done: int, total: int, lost: int) -> None:
        if self._begins_a_tenth(done, total):
            super().runs(done, total, lost)

    def _begins_a_tenth(self, done: int, total: int) -> bool:
        tenths, before = 10 * done // total, self._tenths
        self._tenths = tenths
        return tenths > before

    def part(self, done: int, total: int, text: str) -> None:
        if done == total:
            super().part(done, total, text)

    def _show(self, done: int, total: int, text: str, left_s: float | None = None) -> None:
        print(text, file=self._stream, flush=True)


def progress_on(stream: TextIO, *, quiet: bool) -> CommandProgress:
    """Return the kind of progress that suits a stream."""
    if quiet:
        return Silence()
    return TerminalBar(stream) if stream.isatty() else PlainLines(stream)


def _counted(done: int, total: int) -> str:
    return f"{done:{len(str(total))}} of {total}"
