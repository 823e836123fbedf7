"""Runs of a study, a search or an optimisation, as its report looks at them; outlines and pictures of a study."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import outlines, united
from ...engineering.statistics.probability_map import LEVELS, ProbabilityMap, probability_map
from ...errors import OutputError
from ...model.debris.zones import widened_around
from ...model.ensemble.folder import EnsembleRuns, read_ensemble
from ...model.optimise.conclusions import CANDIDATE, ROUND
from ...model.study.conclusions import Conclusions, Proportion, holds, proportion_leaving
from ...model.study.conclusions import conclusions as conclusions_of
from ...model.study.file import AGAIN_FOLDER, RUN_FOLDER, SEED, Ensemble, Study
from ...model.study.runs_table import REACH, RunsTable
from ...texts import Text
from ..run_folder import pictures_in


@dataclass(frozen=True, eq=False)
class ReportedEnsemble:
    """Runs, and what was asked; the name is their folder's, versions are by name."""

    name: str
    ensemble: Ensemble
    table: RunsTable
    versions: Mapping[str, str]

    @classmethod
    def read(cls, folder: Path, evaluated: Callable[[Any, RunsTable], dict[str, Any]]) -> Self:
        """Read a folder; `evaluated` returns the further attributes of a subclass, from the ensemble and its table."""
        read = read_ensemble(folder)
        try:
            attributes = evaluated(read.ensemble, read.table)
        except (KeyError, TypeError, ValueError) as error:
            raise OutputError(
                f"{folder / read.ensemble.table_file} is damaged ({error}): go on with the command that started the "
                f"{read.ensemble.kind}"
            ) from error
        return cls(read.name, read.ensemble, read.table, read.versions, **attributes)

    @property
    def criteria(self) -> tuple[str, ...]:
        """Names of outputs that say whether a run met a criterion."""
        return tuple(criterion.output for criterion in self.ensemble.criteria)

    @property
    def distances_m(self) -> np.ndarray:
        """Debris distance (n,) of each run, infinity where it did not finish."""
        return self.table.largest(REACH)

    @property
    def varied(self) -> tuple[str, ...]:
        """Names of the inputs but the seed, which has no order, and the ones that only say what a run is for."""
        return tuple(name for name in self.table.inputs if name not in (SEED, CANDIDATE, ROUND))

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """Names of outputs that are numbers and differ between runs."""
        of_numbers = [name for name in self.table.outputs if self.table.output(name).dtype == float]
        return tuple(name for name in of_numbers if len(np.unique(_finite(self.table.output(name)))) > 1)


def _finite(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]


_BEYOND_M2 = 1e-3
"""Area by which the plan of a bridge has to stick out of others to be another one."""


@dataclass(frozen=True, eq=False)
class StudyRuns(ReportedEnsemble):
    """A study, its runs, and what follows from them."""

    ensemble: Study
    swept: Iterable[Sequence[np.ndarray] | None]
    """Outlines (k, 2) of all that debris covered at any time, by row of the table; None where a run did not finish."""

    bridge: CrossSection  # what the bridge covered at first, in any of the runs
    pictures: Mapping[int, Mapping[str, Path]]  # of runs that were repeated, by number and name

    @cached_property
    def conclusions(self) -> Conclusions | None:
        """What the study states; None before all of its runs are there."""
        return conclusions_of(self.ensemble, self.table) if len(self.table) == self.ensemble.settings.runs else None

    @cached_property
    def map(self) -> ProbabilityMap | None:
        """How likely debris is where; None where no run finished."""
        return probability_map(self.swept, self.ensemble.settings.confidence, outlines(self.bridge))

    @cached_property
    def zones_left(self) -> list[Proportion]:
        """How likely debris leaves each zone of the scenario that holds the bridge."""
        if self.bridge.is_empty():
            return []
        confidence, zones = self.ensemble.settings.confidence, self.ensemble.scenario.zones
        return [proportion_leaving(zone, self.swept, confidence) for zone in zones if holds(zone, self.bridge)]

    @property
    def buffer_m(self) -> float | None:
        """What the scenario adds for what the model leaves out; None where it says nothing."""
        exclusion = self.ensemble.scenario.exclusion
        return exclusion.buffer_m if exclusion else None

    @cached_property
    def likely(self) -> dict[float, CrossSection]:
        """Where debris may be likelier than each level that this number of runs resolves, the largest area first."""
        plan = self.map
        return {level: plan.area_above(level) for level in sorted(LEVELS) if plan.resolves(level)} if plan else {}

    @cached_property
    def limits(self) -> dict[str, tuple[float, CrossSection]]:
        """The limit, and what is to keep with factor and buffer: how far each is from the bridge, m, and its area.

        Nothing where there is no limit.
        """
        if self.conclusions is None or not math.isfinite(self.conclusions.reach.limit_m):
            return {}
        reach = self.conclusions.reach
        distances_m, kept_m = {Text("limit"): reach.limit_m}, reach.to_keep_m(self.buffer_m)
        if kept_m > reach.limit_m:
            distances_m[Text("distance to keep")] = kept_m
        return {name: (around_m, widened_around(self.bridge, around_m)) for name, around_m in distances_m.items()}

    @property
    def to_keep(self) -> tuple[float, CrossSection] | None:
        """The largest of the limits: how far it is from the bridge, m, and its area; None where there is none."""
        return max(self.limits.values(), key=lambda limit: limit[0], default=None)

    @property
    def hull_corners(self) -> int:
        """How many corners the convex hull of the area covered by debris has; 0 where it covered nothing."""
        hull = CrossSection()
        for rings in self.swept:
            if rings:
                hull = CrossSection.hull_points(np.concatenate([*outlines(hull), *rings]))
        return sum(map(len, outlines(hull)))


def read_study_runs(folder: Path) -> StudyRuns:
    """Read a study and its runs."""
    return study_runs(read_ensemble(folder))


def study_runs(read: EnsembleRuns) -> StudyRuns:
    """Return a study that was read, with what is kept of its runs."""
    if not isinstance(read.ensemble, Study):
        raise OutputError(f"{read.folder}: expected the folder of a study")
    folders = read.run_folders()
    outlines = {number: read.outlines_in(folder) for number, folder in folders.items()}
    return StudyRuns(
        name=read.name,
        ensemble=read.ensemble,
        table=read.table,
        versions=read.versions,
        swept=[outlines[row.number].swept if row.number in outlines else None for row in read.table.rows],
        bridge=_common_plan(run.bridge for run in outlines.values()),
        pictures=_pictures(read.folder, folders),
    )


def _common_plan(plans: Iterable[Iterable]) -> CrossSection:
    """Return what bridges cover together; nearly always all of them the same."""
    common = CrossSection()
    for rings in plans:
        plan = CrossSection(list(rings))
        if (plan - common).area() > _BEYOND_M2:
            common = united([common, plan])
    return common


def _pictures(folder: Path, run_folders: Mapping[int, Path]) -> dict[int, dict[str, Path]]:
    """Return pictures of runs that were repeated or kept whole, by number and name."""
    pictures_by_run = {}
    for number, run_folder in run_folders.items():
        for run in (folder / AGAIN_FOLDER / str(number), run_folder / RUN_FOLDER):
            if pictures := pictures_in(run, []):
                pictures_by_run[number] = pictures
                break
    return pictures_by_run
