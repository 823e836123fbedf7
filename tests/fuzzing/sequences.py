# SPDX-License-Identifier: GPL-3.0-or-later
"""Sequences of random steps: drawn from a seed, done one after the other, and told what went wrong.

A step is the name of a method and a seed for what it chooses. So some steps of a sequence can be done without the
others, and do what they do with what the steps before have left.
"""

from __future__ import annotations

import io
import json
import os
import signal
import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from random import Random
from typing import NamedTuple

from support.checkout import ROOT

PACKAGE = str(ROOT / "bridge_demolition_addon")
SIGNS = ("Traceback (most recent call last)", "Exception ignored")
"""What Python writes where nobody deals with an exception."""
REFUSED = "refused"
"""In the words of a step that was not done."""


class Drawn(NamedTuple):
    """A sequence, or some of its steps.

    Attributes
    ----------
    seed
        What it is drawn from.
    length
        How many steps are drawn, besides the first and last ones that every sequence has.
    rows
        Which of all steps are done; None for all.
    most
        After how many of them only the last steps that every sequence has are done; None for all.
    refused
        Which of these, counted from the first, the project refused: the player's `idle` step is done in their place.
    """

    seed: int
    length: int
    rows: tuple[int, ...] | None = None
    most: int | None = None
    refused: tuple[int, ...] = ()

    def steps(self, player: type[Player]) -> list[tuple[str, int]]:
        """Return names of the player's methods, each with the seed of what it chooses."""
        random = Random(self.seed)
        names = random.choices(list(player.weights), list(player.weights.values()), k=self.length)
        steps = [(name, random.getrandbits(32)) for name in (*player.first, *names, *player.last)]
        rows = list(range(len(steps)) if self.rows is None else self.rows)
        if self.most is not None:
            rows = rows[: self.most] + [row for row in rows[self.most :] if row >= len(steps) - len(player.last)]
        done = [steps[row] for row in rows]
        return [(player.idle if position in self.refused else name, seed) for position, (name, seed) in enumerate(done)]


class WrongError(Exception):
    """What a step did must not be."""


class Player:
    """Base of those whose methods are steps.

    Each method takes a source of random choices, and returns in words what it chose. An exception that comes out of it
    is a finding where the project's own code is on its way; others are the player's own mistakes.

    Attributes
    ----------
    weights
        How often each step is taken, by its name.
    first, last
        Steps that all sequences begin and end with.
    idle
        Step that is done where another was refused.
    """

    weights: dict[str, int]
    first: tuple[str, ...] = ()
    last: tuple[str, ...] = ()
    idle: str = ""

    def __init__(self, folder: Path, *, bare: bool = False):
        self.folder, self.bare = folder, bare

    def end(self) -> None:
        """Leave everything as the next one wants to find it."""


def play(player: Player, steps: Sequence[tuple[str, int]], tell: Telling, *, busy_s: float) -> None:
    """Do steps, and tell of each before it begins and after it, and what went wrong in it.

    SIGPROF ends the process in a step that keeps the processors busy for longer than `busy_s`.
    """
    for name, seed in steps:
        tell({"begins": name})
        signal.setitimer(signal.ITIMER_PROF, busy_s)
        heard = tell.heard_so_far()
        words = wrong = ""
        try:
            words = getattr(player, name)(Random(seed)) or ""
        except WrongError as error:
            wrong = str(error)
        except Exception as error:
            text = traceback.format_exc()
            words, wrong = f"{type(error).__name__}: {error}", text if PACKAGE in text else ""
        complaint = tell.heard_since(heard)
        if any(sign in complaint for sign in SIGNS) and PACKAGE in complaint:
            wrong = wrong or complaint
        tell({"ends": name, "words": words, "wrong": wrong})
    signal.setitimer(signal.ITIMER_PROF, 0.0)


class Telling:
    """Tells a program, through a pipe, what is done; standard output and error go to a file, and are listened to."""

    def __init__(self, pipe: io.TextIOBase, log: Path):
        self._pipe, self._log = pipe, log

    def __call__(self, news: dict) -> None:
        self._pipe.write(json.dumps(news) + "\n")
        self._pipe.flush()

    def heard_so_far(self) -> int:
        sys.stderr.flush()
        return self._log.stat().st_size

    def heard_since(self, size: int) -> str:
        sys.stderr.flush()
        with self._log.open("rb") as file:
            file.seek(size)
            return file.read().decode("utf-8", "replace")


@contextmanager
def telling(log: Path) -> Iterator[Telling]:
    """Keep what is printed, also past Python, in a file, and tell news where standard output went before."""
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as pipe, log.open("wb") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
        yield Telling(pipe, log)
