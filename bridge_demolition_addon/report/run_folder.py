"""Read a run's folder, whole or cut short."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..errors import OutputError, ScenarioError, UnreadableError
from ..model.debris.footprint import check_covers_ground
from ..model.results.arrays import FRAMES_FILE, RESULTS_FILE, Results, load_results, results_in
from ..model.results.collapse import ShardRest, rest_of
from ..model.results.energy import counted_share, is_known, made_share, much_made_text
from ..model.results.motion import without_removed
from ..model.results.moving import gone_text, moving_summary, moving_text
from ..model.results.summary import hits_of_balls, impact_of, largest_throw
from ..model.run_folder.files import FORCE_LOG, PICTURE_FOLDER, PICTURES, SCENARIO_FILE, SUMMARY_FILE
from ..model.run_folder.folder import holds_run, writer_of_run
from ..model.run_folder.logs import LoggedForces, count_logged_breaks, read_logged_forces
from ..model.run_folder.summary import RunSummary, read_summary
from ..model.scenario import ReportSettings, Scenario
from ..model.scenario.file import read_scenario
from ..model.schema import given
from ..model.sequence.ending import Ending, doubts_of_actions, undone_at_end
from ..system.reading import MEGABYTE, check_file
from ..texts import Text

MOST_PICTURE_BYTES = 100 * MEGABYTE

_NO_PICTURE = (OSError, SyntaxError, ValueError, MemoryError, struct.error, zlib.error)
"""Errors of the reader of pictures for a file that is no picture, or is damaged or cut short."""


@dataclass(frozen=True, eq=False, slots=True)
class ReportedRun:
    """A run as far as its folder holds it; None for what is missing or cannot be read."""

    folder: Path
    scenario: Scenario | None
    summary: RunSummary | None
    results: Results | None
    ball: RunSummary  # the summary, or one of the results with impact and hits of the ball
    logged_forces: LoggedForces | None  # only where there are no results
    logged_breaks: int | None  # connections in the breaking log, only where there are no results
    pictures: dict[str, Path]  # rendered, by name
    is_cut: bool  # only the frames are there that were recorded before it was killed, or so far
    shortcomings: tuple[str, ...]  # whole sentences on what is missing

    @property
    def recorded(self) -> Results:
        """Results of a run that is known to have them."""
        return given(self.results)

    @property
    def rest(self) -> ShardRest:
        """When shards first moved, and when all came to rest: as the run noted it."""
        return rest_of(self.recorded, self.summary.rested if self.summary else None)

    @property
    def planned(self) -> Scenario:
        """Scenario of a run that is known to have one."""
        return given(self.scenario)

    @property
    def report_settings(self) -> ReportSettings:
        """Units and language that its scenario asks for in reports; none without a scenario."""
        return self.scenario.report if self.scenario else ReportSettings()

    @property
    def still_moving(self) -> str:
        """What of it still moved at the end, as a sentence without a full stop; empty where all rested."""
        ended = self._as_recorded
        return moving_text(ended.moving_at_end, ended.came_to_rest_s, completed=ended.completed)

    @property
    def ending(self) -> Ending:
        """How it ended, with results."""
        ending = Ending.of(self._as_recorded)
        return replace(ending, how="Recorded up to") if self.is_cut else ending

    @property
    def first_doubts(self) -> tuple[str, ...]:
        """What has to be said before any of its results, as sentences without full stops."""
        known = is_known(self.recorded)
        much_made = much_made_text(counted_share(self.recorded), made_share(self.recorded)) if known else ""
        unusual = self.summary.stability.unusual if self.summary and self.summary.stability else ()
        gone = gone_text(self._as_recorded.largest_throw, self._as_recorded.moving_at_end)
        texts = gone, much_made, self.ending.text, self.still_moving, *unusual
        return tuple(filter(None, texts))

    @property
    def _as_recorded(self) -> RunSummary:
        """How a run that has results ended, by these, its scenario and its summary."""
        results, summary = self.recorded, self.summary or RunSummary(completed=not self.is_cut)
        has_hit = self.ball.impact is not None
        return RunSummary(
            completed=summary.completed,
            came_to_rest_s=summary.came_to_rest_s,
            simulated_s=float(results.frames.time_s[-1]),
            ended_before=undone_at_end(results, self.scenario, has_hit=has_hit) if self.scenario else None,
            moving_at_end=moving_summary(results),
            largest_throw=largest_throw(without_removed(results)[0]),
        )

    @property
    def name(self) -> str:
        """Name of the run among others."""
        return shown_name(self.folder)

    @property
    def title(self) -> str:
        """Title of the scenario, or else name of the folder."""
        if self.scenario:
            return self.scenario.title
        return (self.summary and self.summary.title) or self.name


def shown_name(folder: Path) -> str:
    """Return the name of a folder; bytes of it that are no letters in UTF-8 are shown as numbers."""
    return os.fsencode(folder.resolve().name).decode("utf-8", "backslashreplace")


def read_run(folder: Path) -> ReportedRun:
    """Read a run's folder, and say what is missing of it."""
    if not folder.is_dir():
        raise OutputError(f"{folder}: expected the folder of a run, found {'a file' if folder.exists() else 'nothing'}")
    at_work = writer_of_run(folder)  # before anything is read: what a run that has ended by now left is whole
    if not holds_run(folder):
        if at_work:
            raise OutputError(f"{folder}: holds no frame yet, and is being written to by {at_work}: wait for its end")
        raise OutputError(f"{folder}: holds no run: expected {RESULTS_FILE} or {FORCE_LOG} in it")
    shortcomings: list[str] = []
    results = _results(folder, at_work, shortcomings)
    summary = _summary(folder, shortcomings)
    if summary:
        shortcomings.extend(Text("{}.", doubt) for doubt in doubts_of_actions(summary))
    if summary and summary.made_by_hand:
        shortcomings.append(
            Text(
                "The scene was changed in Blender after it was built. The scenario of the run does not hold these "
                "changes: {}.",
                "; ".join(summary.made_by_hand),
            )
        )
    logged: LoggedForces | None = _log(read_logged_forces, folder, shortcomings) if results is None else None
    if logged and logged.is_cut:
        shortcomings.append(Text("The last frame in {} is not whole, and is left out.", FORCE_LOG))
    scenario = _scenario(folder, shortcomings)
    return ReportedRun(
        folder=folder,
        scenario=scenario,
        summary=summary,
        results=results,
        ball=_ball(summary, results, scenario),
        logged_forces=logged,
        logged_breaks=_log(count_logged_breaks, folder, shortcomings) if results is None else None,
        pictures=pictures_in(folder, shortcomings),
        is_cut=results is not None and not (folder / RESULTS_FILE).exists(),
        shortcomings=tuple(shortcomings),
    )


