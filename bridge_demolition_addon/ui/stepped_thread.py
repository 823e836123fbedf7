"""Work of some seconds that needs no Blender, in steps: Blender and the work take turns, never both at once."""

from __future__ import annotations

import threading
from collections.abc import Callable
from time import monotonic
from typing import Any

from ..system.progress import Progress


class _StoppedError(BaseException):
    """Ends the work from within; no `except Exception` keeps it going."""


class SteppedThread(Progress):
    """Work in a thread of its own, which waits after each of its parts until `step` is called.

    Blender waits during a step, as if it did the work itself, but reads mouse and keyboard in between.

    Parameters
    ----------
    work
        Reports its stages and parts to this progress, and returns its result.
    shortest_s
        Parts that end within this time are one step, s: Blender may take longer to draw how far the work is than the
        work takes for a part.

    Attributes
    ----------
    stage_text, done, total
        The stage that was reported last, and how many of its parts are done.
    is_finished
        Whether the work has ended, also by an error.
    """

    def __init__(self, work: Callable[[SteppedThread], Any], shortest_s: float = 0.0):
        self.done, self.total, self.stage_text = 0, 0, ""
        self.is_finished = False
        self._work = work
        self._outcome: Any = None
        self._error: Exception | None = None
        self._is_stopped = False
        self._shortest_s, self._begun_s = shortest_s, 0.0
        self._its_turn, self._our_turn = threading.Semaphore(0), threading.Semaphore(0)
        self._thread = threading.Thread(target=self._run, daemon=True)

    def step(self) -> None:
        """Let it work until its next part is done."""
        if self.is_finished:
            return
        self._begun_s = monotonic()
        if not self._thread.is_alive():
            self._thread.start()
        else:
            self._its_turn.release()
        self._our_turn.acquire()

    def stop(self) -> None:
        """End the work where it is; a file that is written whole or not at all stays so."""
        self._is_stopped = True
        if self._thread.is_alive():
            self.step()
        self.is_finished = True

    def outcome(self) -> Any:
        """Return the result of the work; raise what it raised."""
        if self._error:
            raise self._error
        return self._outcome

    def stage(self, text: str) -> None:
        """Note which stage begins; called by the work."""
        self.stage_text, self.done, self.total = text, 0, 0
        self._hand_over()

    def part(self, done: int, total: int, text: str = "") -> None:
        """Note how many parts of a stage are done; called by the work."""
        self.done, self.total = done, total
        if self._is_stopped or monotonic() - self._begun_s >= self._shortest_s:
            self._hand_over()

    def wait(self) -> None:
        """Let Blender go on while the work waits for another process; called by the work."""
        self._hand_over()

    def _hand_over(self) -> None:
        self._our_turn.release()
        self._its_turn.acquire()
        if self._is_stopped:
            raise _StoppedError

    def _run(self) -> None:
        try:
            self._outcome = self._work(self)
        except _StoppedError:
            pass
        except Exception as error:
            self._error = error
        finally:
            self.is_finished = True
            self._our_turn.release()
