"""Influence lines of continuous beams of constant stiffness, and the worst that loads do that move along them.

An influence line says the effect of a unit load by its position: a moment, a shear force or a reaction. Moments are
positive where they pull the underside.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..arrays import FloatArray

_ELEMENTS = 64
_MOST_ELEMENTS = 960
_FEWEST_ELEMENTS = 4
_OF_OVERHANG = 8
_RIGID = 1e12
"""Stiffness of supports, by that of the beam over its span cubed."""


_ROUNDING_M = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class InfluenceLines:
    """Lines of a beam with n points along it and r supports, for unit loads at the points."""

    points_m: FloatArray  # (n,)
    moments: FloatArray  # (n, n), at each point, m
    shears: FloatArray  # (n - 1, n), between each point and the next, a plain number
    reactions: FloatArray  # (r, n), upwards

    @property
    def between_m(self) -> FloatArray:
        """Middles (n - 1,) between each point and the next, where shears are."""
        return 0.5 * (self.points_m[1:] + self.points_m[:-1])


@dataclass(frozen=True, slots=True)
class MovingLoad:
    """Axles at fixed distances, and a load by length that stands where it is worst."""

    axles_n: tuple[float, ...] = ()
    offsets_m: tuple[float, ...] = ()
    uniform_n_m: float = 0.0
    hogging_only: bool = False  # counts for moments over supports and reactions alone
    clear_m: float = 0.0  # least distance of any axle from the ends; with 0 some may be off the beam


def influence_lines(supports_m: Sequence[float], begin_m: float, end_m: float) -> InfluenceLines:
    """Return the lines of a beam over supports; one of a single support is clamped there.

    Beam elements of Bernoulli are exact at their nodes for loads at these.
    """
    points, supports = _points(supports_m, begin_m, end_m)
    count, lengths = len(points), np.diff(points)
    banded = np.zeros((4, 2 * count))
    for element, length in enumerate(lengths):
        _add(banded, 2 * element, _element(length))
    mean = float(lengths.mean())
    banded[0, 2 * supports] += _RIGID / mean**3
    if len(supports) == 1:
        banded[0, 2 * supports + 1] += _RIGID / mean
    loads = np.zeros((2 * count, count))
    loads[2 * np.arange(count), np.arange(count)] = -1.0
    moved = _solved(banded, loads).reshape(count, 2, count)
    moments, shears = _section_forces(lengths, moved)
    # What a support carries follows from the shears on both sides of it: the penalty's own force has fewer digits.
    beside = np.concatenate((np.zeros((1, count)), shears, np.zeros((1, count))))
    reactions = beside[supports + 1] - beside[supports] + np.eye(count)[supports]
    return InfluenceLines(points, moments, shears, reactions)


def _points(supports_m: Sequence[float], begin_m: float, end_m: float) -> tuple[FloatArray, np.ndarray]:
    """Points along a beam, with one at each support, and which are the supports."""
    elements = max(_FEWEST_ELEMENTS, min(_ELEMENTS, _MOST_ELEMENTS // max(len(supports_m) - 1, 1)))
    ends = [begin_m, *supports_m, end_m]
    points, supports = [ends[0]], []
    for number, (start, end) in enumerate(pairwise(ends)):
        if end - start > _ROUNDING_M:
            inner = 0 < number < len(ends) - 2
            parts = elements if inner or len(supports_m) == 1 else _OF_OVERHANG
            points += np.linspace(start, end, parts + 1)[1:].tolist()
        if number < len(supports_m):
            supports.append(len(points) - 1)
    return np.array(points), np.array(supports)


def _element(length: float) -> FloatArray:
    """Stiffness (4, 4) of an element with E I = 1: deflection upwards and rotation at both ends."""
    a, b = 12.0 / length**3, 6.0 / length**2
    c, d = 4.0 / length, 2.0 / length
    return np.array([[a, b, -a, b], [b, c, -b, d], [-a, -b, a, -b], [b, d, -b, c]])


def _add(banded: FloatArray, first: int, element: FloatArray) -> None:
    for row in range(4):
        for column in range(row + 1):
            banded[row - column, first + column] += element[row, column]


def _solved(banded: FloatArray, loads: FloatArray) -> FloatArray:
    """Return displacements (d, n) under loads (d, n), by the diagonal of the stiffness and those below it (4, d).

    L D L^T without pivots, in one order on every processor.
    """
    moved, last = loads.copy(), banded.shape[1] - 1
    factors = np.zeros((last + 1, 3))
    for row in range(last + 1):
        below = min(3, last - row)
        factors[row, :below] = banded[1 : 1 + below, row] / banded[0, row]
        for other in range(below):
            banded[: below - other, row + 1 + other] -= factors[row, other] * banded[1 + other : 1 + below, row]
        moved[row + 1 : row + 1 + below] -= factors[row, :below, None] * moved[row]
    moved /= banded[0, :, None]
    for row in range(last - 1, -1, -1):
        for other in range(min(3, last - row)):
            moved[row] -= factors[row, other] * moved[row + 1 + other]
    return moved


def _section_forces(lengths: FloatArray, moved: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Moments (n, n) at all points and shears (n - 1, n) between them, of displacements (n, 2, n)."""
    (left, left_turn), (right, right_turn) = moved[:-1].swapaxes(0, 1), moved[1:].swapaxes(0, 1)
    length = lengths[:, None]
    slope = (right - left) / length
    at_left = (6.0 * slope - 4.0 * left_turn - 2.0 * right_turn) / length
    at_right = (-6.0 * slope + 2.0 * left_turn + 4.0 * right_turn) / length
    moments = np.concatenate((at_left, at_right[-1:]))
    shears: FloatArray = (at_right - at_left) / length
    return moments, shears


