"""How a run says how far it is: a bar on a terminal, plain lines elsewhere, or nothing."""

import shutil
from typing import TextIO

LONGEST_BAR = 40


class TerminalBar:
    """Stages as lines, and frames as a bar that is drawn over itself."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._bar_is_open = False

    def stage(self, text: str) -> None:
        """Say what is done now."""
        self.finish()
        print(text, file=self._stream, flush=True)

    def frame(self, done: int, total: int, broken: int) -> None:
        """Say how many frames are done and how many connections broken."""
        self._draw(done, total, _counts(done, total, broken))

    def part(self, done: int, total: int, text: str) -> None:
        """Say how many parts of a stage are done."""
        self._draw(done, total, _parts(done, total, text))

    def _draw(self, done: int, total: int, counts: str) -> None:
        length = max(0, min(LONGEST_BAR, shutil.get_terminal_size().columns - len(counts) - 4))
        filled = length * done // total
        bar = f"[{'#' * filled}{'.' * (length - filled)}] " if length else ""
        print(f"\r{bar}{counts}", end="", file=self._stream, flush=True)
        self._bar_is_open = True

    def finish(self) -> None:
        """Leave the bar as it is and go on below it."""
        if self._bar_is_open:
            print(file=self._stream, flush=True)
        self._bar_is_open = False


class PlainLines:
    """Stages as lines, and a line after each tenth of the frames."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._tenths = 0

    def stage(self, text: str) -> None:
        """Say what is done now."""
        print(text, file=self._stream, flush=True)

    def frame(self, done: int, total: int, broken: int) -> None:
        """Say how many frames are done and how many connections broken, after each tenth of the frames."""
        tenths = 10 * done // total
        if tenths > self._tenths:
            print(_counts(done, total, broken), file=self._stream, flush=True)
        self._tenths = tenths

    def part(self, done: int, total: int, text: str) -> None:
        """Say that all parts of a stage are done."""
        if done == total:
            print(_parts(done, total, text), file=self._stream, flush=True)

    def finish(self) -> None:
        """Nothing is left open."""


class Silence:
    """No progress at all."""

    def stage(self, text: str) -> None:
        """Say nothing."""

    def frame(self, done: int, total: int, broken: int) -> None:
        """Say nothing."""

    def part(self, done: int, total: int, text: str) -> None:
        """Say nothing."""

    def finish(self) -> None:
        """Nothing is left open."""


Progress = TerminalBar | PlainLines | Silence


def progress_on(stream: TextIO, *, quiet: bool) -> Progress:
    """The kind of progress that suits a stream."""
    if quiet:
        return Silence()
    return TerminalBar(stream) if stream.isatty() else PlainLines(stream)


def _parts(done: int, total: int, text: str) -> str:
    return f"{done:{len(str(total))}} of {total} {text}"


def _counts(done: int, total: int, broken: int) -> str:
    connections = "connection" if broken == 1 else "connections"
    return f"frame {done:{len(str(total))}} of {total}, {broken} {connections} broken"
