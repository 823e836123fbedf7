"""Runs of a study, a search or an optimisation, as its report looks at them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Self

import numpy as np

from ...errors import OutputError
from ...model.ensemble.folder import read_ensemble
from ...model.optimise.conclusions import CANDIDATE, ROUND
from ...model.study.file import SEED, Ensemble
from ...model.study.runs_table import REACH, RunsTable


@dataclass(frozen=True, eq=False)
class ReportedEnsemble:
    """Runs, and what was asked; the name is that of their folder, versions are by name."""

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
        """Names of all inputs but the seed, which has no order, and those that only say what a run is for."""
        return tuple(name for name in self.table.inputs if name not in (SEED, CANDIDATE, ROUND))

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """Names of all outputs that are numbers, not all of them the same."""
        of_numbers = [name for name in self.table.outputs if self.table.output(name).dtype == float]
        return tuple(name for name in of_numbers if len(np.unique(_finite(self.table.output(name)))) > 1)


def _finite(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]
