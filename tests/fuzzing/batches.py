# SPDX-License-Identifier: GPL-3.0-or-later
"""Sequences in processes of their own: what became of each, and the fewest of its steps that do the same."""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from support.checkout import ROOT, TESTS

from .players import BLENDER
from .sequences import REFUSED, Drawn

HANG_S = 900.0
"""A step that takes longer hangs, even if it does nothing meanwhile."""

BUSY_S = 60.0
"""A step that keeps the processors busy for longer hangs: a report takes some seconds, whatever else goes on."""

_BARE_TRIES = 10
"""What crashes one time in three survives three tries as often, and ten hardly ever."""

_LAST_WORDS = 3000
_PROGRAM = TESTS / "programs" / "fuzz_batch.py"


class Ending(StrEnum):
    """How a sequence can end."""

    WELL = "well"
    WRONG = "wrong"
    CRASH = "crash"
    HANG = "hang"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a sequence.

    Attributes
    ----------
    ending
        How it ended.
    done
        Its steps in words, up to that in which it went wrong.
    text
        What was printed of that.
    """

    ending: Ending
    done: tuple[str, ...]
    text: str = ""

    @property
    def refused(self) -> tuple[int, ...]:
        """Which of its steps were refused."""
        return tuple(position for position, words in enumerate(self.done) if f": {REFUSED}: " in words)


def outcomes(player: str, sequences: Sequence[Drawn], *, bare: bool = False) -> Iterator[Outcome]:
    """Play sequences, in one process as long as it lives, and give what became of each.

    With `bare`, what the project adds to Blender is left out.
    """
    waiting = list(sequences)
    while waiting:
        with (
            tempfile.TemporaryDirectory(prefix="fuzz-", ignore_cleanup_errors=True) as folder,
            _process(player, folder, bare) as (process, news),
        ):
            while waiting:
                outcome = _outcome(process, news, waiting.pop(0), Path(folder) / "printed.log")
                yield outcome
                if outcome.ending in (Ending.CRASH, Ending.HANG):
                    break


def alone(player: str, drawn: Drawn, *, before: Sequence[Drawn] = (), bare: bool = False, tries: int = 2) -> Outcome:
    """Play a sequence in a process of its own, and again in another where it ends well: memory is not always alike.

    With `before`, other sequences are played first in each process; where one of them crashes, that is the outcome.
    """
    for _ in range(tries):
        found = list(outcomes(player, [*before, drawn], bare=bare))
        outcome = next((outcome for outcome in found if outcome.ending in (Ending.CRASH, Ending.HANG)), found[-1])
        if outcome.ending != Ending.WELL:
            break
    return outcome


def is_ours(player: str, drawn: Drawn, outcome: Outcome, *, before: Sequence[Drawn] = ()) -> bool:
    """Return whether an outcome is the project's doing: bare Blender crashes over some sequences, too."""
    if player == BLENDER and outcome.ending in (Ending.CRASH, Ending.HANG):
        part = drawn._replace(most=len(outcome.done), refused=outcome.refused)
        return alone(player, part, before=before, bare=True, tries=_BARE_TRIES).ending == Ending.WELL
    return outcome.ending != Ending.WELL


