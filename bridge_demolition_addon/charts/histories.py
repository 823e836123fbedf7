"""Charts over the time of a run: forces, breaking, heights of spans, progress of the collapse, energy, moving ground.

The time axis of a chart is kept with its picture, so that a click on the picture can be read as a time.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase

from ..engineering.ground_motion import GroundRecord
from ..model.ground_motion.settings import DIRECTIONS, DesignSpectrum
from ..model.ground_motion.sources import design_spectrum, response_spectrum
from ..model.results.arrays import Results
from ..model.results.collapse import Span
from ..model.results.energy import Energy
from ..model.results.force_history import BreakingByKind, ContactForces, largest_on_a_shard
from ..system.disk import whole_file
from ..texts import Text, Unit
from .style import blank_figure, lay_out, line_style, plain

_MOST_KINDS = 7
"""Kinds of connections that have a line of their own."""


def plot_forces(results: Results, path: Path, title: str, impact_s: float | None) -> None:
    """Write a picture of the chart of forces; one in PNG says where its time axis lies."""
    figure = forces_figure(results, title, impact_s)
    with whole_file(path) as part:
        figure.savefig(part, metadata={KEY: TimeAxis.of(figure.axes[0]).text} if path.suffix == ".png" else None)


def forces_figure(results: Results, title: str, impact_s: float | None) -> Figure:
    """Draw the largest force on any shard, the intact connections and the hit of the ball over time."""
    figure = blank_figure(9.0, 5.0, dpi=120, layout="constrained")
    force_axes = figure.add_subplot()
    times, (sums, resultants) = results.frames.time_s, _largest_loads(results)
    lines = force_axes.plot(times, sums / 1e3, color="#b2182b", label=Text("largest sum of magnitudes on a shard"))
    lines += force_axes.plot(times, resultants / 1e3, color="#2166ac", label=Text("largest resultant on a shard"))
    force_axes.set_title(plain(title), wrap=True)
    force_axes.set(xlabel=Text("time (s)"), ylabel=Text("force ({})", Unit("kN")), xmargin=0.0)
    force_axes.set_ylim(bottom=0.0)
    force_axes.grid(alpha=0.3)
    count_axes = force_axes.twinx()
    intact = results.frames.intact.sum(axis=1)
    lines += count_axes.plot(times, intact, color="#4d4d4d", linestyle="--", label=Text("connections intact"))
    count_axes.set(ylabel=Text("connections intact"), ylim=(0.0, 1.05 * max(1, intact.max())))
    if impact_s is not None:
        lines.append(force_axes.axvline(impact_s, color="black", linestyle=":", label=Text("impact of the ball")))
    figure.legend(handles=lines, loc="outside lower center", ncols=2, frameon=False)
    lay_out(figure)
    return figure


def contact_force_history(figure: FigureBase, forces: ContactForces, impact_s: float | None) -> None:
    """Draw total and largest contact force, and what the ground carries by contacts, over time."""
    axes = _time_axes(figure, Text("contact force ({})", Unit("kN")), forces.times_s)
    axes.plot(forces.times_s, forces.total_n / 1e3, **line_style(0), label=Text("all contacts together, at least"))
    axes.plot(forces.times_s, forces.largest_n / 1e3, **line_style(1), label=Text("largest on one shard"))
    axes.plot(forces.times_s, forces.ground_n / 1e3, **line_style(2), label=Text("upward force of the ground"))
    _finish(figure, axes, impact_s)


def load_history(figure: FigureBase, results: Results, impact_s: float | None) -> None:
    """Draw the largest load on any shard over time, by connections and contacts together."""
    axes = _time_axes(figure, Text("largest load on a shard ({})", Unit("kN")), results.frames.time_s)
    _draw_loads(axes, results.frames.time_s, *_largest_loads(results))
    _finish(figure, axes, impact_s)


def logged_load_history(figure: FigureBase, times_s: np.ndarray, sums_n: np.ndarray, resultants_n: np.ndarray) -> None:
    """Draw the largest sum (k,) and resultant (k,) on any body over the times (k,) of a log."""
    axes = _time_axes(figure, Text("largest load on a body ({})", Unit("kN")), times_s)
    _draw_loads(axes, times_s, sums_n, resultants_n)
    _finish(figure, axes, None)


def _draw_loads(axes: Axes, times_s: np.ndarray, sums_n: np.ndarray, resultants_n: np.ndarray) -> None:
    axes.plot(times_s, sums_n / 1e3, **line_style(0), label=Text("sum of magnitudes"))
    axes.plot(times_s, resultants_n / 1e3, **line_style(1), label=Text("resultant"))


def _largest_loads(results: Results) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest sum of magnitudes (k,) and resultant (k,) on any shard over time."""
    loads = results.frames.loads
    return largest_on_a_shard(results, loads.body_peak_sums_n), largest_on_a_shard(results, loads.body_peaks_n)


