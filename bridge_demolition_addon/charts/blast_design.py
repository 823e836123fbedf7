"""Charts to choose charges by: Figures 10 to 14 of the report of 2019, drawn from corrected formulas.

Every chart is its own figure and returns it; `write_charts` saves them all. Lines differ by dashes and weight, and
maps by lightness, so that all can be read in black and white.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from ..engineering.blast.charge_sizing import smallest_charge_for_overpressure
from ..engineering.blast.pulses import BlastModel, Pulses, blast_pulses, blast_wave, pressure_at
from ..engineering.blast.wave import AMBIENT_PRESSURE_PA, Burst
from ..errors import OutputError
from ..model.blast.charges import Charge
from ..model.blast.receptors import distinct_thresholds, ring_radii
from ..system.disk import whole_file
from .style import blank_figure, lay_out

SPAN_M = 20.0
PIERS = (("left end", -SPAN_M), ("mid pier", 0.0), ("right end", SPAN_M))
PIER_CHARGE_KG = 1000.0
"""The example of Figures 13 and 14: two spans of 20 m, with 1000 kg of TNT at both ends and at the mid pier."""

PULSE_CHARGE_KG = 10_000.0
"""Charge of Figure 10."""

PULSE_SCALED_DISTANCES = (2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0)
_LARGEST_DRAWN_KG = 100_000.0
FARTHEST_M = 50.0
"""Charges and distances of Figure 11."""

TARGETS_PA = (6.9e3, 15.8e3, 34.5e3, 68.9e3, 200e3, 500e3, 1e6)
"""Overpressures of Figure 12: four thresholds of damage, and three nearer to the charge."""

SMALLEST_SHADE_PA = 1e4
"""Overpressure that is still white on the map over time; black is a thousand times as much."""

NEAR_RINGS_PA = 15e3
"""Rings of less overpressure are left out of the plan near the charges."""

_LINES: tuple[dict[str, Any], ...] = tuple(
    {"color": shade, "linestyle": dash, "linewidth": width_pt}
    for shade, dash, width_pt in (
        ("0.0", "-", 1.6),
        ("#2166ac", "--", 1.6),
        ("#b2182b", "-.", 1.6),
        ("0.35", ":", 1.6),
        ("#542788", (0, (6, 1, 1, 1, 1, 1)), 1.6),
        ("#b35806", (0, (10, 2)), 1.6),
        ("0.65", "-", 3.5),
        ("0.0", (0, (1, 3)), 1.6),
    )
)
"""Looks of lines: they differ without colour, too."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChartSettings:
    """How the charts are drawn; by default with the charges of the report of 2019."""

    model: BlastModel = BlastModel.KINGERY_BULMASH
    burst: Burst = Burst.AIR
    as_ratio: bool = False  # overpressures over ambient pressure, as in the report, not in kPa
    scaled: bool = False  # distances and times over W^(1/3)
    pulse_charge_kg: float = PULSE_CHARGE_KG
    pier_charge_kg: float = PIER_CHARGE_KG

    @property
    def pier_charges(self) -> tuple[Charge, ...]:
        """The charges of the two-span bridge."""
        return tuple(
            Charge(name=name, position_m=(x, 0.0, 0.0), mass_kg=self.pier_charge_kg, burst=self.burst)
            for name, x in PIERS
        )

    @property
    def pressure_unit_pa(self) -> float:
        """Unit of the pressure axes, Pa."""
        return AMBIENT_PRESSURE_PA if self.as_ratio else 1e3

    @property
    def pressure_label(self) -> str:
        """Label of the pressure axes."""
        return "overpressure / ambient pressure" if self.as_ratio else "overpressure (kPa)"

    @property
    def time_label(self) -> str:
        """Label of the time axes."""
        return "time / W$^{1/3}$ (ms/kg$^{1/3}$)" if self.scaled else "time since the detonation (ms)"

    @property
    def source(self) -> str:
        """Where the numbers come from, for the titles."""
        names = {BlastModel.KINGERY_BULMASH: "Kingery-Bulmash", BlastModel.KINNEY_GRAHAM: "Kinney-Graham"}
        return f"{names[self.model]}, {self.burst} burst"


