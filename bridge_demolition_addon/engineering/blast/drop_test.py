"""Where to measure as a weight is dropped, so that its law holds for what a demolition lets fall."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arithmetic import power
from ..arrays import FloatArray

STATIONS = 8
"""With eight the band is 1.3 times as wide as with very many: t of six degrees of freedom is 2.45."""

_MARGIN = 1.25
"""Of the nearest and the farthest scaled distance, to be sure that they are within those that are measured."""


def station_distances_m(scaled: Sequence[float], energy_kj: float) -> FloatArray:
    """Return distances (8,) from a weight that lands with an energy, evenly in ratio.

    They have all scaled distances R / √E in m/√kJ between them, those of the demolition's neighbours.
    """
    nearest, farthest = min(scaled) / _MARGIN, max(scaled) * _MARGIN
    between = nearest * power(farthest / nearest, np.linspace(0.0, 1.0, STATIONS))
    distances: FloatArray = between * np.sqrt(energy_kj)
    return distances
