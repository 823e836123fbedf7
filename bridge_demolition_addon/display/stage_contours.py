"""Contours of stages: how much of its strength each shard's connections use, at rest, before anything is run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..model.stages.stages import Stage
from ..model.structure.model import Model
from .colour_scale import colours
from .contour_quantities import BREAKS
from .contour_ranges import ContourScale, ContourSettings, RangeKind, percentiles
from .contours import ContourFrame


@dataclass(frozen=True, slots=True, eq=False)
class StageContours:
    """Utilisation of n shards in s stages."""

    times_s: np.ndarray  # (s,) begin of the stages
    used: np.ndarray  # (s, n) largest utilisation of a shard's connections; nan where it has none any more
    centres_m: np.ndarray  # (n, 3), by which the shards are known in a scene

    @classmethod
    def of_stages(cls, model: Model, stages: Sequence[Stage]) -> StageContours:
        """Return the contours of the stages of a model."""
        used = [used_by_shard(model, stage.standing.used) for stage in stages]
        return cls(np.array([stage.time_s for stage in stages]), np.array(used), np.asarray(model.centres_m))

    def __len__(self) -> int:
        return len(self.times_s)

    def show(self, stage: int, settings: ContourSettings) -> ContourFrame:
        """Return the colours of a stage, from 1 on.

        A range that is not fixed is linear, from 0 to where connections break, or as far beyond as they are used.
        """
        values = self.used[stage - 1]
        of = values if settings.range_kind == RangeKind.FRAME else self.used
        _, high = percentiles(of[np.isfinite(of)], settings.percentile)
        is_fixed = settings.range_kind == RangeKind.FIXED
        scale = settings.scale(0.0, high) if is_fixed else ContourScale(0.0, max(high, BREAKS))
        painted = colours(settings.colour_map, scale.shares(values))
        return ContourFrame(stage, float(self.times_s[stage - 1]), values, scale, painted)


def used_by_shard(model: Model, used: np.ndarray) -> np.ndarray:
    """Return the largest utilisation (n,) of each shard's connections, of that of all connections (m,)."""
    largest = np.full(len(model.shards), np.nan)
    for shards in model.connections.pairs.T:
        there = shards >= 0  # the ground is no shard
        np.fmax.at(largest, shards[there], used[there])
    return largest
