"""Blast in plan and over time: overpressure on the ground with rings of damage, and pressure at neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill

import numpy as np
from manifold3d import CrossSection
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import FigureBase

from ..engineering.blast.pulses import BlastModel
from ..engineering.terrain.surface import RecordedGround
from ..model.blast.charges import Charge
from ..model.blast.receptors import PlaceLoads, distinct_thresholds, peak_overpressures, ring_radii
from ..model.scenario import Neighbour
from ..texts import Quantity, Text, Unit
from .plan_maps import LEVEL_GROUND, draw_area, draw_ground
from .style import line_style, plain

_CELLS = 240
_NAME_LETTERS = 28
_ROOM = 1.05
WIDEST_PA = 2.07e3
"""The map reaches to the ring of this threshold; those of less pressure would leave nothing to see of the rest."""


def overpressure_map(
    figure: FigureBase,
    charges: Sequence[Charge],
    bridge: CrossSection,
    neighbours: Sequence[Neighbour],
    model: BlastModel,
    pressure_factor: float = 1.0,
    ground: RecordedGround = LEVEL_GROUND,
) -> None:
    """Largest overpressure of any one charge on the ground, with the rings of damage and the ground's contour lines."""
    thresholds = [threshold for threshold in distinct_thresholds() if threshold.overpressure_pa >= WIDEST_PA]
    radii = ring_radii(charges, 0.0, thresholds, model, pressure_factor)
    positions = np.array([charge.position_m[:2] for charge in charges])
    left, back, right, front = bridge.bounds()  # shown even where no ring reaches the ground
    low = np.minimum(positions.min(axis=0) - _ROOM * radii.max(), (left, back))
    high = np.maximum(positions.max(axis=0) + _ROOM * radii.max(), (right, front))
    xs, ys = np.linspace(low[0], high[0], _CELLS), np.linspace(low[1], high[1], _CELLS)
    plan = np.stack(np.meshgrid(xs, ys), axis=-1)
    grid = np.concatenate([plan, ground.heights_at(plan)[..., None]], axis=-1)
    peaks_pa = peak_overpressures(grid.reshape(-1, 3), charges, model, pressure_factor)
    peaks_kpa = peaks_pa.reshape(_CELLS, _CELLS) / 1e3
    axes = figure.add_subplot()
    scale = LogNorm(1.0, max(float(peaks_kpa.max()), 10.0))
    image = axes.imshow(
        peaks_kpa, extent=(*xs[[0, -1]], *ys[[0, -1]]), origin="lower", cmap="Greys", norm=scale, aspect="equal"
    )
    levels = [threshold.overpressure_pa / 1e3 for threshold in thresholds]
    order = np.argsort(levels)
    styles = [line_style(row)["linestyle"] for row in range(len(levels))]
    lines = axes.contour(
        xs, ys, peaks_kpa, levels=np.array(levels)[order], colors=line_style(1)["color"], linestyles=styles
    )
    axes.clabel(lines, fmt=lambda level: Quantity(level, "kPa", "g"), fontsize=6)
    draw_area(axes, bridge, fill=False, edgecolor="black", linewidth=1.0, label=Text("bridge"))
    axes.plot(*positions.T, "k+", markersize=7, label=Text("charge"))
    for neighbour in neighbours:
        if (np.array(neighbour.position_m[:2]) >= low).all() and (np.array(neighbour.position_m[:2]) <= high).all():
            axes.plot(*neighbour.position_m[:2], "k^", markersize=5)
            name_neighbour(axes, neighbour, to_the_left=neighbour.position_m[0] > (low[0] + high[0]) / 2.0)
    draw_ground(axes, ground)
    axes.set(xlabel=Text("x along the road ({})", Unit("m")), ylabel=Text("y across the road ({})", Unit("m")))
    figure.colorbar(image, ax=axes, label=Text("peak overpressure of one charge ({})", Unit("kPa")), shrink=0.9)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False, fontsize=8)


def name_neighbour(axes: Axes, neighbour: Neighbour, *, to_the_left: bool) -> None:
    """Write a neighbour's name next to it, towards the middle of the map, over several lines where it is long."""
    name = fill(plain(neighbour.name), _NAME_LETTERS)
    offset, side = ((-4, 4), "right") if to_the_left else ((4, 4), "left")
    axes.annotate(name, neighbour.position_m[:2], offset, textcoords="offset points", ha=side, fontsize=7)


def neighbour_pressures(figure: FigureBase, loads: Sequence[tuple[str, PlaceLoads]]) -> None:
    """Overpressure of the charges together at neighbours, over time."""
    axes = figure.add_subplot()
    for number, (name, load) in enumerate(loads):
        axes.plot(1e3 * load.times_s, load.pressures_pa / 1e3, **line_style(number, 1.2), label=plain(name))
    axes.set(
        xlabel=Text("time since the start of the blasting (ms)"),
        ylabel=Text("overpressure of all charges ({})", Unit("kPa")),
    )
    axes.set_ylim(bottom=0.0)
    axes.set_xlim(left=0.0)
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=4, frameon=False, fontsize=8)
