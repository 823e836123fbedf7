"""The law of a site: how its ground carries vibration, by events that were measured there.

v = K (R / √S)^-b is fitted to them as a straight line in logarithms, with R the distance and S the size of an event:
the charge within a delay in kg, or the energy of a fall in kJ. Form: Nicholls, Johnson and Duvall, USBM Bulletin 656
(1971); line and band: International Society of Explosives Engineers, Blasters' Handbook, 18th edition (2011), chapter
on vibration, with the limits of prediction of `statistics.line`. With energies above those that were measured, a root
is on the safe side of the cube root of Zhou's formula.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import BlastError
from ..arithmetic import exponential, logarithm, power
from ..arrays import FloatArray
from ..statistics.line import FittedLine, fitted_line

FEWEST_EVENTS = 5
"""With fewer, the band is so wide that it says nothing: with four, t is 4.3 and with three it is 12.7."""

CONFIDENCE = 0.95
"""Part of new events that lie within the band."""

LEAST_RATIO = 1.5
"""Of the farthest scaled distance to the nearest: events that are closer to each other give no slope."""

_TINY = 1e-300


@dataclass(frozen=True, slots=True)
class SiteLaw:
    """A fitted law, with what it was fitted to.

    Attributes
    ----------
    velocity_m_s : float
        K, the peak particle velocity at a scaled distance of 1.
    exponent : float
        b.
    scatter : float
        Standard deviation of the natural logarithm of the velocities about the law.
    events : int
    nearest, farthest : float
        Scaled distances of the events, in m/√kg or m/√kJ.
    middle, spread : float
        Geometric mean of these distances, and the standard deviation of their natural logarithms.
    """

    velocity_m_s: float
    exponent: float
    scatter: float
    events: int
    nearest: float
    farthest: float
    middle: float
    spread: float

    @property
    def line(self) -> FittedLine:
        """Return the line of the natural logarithms."""
        logs = [float(logarithm(value)) for value in (self.velocity_m_s, self.middle)]
        return FittedLine(logs[0], -self.exponent, self.scatter, self.events, logs[1], self.spread)

    def velocity(self, distance_m: ArrayLike, size: ArrayLike) -> FloatArray:
        """Return the peak particle velocity, m/s, that half of the events of a size stay below at a distance."""
        return exponential(self.line.at(_logs_of(distance_m, size)))

    def at_most(self, distance_m: ArrayLike, size: ArrayLike) -> FloatArray:
        """Return the upper line of the band, m/s."""
        return self._edge(distance_m, size, 1.0)

    def at_least(self, distance_m: ArrayLike, size: ArrayLike) -> FloatArray:
        """Return the lower line of the band, m/s."""
        return self._edge(distance_m, size, -1.0)

    def covers(self, distance_m: float, size: float) -> bool:
        """Return whether a scaled distance is within those that were measured; elsewhere the law is extrapolated."""
        return self.nearest <= scaled_by_root(distance_m, size) <= self.farthest

    def _edge(self, distance_m: ArrayLike, size: ArrayLike, sign: float) -> FloatArray:
        logs = _logs_of(distance_m, size)
        return exponential(self.line.at(logs) + sign * self.line.half_band(logs, CONFIDENCE))


def scaled_by_root(distance_m: float, size: float) -> float:
    """Return the scaled distance R / √S; infinite for a size of 0."""
    return float(distance_m / np.sqrt(size)) if size > 0.0 else np.inf


def fitted_law(distances_m: ArrayLike, sizes: ArrayLike, velocities_m_s: ArrayLike) -> SiteLaw:
    """Return the law of events (n,): their distances, sizes in kg or kJ, and peak particle velocities.

    Raises
    ------
    BlastError
        With too few events, with numbers that are not above 0, where distances scarcely differ, or where velocities do
        not fall with the distance.
    """
    columns = [np.asarray(values, float) for values in (distances_m, sizes, velocities_m_s)]
    if not all((np.isfinite(values) & (values > 0.0)).all() for values in columns):
        raise BlastError("events need distances, sizes and velocities that are numbers above 0")
    if len(columns[0]) < FEWEST_EVENTS:
        raise BlastError(f"too few events, {len(columns[0])}: expected at least {FEWEST_EVENTS}")
    logs, heights = _logs_of(columns[0], columns[1]), logarithm(columns[2])
    scaled = columns[0] / np.sqrt(columns[1])
    nearest, farthest = float(scaled.min()), float(scaled.max())
    if farthest < LEAST_RATIO * nearest:
        raise BlastError(
            f"all events are at nearly one scaled distance, {nearest:.3g} to {farthest:.3g}: expected the farthest at "
            f"least {LEAST_RATIO:g} times the nearest"
        )
    line = fitted_line(logs, heights)
    if line.slope >= 0.0:
        raise BlastError("velocities do not fall with the distance: expected events of one source, in one unit")
    return SiteLaw(
        velocity_m_s=float(exponential(line.intercept)),
        exponent=-line.slope,
        scatter=line.scatter,
        events=line.points,
        nearest=nearest,
        farthest=farthest,
        middle=float(exponential(line.middle)),
        spread=line.spread,
    )


def _logs_of(distance_m: ArrayLike, size: ArrayLike) -> FloatArray:
    """Return logarithms of scaled distances; a size of 0 is as far as can be."""
    return logarithm(np.asarray(distance_m, float)) - 0.5 * logarithm(np.maximum(np.asarray(size, float), _TINY))


STATIONS = 8
"""With eight the band is 1.3 times as wide as with very many: t of six degrees of freedom is 2.45."""

_MARGIN = 1.25
"""Of the nearest and the farthest scaled distance, to be sure that they are within those that are measured."""


def station_distances_m(scaled: Sequence[float], energy_kj: float) -> FloatArray:
    """Return distances (8,) from a weight that lands with an energy, evenly in ratio.

    They have all scaled distances R / √E in m/√kJ between them, the demolition's neighbours.
    """
    nearest, farthest = min(scaled) / _MARGIN, max(scaled) * _MARGIN
    between = nearest * power(farthest / nearest, np.linspace(0.0, 1.0, STATIONS))
    distances: FloatArray = between * np.sqrt(energy_kj)
    return distances
