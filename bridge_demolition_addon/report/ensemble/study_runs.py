"""A study with its runs, as its report looks at it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import outlines
from ...engineering.statistics.probability_map import LEVELS, ProbabilityMap, probability_map
from ...model.debris.exclusion import widened_around
from ...model.study.conclusions import Conclusions, Proportion, conclusions
from ...model.study.criteria import Criterion
from ...model.study.file import SEED, Study
from ...model.study.runs_table import REACH, RunsTable
from ...model.study.verification import holds, proportion_leaving


@dataclass(frozen=True, eq=False)
class StudyRuns:
    """A study, its runs, and what follows from them.

    Attributes
    ----------
    name : str
        Of its folder.
    study : Study
        What was asked.
    table : RunsTable
        All draws that are there.
    swept : iterable
        Of each row of the table the outlines (k, 2) of all that debris covered at any time, None where the run did not
        finish; it can be gone through again and again.
    bridge : CrossSection
        What the bridge covered at first, in any of the runs.
    pictures : dict
        Rendered pictures of draws that were run once more, by number and by what they show.
    versions : dict
        What the draws were run with: version by name.
    """

    name: str
    study: Study
    table: RunsTable
    swept: Iterable[Sequence[np.ndarray] | None]
    bridge: CrossSection
    pictures: Mapping[int, Mapping[str, Path]]
    versions: Mapping[str, str]

    @cached_property
    def said(self) -> Conclusions | None:
        """What the study says; None before all of its runs are there."""
        return conclusions(self.study, self.table) if len(self.table) == self.study.settings.runs else None

    @cached_property
    def map(self) -> ProbabilityMap | None:
        """How likely debris is where; None where no run finished."""
        return probability_map(self.swept, self.study.settings.confidence, outlines(self.bridge))

    @property
    def criteria(self) -> tuple[str, ...]:
        """Names of outputs that say whether a run met a criterion."""
        return tuple(each.output for each in self.study.criteria)

    @property
    def reaches_m(self) -> np.ndarray:
        """Reach (n,) of each run, infinity where it did not finish."""
        return self.table.largest(REACH)

    @property
    def varied(self) -> tuple[str, ...]:
        """Names of all inputs but the seed, which has no order."""
        return tuple(name for name in self.table.inputs if name != SEED)

    @cached_property
    def zones_left(self) -> list[Proportion]:
        """How likely debris leaves each zone of the scenario that holds the bridge."""
        zones = (
            [] if self.bridge.is_empty() else [each for each in self.study.scenario.zones if holds(each, self.bridge)]
        )
        return [proportion_leaving(zone, self.swept, self.study.settings.confidence) for zone in zones]

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """Names of all outputs that are numbers, not all of them the same."""
        of_numbers = [name for name in self.table.outputs if self.table.output(name).dtype == float]
        return tuple(name for name in of_numbers if len(np.unique(_finite(self.table.output(name)))) > 1)

    @property
    def buffer_m(self) -> float | None:
        """What the scenario adds for what the model leaves out; None where it says nothing."""
        exclusion = self.study.scenario.exclusion
        return exclusion.buffer_m if exclusion else None

    @cached_property
    def likely(self) -> dict[float, CrossSection]:
        """Where debris may be likelier than each of the levels that so many runs resolve, the largest area first."""
        resolved = sorted(level for level in LEVELS if self.map and self.map.resolves(level))
        return {level: self.map.area_above(level) for level in resolved}

    @cached_property
    def limits(self) -> dict[str, tuple[float, CrossSection]]:
        """The limit, and the limit with the buffer if there is one: how far each is from the bridge, m, and its area.

        Nothing where there is no limit.
        """
        if self.said is None or not math.isfinite(self.said.reach.limit_m):
            return {}
        limit_m = self.said.reach.limit_m
        found = {"limit": (limit_m, widened_around(self.bridge, limit_m))}
        if self.buffer_m:
            found["limit and buffer"] = limit_m + self.buffer_m, widened_around(self.bridge, limit_m + self.buffer_m)
        return found

    @property
    def limit(self) -> CrossSection | None:
        """The bridge's plan with the limit around it; None without one."""
        return self.limits["limit"][1] if self.limits else None

    @property
    def hull_corners(self) -> int:
        """How many corners the convex hull of all that debris covered has; 0 where it covered nothing."""
        hull = CrossSection()
        for rings in self.swept:
            if rings:
                hull = CrossSection.hull_points(np.concatenate([*outlines(hull), *rings]))
        return sum(map(len, outlines(hull)))


def shown(name: str) -> str:
    """Return the name of an input or output as people read it: its unit in brackets, of a criterion only its own."""
    if name.startswith(_CRITERION):
        return name.removeprefix(_CRITERION).strip('"')
    name, place = _IN_LIST.fullmatch(name).groups(default="")
    name = _QUOTED_OR_DOT.sub(lambda found: " " if found[0] == "." else found[0], name)
    for ending, unit in _UNITS.items():
        if name.endswith(ending):
            return f"{name.removesuffix(ending).replace('_', ' ')}{place.replace('.', ' ')} ({unit})"
    return f"{name.replace('_', ' ')}{place.replace('.', ' ')}"


_IN_LIST = re.compile(r"(.*?)(\.\d+)?")
"""A name, and the place of a value in a list at its end."""

_QUOTED_OR_DOT = re.compile(r'"[^"]*"|\.')
_CRITERION = f"{Criterion.table}."

_UNITS = {
    "_n_mm2": "N/mm²",
    "_kg_m3": "kg/m³",
    "_mm_s": "mm/s",
    "_m_s2": "m/s²",
    "_m_s": "m/s",
    "_newton": "N",
    "_kgf": "kgf",
    "_degrees": "°",
    "_deg": "°",
    "_kpa": "kPa",
    "_m2": "m²",
    "_m3": "m³",
    "_kg": "kg",
    "_ms": "ms",
    "_mm": "mm",
    "_N": "N",
    "_J": "J",
    "_m": "m",
    "_s": "s",
}
"""Endings of names, longer ones before those that end like them."""


def _finite(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]
