"""Charts to choose charges by: Figures 10 to 14 of the report of 2019, drawn anew from formulas put right.

Every chart is its own figure and returns it; `write_charts` saves them all. Lines differ by dashes and weight, and
maps by lightness, so that all can be read in black and white.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from matplotlib.ticker import FuncFormatter, LogLocator

from ..core.blast.air import AMBIENT_PRESSURE_PA
from ..core.blast.charges import Charge, ChargeArrays
from ..core.blast.damage import THRESHOLDS, ring_radii
from ..core.blast.design import smallest_charge_for_overpressure
from ..core.blast.models import BlastModel, blast_wave
from ..core.blast.projection import lines_of_blast
from ..core.blast.pulses import Pulses, blast_pulses, pressure_at
from ..core.blast.wave import Burst
from ..core.errors import OutputError

SPAN_M = 20.0
TWO_SPAN_BRIDGE = tuple(
    Charge(name=name, place_m=(x, 0.0, 0.0), mass_kg=1000.0)
    for name, x in (("left end", -SPAN_M), ("mid pier", 0.0), ("right end", SPAN_M))
)
"""The example of Figures 13 and 14: two spans of 20 m, with 1000 kg of TNT at both ends and at the mid pier."""

PULSE_CHARGE_KG = 10_000.0
"""Charge of Figure 10."""

PULSE_SCALED_DISTANCES = (2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0)
LARGEST_CHARGE_KG = 100_000.0
FARTHEST_M = 50.0
"""Reach of Figure 11."""

TARGETS_PA = (6.9e3, 15.8e3, 34.5e3, 68.9e3, 200e3, 500e3, 1e6)
"""Overpressures of Figure 12: four thresholds of damage, and three that break concrete."""

NEAREST_ON_BRIDGE_M = 1.0
"""The overpressure is not drawn nearer to a charge than this: it goes up a hundredfold, and into its craters."""

_DASHES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (10, 2)), (0, (3, 2)))
_SHADES = ("0.0", "#2166ac", "#b2182b", "0.35", "#542788", "#b35806", "#1b7837")


@dataclass(frozen=True, slots=True, kw_only=True)
class ChartSettings:
    """How the charts are drawn.

    Attributes
    ----------
    model, burst
        Where the waves come from, and where the charges detonate.
    as_ratio
        Overpressures as a ratio to ambient pressure, like in the report, instead of in kPa.
    scaled
        Distances and times divided by W^(1/3) instead of real ones.
    """

    model: BlastModel = BlastModel.KINGERY_BULMASH
    burst: Burst = Burst.AIR
    as_ratio: bool = False
    scaled: bool = False

    @property
    def pressure_unit_pa(self) -> float:
        """What the unit of the pressure axes is in Pa."""
        return AMBIENT_PRESSURE_PA if self.as_ratio else 1e3

    @property
    def pressure_label(self) -> str:
        """Unit of the pressure axes, in words."""
        return "overpressure / ambient pressure" if self.as_ratio else "overpressure (kPa)"

    @property
    def source(self) -> str:
        """Where the numbers come from, for the titles."""
        names = {BlastModel.KINGERY_BULMASH: "Kingery-Bulmash", BlastModel.KINNEY_GRAHAM: "Kinney-Graham"}
        return f"{names[self.model]}, {self.burst} burst"


def pressure_over_time(settings: ChartSettings) -> Figure:
    """Figure 10: the pulse of a large charge as it passes at several distances."""
    figure, axes = _figure()
    cube_root = np.cbrt(PULSE_CHARGE_KG)
    distances = np.array(PULSE_SCALED_DISTANCES)
    stand_offs = distances[:, None] * cube_root
    pulses = blast_pulses(stand_offs, [PULSE_CHARGE_KG], [0.0], [settings.burst], model=settings.model)
    time_unit = cube_root * 1e-3 if settings.scaled else 1e-3
    for row, (z, style) in enumerate(zip(distances, _line_styles(), strict=False)):
        arrival, end = pulses.arrivals_s[row, 0], pulses.ends_s[row, 0]
        times = np.linspace(arrival, end, 200)
        pressures = np.array([pressure_at(pulses, time)[row, 0] for time in times])
        pressures[-1] = 0.0
        label = f"Z = {z:g} m/kg$^{{1/3}}$" if settings.scaled else f"{z * cube_root:.0f} m (Z = {z:g})"
        times, pressures = np.append(arrival, times) / time_unit, np.append(0.0, pressures)
        axes.plot(times, pressures / settings.pressure_unit_pa, label=label, **style)
    axes.set_title(f"Pulses of {PULSE_CHARGE_KG:,.0f} kg of TNT as they pass\n{settings.source}")
    axes.set_xlabel("time / W$^{1/3}$ (ms/kg$^{1/3}$)" if settings.scaled else "time since the detonation (ms)")
    axes.set_ylabel(settings.pressure_label)
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend(title="scaled distance" if settings.scaled else "distance", frameon=False)
    return figure


def overpressure_contours(settings: ChartSettings) -> Figure:
    """Figure 11: lines of equal peak overpressure over distance and charge; one curve over scaled distance."""
    if settings.scaled:
        return _overpressure_over_scaled_distance(settings)
    figure, axes = _figure()
    distances = np.linspace(1.0, FARTHEST_M, 300)
    charges = np.linspace(100.0, LARGEST_CHARGE_KG, 300)
    wave = blast_wave(distances, charges[:, None], settings.burst, settings.model)
    ratios = wave.peak_overpressure_pa / settings.pressure_unit_pa
    levels = _levels(ratios[:, distances > 0.1 * FARTHEST_M])
    axes.contourf(distances, charges / 1e3, ratios, levels, norm=LogNorm(), cmap="Greys", alpha=0.35, extend="both")
    lines = axes.contour(distances, charges / 1e3, ratios, levels, colors="black", linewidths=0.9)
    axes.clabel(lines, fmt=_plain, fontsize=8)
    axes.set_title(f"Peak {settings.pressure_label}\n{settings.source}")
    axes.set(xlabel="distance (m)", ylabel="charge (t of TNT)")
    return figure


def _overpressure_over_scaled_distance(settings: ChartSettings) -> Figure:
    """All charges fall on one curve over scaled distance, with the thresholds of damage on it."""
    figure, axes = _figure()
    distances = np.geomspace(0.1, 100.0, 400)
    wave = blast_wave(distances, 1.0, settings.burst, settings.model)
    axes.loglog(distances, wave.peak_overpressure_pa / settings.pressure_unit_pa, color="black", label="incident")
    axes.loglog(
        distances, wave.reflected_overpressure_pa / settings.pressure_unit_pa, "--", color="black", label="reflected"
    )
    for threshold in _distinct_thresholds():
        level = threshold.overpressure_pa / settings.pressure_unit_pa
        axes.axhline(level, color="0.5", linewidth=0.6, linestyle=":")
        axes.text(0.105, level, threshold.damage, fontsize=7, va="bottom")
    axes.set_title(f"Peak overpressure of any charge\n{settings.source}")
    axes.set(xlabel="scaled distance Z (m/kg$^{1/3}$)", ylabel=f"peak {settings.pressure_label}", xmargin=0.0)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: _plain(value)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: _plain(value)))
    axes.legend(frameon=False)
    return figure


def charge_for_overpressure(settings: ChartSettings) -> Figure:
    """Figure 12: the smallest charge that gives a wanted peak overpressure at a distance.

    Over real distances in any case: over scaled ones there is no charge left to choose.
    """
    figure, axes = _figure()
    distances = np.geomspace(1.0, 200.0, 100)
    for target, style in zip(TARGETS_PA, _line_styles(), strict=False):
        at_one_metre = smallest_charge_for_overpressure(target, 1.0, settings.burst, settings.model)
        label = f"{_plain(target / settings.pressure_unit_pa)}"
        axes.loglog(distances, at_one_metre * distances**3, label=label, **style)
    axes.set_title(f"Smallest charge for a peak overpressure\n{settings.source}")
    axes.set(xlabel="distance (m)", ylabel="charge (kg of TNT)", xmargin=0.0, ylim=(1e-2, 1e6))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: _plain(value)))
    axes.yaxis.set_major_locator(LogLocator(numticks=12))
    handles, labels = axes.get_legend_handles_labels()
    title = f"peak {settings.pressure_label}".replace(" / ", " /\n").replace(" (", "\n(")
    figure.legend(handles[::-1], labels[::-1], title=title, loc="outside right center", frameon=False)
    return figure


def two_span_charges(settings: ChartSettings) -> Figure:
    """Figure 13: the peak overpressure of each charge along the bridge."""
    figure, axes = _figure()
    places, peaks = _peaks_along_bridge(settings)
    for charge, peak, style in zip(TWO_SPAN_BRIDGE, peaks.T, _line_styles(), strict=False):
        axes.semilogy(places, peak / settings.pressure_unit_pa, label=charge.name, **style)
    _finish_bridge_chart(figure, axes, settings, "Peak overpressure of each charge")
    return figure


def two_span_total(settings: ChartSettings) -> Figure:
    """Figure 14: the sum of the peaks along the bridge, and what is there at any one time."""
    figure, axes = _figure()
    places, peaks = _peaks_along_bridge(settings)
    pulses = _pulses_along_bridge(places, settings)
    # The pressure can only be largest when a front has just arrived.
    at_arrivals = [_pressures_at(pulses, pulses.arrivals_s[:, column]) for column in range(len(TWO_SPAN_BRIDGE))]
    unit = settings.pressure_unit_pa
    axes.semilogy(places, peaks.sum(axis=1) / unit, "--", color="0.0", label="sum of the peaks, as in 2019")
    axes.semilogy(places, np.max(at_arrivals, axis=0) / unit, "-", color="#b2182b", label="largest sum at one time")
    _finish_bridge_chart(figure, axes, settings, "Peak overpressure of all charges")
    return figure


def two_span_over_time(settings: ChartSettings) -> Figure:
    """The overpressure along the bridge as time goes on: where the waves run and meet."""
    figure, axes = _figure()
    cube_root = _bridge_cube_root() if settings.scaled else 1.0
    places = np.linspace(-SPAN_M, SPAN_M, 801)
    pulses = _pulses_along_bridge(places, settings)
    times = np.linspace(0.0, 1.05 * pulses.arrivals_s.min(axis=1).max() * 2.5, 700)
    pressures = np.array([pressure_at(pulses, time).sum(axis=1) for time in times]) / settings.pressure_unit_pa
    smallest = 10.0 / (settings.pressure_unit_pa / 1e3)
    image = axes.pcolormesh(
        places / cube_root,
        1e3 * times / cube_root,
        np.maximum(pressures, smallest),
        norm=LogNorm(smallest, 1e3 * smallest),
        cmap="Greys",
        shading="auto",
        rasterized=True,
    )
    bar = figure.colorbar(image, ax=axes, extend="both", label=settings.pressure_label)
    bar.formatter = FuncFormatter(lambda value, _: _plain(value))
    axes.set_title(f"Overpressure of all charges over time\n{_bridge_in_words()}\n{settings.source}")
    axes.set_xlabel(_along_bridge(settings))
    axes.set_ylabel("time / W$^{1/3}$ (ms/kg$^{1/3}$)" if settings.scaled else "time since the detonation (ms)")
    return figure


def rings_on_plan(charges: Sequence[Charge], settings: ChartSettings, title: str) -> Figure:
    """Plan view of charges with the rings within which thresholds of damage are reached at the charges' level."""
    figure, axes = _figure()
    thresholds = _distinct_thresholds()
    radii = ring_radii(charges, charges[0].place_m[2], thresholds, settings.model)
    for threshold, row, style in zip(thresholds, radii, cycle(_line_styles()), strict=False):
        label = f"{_plain(threshold.overpressure_pa / settings.pressure_unit_pa)}: {threshold.damage}"
        for charge, radius in zip(charges, row, strict=True):
            axes.add_patch(Circle(charge.place_m[:2], radius, fill=False, label=label, **style))
            label = None
    axes.plot(*np.array([charge.place_m[:2] for charge in charges]).T, "k+", label="charge")
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_title(f"{title}\n{settings.source}", parse_math=False)
    axes.set(xlabel="x (m)", ylabel="y (m)")
    legend = figure.legend(loc="outside right center", frameon=False, fontsize=8)
    legend.set_title(f"peak {settings.pressure_label}")
    return figure


