"""The motion of the ground: acceleration, velocity and displacement over time, and its response spectrum."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import FigureBase

from ..engineering.ground_motion import GroundRecord
from ..model.ground_motion.settings import DIRECTIONS, DesignSpectrum
from ..model.ground_motion.sources import design_spectrum, response_spectrum
from ..texts import Text, Unit
from .style import line_style

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