def breaking_history(
    figure: FigureBase, times_s: np.ndarray, kinds: Sequence[BreakingByKind], impact_s: float | None
) -> None:
    """Draw over time which share of each kind of connections has cracked or is torn, and the torn share in all."""
    axes = _time_axes(figure, Text("connections cracked or torn (%)"), times_s)
    for number, kind in enumerate(kinds[:_MOST_KINDS]):
        label = plain(Text("{} ({} of {})", kind.kind, kind.broken[-1], kind.count))
        axes.plot(times_s, 100.0 * kind.broken / kind.count, **line_style(number + 1), label=label)
    count = sum(kind.count for kind in kinds)
    broken = np.sum([kind.broken for kind in kinds], axis=0)
    all_of_them: dict[str, Any] = {
        "color": "black",
        "linewidth": 2.5,
        "label": Text("all ({} of {})", broken[-1], count),
    }
    axes.plot(times_s, 100.0 * broken / count, **all_of_them)
    torn = [kind.torn for kind in kinds if kind.torn is not None]
    if len(torn) == len(kinds) and (all_torn := np.sum(torn, axis=0))[-1] < broken[-1]:
        label = Text("torn ({} of {})", all_torn[-1], count)
        axes.plot(times_s, 100.0 * all_torn / count, color="black", linestyle=":", linewidth=2.5, label=label)
    axes.set_ylim(0.0, 105.0)
    _finish(figure, axes, impact_s, columns=3)


def span_heights(figure: FigureBase, times_s: np.ndarray, spans: Sequence[Span], impact_s: float | None) -> None:
    """Draw the height of the centre of mass of every span over time, and of the lowest centre of its shards."""
    axes = _time_axes(figure, Text("height above the ground ({})", Unit("m")), times_s)
    for number, span in enumerate(spans):
        style = line_style(number)
        axes.plot(times_s, span.heights_m, **style, label=plain(Text("{}: centre of mass", span.name)))
        axes.plot(
            times_s, span.lowest_m, **style | {"linewidth": 0.7}, label=plain(Text("{}: lowest shard", span.name))
        )
    highest = max((float(span.heights_m.max()) for span in spans), default=0.0)
    axes.set_ylim(min(0.0, axes.get_ylim()[0]), 1.05 * highest if highest > 0.0 else None)
    _finish(figure, axes, impact_s, columns=2)


def progress_history(figure: FigureBase, times_s: np.ndarray, progress: np.ndarray, impact_s: float | None) -> None:
    """Draw the progress of the collapse over time."""
    axes = _time_axes(figure, Text("progress (%)"), times_s)
    axes.plot(times_s, 100.0 * progress, **line_style(0), label=Text("progress of the collapse"))
    axes.set_ylim(min(0.0, 105.0 * progress.min()), 105.0)
    _finish(figure, axes, impact_s)