def pressure_over_time(settings: ChartSettings) -> Figure:
    """Figure 10: the pulse of a large charge as it passes at several distances."""
    figure, axes = _figure()
    cube_root = np.cbrt(settings.pulse_charge_kg)
    distances = np.array(PULSE_SCALED_DISTANCES)
    stand_offs = distances[:, None] * cube_root
    pulses = blast_pulses(stand_offs, [settings.pulse_charge_kg], [0.0], [settings.burst], model=settings.model)
    times = pulses.arrivals_s + pulses.durations_s * np.linspace(0.0, 1.0, 200)
    pressures = pressure_at(pulses, times) / settings.pressure_unit_pa
    time_unit = cube_root * 1e-3 if settings.scaled else 1e-3
    for z, time, pressure, style in zip(distances, times, pressures, _LINES, strict=False):
        label = f"Z = {z:g} m/kg$^{{1/3}}$" if settings.scaled else f"{_plain(z * cube_root)} m (Z = {z:g})"
        # Up the front first, which takes no time.
        axes.plot(np.append(time[0], time) / time_unit, np.append(0.0, pressure), label=label, **style)
    axes.set_title(f"Pulses of {settings.pulse_charge_kg:,.10g} kg of TNT as they pass\n{settings.source}")
    axes.set(xlabel=settings.time_label, ylabel=settings.pressure_label)
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend(title="scaled distance" if settings.scaled else "distance", frameon=False)
    return figure


def overpressure_contours(settings: ChartSettings) -> Figure:
    """Figure 11: lines of equal peak overpressure over distance and charge; one curve over scaled distance."""
    if settings.scaled:
        return _overpressure_over_scaled_distance(settings)
    figure, axes = _figure()
    axes.set(xlabel="distance (m)", ylabel="charge (kg of TNT)", xscale="log", yscale="log")
    distances = np.geomspace(1.0, FARTHEST_M, 300)
    charges = np.geomspace(1.0, _LARGEST_DRAWN_KG, 300)
    wave = blast_wave(distances, charges[:, None], settings.burst, settings.model)
    peaks = wave.peak_overpressure_pa / settings.pressure_unit_pa
    levels = _levels(peaks)
    axes.contourf(distances, charges, peaks, levels, norm=LogNorm(), cmap="Greys", alpha=0.35, extend="both")
    lines = axes.contour(distances, charges, peaks, levels, colors="black", linewidths=0.9)
    axes.clabel(lines, fmt=_plain, fontsize=8, manual=_across(distances, charges, peaks, levels))
    axes.set_title(f"Peak {settings.pressure_label}\n{settings.source}")
    _label_plainly(axes)
    return figure


def _overpressure_over_scaled_distance(settings: ChartSettings) -> Figure:
    """All charges fall on one curve over scaled distance, with the thresholds of damage on it."""
    figure, axes = _figure()
    distances = np.geomspace(0.1, 100.0, 400)
    wave, unit_pa = blast_wave(distances, 1.0, settings.burst, settings.model), settings.pressure_unit_pa
    axes.loglog(distances, wave.peak_overpressure_pa / unit_pa, color="black", label="incident")
    axes.loglog(distances, wave.reflected_overpressure_pa / unit_pa, "--", color="black", label="reflected")
    for threshold in distinct_thresholds():
        level = threshold.overpressure_pa / unit_pa
        axes.axhline(level, color="0.5", linewidth=0.6, linestyle=":")
        axes.text(0.105, level, threshold.damage, fontsize=7, va="bottom")
    axes.set_title(f"Peak overpressure of any charge\n{settings.source}")
    axes.set(xlabel="scaled distance Z (m/kg$^{1/3}$)", ylabel=f"peak {settings.pressure_label}", xmargin=0.0)
    _label_plainly(axes)
    axes.legend(frameon=False)
    return figure


def charge_for_overpressure(settings: ChartSettings) -> Figure:
    """Figure 12: the smallest charge for a peak overpressure over real distances: scaled ones leave no choice."""
    figure, axes = _figure()
    distances = np.geomspace(1.0, 200.0, 100)
    for target, style in zip(TARGETS_PA, _LINES, strict=False):
        at_one_metre = smallest_charge_for_overpressure(target, 1.0, settings.burst, settings.model)
        label = _plain(target / settings.pressure_unit_pa)
        axes.loglog(distances, at_one_metre * distances**3, label=label, **style)
    axes.set_title(f"Smallest charge for a peak overpressure\n{settings.source}")
    axes.set(xlabel="distance (m)", ylabel="charge (kg of TNT)", xmargin=0.0, ylim=(1e-2, 1e6))
    _label_plainly(axes)
    handles, labels = axes.get_legend_handles_labels()
    title = f"peak {settings.pressure_label}".replace(" / ", " /\n").replace(" (", "\n(")
    figure.legend(handles[::-1], labels[::-1], title=title, loc="outside right center", frameon=False)
    return figure


