"""What bodies can be coloured by: each quantity with its title, its units and where its values come from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..engineering.geometry.vectors import length
from ..engineering.mechanics.stress import principal_stresses
from ..model.results.frames import Frame


@dataclass(frozen=True, slots=True)
class ContourUnit:
    """A unit that keeps numbers short: values are divided by `size`."""

    name: str
    size: float


@dataclass(frozen=True, slots=True)
class UnitFamily:
    """The units of one kind of quantity, and that in which the user gives a fixed range."""

    steps: tuple[tuple[float, ContourUnit], ...]  # from the largest down, each with the value from which it is used
    of_range: ContourUnit

    def of(self, largest: float) -> ContourUnit:
        """Return the unit for values up to a largest magnitude, in SI."""
        return next((unit for least, unit in self.steps if largest >= least), self.steps[-1][1])


_KILONEWTON, _NEWTON_PER_MM2, _MILLIMETRE, _PERCENT = (
    ContourUnit("kN", 1e3),
    ContourUnit("N/mm²", 1e6),
    ContourUnit("mm", 1e-3),
    ContourUnit("%", 0.01),
)
FORCES = UnitFamily(((1e6, ContourUnit("MN", 1e6)), (1e3, _KILONEWTON), (0.0, ContourUnit("N", 1.0))), _KILONEWTON)
STRESSES = UnitFamily(((1e4, _NEWTON_PER_MM2), (0.0, ContourUnit("kPa", 1e3))), _NEWTON_PER_MM2)
LENGTHS = UnitFamily(((1.0, ContourUnit("m", 1.0)), (0.0, _MILLIMETRE)), _MILLIMETRE)
RATIOS = UnitFamily(((0.0, _PERCENT),), _PERCENT)

BREAKS = 1.0
"""Utilisation above which a connection breaks."""

Values = Callable[[Frame, Frame], np.ndarray]
"""Returns the values (n,) of bodies in a frame, by that frame and the first one."""


def _or_unknown(values: np.ndarray | None, frame: Frame) -> np.ndarray:
    return np.full(len(frame.positions_m), np.nan) if values is None else values


class ContourQuantity(Enum):
    """The quantities, in the order of the sidebar: Blender saves the number of the chosen one.

    `mean` returns values over a frame, nan where there is none; `peak` the largest within it, as far as recorded. The
    colour bar names them by `kind_of_mean` and `kind_of_peak`, which may be empty.
    """

    RESULTANT = (
        "Resultant force",
        "Magnitude of the sum of all contact and connection forces: its mean over each frame, or its largest in any "
        "sub-step with Peak So Far",
        FORCES,
        lambda frame, _: length(frame.loads.body_forces_n),
        lambda frame, _: frame.loads.body_peaks_n,
        ("frame mean", "sub-step peak"),
    )
    SUM = (
        "Sum of forces",
        "Sum of the magnitudes of all contact and connection forces: its mean over each frame, or its largest in any "
        "sub-step with Peak So Far",
        FORCES,
        lambda frame, _: frame.loads.body_sums_n,
        lambda frame, _: frame.loads.body_peak_sums_n,
        ("frame mean", "sub-step peak"),
    )
    VON_MISES = (
        "Von Mises stress",
        "Equivalent stress, averaged over the body",
        STRESSES,
        lambda frame, _: frame.loads.von_mises_pa,
    )
    PRINCIPAL = (
        "Largest principal stress",
        "Largest tension, averaged over the body",
        STRESSES,
        lambda frame, _: principal_stresses(frame.loads.stresses_pa)[:, 0],
    )
    DISPLACEMENT = (
        "Displacement",
        "How far the body is from its position when the recording began; elastic connections carry no load there",
        LENGTHS,
        lambda frame, first: length(frame.positions_m - first.positions_m),
        None,
        ("", "peak"),
    )
    UTILISATION = (
        "Utilisation at rest",
        "Load over strength of the shard's connections at rest, in the stage that the panel Stages shows: above 100 % "
        "one of them breaks",
        RATIOS,
        lambda frame, _: np.full(len(frame.positions_m), np.nan),  # of stages alone
    )
    SIGNED_2019 = (
        "Contact force of 2019",
        "What the add-on of 2019 logged: for comparison only",
        FORCES,
        lambda frame, _: frame.loads.body_signed_2019_n,
        lambda frame, _: abs(frame.loads.body_signed_2019_n),
    )
    BAR_USE = (
        "Use of bars",
        "Largest part of their rupture strain that bars across cracks of the shard use, with elastic connections: at "
        "100 % they rupture",
        RATIOS,
        lambda frame, _: _or_unknown(frame.loads.body_bar_use, frame),
        None,
        ("largest in the frame", "largest"),
    )

    def __init__(
        self,
        title: str,
        tooltip: str,
        units: UnitFamily,
        mean: Values,
        peak: Values | None = None,
        kinds: tuple[str, str] = ("frame mean", "frame mean, peak"),
    ):
        self.title, self.tooltip, self.units = title, tooltip, units
        self.mean, self.peak = mean, peak or mean
        self.kind_of_mean, self.kind_of_peak = kinds