def energy_history(figure: FigureBase, energy: Energy, impact_s: float | None) -> None:
    """Draw potential and kinetic energy, and what is lost of them, over time."""
    axes = _time_axes(figure, Text("energy ({})", Unit("MJ")), energy.times_s)
    axes.plot(energy.times_s, energy.potential_j / 1e6, **line_style(0), label=Text("potential"))
    axes.plot(energy.times_s, energy.kinetic_j / 1e6, **line_style(1), label=Text("kinetic"))
    axes.plot(energy.times_s, energy.rotation_j / 1e6, **line_style(3), label=Text("part of it in rotation"))
    axes.plot(energy.times_s, energy.dissipated_j / 1e6, **line_style(2), label=Text("dissipated"))
    _finish(figure, axes, impact_s)


def throw_distribution(figure: FigureBase, throws_m: np.ndarray, masses_kg: np.ndarray) -> None:
    """Draw which share of the debris was thrown farther than a distance, by mass and by number."""
    axes = figure.add_subplot()
    order = np.argsort(throws_m)
    distances = np.concatenate([[0.0], throws_m[order]])
    by_mass = 100.0 * (1.0 - np.concatenate([[0.0], np.cumsum(masses_kg[order])]) / masses_kg.sum())
    by_number = 100.0 * (1.0 - np.arange(len(distances)) / max(len(throws_m), 1))
    axes.step(distances, by_mass, where="post", **line_style(0), label=Text("by mass"))
    axes.step(distances, by_number, where="post", **line_style(1), label=Text("by number of shards"))
    axes.set(xlabel=Text("throw ({})", Unit("m")), ylabel=Text("debris thrown farther (%)"), ylim=(0.0, 102.0))
    axes.set_xlim(left=0.0)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, fontsize=8)


def compared_histories(figure: FigureBase, label: str, histories: Sequence[tuple[str, np.ndarray, np.ndarray]]) -> None:
    """Draw lines of several runs in one chart: of each its name, its times (k,) and its values (k,)."""
    axes = _time_axes(figure, label, np.concatenate([times for _, times, _ in histories]))
    for number, (name, times, values) in enumerate(histories):
        axes.plot(times, values, **line_style(number), label=plain(name))
    _finish(figure, axes, None, columns=2)


def _time_axes(figure: FigureBase, label: str, times_s: np.ndarray) -> Axes:
    axes = figure.add_subplot()
    axes.set(xlabel=Text("time (s)"), ylabel=label)
    last = float(times_s.max(initial=0.0))
    axes.set_xlim(0.0, last if last > 0.0 else 1.0)
    axes.grid(alpha=0.3)
    return axes


def _finish(figure: FigureBase, axes: Axes, impact_s: float | None, columns: int = 2) -> None:
    for line in axes.lines:
        if np.size(line.get_xdata()) == 1:  # a run of one frame has no line to show
            line.set_marker("o")
    if impact_s is not None:
        axes.axvline(impact_s, color="black", linestyle=(0, (1, 1)), linewidth=1.0, label=Text("impact of the ball"))
    if axes.get_ylim()[0] > 0.0:
        axes.set_ylim(bottom=0.0)
    figure.legend(loc="outside lower center", ncols=columns, frameon=False, fontsize=8)


KEY = "bda time axis"
"""Keyword of the text in the picture (PNG) that says where the axis lies."""

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_LENGTH, _NAME, _CHECK = 4, 4, 4
_IMAGE_BEGINS = b"IDAT"