def fewest(rows: Sequence[int], fails: Callable[[Sequence[int]], bool]) -> list[int]:
    """Return fewer rows that still fail, of which none can be left out.

    References
    ----------
    A. Zeller and R. Hildebrandt (2002), Simplifying and isolating failure-inducing input: ddmin.
    """
    rows, parts = list(rows), 2
    while len(rows) > 1:
        size = max(len(rows) // parts, 1)
        without = [rows[:first] + rows[first + size :] for first in range(0, len(rows), size)]
        found = next((shorter for shorter in without if fails(shorter)), None)
        if found is not None:
            rows, parts = found, max(parts - 1, 2)
        elif size == 1:
            break
        else:
            parts = min(2 * parts, len(rows))
    return rows


def minimised(
    player: str, drawn: Drawn, outcome: Outcome, *, before: Sequence[Drawn] = (), bare: bool = False
) -> Drawn:
    """Return the fewest steps that go wrong as the whole sequence did."""

    def fails(rows: Sequence[int]) -> bool:
        part = drawn._replace(rows=tuple(rows))
        found = alone(player, part, before=before, bare=bare)
        return _same(found, outcome) and (bare or is_ours(player, part, found, before=before))

    return drawn._replace(rows=tuple(fewest(range(len(outcome.done)), fails)))


def fewest_before(
    player: str, before: Sequence[Drawn], drawn: Drawn, outcome: Outcome, *, bare: bool = False
) -> list[Drawn]:
    """Return the fewest of the sequences played before one in its process, without which it does not go wrong."""

    def fails(rows: Sequence[int]) -> bool:
        return _same(alone(player, drawn, before=[before[row] for row in rows], bare=bare), outcome)

    return [before[row] for row in fewest(range(len(before)), fails)]


def _same(found: Outcome, outcome: Outcome) -> bool:
    if found.ending != outcome.ending:
        return False
    return outcome.ending != Ending.WRONG or _last_line(found.text) == _last_line(outcome.text)


def _last_line(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1].split(":")[0] if lines else ""


@contextmanager
def _process(player: str, folder: str, bare: bool) -> Iterator[tuple[subprocess.Popen[str], queue.Queue[str]]]:
    """Start a process that plays; its news come through a queue, an empty one where it has ended."""
    command = [sys.executable, str(_PROGRAM), player, folder, str(BUSY_S), *(["--bare"] if bare else [])]
    environment = {
        "PYTHONPATH": os.pathsep.join(map(str, (TESTS, ROOT))),
        "BLENDER_USER_RESOURCES": str(Path(folder) / "user"),
        "OPENBLAS_NUM_THREADS": "1",
        "MALLOC_PERTURB_": "165",  # glibc overwrites what is freed: who uses it then crashes at once, not at times
    }
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=os.environ | environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    )
    news: queue.Queue[str] = queue.Queue()
    reader = threading.Thread(target=_pass_on, args=(process, news), daemon=True)
    reader.start()
    try:
        yield process, news
    finally:
        process.stdin.close()
        process.kill()
        process.wait()
        reader.join()
        process.stdout.close()


def _pass_on(process: subprocess.Popen[str], news: queue.Queue[str]) -> None:
    for line in process.stdout:
        news.put(line)
    news.put("")


def _outcome(process: subprocess.Popen[str], news: queue.Queue[str], drawn: Drawn, printed: Path) -> Outcome:
    done: list[str] = []
    wrong = None
    try:
        process.stdin.write(json.dumps(drawn) + "\n")
        process.stdin.flush()
        while line := news.get(timeout=HANG_S):
            told = json.loads(line)
            if "begins" in told:
                done.append(told["begins"])
            elif "ends" in told:
                done[-1] = f"{told['ends']}: {told['words']}".strip(": ")
                if told["wrong"] and wrong is None:
                    wrong = Outcome(Ending.WRONG, tuple(done), told["wrong"])
            else:
                return wrong or Outcome(Ending.WELL, tuple(done))
    except BrokenPipeError:  # it died as it waited
        pass
    except queue.Empty:
        return Outcome(Ending.HANG, tuple(done), _last_words(printed))
    process.wait(HANG_S)
    if process.returncode > 0 and not done:
        raise RuntimeError(f"the process that plays ended with status {process.returncode} before it did a step")
    ending = Ending.HANG if process.returncode == -signal.SIGPROF else Ending.CRASH
    return Outcome(ending, tuple(done), f"status {process.returncode}\n{_last_words(printed)}")


def _last_words(printed: Path) -> str:
    return printed.read_bytes().decode("utf-8", "replace")[-_LAST_WORDS:] if printed.exists() else ""