def two_span_charges(settings: ChartSettings) -> Figure:
    """Figure 13: the peak overpressure of each charge along the bridge."""
    figure, axes = _figure()
    positions = _along_the_spans()
    peaks = _pulses_along_bridge(positions, settings).peaks_pa
    for charge, peak, style in zip(settings.pier_charges, peaks.T, _LINES, strict=False):
        axes.semilogy(positions / _scale(settings), peak / settings.pressure_unit_pa, label=charge.name, **style)
    _finish_bridge_chart(figure, axes, settings, "Peak overpressure of each charge")
    return figure


def two_span_total(settings: ChartSettings) -> Figure:
    """Figure 14: the sum of the peaks along the bridge, and what is there at any one time."""
    figure, axes = _figure()
    positions = _along_the_spans()
    pulses = _pulses_along_bridge(positions, settings)
    # The pressure can only be largest when a front has just arrived.
    at_arrivals = [pressure_at(pulses, arrivals[:, None]).sum(axis=1) for arrivals in pulses.arrivals_s.T]
    unit, along = settings.pressure_unit_pa, positions / _scale(settings)
    axes.semilogy(along, pulses.peaks_pa.sum(axis=1) / unit, "--", color="black", label="sum of the peaks, as in 2019")
    axes.semilogy(along, np.max(at_arrivals, axis=0) / unit, "-", color="#b2182b", label="largest sum at one time")
    _finish_bridge_chart(figure, axes, settings, "Peak overpressure of all charges")
    return figure


def two_span_over_time(settings: ChartSettings) -> Figure:
    """The overpressure along the bridge as time goes on: where the waves run and meet."""
    figure, axes = _figure()
    positions = _along_the_spans()
    pulses = _pulses_along_bridge(positions, settings)
    meeting_s = pulses.arrivals_s.min(axis=1).max()
    times = np.linspace(0.0, 2.5 * meeting_s, 700)
    pressures = np.array([pressure_at(pulses, time).sum(axis=1) for time in times]) / settings.pressure_unit_pa
    smallest = SMALLEST_SHADE_PA / settings.pressure_unit_pa
    image = axes.pcolormesh(
        positions / _scale(settings),
        1e3 * times / _scale(settings),
        np.maximum(pressures, smallest),
        norm=LogNorm(smallest, 1e3 * smallest),
        cmap="Greys",
        shading="auto",
        rasterized=True,
    )
    bar = figure.colorbar(image, ax=axes, extend="both", label=settings.pressure_label)
    bar.formatter = PLAIN
    axes.set_title(f"Overpressure of all charges over time\n{_bridge_text(settings)}\n{settings.source}")
    axes.set(xlabel=_along_bridge(settings), ylabel=settings.time_label)
    return figure


def rings_on_plan(charges: Sequence[Charge], settings: ChartSettings, title: str) -> Figure:
    """Plan of charges with the rings of damage at the first one's level: all of them, and those near the charges."""
    figure = _blank_figure(11.0, 7.0)
    thresholds = distinct_thresholds()
    radii = ring_radii(charges, charges[0].position_m[2], thresholds, settings.model)
    positions = np.array([charge.position_m[:2] for charge in charges])
    for axes, nearest in zip(figure.subplots(1, 2), (0.0, NEAR_RINGS_PA), strict=True):
        for threshold, row, style in zip(thresholds, radii, _LINES, strict=True):
            if threshold.overpressure_pa >= nearest:
                label = f"{_plain(threshold.overpressure_pa / settings.pressure_unit_pa)}: {threshold.damage}"
                axes.plot(*_circles(positions, row), label=label, **style)
        axes.plot(*positions.T, "k+", label="charge")
        axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
        axes.set_title("near the charges" if nearest else "all rings", fontsize=10)
        axes.grid(alpha=0.3)
    handles, labels = figure.axes[0].get_legend_handles_labels()
    looks: dict[str, Any] = {"loc": "outside lower center", "ncols": 2, "frameon": False, "fontsize": 9}
    figure.legend(handles, labels, title=f"peak {settings.pressure_label}", **looks)
    figure.suptitle(f"{title}\n{settings.source}", parse_math=False)
    return figure


def two_span_rings(settings: ChartSettings) -> Figure:
    """Plan view of the two-span bridge with the rings of its charges."""
    return rings_on_plan(settings.pier_charges, settings, f"Reach of each charge on plan\n{_bridge_text(settings)}")


CHARTS: dict[str, Callable[[ChartSettings], Figure]] = {
    "pressure_over_time": pressure_over_time,
    "overpressure_contours": overpressure_contours,
    "charge_for_overpressure": charge_for_overpressure,
    "two_span_charges": two_span_charges,
    "two_span_total": two_span_total,
    "two_span_over_time": two_span_over_time,
    "two_span_rings": two_span_rings,
}
"""The charts by the names of their pictures."""