@dataclass(frozen=True, slots=True)
class TimeAxis:
    """Where an axis lies in its picture, as shares of the width from the left, and the times at its ends, s."""

    left: float
    right: float
    begin_s: float
    end_s: float

    @classmethod
    def of(cls, axes: Axes) -> TimeAxis:
        """Return the axis of a chart that is laid out for good."""
        box, (begin_s, end_s) = axes.get_position(), axes.get_xlim()
        return cls(float(box.x0), float(box.x1), float(begin_s), float(end_s))

    @classmethod
    def read(cls, path: Path) -> TimeAxis | None:
        """Return the axis that a picture was written with; None where it has none, or is no picture."""
        try:
            text = _texts(path.read_bytes()).get(KEY)
            return cls(*map(float, text.split())) if text else None
        except (OSError, struct.error, TypeError, ValueError):
            return None

    @property
    def text(self) -> str:
        """The axis as it is kept."""
        return f"{self.left:.6f} {self.right:.6f} {self.begin_s:.6f} {self.end_s:.6f}"

    def time_at(self, share: float) -> float | None:
        """Return the time, s, at a share of the picture's width; None off the axis."""
        if not self.left <= share <= self.right:
            return None
        return self.begin_s + (share - self.left) / (self.right - self.left) * (self.end_s - self.begin_s)


def _texts(picture: bytes) -> dict[str, str]:
    """Return the texts of a PNG by their keywords, up to where its pixels begin."""
    found, begin = {}, len(_SIGNATURE)
    if not picture.startswith(_SIGNATURE):
        return {}
    while begin + _LENGTH + _NAME <= len(picture):
        length, name = struct.unpack_from(">I4s", picture, begin)
        if name == _IMAGE_BEGINS:
            break
        first = begin + _LENGTH + _NAME
        if name == b"tEXt":
            keyword, _, text = picture[first : first + length].partition(b"\0")
            found[keyword.decode("latin-1")] = text.decode("latin-1")
        begin = first + length + _CHECK
    return found


_PERIODS_S = 0.05 * 80.0 ** np.linspace(0.0, 1.0, 120)


def moving_directions(record: GroundRecord) -> list[int]:
    """Return the axes along which the ground moves."""
    return np.flatnonzero(record.accelerations_m_s2.any(axis=0)).tolist()


def ground_motion_history(figure: FigureBase, record: GroundRecord, start_s: float) -> None:
    """Draw how the ground is accelerated, how fast it is and where, over the time of the run."""
    rows = figure.subplots(3, 1, sharex=True)
    quantities = (
        (Text("acceleration ({})", Unit("m/s²")), record.accelerations_m_s2),
        (Text("velocity ({})", Unit("m/s")), record.velocities_m_s),
        (Text("displacement ({})", Unit("m")), record.displacements_m),
    )
    for axes, (label, values) in zip(rows, quantities, strict=True):
        for number, axis in enumerate(moving_directions(record)):
            axes.plot(start_s + record.times_s, values[:, axis], **line_style(number, 0.9), label=DIRECTIONS[axis])
        axes.set_ylabel(label)
        axes.grid(color="0.9", linewidth=0.5)
        axes.set_axisbelow(True)
    rows[-1].set_xlabel(Text("time (s)"))
    rows[0].legend(frameon=False, ncols=3, loc="lower right", bbox_to_anchor=(1.0, 0.98), borderaxespad=0.2)


def response_spectra(figure: FigureBase, record: GroundRecord, wanted: DesignSpectrum | None, factor: float) -> None:
    """Draw the response spectrum of a record for 5 % damping, and the one that it was made from, times a factor."""
    axes = figure.subplots()
    step_s = float(np.diff(record.times_s).min())
    times = np.arange(0.0, record.duration_s, step_s)
    for number, axis in enumerate(moving_directions(record)):
        even = np.interp(times, record.times_s, record.accelerations_m_s2[:, axis])
        spectrum = response_spectrum(even, step_s, _PERIODS_S)
        axes.semilogx(_PERIODS_S, spectrum, **line_style(number), label=DIRECTIONS[axis])
    if wanted:
        shape = factor * design_spectrum(wanted, _PERIODS_S)
        axes.semilogx(_PERIODS_S, shape, color="0.5", linewidth=2.5, label="EN 1998-1, 5 %")
    axes.set_xlabel(Text("period (s)"))
    axes.set_ylabel(Text("largest acceleration ({})", Unit("m/s²")))
    axes.grid(color="0.9", linewidth=0.5, which="both")
    axes.set_axisbelow(True)
    axes.legend(frameon=False)
