"""The search at work, and what the last one came to.

Trials run in processes of their own. Blender looks in on them a few times a second, and answers the user meanwhile.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy

from ...errors import DemolitionError, text_of
from ...model.search.file import Search
from ...model.study.files import CURVE_PICTURE
from ...report.wording.search import search_sentences
from ...studies.session import EnsembleSession
from ..study.prop import redraw_views
from ..study.session import engine_for

_LOOK_EVERY_S = 0.3

_at_work: list[SearchAtWork] = []
_found: list[FoundBySearch] = []
_ended: list[str] = []
"""Why the last search ended before its end, if it did."""


@dataclass(frozen=True, slots=True)
class FoundBySearch:
    """What a search came to.

    Attributes
    ----------
    sentences
        What it says.
    picture
        Its curve.
    """

    sentences: tuple[str, ...]
    picture: Path


class SearchAtWork:
    """A search whose trials are made.

    Parameters
    ----------
    search
        What is asked.
    path
        Its folder.
    jobs
        Trials at a time.

    Raises
    ------
    OutputError
        The folder is another's, or cannot be written.
    """

    def __init__(self, search: Search, path: Path, jobs: int):
        self.search, self.path = search, path
        self.run = EnsembleSession(search, path, engine_for(search, jobs))

    def end(self) -> None:
        """End all trials at work, and keep the table of those that have ended; once more is nothing."""
        self.run.stop()

    def finish(self) -> FoundBySearch:
        """Keep what all trials say, and return it."""
        run = self.run
        answer, _ = run.finish()
        lost = [f"{run.lost} trials did not finish, and count as no success: see trials.csv"] if run.lost else []
        return FoundBySearch((*search_sentences(answer), *lost), self.path / CURVE_PICTURE)


def begin(search: Search, path: Path, jobs: int) -> None:
    """Begin a search, or go on with it.

    Raises
    ------
    OutputError
        Its folder is another's, or cannot be written.
    """
    _ended.clear()
    _at_work.append(SearchAtWork(search, path, jobs))
    _found.clear()
    if not bpy.app.timers.is_registered(look_in):
        bpy.app.timers.register(look_in, persistent=True)


def search_at_work() -> SearchAtWork | None:
    """Return the search that is at work, None where none is."""
    return _at_work[0] if _at_work else None


def found_by_search() -> FoundBySearch | None:
    """Return what the last search came to; None where none has ended."""
    return _found[0] if _found else None


def end() -> None:
    """End the search at work, if there is one; what is done is kept."""
    _ended.clear()
    if _at_work:
        _at_work.pop().end()


def why_ended() -> str:
    """Return why the last search ended before its end; empty where it did not, or was stopped by the user."""
    return _ended[0] if _ended else ""


def look_in() -> float | None:
    """Take in what trials came to since the last look; called by Blender's timer, which gets when to call again."""
    if not _at_work:
        return None
    at_work = _at_work[0]
    before = at_work.run.done
    try:
        at_work.run.step(0.0)
        if at_work.run.is_finished:
            _at_work.clear()
            _found[:] = [at_work.finish()]
    except (DemolitionError, OSError) as error:
        _end_for(error, at_work)
    if at_work.run.done != before or not _at_work:
        redraw_views(bpy.context)
    return _LOOK_EVERY_S if _at_work else None


def unregister() -> None:
    """End the search at work, and forget what the last one came to."""
    if bpy.app.timers.is_registered(look_in):
        bpy.app.timers.unregister(look_in)
    end()
    _found.clear()


def _end_for(error: Exception, at_work: SearchAtWork) -> None:
    """End a search that cannot go on, and remember why; its folder is free then, whatever can still be written."""
    _at_work.clear()
    _ended[:] = [text_of(error)]
    try:
        at_work.end()
    except OSError as other:
        _ended[:] = [f"{text_of(error)}; {text_of(other)}"]
