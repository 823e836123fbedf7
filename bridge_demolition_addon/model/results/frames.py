"""What is recorded of a frame, and of all frames of a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from ...engineering.arrays import FloatArray, IntArray
from ...engineering.mechanics.frame_loads import FrameLoads
from ...engineering.mechanics.work import FrameWork

_Count = TypeVar("_Count", int, IntArray)
_Number = TypeVar("_Number", float, FloatArray)


@dataclass(frozen=True, slots=True, eq=False)
class _Recorded(Generic[_Count, _Number]):
    """n bodies and m connections at the end of a frame, and the loads in it. All vectors are in the world's axes.

    Attributes
    ----------
    number : int
        Blender's frame.
    time_s, substep_s : float
        Simulated time since the start, and length of the sub-steps before; 0 for the first frame.
    positions_m, rotations : (n, 3) float, (n, 3, 3) float
        Centres of mass and rotation matrices.
    velocities_m_s, angular_velocities_rad_s : (n, 3) float
    asleep : (n,) bool
        Bodies that are not simulated because they rest; they keep the loads that they fell asleep with.
    intact : (m,) bool
        Whether each connection holds.
    blast_impulses_ns : (n, 3) float
        Impulse of all blasts in the frame; it is no part of the loads.
    """

    number: _Count
    time_s: _Number
    substep_s: _Number
    positions_m: np.ndarray
    rotations: np.ndarray
    velocities_m_s: np.ndarray
    angular_velocities_rad_s: np.ndarray
    asleep: np.ndarray
    intact: np.ndarray
    blast_impulses_ns: np.ndarray
    loads: FrameLoads
    work: FrameWork[_Number]


class Frame(_Recorded[int, float]):
    __slots__ = ()


class FrameSeries(_Recorded[IntArray, FloatArray]):
    """k frames: every array of `Frame`, also of its loads, with one more axis in front, such as `time_s` (k,)."""

    __slots__ = ()

    @classmethod
    def of(cls, frames: Sequence[Frame]) -> FrameSeries:
        """Put frames one after another; there has to be one."""
        return cls(*(_stacked([getattr(frame, field.name) for frame in frames]) for field in fields(Frame)))

    def __len__(self) -> int:
        return len(self.number)

    def __getitem__(self, row: int) -> Frame:
        return Frame(*(_row(getattr(self, field.name), row) for field in fields(Frame)))


@dataclass(frozen=True, slots=True, eq=False)
class BallHistory:
    """Impulses (s, b, 3) of the contacts of b balls in each of s sub-steps, and their velocities (s, b, 3) after it.

    `bodies` (b,) are indices of the balls, `times_s` (s,) the ends of sub-steps.
    """

    bodies: np.ndarray
    times_s: np.ndarray
    impulses_ns: np.ndarray
    velocities_m_s: np.ndarray

    @classmethod
    def unknown(cls) -> BallHistory:
        return cls(np.zeros(0, int), np.zeros(0), np.zeros((0, 0, 3)), np.zeros((0, 0, 3)))


@dataclass(frozen=True, slots=True, eq=False)
class ContactHistory:
    """The c contact points that carried a load in the last sub-steps of frames.

    `frames` (c,) are Blender's, in ascending order. Two `bodies` (c, 2) touch at `places_m` (c, 3), as the sub-step
    began, on the second body. `normals` (c, 3) point from the second body to the first. The impulses, along the normals
    (c,) and of friction (c, 3), are those on the first bodies; the second ones get the opposite.
    """

    frames: np.ndarray
    bodies: np.ndarray
    places_m: np.ndarray
    normals: np.ndarray
    normal_impulses_ns: np.ndarray
    friction_impulses_ns: np.ndarray

    @classmethod
    def none(cls) -> ContactHistory:
        vectors = np.zeros((0, 3))
        return cls(np.zeros(0, int), np.zeros((0, 2), int), vectors, vectors, np.zeros(0), vectors)

    @property
    def impulses_ns(self) -> np.ndarray:
        """Return the whole impulses (c, 3) on the first bodies."""
        return self.normal_impulses_ns[:, None] * self.normals + self.friction_impulses_ns

    def of_frame(self, number: int) -> ContactHistory:
        """Return the contacts of one of Blender's frames."""
        first, last = np.searchsorted(self.frames, (number, number + 1))
        return ContactHistory(*(getattr(self, field.name)[first:last] for field in fields(self)))

    def __len__(self) -> int:
        return len(self.frames)


def _stacked(parts: Sequence[Any]) -> Any:
    """Put numbers, arrays, or dataclasses of them into arrays with one more axis in front; None stays."""
    if parts[0] is None:
        return None
    if not is_dataclass(parts[0]):
        return np.array(parts)
    kind: type[Any] = type(parts[0])
    return kind(*(_stacked([getattr(part, field.name) for part in parts]) for field in fields(kind)))


def _row(series: Any, row: int) -> Any:
    if series is None:
        return None
    if not is_dataclass(series):
        return series[row]
    kind: type[Any] = type(series)
    return kind(*(_row(getattr(series, field.name), row) for field in fields(kind)))
