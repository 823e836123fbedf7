"""The curve of a search: where success has which probability, most likely and at least or at most."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engineering.search.probit import Trials, fitted, limit
from ...system.disk import whole_file
from .file import Search

PROBABILITIES = (0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99)


@dataclass(frozen=True, slots=True, eq=False)
class SearchCurve:
    """Values of the quantity for k probabilities of success.

    Attributes
    ----------
    probabilities : (k,) float
    values : (k,) float
        Most likely.
    lows, highs : (k,) float
        Limits with the confidence of the search, one from either side; nan where the trials set none.
    """

    probabilities: np.ndarray
    values: np.ndarray
    lows: np.ndarray
    highs: np.ndarray


def curve_of(search: Search, trials: Trials) -> SearchCurve | None:
    """Return the curve after trials, by their levels; None as long as no curve fits."""
    found = fitted(trials)
    if found is None:
        return None
    scale, confidence = search.scale, search.settings.confidence
    values = [scale.value(found.quantile(each)) for each in PROBABILITIES]
    ends = [[scale.value(limit(trials, each, confidence, side)) for side in (-1, 1)] for each in PROBABILITIES]
    finite = np.array([[end if math.isfinite(end) else np.nan for end in pair] for pair in ends])
    low, high = (1, 0) if scale.is_falling else (0, 1)
    return SearchCurve(np.array(PROBABILITIES), np.array(values), finite[:, low], finite[:, high])


def write_curve(curve: SearchCurve, path: Path) -> None:
    """Write a curve as CSV; what is not known is empty."""
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["probability", "value", "lower_limit", "upper_limit"])
        for row in zip(curve.probabilities, curve.values, curve.lows, curve.highs, strict=True):
            rows.writerow([f"{each:.6g}" if math.isfinite(each) else "" for each in row])
