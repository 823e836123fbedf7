"""The last recording made since Blender started, for the panel of its results and the charts of them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...core.results.arrays import Results


@dataclass(frozen=True, slots=True, eq=False)
class LastRecording:
    """What was recorded, and where it was written to.

    Attributes
    ----------
    folder
        Folder with its logs and results.
    results
        Everything, frame by frame.
    summary
        The few numbers that are asked for first.
    """

    folder: Path
    results: Results
    summary: dict[str, Any]


_last: LastRecording | None = None


def keep(folder: Path, results: Results, summary: dict[str, Any]) -> None:
    """Keep a recording in place of the one before."""
    global _last
    _last = LastRecording(folder, results, summary)


def last() -> LastRecording | None:
    """The last recording, None before there was one."""
    return _last


def forget() -> None:
    """Keep none."""
    global _last
    _last = None
