"""Outcome of a preview as lines and numbers: debris on the ground, what falls and what stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ..engineering.geometry.plan_areas import without_gaps
from ..engineering.geometry.vectors import transformed, transformed_back
from ..model.debris.footprint import landed
from ..model.debris.throws import debris_of
from ..model.results.arrays import Results
from ..model.results.motion import relative_to_ground, without_removed
from .ground_lines import draped, outline_lines

_DECIMALS = 3
"""Of a metre, of lines that are handed from process to process as text."""

GAP_M = 2.0
"""Shards that lie less apart are in one outline: a ring around each would not show where debris ends."""

_LINES = ("debris_lines_m", "fallen_lines_m", "standing_lines_m")


@dataclass(frozen=True, slots=True, eq=False)
class PreviewOutcome:
    """How far a run has got, and how the bridge is then.

    Attributes
    ----------
    shards, fallen : int
        Number of shards without those that were removed, and how many of them are debris.
    falling : int
        Number of shards that still fall. They count as debris, and are where they would land in free fall.
    fallen_kg, area_m2, farthest_m : float
        Mass of debris, area that it covers in plan, and its largest distance from the bridge's plan.
    time_s, duration_s : float
        Simulated time so far, and the scenario's duration.
    is_elastic : bool
        Whether connections are elastic, so that the preview takes longer steps than the run.
    debris_lines_m : (2 k, 3) float
        Outline of the debris on the ground, around what lies less than `GAP_M` apart.
    fallen_lines_m, standing_lines_m : (2 k, 3) float
        Edges of the debris, and of the other shards, where they are.
    """

    shards: int
    fallen: int
    falling: int
    fallen_kg: float
    area_m2: float
    farthest_m: float
    time_s: float
    duration_s: float
    is_elastic: bool
    debris_lines_m: np.ndarray
    fallen_lines_m: np.ndarray
    standing_lines_m: np.ndarray

    @property
    def standing(self) -> int:
        """Number of shards that stand."""
        return self.shards - self.fallen

    @classmethod
    def of(
        cls, results: Results, edges_m: Sequence[np.ndarray], duration_s: float, *, is_elastic: bool = False
    ) -> Self:
        """Return the outcome of what was recorded so far.

        Parameters
        ----------
        results
            Frames of a run; the last one counts.
        edges_m
            Edges of each shard as lines (2 k, 3) float, m, where it was built.
        duration_s
            Simulated time of the whole scenario.
        """
        results, falling = landed(relative_to_ground(results))
        moved = _edges_at_end(results, edges_m)
        left, _ = without_removed(results)
        shards, debris = left.inventory.of_kind("shard"), debris_of(left)
        rows = {body: row for row, body in enumerate(results.inventory.of_kind("shard").tolist())}
        fallen = set(debris.bodies.tolist())
        return cls(
            shards=len(shards),
            fallen=len(fallen),
            falling=falling,
            fallen_kg=float(debris.masses_kg.sum()),
            area_m2=float(debris.area.area()),
            farthest_m=float(debris.reaches_m.max(initial=0.0)),
            time_s=float(results.frames.time_s[-1]),
            duration_s=duration_s,
            is_elastic=is_elastic,
            debris_lines_m=draped(outline_lines(without_gaps(debris.area, GAP_M)), debris.ground),
            fallen_lines_m=_joined([moved[rows[body]] for body in shards.tolist() if body in fallen]),
            standing_lines_m=_joined([moved[rows[body]] for body in shards.tolist() if body not in fallen]),
        )

    def to_json(self) -> dict[str, Any]:
        """Return all values as JSON can hold them; lines to the mm."""
        values = {name: getattr(self, name) for name in self.__slots__}
        return values | {name: np.round(values[name], _DECIMALS).tolist() for name in _LINES}

    @classmethod
    def of_json(cls, values: Mapping[str, Any]) -> Self:
        """Return an outcome from what `stored` gives."""
        lines = {name: np.array(values[name], float).reshape(-1, 3) for name in _LINES}
        return cls(**{**values, **lines})


def _edges_at_end(results: Results, edges_m: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Return the edges of each shard where it is in the last frame."""
    frames, moved = results.frames, []
    for body, lines in zip(results.inventory.of_kind("shard").tolist(), edges_m, strict=True):
        own = transformed_back(frames.rotations[0, body], lines - frames.positions_m[0, body])
        moved.append(transformed(frames.rotations[-1, body], own) + frames.positions_m[-1, body])
    return moved


def _joined(parts: Sequence[np.ndarray]) -> np.ndarray:
    return np.concatenate([np.zeros((0, 3)), *parts])
