"""Key figures of a run at a frame, the history of a force, and where debris lies then, as the 3D view shows them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import CrossSection

from ..engineering.geometry.plan_areas import distances_outside
from ..engineering.geometry.vectors import length
from ..engineering.terrain.surface import RecordedGround
from ..model.debris.footprint import corners_at, footprint, straightened
from ..model.results.arrays import Results
from ..model.results.collapse import ConnectionCounts, Rested, ShardRest, rest_of
from ..model.results.motion import MOVED_M, relative_to_ground, travel, without_removed


@dataclass(frozen=True, slots=True, eq=False)
class ForceHistory:
    """A force over k recorded rows, each the largest in any sub-step of its frame.

    Attributes
    ----------
    name
        Body or connection that it acts on; empty for the largest on any shard.
    times_s, forces_n : (k,) float
        Forces are nan where they are not known.
    """

    name: str
    times_s: np.ndarray
    forces_n: np.ndarray

    @property
    def peak_row(self) -> int | None:
        """Row of the largest force, the first of several; None where there never was one."""
        known = np.nan_to_num(self.forces_n)
        return int(known.argmax()) if known.max(initial=0.0) > 0.0 else None


@dataclass(frozen=True, slots=True, eq=False)
class HistoryCurve:
    """A history in a square from 0 to 1, of time from left to right, and of force up to the peak.

    Attributes
    ----------
    lines : (2 j, 2) float
        Pairs of ends. A row whose force is not known has none.
    now, peak : (2,) float
        The shown row, and the peak; None where there is no force to show there.
    now_share : float
        Time of the shown row.
    """

    lines: np.ndarray
    now: np.ndarray | None
    peak: np.ndarray | None
    now_share: float


def largest_history(results: Results) -> ForceHistory:
    """Return the largest force on any shard over time; nan where none is known."""
    peaks_n = np.asarray(results.frames.loads.body_peaks_n, float)[:, results.inventory.of_kind("shard")]
    forces_n = np.fmax.reduce(peaks_n, axis=1, initial=np.nan)
    return ForceHistory("", np.asarray(results.frames.time_s, float), forces_n)


def history_curve(history: ForceHistory, row: int, columns: int) -> HistoryCurve:
    """Return the chart of a history with a shown row; of points that fall into one column it has the largest.

    Parameters
    ----------
    row
        Recorded row that is shown.
    columns
        How many points the chart can tell apart in its width, at least 1.
    """
    times, forces = history.times_s, history.forces_n
    duration, peak = float(times[-1] - times[0]), history.peak_row
    shares = (times - times[0]) / duration if duration > 0.0 else np.zeros(len(times))
    points = np.column_stack((shares, forces / (1.0 if peak is None else forces[peak])))
    kept = points[_told_apart(shares, forces, columns)]
    lines = np.stack((kept[:-1], kept[1:]), axis=1)
    return HistoryCurve(
        lines=lines[np.isfinite(lines).all(axis=(1, 2))].reshape(-1, 2),
        now=points[row] if np.isfinite(points[row]).all() else None,
        peak=None if peak is None else points[peak],
        now_share=float(shares[row]),
    )


def _told_apart(shares: np.ndarray, forces_n: np.ndarray, columns: int) -> np.ndarray:
    """Return rows: the first, the last, and the row with the largest force in each column."""
    if len(shares) <= columns:
        return np.arange(len(shares))
    numbers = np.minimum((shares * columns).astype(int), columns - 1)
    order = np.lexsort((np.nan_to_num(forces_n, nan=-1.0), numbers))
    last_of_column = np.flatnonzero(np.diff(numbers[order], append=columns))
    return np.unique([0, *order[last_of_column].tolist(), len(shares) - 1])


_SHARD = "shard"


@dataclass(frozen=True, slots=True, eq=False)
class Farthest:
    """Debris distance of a frame, and the corner (2,) of a shard that is so far away, both m."""

    distance_m: float
    position_m: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class FrameFigures:
    """Key figures of a frame.

    Attributes
    ----------
    number, time_s : int, float
        Blender's frame, and simulated time.
    connections : ConnectionCounts
        How many have cracked, yielded or torn.
    debris_kg, bridge_kg : float
        Mass of the shards that have come down by then, and of every shard. Removed ones are left out of both.
    area
        What debris covers in plan.
    farthest
        How far the farthest debris is from the bridge's plan; None without debris.
    """

    number: int
    time_s: float
    connections: ConnectionCounts
    debris_kg: float
    bridge_kg: float
    area: CrossSection
    farthest: Farthest | None


class RunFigures:
    """Key figures of a run, worked out frame by frame as they are asked for.

    Debris is what `debris_of` calls so, but at any frame: shards that are more than `MOVED_M` from where they began.
    """

    def __init__(self, results: Results, rested: Rested | None = None):
        self._whole, self._rested = results, rested
        self._left, _ = without_removed(relative_to_ground(results))
        inventory = self._left.inventory
        self._shards = inventory.of_kind(_SHARD)
        self._masses_kg = np.asarray(inventory.masses_kg, float)
        self._radii_m = np.array([float(length(own).max()) for own in inventory.vertices_by_body()])
        self._bodies = {str(name): row for row, name in enumerate(inventory.body_names)}
        self._connections = {str(name): row for row, name in enumerate(inventory.connection_names)}

    def __len__(self) -> int:
        return len(self._left.frames)

    @cached_property
    def plan(self) -> CrossSection:
        """What the bridge covered at first."""
        return straightened(footprint(self._left, self._shards, 0))

    @cached_property
    def ground(self) -> RecordedGround:
        """What the run was on."""
        return self._left.ground()

    @cached_property
    def rest(self) -> ShardRest:
        """When the shards began to move, and when they came to rest."""
        return rest_of(self._left, self._rested)

    @cached_property
    def largest(self) -> ForceHistory:
        """The largest force on any shard over time."""
        return largest_history(self._whole)

    def at(self, row: int) -> FrameFigures:
        """Return the key figures of a recorded row."""
        frames, debris = self._left.frames, self.debris(row)
        return FrameFigures(
            number=int(frames.number[row]),
            time_s=float(frames.time_s[row]),
            connections=ConnectionCounts.of_results(self._whole, row),
            debris_kg=float(self._masses_kg[debris].sum()),
            bridge_kg=float(self._masses_kg[self._shards].sum()),
            area=footprint(self._left, debris, row),
            farthest=self._farthest(row, debris),
        )

    def debris(self, row: int) -> np.ndarray:
        """Return the shards (d,) that are debris in a recorded row."""
        positions = self._left.frames.positions_m
        first, now = (np.asarray(positions[step], float)[self._shards] for step in (0, row))
        return self._shards[travel(first, now) > MOVED_M]

    def history(self, name: str) -> ForceHistory:
        """Return the force on a body or in a connection by its name, else the largest on any shard.

        Ground does not move, and carries what all others press on it: it has no history of its own.
        """
        loads, inventory = self._whole.frames.loads, self._whole.inventory
        body, connection = self._bodies.get(name), self._connections.get(name)
        if body is not None and inventory.moves[body]:
            forces_n = loads.body_peaks_n[:, body]
        elif connection is not None:
            forces_n = loads.connection_peaks_n[:, connection]
        else:
            return self.largest
        return ForceHistory(name, np.asarray(self._whole.frames.time_s, float), np.asarray(forces_n, float))

    def frame_of(self, row: int) -> int:
        """Return Blender's frame of a recorded row."""
        return int(self._left.frames.number[row])

    def largest_loaded(self, row: int) -> str:
        """Return the name of the shard with the largest force in a recorded row; empty without shards."""
        forces_n = np.nan_to_num(np.asarray(self._whole.frames.loads.body_peaks_n[row], float)[self._shards])
        return str(self._left.inventory.body_names[self._shards[forces_n.argmax()]]) if len(forces_n) else ""

    def _farthest(self, row: int, debris: np.ndarray) -> Farthest | None:
        if not len(debris) or self.plan.is_empty():
            return None
        middles = np.asarray(self._left.frames.positions_m[row], float)[debris, :2]
        of_middles = distances_outside(self.plan, middles)
        # No other body can have a corner farther away than the middle of the farthest one.
        can_be = debris[of_middles + self._radii_m[debris] >= of_middles.max()]
        corners = np.concatenate(corners_at(self._left, row, can_be))[:, :2]
        distances = distances_outside(self.plan, corners)
        farthest = int(distances.argmax())
        return Farthest(float(distances[farthest]), corners[farthest])
