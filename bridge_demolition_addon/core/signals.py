"""Signals that ask the program to end: Ctrl-C, and SIGTERM, which systems send before they kill."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn


class Interrupted(KeyboardInterrupt):
    """The program was asked to end.

    Attributes
    ----------
    signal_number
        Signal that asked.
    """

    def __init__(self, signal_number: int):
        super().__init__()
        self.signal_number = signal_number


def interrupt(signal_number: int, _frame: FrameType | None) -> NoReturn:
    """Raise what a signal asks for; to be set as its handler."""
    raise Interrupted(signal_number)


@contextmanager
def interrupted_afterwards() -> Iterator[None]:
    """Let such signals wait until the end of the block: Blender's own scripts would print them as errors and go on."""
    with signals_noted() as signals:
        yield
    if signals:
        raise Interrupted(signals[0])


@contextmanager
def signals_noted() -> Iterator[Sequence[int]]:
    """Give a list that grows by every such signal; none of them cuts what is done in the block, or a file, in two."""
    numbers: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield numbers
        return
    noted = (signal.SIGINT, signal.SIGTERM)
    before = {each: signal.signal(each, lambda number, _: numbers.append(number)) for each in noted}
    try:
        yield numbers
    finally:
        for each, handler in before.items():
            signal.signal(each, handler or signal.SIG_DFL)  # none that Python knows of, inside Blender
