"""Bodies and connections of a run as its simulation begins, and what is recorded of its frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from ...engineering.arrays import FloatArray, IntArray
from ...engineering.mechanics.frame_loads import FrameLoads
from ...engineering.mechanics.section_cuts import ConnectedFaces
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
        Total impulse of blasts in the frame; it is no part of the loads.
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


@dataclass(frozen=True, slots=True, eq=False)
class Inventory:
    """n bodies and m connections.

    Attributes
    ----------
    body_names, body_kinds : (n,) str
        Names, and kinds: shard, ball, ground, tool, crane.
    masses_kg, volumes_m3 : (n,) float
        Both 0 for a body that never moves.
    body_members, body_member_kinds : (n,) str
        Name and kind of the member that each body was cut from; empty where it was not.
    vertices_m, vertex_counts : (v, 3) float, (n,) int
        Vertices of the bodies, each in its own axes from its origin, and how many each has.
    connection_names, pairs : (m,) str, (m, 2) int
        Names, and indices of the connected bodies.
    points_m, areas_m2, normals : (m, 3), (m,), (m, 3) float
        Middles and areas of the faces, and unit normals from the first body to the second.
    second_moments_m4 : (m, 2, 2) float
        Second moments of these areas about the sections' y and z axes.
    triangles, triangle_counts : (t, 3) int, (n,) int, optional
        Triangles of ground that is not flat and of surfaces on it, one body after the other, each in rows of the body's
        own vertices, and how many each has; all other bodies are convex. None where all are.
    """

    body_names: np.ndarray
    body_kinds: np.ndarray
    masses_kg: np.ndarray
    volumes_m3: np.ndarray
    body_members: np.ndarray
    body_member_kinds: np.ndarray
    vertices_m: np.ndarray
    vertex_counts: np.ndarray
    connection_names: np.ndarray
    pairs: np.ndarray
    points_m: np.ndarray
    areas_m2: np.ndarray
    normals: np.ndarray
    second_moments_m4: np.ndarray
    triangles: np.ndarray | None = None
    triangle_counts: np.ndarray | None = None

    @property
    def moves(self) -> np.ndarray:
        """Return whether each body (n,) can move at all."""
        return self.masses_kg > 0.0

    @property
    def faces(self) -> ConnectedFaces:
        return ConnectedFaces(self.pairs, self.points_m, self.normals, self.areas_m2, self.second_moments_m4)

    def of_kind(self, kind: str) -> np.ndarray:
        """Return the indices of the bodies of a kind."""
        return np.flatnonzero(self.body_kinds == kind)

    def vertices_by_body(self) -> list[np.ndarray]:
        """Return the vertices (v, 3) of every body in its own axes, m; its origin where it has none."""
        parts = np.split(self.vertices_m, np.cumsum(self.vertex_counts)[:-1])
        return [part if len(part) else np.zeros((1, 3)) for part in parts]

    def vertices_of(self, body: int) -> np.ndarray:
        """Return the vertices (v, 3) of a body in its own axes, m; its origin where it has none."""
        if not self.vertex_counts[body]:
            return np.zeros((1, 3))
        first = int(self.vertex_counts[:body].sum())
        return self.vertices_m[first : first + self.vertex_counts[body]]

    def triangles_of(self, body: int) -> np.ndarray:
        """Return the triangles (t, 3) of a body, in rows of its vertices; none of a convex hull."""
        if self.triangle_counts is None or self.triangles is None:
            return np.zeros((0, 3), int)
        first = int(self.triangle_counts[:body].sum())
        return self.triangles[first : first + self.triangle_counts[body]]