def write_charts(
    folder: Path, settings: ChartSettings, drawn: Callable[[int, int], None] = lambda *_: None
) -> list[Path]:
    """Draw all charts into a folder, made if new, and return their paths; `drawn` gets the number so far and in all."""
    paths = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, draw in CHARTS.items():
            paths.append(folder / f"{name}.png")
            figure = draw(settings)
            lay_out(figure)
            with whole_file(paths[-1]) as part:
                figure.savefig(part)
            drawn(len(paths), len(CHARTS))
    except OSError as error:
        raise OutputError(f"{folder}: charts cannot be written: {error.strerror or error}") from error
    return paths


def _figure() -> tuple[Figure, Axes]:
    figure = _blank_figure(8.0, 5.5)
    axes = figure.add_subplot()
    axes.grid(alpha=0.3)
    return figure, axes


def _blank_figure(width_in: float, height_in: float) -> Figure:
    figure = blank_figure(width_in, height_in, dpi=120)
    figure.set_layout_engine("constrained", w_pad=0.15, h_pad=0.1)
    return figure


def _levels(values: np.ndarray) -> np.ndarray:
    """Round levels, 1, 2 and 5 in every decade, within the values."""
    decades = np.arange(np.floor(np.log10(values.min())), np.ceil(np.log10(values.max())))
    levels = np.outer(10.0**decades, (1.0, 2.0, 5.0)).ravel()
    return levels[(levels > values.min()) & (levels < values.max())]


def _across(distances: np.ndarray, charges: np.ndarray, peaks: np.ndarray, levels: np.ndarray) -> np.ndarray:
    """Places (k, 2) where the diagonal from much charge nearby to little far away crosses the levels (k,)."""
    falling = peaks[::-1].diagonal()
    steps = np.interp(-np.log(levels), -np.log(falling), np.arange(len(falling))).round().astype(int)
    return np.column_stack((distances[steps], charges[::-1][steps]))


def _plain(value: float) -> str:
    """A number in three digits, large ones without powers of ten."""
    return f"{value:,.0f}" if value >= 1000.0 else f"{value:.3g}"


PLAIN = FuncFormatter(lambda value, _: _plain(value))


def _label_plainly(axes: Axes) -> None:
    """Logarithmic axes with numbers in full at each decade, and at 2 and 5 where there are few decades."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        if axis.get_scale() == "log":
            steps = (1.0, 2.0, 5.0) if high < 1e3 * low else (1.0,)
            axis.set_major_locator(LogLocator(subs=steps, numticks=20))
            axis.set_major_formatter(PLAIN)
            axis.set_minor_formatter(NullFormatter())


def _circles(positions: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Circles round positions (c, 2) as one line, with gaps between them."""
    angles = np.append(np.linspace(0.0, 2.0 * np.pi, 181), np.nan)
    x = positions[:, :1] + radii[:, None] * np.cos(angles)
    y = positions[:, 1:] + radii[:, None] * np.sin(angles)
    return x.ravel(), y.ravel()


def _scale(settings: ChartSettings) -> float:
    """Divisor of distances along the bridge, and of times there."""
    return float(np.cbrt(settings.pier_charge_kg)) if settings.scaled else 1.0


def _bridge_text(settings: ChartSettings) -> str:
    return f"two spans of {SPAN_M:g} m, {settings.pier_charge_kg:,.10g} kg of TNT at both ends and the mid pier"


def _along_bridge(settings: ChartSettings) -> str:
    return "distance from the mid pier / W$^{1/3}$ (m/kg$^{1/3}$)" if settings.scaled else "distance from mid pier (m)"


def _along_the_spans() -> np.ndarray:
    """Places from end to end, m from the mid pier."""
    return np.linspace(-SPAN_M, SPAN_M, 801)


def _pulses_along_bridge(positions_m: np.ndarray, settings: ChartSettings) -> Pulses:
    charges = settings.pier_charges
    stand_offs = abs(positions_m[:, None] - [charge.position_m[0] for charge in charges])
    masses, delays = [charge.tnt_kg for charge in charges], [charge.delay_s for charge in charges]
    return blast_pulses(stand_offs, masses, delays, [charge.burst for charge in charges], model=settings.model)


def _finish_bridge_chart(figure: Figure, axes: Axes, settings: ChartSettings, title: str) -> None:
    axes.set_title(f"{title}\n{_bridge_text(settings)}\n{settings.source}")
    axes.set(xlabel=_along_bridge(settings), ylabel=f"peak {settings.pressure_label}", xmargin=0.0)
    _label_plainly(axes)
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