def two_span_rings(settings: ChartSettings) -> Figure:
    """Plan view of the two-span bridge with the rings of its charges."""
    charges = [
        Charge(name=charge.name, place_m=charge.place_m, mass_kg=charge.mass_kg, burst=settings.burst)
        for charge in TWO_SPAN_BRIDGE
    ]
    return rings_on_plan(charges, settings, f"Reach of each charge on plan\n{_bridge_in_words()}")


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


def write_charts(folder: Path, settings: ChartSettings) -> list[Path]:
    """Draw all charts into a folder, which is made if it is new, and return their paths.

    Raises
    ------
    OutputError
        The folder or a picture cannot be written.
    """
    paths = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, draw in CHARTS.items():
            paths.append(folder / f"{name}.png")
            draw(settings).savefig(paths[-1])
    except OSError as error:
        raise OutputError(f"{folder}: charts cannot be written: {error.strerror or error}") from error
    return paths


def _figure() -> tuple[Figure, Axes]:
    # A figure of its own: pyplot would set up a window system inside Blender and keep every figure alive.
    figure = Figure(figsize=(8.0, 5.5), dpi=120, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.grid(alpha=0.3)
    return figure, axes


def _line_styles() -> list[dict]:
    return [
        {"color": shade, "linestyle": dash, "linewidth": 1.6} for shade, dash in zip(_SHADES, _DASHES, strict=True)
    ]


def _levels(values: np.ndarray) -> np.ndarray:
    """Round levels, 1, 2 and 5 in every decade, within the values."""
    decades = np.arange(np.floor(np.log10(values.min())), np.ceil(np.log10(values.max())))
    levels = np.outer(10.0**decades, (1.0, 2.0, 5.0)).ravel()
    return levels[(levels > values.min()) & (levels < values.max())]


def _plain(value: float) -> str:
    """A number in three digits and never in powers of ten."""
    return f"{value:,.0f}" if value >= 1000.0 else f"{value:.3g}" if value >= 1e-4 else f"{value:f}".rstrip("0")


def _distinct_thresholds() -> list:
    """The thresholds, without those of the same overpressure as one before."""
    return list({threshold.overpressure_pa: threshold for threshold in reversed(THRESHOLDS)}.values())[::-1]


def _bridge_cube_root() -> float:
    return float(np.cbrt(TWO_SPAN_BRIDGE[0].tnt_kg))


def _bridge_in_words() -> str:
    return f"two spans of {SPAN_M:g} m, {TWO_SPAN_BRIDGE[0].mass_kg:g} kg of TNT at both ends and the mid pier"


def _along_bridge(settings: ChartSettings) -> str:
    return "distance from the mid pier / W$^{1/3}$ (m/kg$^{1/3}$)" if settings.scaled else "distance from mid pier (m)"


def _pulses_along_bridge(places_m: np.ndarray, settings: ChartSettings) -> Pulses:
    arrays = ChargeArrays.of(TWO_SPAN_BRIDGE)
    points = np.column_stack((places_m, np.zeros((len(places_m), 2))))
    stand_offs, _ = lines_of_blast(arrays.places_m, points)
    bursts = [settings.burst] * len(TWO_SPAN_BRIDGE)
    return blast_pulses(stand_offs, arrays.tnt_kg, arrays.delays_s, bursts, model=settings.model)


def _peaks_along_bridge(settings: ChartSettings) -> tuple[np.ndarray, np.ndarray]:
    """Places along the bridge, m, and the peak of each charge there, Pa; gaps where a charge is too near."""
    places = np.linspace(-SPAN_M, SPAN_M, 801)
    peaks = _pulses_along_bridge(places, settings).peaks_pa
    return places, peaks


def _pressures_at(pulses: Pulses, times_s: np.ndarray) -> np.ndarray:
    """Sum of the pressures on every body (n,) at its own time (n,), Pa."""
    rows = [
        Pulses(pulses.arrivals_s[[row]], pulses.peaks_pa[[row]], pulses.durations_s[[row]], pulses.decays[[row]])
        for row in range(len(times_s))
    ]
    return np.array([pressure_at(row, time).sum() for row, time in zip(rows, times_s, strict=True)])


def _finish_bridge_chart(figure: Figure, axes: Axes, settings: ChartSettings, title: str) -> None:
    cube_root = _bridge_cube_root() if settings.scaled else 1.0
    for line in axes.lines:
        line.set_xdata(np.asarray(line.get_xdata()) / cube_root)
    axes.relim()
    axes.autoscale_view()
    axes.set_title(f"{title}\n{_bridge_in_words()}\n{settings.source}")
    axes.set(xlabel=_along_bridge(settings), ylabel=f"peak {settings.pressure_label}", xmargin=0.0)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: _plain(value)))
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
