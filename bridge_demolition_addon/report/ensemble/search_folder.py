"""Read the folder of a search, as `bda search` leaves it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engineering.search.probit import Trials
from ...errors import OutputError, ScenarioError, UnreadableError
from ...model.search.conclusions import Answer, answer_of
from ...model.search.file import Search, read_search
from ...model.search.files import ANSWER_FILE, SEARCH_FILE, TRIALS_FILE
from ...model.study.outcome import SUCCESS
from ...model.study.runs_table import read_runs
from ...system.reading import MEGABYTE, file_text

_MOST_BYTES = 10 * MEGABYTE
_GO_ON = "go on with the command that started the search"


@dataclass(frozen=True, slots=True, eq=False)
class FoundSearch:
    """A search that has ended.

    Attributes
    ----------
    search
        What was asked.
    values : (n,) float
        Where trials were made.
    trials
        The same as levels, and which succeeded.
    answer, reason
        What they say, and why there are no more of them.
    """

    search: Search
    values: np.ndarray
    trials: Trials
    answer: Answer
    reason: str


def is_search(folder: Path) -> bool:
    """Return whether a folder is one of a search."""
    return (folder / SEARCH_FILE).is_file()


def read_found_search(folder: Path) -> FoundSearch:
    """Read a search and its trials.

    Raises
    ------
    OutputError
        The search has not ended, or what it left cannot be read.
    """
    try:
        search = read_search(folder / SEARCH_FILE)
    except ScenarioError as error:
        raise OutputError(str(error)) from error
    if not (folder / ANSWER_FILE).exists() or not (folder / TRIALS_FILE).exists():
        raise OutputError(f"{folder}: holds no {ANSWER_FILE} yet: {_GO_ON}")
    table = read_runs(folder / TRIALS_FILE)
    try:
        reason = str(json.loads(file_text(folder / ANSWER_FILE, _MOST_BYTES))["ended_as"])
        values = np.array([float(row.inputs[search.settings.key]) for row in table.rows])
    except (UnreadableError, ValueError, KeyError, TypeError) as error:
        raise OutputError(f"{folder}: what the search left is damaged ({error}): {_GO_ON}") from error
    levels = np.array([search.scale.level(float(value)) for value in values])
    trials = Trials(levels, table.met(SUCCESS))
    return FoundSearch(search, values, trials, answer_of(search, trials), reason)
