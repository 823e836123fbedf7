"""What runs the draws of a study: here or elsewhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from .draw_process import End


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """A draw to be run.

    Attributes
    ----------
    address : str
        Digest of all that its result depends on.
    request : dict
        What its program is asked, ready for JSON.
    folder : Path
        Where its files are to be once it has ended.
    """

    address: str
    request: Mapping[str, Any]
    folder: Path


class Engine(Protocol):
    """Runs draws beside whoever asks for them.

    Attributes
    ----------
    versions : dict
        What draws are run with.
    """

    versions: Mapping[str, str]

    @property
    def capacity(self) -> int:
        """How many draws to have submitted at a time, so that it never waits for the next."""

    def submit(self, task: Task) -> None:
        """Have a draw run as soon as there is a place for it."""

    def collect(self, timeout_s: float) -> Sequence[tuple[Task, End]]:
        """Return draws that have ended since this was asked last, waiting for the first as long as is given.

        Raises
        ------
        DemolitionError, OSError
            Draws cannot be run at all, or their files not be written.
        """

    def close(self) -> None:
        """Stop at once; what is at work is lost. Once more is nothing."""
