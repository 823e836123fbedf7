"""Signals that ask the program to end: Ctrl-C, a system's before it kills, and a closing terminal's."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

_BY_SYSTEM = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
"""Windows has no SIGHUP."""


class Interrupted(KeyboardInterrupt):
    """The program was asked to end, by a signal."""

    def __init__(self, signal_number: int):
        super().__init__()
        self.signal_number = signal_number


def interrupt_by_system() -> None:
    """Have the system's signals raise `Interrupted` from now on, but ignored ones, as `nohup` asks."""
    for number in _heeded(_BY_SYSTEM):
        signal.signal(number, _interrupt)


def ignore_from_now_on() -> None:
    """Have no such signal end a process that is ending: all that is left to say is its status."""
    for number in (signal.SIGINT, *_BY_SYSTEM):
        signal.signal(number, signal.SIG_IGN)


def _interrupt(signal_number: int, _frame: FrameType | None) -> NoReturn:
    raise Interrupted(signal_number)


def _heeded(signals: Sequence[int]) -> list[int]:
    return [number for number in signals if signal.getsignal(number) is not signal.SIG_IGN]


@contextmanager
def interrupted_afterwards() -> Iterator[None]:
    """Let such signals wait until the end of the block: Blender's own scripts would print them as errors and go on."""
    with signals_noted() as signals:
        yield
    if signals:
        raise Interrupted(signals[0])


@contextmanager
def signals_noted() -> Iterator[Sequence[int]]:
    """Give a list that grows by every such signal; none of them interrupts the block, or cuts a file in two."""
    numbers: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield numbers
        return
    noted = _heeded([signal.SIGINT, *_BY_SYSTEM])
    before = {number: signal.signal(number, lambda received, _: numbers.append(received)) for number in noted}
    try:
        yield numbers
    finally:
        for number, handler in before.items():
            signal.signal(number, handler or signal.SIG_DFL)  # Blender's own handlers are None here
