"""Map of a study: probability of debris at a position.

The limit of each cell holds for this cell by itself. Of many cells, one is expected to be hit more often than its limit
says: the limit of the debris distance is for the whole plan at once.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import CrossSection

from ..arrays import FloatArray, IntArray
from ..geometry.plan_areas import PlanCells
from .binomial import upper_limit
from .order_limits import least_runs

LEVELS = (0.5, 0.05, 0.01)
"""Probabilities that are outlined."""

_MOST_CELLS = 200
"""Along the longer side of the map."""


@dataclass(frozen=True, eq=False)
class ProbabilityMap:
    """Numbers of runs with debris in each cell, at any time. A run that did not finish hit every cell."""

    cells: PlanCells
    hits: IntArray  # (rows, columns)
    runs: int
    unfinished: int
    confidence: float  # of the limit of each cell by itself

    @property
    def shares(self) -> FloatArray:
        """Shares (rows, columns) of the runs that hit each cell."""
        return self.hits / self.runs

    @cached_property
    def upper_limits(self) -> FloatArray:
        """Upper limits (rows, columns) of the probability that a run hits each cell, after Clopper and Pearson."""
        counts, of = np.unique(self.hits, return_inverse=True)
        return upper_limit(counts, self.runs, self.confidence)[of.reshape(self.hits.shape)]

    def resolves(self, probability: float) -> bool:
        """Return whether the runs show of any position, even a distant one, that they hit it with no more than this."""
        return float(upper_limit(self.unfinished, self.runs, self.confidence)) <= probability

    def runs_for(self, probability: float) -> int:
        """Return how many runs it takes to show this of a position that none of them hits."""
        return least_runs(1.0 - probability, self.confidence)

    def area_above(self, probability: float) -> CrossSection:
        """Return the cells that runs may hit with more than a probability.

        Beyond the map as well nothing is sure where the runs do not resolve the probability.
        """
        return self.cells.area_of(self.upper_limits > probability)


def probability_map(
    swept: Iterable[Sequence[FloatArray] | None], confidence: float, around: Sequence[FloatArray] = ()
) -> ProbabilityMap | None:
    """Return the map of a study; None where no run moved anything and `around` is empty.

    `swept` has the outlines (k, 2) of the area that debris covered in each run, with holes the other way round; None
    for a run that did not finish. It is gone through twice. The map also shows the outlines `around`, such as the
    bridge's.
    """
    corners = [_box(rings) for rings in (*swept, around) if rings]
    if not corners:
        return None
    low, high = np.array([low for low, _ in corners]).min(axis=0), np.array([high for _, high in corners]).max(axis=0)
    cells = PlanCells.over(low, high, _MOST_CELLS)
    hits, runs, unfinished = np.zeros((cells.rows, cells.columns), int), 0, 0
    for rings in swept:
        hits += 1 if rings is None else cells.touched(rings)
        runs, unfinished = runs + 1, unfinished + (rings is None)
    return ProbabilityMap(cells, hits, runs, unfinished, confidence)


def _box(rings: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    corners = np.concatenate(rings)
    return corners.min(axis=0), corners.max(axis=0)