def permanent_effects(points_m: FloatArray, lines: FloatArray, uniform_n_m: float) -> FloatArray:
    """Return the effects (s,) of a load over the whole beam, of influence lines (s, n)."""
    return uniform_n_m * _areas(points_m, lines)


def _areas(points_m: FloatArray, lines: FloatArray) -> FloatArray:
    """Return the areas (s,) under lines (s, n), by trapezoids."""
    areas: FloatArray = (0.5 * (lines[:, 1:] + lines[:, :-1]) * np.diff(points_m)).sum(axis=1)
    return areas


def extreme_effects(
    points_m: FloatArray, lines: FloatArray, loads: Sequence[MovingLoad]
) -> tuple[FloatArray, FloatArray]:
    """Return the least and the largest effects (s,) of moving loads, of influence lines (s, n); at most and at least 0.

    One of the loads acts, either way round, with one axle after the other at each point. Parts of it that would
    relieve are left out.
    """
    largest, least = np.zeros(len(lines)), np.zeros(len(lines))
    raising, lowering = np.maximum(lines, 0.0), np.minimum(lines, 0.0)
    for load in loads:
        positions = _positions(points_m, load)
        up = (raising @ positions.T).max(axis=1, initial=0.0)
        down = (lowering @ positions.T).min(axis=1, initial=0.0)
        up += load.uniform_n_m * _areas(points_m, raising)
        down += load.uniform_n_m * _areas(points_m, lowering)
        least = np.minimum(least, down)
        largest = largest if load.hogging_only else np.maximum(largest, up)
    return least, largest


def _positions(points_m: FloatArray, load: MovingLoad) -> FloatArray:
    """Loads (p, n) at the points for all positions of the axles: a load between two points is shared by both."""
    if not load.axles_n:
        return np.zeros((1, len(points_m)))
    axles, offsets = np.array(load.axles_n), np.array(load.offsets_m)
    rows = []
    for distances in (offsets, -offsets):
        stops = points_m
        if load.clear_m:
            stops = np.concatenate((points_m, (points_m[0] + load.clear_m, points_m[-1] - load.clear_m)))
        places = (stops[:, None] - distances[None, :]).ravel()[:, None] + distances[None, :]
        if load.clear_m:
            low, high = points_m[0] + load.clear_m - _ROUNDING_M, points_m[-1] - load.clear_m + _ROUNDING_M
            places = places[((places >= low) & (places <= high)).all(axis=1)]
        rows.append(_shared(points_m, places, axles))
    return np.concatenate(rows)


def _shared(points_m: FloatArray, places: FloatArray, axles: FloatArray) -> FloatArray:
    slack = 1e-9 * (points_m[-1] - points_m[0])
    on_beam = (places >= points_m[0] - slack) & (places <= points_m[-1] + slack)
    after = np.clip(np.searchsorted(points_m, places), 1, len(points_m) - 1)
    share = np.clip((places - points_m[after - 1]) / (points_m[after] - points_m[after - 1]), 0.0, 1.0)
    loads = np.zeros((len(places), len(points_m)))
    rows = np.broadcast_to(np.arange(len(places))[:, None], places.shape)
    np.add.at(loads, (rows, after), axles * share * on_beam)
    np.add.at(loads, (rows, after - 1), axles * (1.0 - share) * on_beam)
    return loads
