"""A force over the time of a run as a small chart: its curve, its peak, and the frame that is shown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..model.results.arrays import Results


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
    """Return rows: the first, the last, and that of the largest force in each column."""
    if len(shares) <= columns:
        return np.arange(len(shares))
    numbers = np.minimum((shares * columns).astype(int), columns - 1)
    order = np.lexsort((np.nan_to_num(forces_n, nan=-1.0), numbers))
    last_of_column = np.flatnonzero(np.diff(numbers[order], append=columns))
    return np.unique([0, *order[last_of_column].tolist(), len(shares) - 1])
