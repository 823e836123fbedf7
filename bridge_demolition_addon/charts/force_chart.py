"""Chart of the forces and of the breaking over a run's time."""

from __future__ import annotations

from pathlib import Path

from ..model.results.arrays import Results
from ..model.results.force_history import largest_on_a_shard
from ..system.disk import whole_file
from .style import blank_figure, lay_out, plain


def plot_forces(results: Results, path: Path, title: str, impact_s: float | None) -> None:
    """Draw the largest force on any shard, and the connections that still hold, over time, as a picture.

    A line marks when the ball hit, if it did.
    """
    figure = blank_figure(9.0, 5.0, dpi=120, layout="constrained")
    force_axes = figure.add_subplot()
    sums = largest_on_a_shard(results, results.frames.loads.body_peak_sums_n)
    resultants = largest_on_a_shard(results, results.frames.loads.body_peaks_n)
    times = results.frames.time_s
    lines = force_axes.plot(times, sums / 1e3, color="#b2182b", label="largest sum of magnitudes on a shard")
    lines += force_axes.plot(times, resultants / 1e3, color="#2166ac", label="largest resultant on a shard")
    force_axes.set_title(plain(title), wrap=True)
    force_axes.set(xlabel="time (s)", ylabel="force (kN)", xmargin=0.0)
    force_axes.set_ylim(bottom=0.0)
    force_axes.grid(alpha=0.3)
    count_axes = force_axes.twinx()
    intact = results.frames.intact.sum(axis=1)
    lines += count_axes.plot(times, intact, color="#4d4d4d", linestyle="--", label="connections intact")
    count_axes.set(ylabel="connections intact", ylim=(0.0, 1.05 * max(1, intact.max())))
    if impact_s is not None:
        lines.append(force_axes.axvline(impact_s, color="black", linestyle=":", label="impact of the ball"))
    figure.legend(handles=lines, loc="outside lower center", ncols=2, frameon=False)
    lay_out(figure)
    with whole_file(path) as part:
        figure.savefig(part)