def _results(folder: Path, at_work: str | None, shortcomings: list[str]) -> Results | None:
    path = results_in(folder)
    if not path.exists():
        shortcomings.append(
            Text("{} No frame is recorded yet.", _still_at_work(at_work))
            if at_work
            else Text(
                "The run was killed before it could write {}: only its logs are here. Debris, zones, exclusion "
                "zone, spans, energy and stresses are left out.",
                RESULTS_FILE,
            )
        )
        return None
    try:
        results, removed = without_removed(load_results(path))
        check_covers_ground(results)
    except OutputError as error:
        if path != results_in(folder):  # the run has ended meanwhile
            return _results(folder, None, shortcomings)
        shortcomings.append(
            Text("{} cannot be read, and all that needs it is left out: {}.", path.name, _reason(error, path))
        )
        return None
    if path.name == FRAMES_FILE:
        shortcomings.append(
            Text(
                "{} {} frames are recorded so far, and everything here ends with the last of them.",
                _still_at_work(at_work),
                len(results.frames),
            )
            if at_work
            else Text(
                "The run ended before its end, as by a kill, a crash or a full disk; {} frames are kept, and "
                "everything here ends with the last of them.",
                len(results.frames),
            )
        )
    if removed:
        shortcomings.append(
            Text(
                "{} shards were removed during the run, as the scenario says. They are left out of debris, "
                "masses, loads and energies, also of the time before.",
                removed,
            )
        )
    return results


def _still_at_work(writer: str) -> str:
    return Text("The run is still at work ({}): make the report again once it has ended.", writer)


def _reason(error: Exception, path: Path) -> str:
    """Return what an error says without the path at its beginning: a report is read elsewhere."""
    return str(error).removeprefix(f"{path}: ")


def _summary(folder: Path, shortcomings: list[str]) -> RunSummary | None:
    if not (folder / SUMMARY_FILE).exists():
        shortcomings.append(
            Text(
                "There is no {}: the version of Blender is not known. Hits of the ball are worked out from the "
                "frames that are here.",
                SUMMARY_FILE,
            )
        )
        return None
    try:
        return read_summary(folder)
    except OutputError as error:
        shortcomings.append(Text("{} is not what a run writes, and is left out: {}.", SUMMARY_FILE, error))
    except (UnreadableError, ValueError) as error:
        shortcomings.append(Text("{} cannot be read, and what it says is left out: {}.", SUMMARY_FILE, error))
    return None


def _ball(summary: RunSummary | None, results: Results | None, scenario: Scenario | None) -> RunSummary:
    """Return the summary; without one, impact and hits of the ball under standard gravity."""
    if summary or results is None:
        return summary or RunSummary()
    gravity = np.array([0.0, 0.0, -STANDARD_GRAVITY_M_S2])
    contact_time_s = scenario.ball.contact_time_s if scenario and scenario.ball else None
    hits = hits_of_balls(results, gravity, contact_time_s)
    return RunSummary.of({"impact": impact_of(results, gravity), "hits_of_the_ball": hits})


def _log(read: Callable[[Path], Any], folder: Path, shortcomings: list[str]) -> Any:
    """Return what a log holds; None where it is missing or cannot be read."""
    try:
        return read(folder)
    except OutputError as error:
        shortcomings.append(Text("{}.", error))
        return None


def _scenario(folder: Path, shortcomings: list[str]) -> Scenario | None:
    path = folder / SCENARIO_FILE
    if not path.is_file():
        shortcomings.append(
            Text(
                "There is no {}, as for a scene that was built by hand: zones, exclusion zone, charges and "
                "lengths of spans are not known.",
                SCENARIO_FILE,
            )
        )
        return None
    try:
        return read_scenario(path)
    except ScenarioError as error:
        shortcomings.append(Text("The scenario of the run cannot be read: {}.", _reason(error, path)))
        return None


def pictures_in(folder: Path, shortcomings: list[str]) -> dict[str, Path]:
    """Return the rendered pictures that are whole, and explain each that is not."""
    pictures = {}
    for name in PICTURES:
        path = folder / PICTURE_FOLDER / f"{name}.png"
        if not path.exists():
            continue
        from matplotlib.image import imread  # not loaded where only numbers are read, as in the sidebar

        try:
            check_file(path, MOST_PICTURE_BYTES)
            imread(path)
        except (UnreadableError, *_NO_PICTURE):
            shortcomings.append(Text("{} is no whole picture, and is left out.", f"frames/{path.name}"))
        else:
            pictures[name] = path
    return pictures
